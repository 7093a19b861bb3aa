//! A contact sweep of one's own: loaded transmission error over torque, with and without tip relief, by finite elements.
//!
//! `cargo run --release --example transmission_error`. No study file: the gears are made here, and nothing wears. The contact of the
//! new flanks is solved at every mesh position, and the rotation that closes the flanks is the transmission error at the pinion.

use std::error::Error;

use gearwear::gear::{BasicRack, Gear, ToothSpec};
use gearwear::material::Elastic;
use gearwear::simulate::forward::{Conditions, Forward, ForwardError};
use gearwear::simulate::gear_set::GearSet;
use gearwear::simulate::numerics::Numerics;

/// Pinion torques, N m.
const TORQUES: [f64; 4] = [25.0, 50.0, 100.0, 200.0];

#[expect(clippy::print_stdout, reason = "an example shows what it found")]
fn main() -> Result<(), Box<dyn Error>> {
    println!("torque, N m    peak to peak, µrad: plain   15 µm tip relief");
    let (plain, relieved) = (gears(0.0)?, gears(0.015)?);
    for torque in TORQUES {
        println!(
            "{torque:11.0} {:33.1} {:18.1}",
            peak_to_peak(&plain, torque)?,
            peak_to_peak(&relieved, torque)?
        );
    }
    Ok(())
}

/// 27 and 53 teeth, module 2 mm, steel, with `relief` mm taken off both tips over 1.5 mm of the path of contact.
fn gears(relief: f64) -> Result<GearSet, Box<dyn Error>> {
    let gear = |teeth, bore| {
        let spec = ToothSpec {
            tip_relief_amount: relief,
            tip_relief_length: if relief > 0.0 { 1.5 } else { 0.0 },
            ..ToothSpec::plain(teeth, bore)
        };
        Gear::new(BasicRack::iso53_a(2.0), spec)
    };
    let steel = Elastic {
        youngs_modulus: 2.1e5,
        poisson_ratio: 0.3,
    };
    Ok(GearSet {
        gears: [gear(27, 25.0)?, gear(53, 40.0)?],
        materials: [steel; 2],
        densities: [7850.0; 2],
        centre_distance: 80.0,
        face_width: 33.0,
        face: gearwear::gear::Face::default(),
        teeth: gearwear::gear::Teeth::default(),
    })
}

/// Peak-to-peak loaded transmission error over one base pitch, µrad at the pinion.
fn peak_to_peak(set: &GearSet, torque_nm: f64) -> Result<f64, ForwardError> {
    let conditions = Conditions {
        torque: 1e3 * torque_nm,
        speed: 1000.0,
        misalignment: 0.0,
        cycles: 1.0,
        coefficient: [0.0; 2],
    };
    // 3 edges on the half width and 50 positions are enough for stiffness; pressures want more (see the architecture notes)
    let numerics = Numerics {
        elements_per_half_width: 3.0,
        positions: 50,
        ..Numerics::default()
    };
    let members = set.members(&numerics, &[conditions.torque], &[0.0])?;
    let mut forward = Forward::new(set, Some(&members), conditions, numerics)?;
    let stations: usize = forward.cycle().stations.arc.iter().map(Vec::len).sum();
    let contacts = forward.contacts_at(&vec![0.0; stations])?;
    let lag = contacts.iter().map(|contact| 1e6 * contact.approach);
    let (least, most) = lag.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| {
        (a.min(x), b.max(x))
    });
    Ok(most - least)
}
