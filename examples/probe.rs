//! scratch
use gearwear::gear::{BasicRack, Gear, ToothSpec};
use gearwear::material::Elastic;
use gearwear::simulate::forward::{Conditions, Forward, GearSet};
use gearwear::simulate::history::line_load;
use gearwear::simulate::numerics::Numerics;
use std::time::Instant;

fn set() -> GearSet {
    let rack = BasicRack {
        module: 2.0,
        pressure_angle: 20f64.to_radians(),
        addendum: 1.0,
        dedendum: 1.25,
        fillet_radius: 0.38,
    };
    let gear = |z, bore| Gear::new(rack, ToothSpec::plain(z, bore)).unwrap();
    let steel = Elastic {
        youngs_modulus: 2.1e5,
        poisson_ratio: 0.3,
    };
    GearSet {
        gears: [gear(27, 25.0), gear(53, 40.0)],
        materials: [steel; 2],
        centre_distance: 80.0,
        face_width: 33.0,
    }
}

fn main() {
    faer::set_global_parallelism(faer::Par::Seq);
    let arg = |i: usize, d: f64| std::env::args().nth(i).map_or(d, |s| s.parse().unwrap());
    let numerics = Numerics {
        elements_per_half_width: arg(1, 8.0),
        positions: arg(2, 150.0) as usize,
        step_tolerance: arg(3, 2e-3),
        ..Numerics::default()
    };
    let set = set();
    let t = Instant::now();
    let members = set
        .members(&numerics, &[100e3, 170e3], &[0.0, 0.5])
        .unwrap();
    println!(
        "members {:?} spacing {} nodes {:?}",
        t.elapsed(),
        members.spacing(),
        members.members.each_ref().map(|m| m.mesh.points.len())
    );
    let t = Instant::now();
    let conditions = Conditions {
        torque: 100e3,
        speed: 2000.0,
        misalignment: 0.0,
        cycles: 1e6,
        coefficient: [2.37e-10; 2],
    };
    let forward = Forward::new(&set, Some(&members), conditions, numerics).unwrap();
    println!(
        "cycle {:?} stations {}",
        t.elapsed(),
        forward.cycle().stations.count()
    );
    let t = Instant::now();
    let contacts: Vec<_> = forward.with_model(|m| {
        (0..numerics.positions)
            .map(|q| {
                m.solve(
                    q,
                    [
                        &vec![0.0; m.cycle().stations.arc[0].len()],
                        &vec![0.0; m.cycle().stations.arc[1].len()],
                    ],
                    &[],
                )
                .unwrap()
            })
            .collect()
    });
    println!("contacts {:?}", t.elapsed());
    let base = forward.torque() / forward.cycle().pair.pinion.base_radius;
    for (position, contact) in forward.cycle().positions.iter().zip(&contacts) {
        print!(
            "{:.4} te {:.2} it {}",
            position.theta,
            contact.approach * 1e6,
            contact.iterations
        );
        for pair in &position.pairs {
            let w = line_load(pair, contact);
            let p = contact.pressure[pair.offset..pair.offset + pair.xi.len()]
                .iter()
                .fold(0.0, |m: f64, p| m.max(*p));
            print!(
                "   {:+.3} {:?} {:.4} p {:.1}",
                pair.path,
                pair.frame.touch,
                w / base,
                p
            );
        }
        println!();
    }
    let tests: [(&str, f64, f64, &[f64]); 4] = [
        ("A", 100e3, 0.0, &[1e5, 2.5e5, 5e5, 7.5e5, 1e6]),
        ("B", 170e3, 0.0, &[8e4, 2e5, 4e5, 6e5, 8e5]),
        ("D", 170e3, 0.5, &[8e4, 2e5, 4e5, 6e5, 8e5]),
        ("S", 140e3, 0.3, &[1.2e6]),
    ];
    let k = arg(4, 2.004e-10);
    use std::io::Write;
    let mut f =
        std::fs::File::create(std::env::args().nth(5).unwrap_or("/tmp/depth.csv".into())).unwrap();
    for (id, torque, misalignment, stops) in tests {
        let t = Instant::now();
        let c = Conditions {
            torque,
            misalignment,
            coefficient: [k; 2],
            ..conditions
        };
        let mut forward = Forward::new(&set, Some(&members), c, numerics).unwrap();
        let t1 = t.elapsed();
        let t = Instant::now();
        let (mut progress, mut states) = (None, Vec::new());
        let done = forward.wear(
            &mut progress,
            stops,
            &mut |r| {
                if id == "A" {
                    println!(
                        "n {:.0} step {:.0} max {:?} bal {:.2e} solves {} rej {}",
                        r.stand.n,
                        r.stand.step,
                        r.max_depth,
                        r.balance.error(),
                        r.solves,
                        r.stand.rejected
                    );
                }
                true
            },
            &mut |s| states.push(s),
        );
        let p = progress.unwrap();
        println!(
            "{id} setup {t1:?} wear {:?} {done:?} steps {} rej {} bal {:.2e}",
            t.elapsed(),
            p.stand.accepted,
            p.stand.rejected,
            p.balance.error()
        );
        for s in &states {
            for side in 0..2 {
                let g = &set.gears[side];
                for (a, d) in forward.cycle().stations.arc[side]
                    .iter()
                    .zip(&s.depth[side])
                {
                    writeln!(
                        f,
                        "{id},{},{side},{},{}",
                        s.cycles,
                        g.radius_at_rho(g.rho_at_arc(*a)),
                        d * 1e3
                    )
                    .unwrap();
                }
            }
        }
    }
}
