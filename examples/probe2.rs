//! scratch
use gearwear::gear::{BasicRack, Gear, ToothSpec};
use gearwear::material::Elastic;
use gearwear::simulate::forward::{Conditions, Forward, GearSet, Preparation};
use gearwear::simulate::numerics::Numerics;

fn main() {
    faer::set_global_parallelism(faer::Par::Seq);
    let k: f64 = std::env::args()
        .nth(1)
        .map_or(4.7e-10, |s| s.parse().unwrap());
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
    let set = GearSet {
        gears: [gear(27, 25.0), gear(53, 40.0)],
        materials: [steel; 2],
        densities: [7850.0; 2],
        centre_distance: 80.0,
        face_width: 33.0,
    };
    let numerics = Numerics::default();
    let members = set.members(&numerics, &[100e3], &[0.0]).unwrap();
    let c = Conditions {
        torque: 100e3,
        speed: 2000.0,
        misalignment: 0.0,
        cycles: 1e6,
        coefficient: [k; 2],
    };
    let mut forward = Forward::new(&set, Some(&members), c, numerics).unwrap();
    let mut progress = None;
    forward
        .wear_to(&mut progress, 1e6, &mut |_, _| true)
        .unwrap();
    let p = progress.unwrap();
    println!(
        "max {:?} condensed {:?} solves {} steps {}",
        p.max_depth,
        forward.preparation().condensed_at.is_some(),
        p.solves,
        p.stand.accepted
    );
    let before = forward.state(&p).unwrap();
    forward
        .prepare(&Preparation {
            condensed_at: Some(p.stand.u.clone()),
            ..forward.preparation()
        })
        .unwrap();
    let after = forward.state(&p).unwrap();
    let mut worst: (f64, f64, f64, f64) = (0.0, 0.0, 0.0, 0.0);
    for (q, (a, b)) in before.contacts.iter().zip(&after.contacts).enumerate() {
        worst.0 = worst.0.max((b.approach / a.approach - 1.0).abs());
        for pair in &forward.cycle().positions[q].pairs {
            let own = pair.offset..pair.offset + pair.xi.len();
            let pk = |c: &[f64]| c[own.clone()].iter().fold(0.0, |m: f64, x| m.max(*x));
            let (x, y) = (pk(&a.pressure), pk(&b.pressure));
            let edge = a.pressure[own.start] > 0.0 || a.pressure[own.end - 1] > 0.0;
            let l = |c: &[f64]| {
                pair.length
                    .iter()
                    .zip(&c[own.clone()])
                    .map(|(l, p)| l * p)
                    .sum::<f64>()
            };
            worst.1 = worst
                .1
                .max((l(&a.pressure) - l(&b.pressure)).abs() / 119.436);
            if x > 50.0 {
                let d0 = (y / x - 1.0).abs();
                if d0 > 0.004 {
                    println!(
                        "{:+.3} p {x:.1} {y:.1} load {:.3}",
                        pair.path,
                        l(&a.pressure) / 119.436
                    );
                }
                let d = (y / x - 1.0).abs();
                if edge {
                    worst.3 = worst.3.max(d)
                } else {
                    worst.2 = worst.2.max(d)
                }
            }
        }
    }
    use std::io::Write;
    let mut f = std::fs::File::create(std::env::args().nth(2).unwrap()).unwrap();
    for side in 0..2 {
        for (a, d) in forward.cycle().stations.arc[side]
            .iter()
            .zip(&after.depth[side])
        {
            let g = &set.gears[side];
            writeln!(
                f,
                "A,{},{side},{},{}",
                1e6,
                g.radius_at_rho(g.rho_at_arc(*a)),
                d * 1e3
            )
            .unwrap();
        }
    }
    println!(
        "relative change: approach {:.2e} share {:.2e} peak pressure {:.2e} at edges {:.2e}",
        worst.0, worst.1, worst.2, worst.3
    );
}
