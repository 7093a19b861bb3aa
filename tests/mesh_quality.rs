//! Claim: meshes.
use gearwear::mesh::*;
use gearwear::numeric::Vec2;

#[test]
fn probe_ring() {
    // a ring with a fine stretch
    let n = 900;
    let mut pts = vec![];
    let r = 20.0;
    for i in 0..n {
        let a = f64::from(i) / f64::from(n) * 0.5;
        pts.push(r * Vec2::new(a.cos(), a.sin()));
    }
    let mut a: f64 = 0.5;
    let mut h = 0.011 / r;
    while a < 6.28 - h {
        pts.push(r * Vec2::new(a.cos(), a.sin()));
        h = (0.011 / r * 1.0 + 0.25 * (a - 0.5).min(6.2832 - a).max(0.0)).min(0.05);
        a += h;
    }
    println!("gap {}", (pts[pts.len() - 1] - pts[0]).norm());
    let outline = Outline {
        loops: vec![Loop::polygon(pts), Loop::circle(10.0, 60, true)],
    };
    let t0 = std::time::Instant::now();
    let field = SizeField::of_outline(&outline, 0.3, 2.0);
    for rounds in [0, 1, 2, 4, 8] {
        let t0 = std::time::Instant::now();
        let m = triangulate(
            &outline,
            &|x| field.size(x),
            &TriangulateOptions {
                rounds,
                min_angle_deg: 0.0,
                ..Default::default()
            },
        )
        .unwrap();
        let el = t0.elapsed();
        let (points, cells, _) = raise_order(&m, &outline, Order::T6);
        let mesh = Mesh {
            points,
            cells,
            flanks: vec![],
            bore: vec![],
        };
        let q = Quality::of(&mesh);
        println!("{rounds} {el:?} {q:?}");
    }
    println!("{:?}", t0.elapsed());
}

use gearwear::gear::*;
#[test]
fn probe_gear() {
    for (z, bore, from) in [(27, 25.0, 3.8), (53, 40.0, 13.0)] {
        let gear = Gear::new(BasicRack::iso53_a(2.0), ToothSpec::plain(z, bore)).unwrap();
        println!(
            "rho {} {} {}",
            gear.rho_form,
            gear.rho_end,
            gear.arc(gear.rho_end) - gear.arc(from)
        );
        let spec = MeshSpec::new(&gear, vec![-1, 0], 0.011, from);
        for _ in 0..2 {
            let t0 = std::time::Instant::now();
            let mesh = mesh_gear(&gear, &spec).unwrap();
            println!(
                "{:?} {:?} {}",
                t0.elapsed(),
                Quality::of(&mesh),
                mesh.bore.len()
            );
        }
    }
}
