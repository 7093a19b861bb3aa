//! Places and states to ask effects about: one ordinary, and any.

use gearwear::effects::{Local, OperationState, ProfileAt};
use gearwear::gear::Member;
use proptest::prelude::*;

/// A point on the pinion's dedendum of the 27/53 reference pair, in mid-life.
pub(crate) fn ordinary() -> Local {
    Local {
        member: Member::Pinion,
        radius: 26.4,
        path: -1.5,
        approach: true,
        curvature: [7.7, 19.7],
        rolling: [1.61, 2.10],
        pressure: 640.0,
        peak_pressure: 850.0,
        hertz_pressure: 820.0,
        line_load: 110.0,
        half_width: 0.085,
        normal_load: 119.44,
        depth: 4.0,
        cycles: 2.5e5,
        contacts: 2.5e5,
        hours: 30.0,
        contact_hours: 1.0 / (60.0 * 2000.0),
        worn_volume: 50.0,
        torque: 100.0,
        speed: 2000.0,
        base_radius: 25.3717,
        base_pitch: 5.904,
        film_ratio: 0.3,
        friction: 0.045,
        flash_temperature: 12.5,
        bulk_temperature: 80.0,
    }
}

pub(crate) fn profile() -> ProfileAt {
    ProfileAt {
        member: Member::Pinion,
        radius: 28.5,
        path: 3.8,
        from_tip: 0.5,
        along: 0.8,
    }
}

pub(crate) fn operation() -> OperationState {
    OperationState {
        torque: 100.0,
        speed: 2000.0,
        normal_force: 3941.4,
        working_pressure_angle: 20f64.to_radians(),
        centre_distance: 80.0,
        bulk_temperature: 60.0,
    }
}

/// From zero to `most`, zero itself often, and spread over the decades below it.
fn up_to(most: f64) -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => Just(0.0),
        1 => Just(most),
        4 => (-9.0..0.0f64).prop_map(move |power| most * 10f64.powf(power)),
        4 => (0.0..1.0f64).prop_map(move |share| share * most),
    ]
}

fn member() -> impl Strategy<Value = Member> {
    prop_oneof![Just(Member::Pinion), Just(Member::Gear)]
}

prop_compose! {
    fn contact()(
        pressure in up_to(2e4), peak in up_to(2e4), line_load in up_to(1e5), half_width in up_to(5.0),
        normal_load in up_to(1e5), film_ratio in up_to(1e3), friction in up_to(2.0), flash in up_to(2e3),
        bulk in -60.0..400.0f64, u1 in up_to(300.0), u2 in up_to(300.0), rho1 in up_to(500.0), rho2 in up_to(500.0),
    ) -> Local {
        Local {
            pressure, peak_pressure: peak, hertz_pressure: peak, line_load, half_width, normal_load, film_ratio, friction,
            flash_temperature: flash, bulk_temperature: bulk, rolling: [u1, u2], curvature: [rho1, rho2],
            ..ordinary()
        }
    }
}

prop_compose! {
    /// Anything a flank point may meet, and more.
    pub fn anywhere()(
        at in contact(), member in member(), approach in any::<bool>(), radius in 1.0..2e3f64, path in -100.0..100.0f64,
        base_radius in 1.0..2e3f64, base_pitch in 0.1..200.0f64, depth in up_to(1e4), cycles in up_to(1e13),
        contacts in up_to(1e13), hours in up_to(1e7), contact_hours in up_to(10.0),
    )(
        worn_volume in up_to(1e8), torque in up_to(1e7), speed in up_to(2e5), on_pitch in proptest::bool::weighted(0.1),
        at in Just(Local {
            member, approach, radius, path, base_radius, base_pitch, depth, cycles, contacts, hours, contact_hours, ..at
        }),
    ) -> Local {
        Local { worn_volume, torque, speed, path: if on_pitch { 0.0 } else { at.path }, ..at }
    }
}

prop_compose! {
    pub fn any_profile()(
        member in member(), radius in 1.0..2e3f64, path in -100.0..100.0f64, from_tip in up_to(100.0), along in -0.2..1.2f64,
    ) -> ProfileAt {
        ProfileAt { member, radius, path, from_tip, along }
    }
}

prop_compose! {
    pub fn any_operation()(
        torque in up_to(1e6), speed in up_to(1e5), force in up_to(1e7), angle in 0.1..0.8f64, distance in 1.0..2e3f64,
        bulk in -60.0..400.0f64,
    ) -> OperationState {
        OperationState {
            torque, speed, normal_force: force, working_pressure_angle: angle, centre_distance: distance, bulk_temperature: bulk,
        }
    }
}
