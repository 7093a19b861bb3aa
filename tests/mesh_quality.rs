//! Claim: meshes.
use gearwear::gear::*;
use gearwear::mesh::*;
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

#[test]
fn probe_many() {
    let rack = |m, rf| BasicRack {
        fillet_radius: rf,
        ..BasicRack::iso53_a(m)
    };
    for (z, m, x, bore, rf, tipr, sp) in [
        (16, 4.5, 0.1817, 30.0, 0.38, 0.0, 0.02),
        (24, 4.5, 0.1715, 40.0, 0.38, 0.0, 0.02),
        (30, 2.0, 0.0, 30.0, 0.38, 0.0, 0.011),
        (16, 2.0, 0.0, 12.0, 0.38, 0.0, 0.011),
        (12, 2.0, 0.0, 12.0, 0.38, 0.0, 0.011),
        (8, 2.0, 0.2, 5.0, 0.38, 0.0, 0.011),
        (100, 1.0, 0.0, 40.0, 0.38, 0.0, 0.011),
        (27, 2.0, 0.0, 25.0, 0.0, 0.0, 0.011),
        (27, 2.0, 0.0, 25.0, 0.1, 0.0, 0.011),
        (27, 2.0, 0.0, 25.0, 0.38, 0.1, 0.011),
        (27, 2.0, 0.0, 25.0, 0.38, 0.005, 0.011),
        (27, 2.0, 0.0, 46.0, 0.38, 0.0, 0.011),
        (27, 2.0, 0.0, 25.0, 0.38, 0.0, 0.1),
        (27, 2.0, 0.0, 25.0, 0.38, 0.0, 0.003),
        (27, 2.0, 0.0, 25.0, 0.45, 0.3, 0.02),
        (27, 2.0, 0.9, 25.0, 0.38, 0.0, 0.02),
        (27, 2.0, -0.4, 25.0, 0.2, 0.02, 0.02),
        (200, 2.0, 0.5, 25.0, 0.38, 0.0, 0.02),
    ] {
        let gear = match Gear::new(
            rack(m, rf),
            ToothSpec {
                profile_shift: x,
                tip_rounding: tipr,
                ..ToothSpec::plain(z, bore)
            },
        ) {
            Ok(g) => g,
            Err(e) => {
                println!("z {z} {e}");
                continue;
            }
        };
        for (teeth, order) in [(vec![-1, 0, 1, 2], Order::T6), (vec![], Order::T3)] {
            let spec = MeshSpec {
                min_angle_deg: 0.0,
                order,
                ..MeshSpec::new(&gear, teeth, sp, gear.rho_form)
            };
            let t0 = std::time::Instant::now();
            match mesh_gear(&gear, &spec) {
                Ok(mesh) => {
                    let q = Quality::of(&mesh);
                    println!(
                        "z {z} m {m} x {x} rf {rf} tip {tipr} sp {sp}: {:?} nodes {} el {} angle {:.2} {:.2} asp {:.2} jac {:.2} grad {:.2} undercut {}",
                        t0.elapsed(),
                        q.nodes,
                        q.elements,
                        q.min_angle_deg,
                        q.angle_1pct,
                        q.max_aspect,
                        q.min_scaled_jacobian,
                        q.max_gradation,
                        gear.undercut
                    )
                }
                Err(e) => println!("z {z} m {m} x {x} rf {rf} tip {tipr} sp {sp}: {e}"),
            }
        }
    }
}
#[test]
fn probe_where() {
    for (z, m, x, bore, sp) in [
        (200, 2.0, 0.5, 25.0, 0.02),
        (27, 2.0, 0.9, 25.0, 0.02),
        (100, 1.0, 0.0, 40.0, 0.011),
        (12, 2.0, 0.0, 12.0, 0.011),
    ] {
        let gear = Gear::new(
            BasicRack::iso53_a(m),
            ToothSpec {
                profile_shift: x,
                ..ToothSpec::plain(z, bore)
            },
        )
        .unwrap();
        let spec = MeshSpec {
            min_angle_deg: 0.0,
            ..MeshSpec::new(&gear, vec![0], sp, gear.rho_form)
        };
        let mesh = mesh_gear(&gear, &spec).unwrap();
        for (i, p) in mesh.points.iter().enumerate().take(24) {
            println!("# {i} {:.4} {:.5}", p.norm(), p.y.atan2(p.x));
        }
        println!(
            "# z {z} root {} form {} tip {}",
            gear.root_radius, gear.form_radius, gear.tip_radius
        );
        let mut worst: Vec<_> = mesh
            .corners()
            .iter()
            .map(|t| {
                let p = t.map(|k| mesh.points[k as usize]);
                let l = [
                    (p[1] - p[0]).norm(),
                    (p[2] - p[1]).norm(),
                    (p[0] - p[2]).norm(),
                ];
                let s = l.iter().cloned().fold(f64::INFINITY, f64::min);
                let a = (p[1] - p[0]).perp(&(p[2] - p[0]));
                let c = (p[0] + p[1] + p[2]) / 3.0;
                let tt = *t;
                let big = l[0] * l[1] * l[2] / s;
                (
                    (a / big).asin().to_degrees(),
                    c.norm(),
                    c.y.atan2(c.x) / gear.pitch_angle(),
                    l,
                    tt,
                )
            })
            .collect();
        worst.sort_by(|a, b| a.0.total_cmp(&b.0));
        for w in &worst[..8] {
            println!("# {w:.3?}");
        }
    }
}
#[test]
fn probe_relocate() {
    let gear = Gear::new(BasicRack::iso53_a(2.0), ToothSpec::plain(27, 25.0)).unwrap();
    let spec = MeshSpec::new(&gear, vec![-1, 0], 0.011, 3.8);
    let mesh = mesh_gear(&gear, &spec).unwrap();
    for depth in [0.0, 0.015, 0.05, 0.1] {
        let depths: Vec<Vec<f64>> = mesh.flanks.iter().map(|f| f.arc.iter().map(|s| depth * ((s - f.arc[0]) / 0.3).min(1.0) * (1.0 + 0.3 * (s * 4.0).sin())).collect()).collect();
        let t0 = std::time::Instant::now();
        match relocate(&mesh, &gear, &depths) {
            Ok(m) => println!("# {depth} {:?} {:?} {}", t0.elapsed(), Quality::of(&m), outer_area(&mesh) - outer_area(&m)),
            Err(e) => println!("# {depth} {e}"),
        }
    }
}
