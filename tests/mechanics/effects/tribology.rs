//! Film ratio, friction and flash temperature of a [`Local`] at the characteristic points of the reference pair (27/53, m 2,
//! 100 N m on 33 mm, 2000 rpm; µ 0.06, η 0.015 Pa s, α_p 18/GPa, Rq 0.5 µm; load share 0.36 in double contact).

use gearwear::effects::{Local, REFERENCE_TEMPERATURE, Surroundings};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::close;
use super::places::{anywhere, ordinary};

const SURROUNDINGS: Surroundings = Surroundings {
    contact_modulus: 115_385.0,
    viscosity_pa_s: Some(0.015),
    pressure_viscosity_per_gpa: Some(18.0),
    roughness_um: Some(0.5),
    friction_coefficient: Some(0.06),
    contact_coefficient: Some(13_000.0),
    bulk_temperature_c: Some(60.0),
    flank_temperature_c: Some(60.0),
};

#[test]
fn characteristic_points() {
    // ρ1 mm, load share, a_H mm, λ, flash K
    let points = [
        (4.0251, 0.36, 0.040, 0.26, 16.0),
        (8.1413, 1.0, 0.087, 0.31, 6.0),
        (9.2345, 1.0, 0.090, 0.33, 0.0),
        (9.9294, 1.0, 0.091, 0.33, 4.0),
        (14.0455, 0.36, 0.057, 0.42, 11.0),
    ];
    let omega = 2000.0 * std::f64::consts::TAU / 60.0;
    for (rho, share, half_width, ratio, flash) in points {
        let other = 80.0 * 20f64.to_radians().sin() - rho;
        let mut at = Local {
            curvature: [rho, other],
            rolling: [omega * rho * 1e-3, omega * 27.0 / 53.0 * other * 1e-3],
            line_load: share * 119.44,
            half_width,
            ..ordinary()
        };
        SURROUNDINGS.complete(&mut at);
        close(at.film_ratio, ratio, 5.1e-3);
        // a half width of two digits leaves 0.6 % of the temperature open
        close(at.flash_temperature, flash, 0.51 + 0.006 * flash);
        assert!((0.02..0.1).contains(&at.friction), "{}", at.friction);
        assert_eq!(at.bulk_temperature, 60.0);
    }
}

#[test]
fn what_is_not_stated_is_none() {
    let mut at = ordinary();
    Surroundings {
        contact_modulus: 115_385.0,
        ..Surroundings::default()
    }
    .complete(&mut at);
    assert_eq!([at.film_ratio, at.friction, at.flash_temperature], [0.0; 3]);
    assert_eq!(at.bulk_temperature, REFERENCE_TEMPERATURE);
    // dry gears with a stated friction
    let dry = Surroundings {
        friction_coefficient: Some(0.3),
        ..Surroundings::default()
    };
    dry.complete(&mut at);
    assert_eq!(
        [at.film_ratio, at.friction, at.flash_temperature],
        [0.0, 0.3, 0.0]
    );
}

#[test]
fn sliding_and_its_side() {
    let at = ordinary();
    close(at.sliding_speed(), 0.49, 1e-12);
    close(at.entraining_speed(), 1.855, 1e-12);
    close(at.relative_radius(), 7.7 * 19.7 / 27.4, 1e-12);
    assert_eq!(
        Local {
            curvature: [0.0, 0.0],
            ..at
        }
        .relative_radius(),
        0.0
    );
    assert!(at.dedendum());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, rng_seed: RngSeed::Fixed(20), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn finite_everywhere(at in anywhere()) {
        let mut at = at;
        SURROUNDINGS.complete(&mut at);
        for value in [at.film_ratio, at.friction, at.flash_temperature, at.bulk_temperature] {
            prop_assert!(value.is_finite() && value >= 0.0, "{:?}", at);
        }
    }
}
