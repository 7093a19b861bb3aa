//! The reference pair (27/53, m 2, 100 N m on 33 mm, 2000 rpm; µ 0.06, η 0.015 Pa s, α_p 18/GPa, Rq 0.5 µm) at the five
//! characteristic points, against a table computed once by other hands with a load share of 0.36 in double contact. Limits:
//! half the table's last digit.

use std::f64::consts::{PI, TAU};

use super::film::{Film, film_ratio, inlet_heating_factor, thermal_loading};
use super::flash_temperature::{HeatSource, contact_coefficient, flash_rise};
use super::friction::{Flank, force_arm, local_coefficient};
use super::sliding::Kinematics;
use crate::analytic::hertz_line;

const BASE: [f64; 2] = [25.371_700, 49.803_708];

fn kinematics() -> Kinematics {
    Kinematics {
        base_radius: BASE,
        operating_angle: 20f64.to_radians(),
        pinion_speed: 2000.0 * TAU / 60.0,
    }
}

struct Row {
    rho: f64,
    share: f64,
    specific: [f64; 2],
    pressure: f64,
    half_width: f64,
    film_um: f64,
    ratio: f64,
    flash: f64,
}

#[rustfmt::skip]
const TABLE: [Row; 5] = [
    Row { rho: 4.0251, share: 0.36, specific: [-1.954, 0.661], pressure: 678.0, half_width: 0.040, film_um: 0.131, ratio: 0.26, flash: 16.0 },
    Row { rho: 8.1413, share: 1.0, specific: [-0.203, 0.169], pressure: 876.0, half_width: 0.087, film_um: 0.155, ratio: 0.31, flash: 6.0 },
    Row { rho: 9.2345, share: 1.0, specific: [0.0, 0.0], pressure: 847.0, half_width: 0.090, film_um: 0.163, ratio: 0.33, flash: 0.0 },
    Row { rho: 9.9294, share: 1.0, specific: [0.106, -0.118], pressure: 833.0, half_width: 0.091, film_um: 0.167, ratio: 0.33, flash: 4.0 },
    Row { rho: 14.0455, share: 0.36, specific: [0.517, -1.070], pressure: 481.0, half_width: 0.057, film_um: 0.212, ratio: 0.42, flash: 11.0 },
];

fn close(ours: f64, expected: f64, tolerance: f64) {
    assert!(
        (ours - expected).abs() <= tolerance,
        "{ours} against {expected} within {tolerance}"
    );
}

#[test]
fn table_of_the_reference_pair() {
    let pair = kinematics();
    let pitch = BASE[0] * pair.operating_angle.tan();
    let e_star = 2.1e5 / (2.0 * 0.91);
    for row in &TABLE {
        let path = row.rho - pitch;
        let [rho1, rho2] = pair.curvature_radii(path);
        let motion = pair.motion(path);
        let radius = hertz_line::relative_radius(rho1, rho2);
        let load = row.share * 100e3 / (BASE[0] * 33.0);
        let half_width = hertz_line::half_width(load, radius, e_star);
        for (ours, expected) in motion.specific().into_iter().zip(row.specific) {
            close(ours, expected, 5.1e-4);
        }
        close(
            hertz_line::peak_pressure(load, radius, e_star),
            row.pressure,
            0.51,
        );
        close(half_width, row.half_width, 5.1e-4);
        let film = Film {
            load,
            radius,
            contact_modulus: e_star,
            entraining_speed: motion.entraining(),
            viscosity_pa_s: 0.015,
            pressure_viscosity_per_gpa: 18.0,
        };
        close(film.minimum() * 1e3, row.film_um, 5.1e-4);
        close(film_ratio(film.minimum(), 0.5), row.ratio, 5.1e-3);
        // Central and minimum film of a line contact lie within a third of each other.
        let ratio = film.central() / film.minimum();
        assert!((1.1..1.35).contains(&ratio), "{ratio}");
        let source = HeatSource {
            load,
            friction: 0.06,
            rolling: motion.rolling,
            half_width,
        };
        close(flash_rise(&source, 13_000.0), row.flash, 0.51);
    }
}

#[test]
fn contact_coefficient_of_steel() {
    // about 13 000 N/(m s^½ K)
    close(contact_coefficient(46.0, 7850.0, 470.0), 13_000.0, 50.0);
}

#[test]
fn factor_of_the_flash_temperature() {
    // A band source q of Hertz shape and strength 1 on a fast body: T = (1/(B √(π u))) ∫ q(ξ)/√(x − ξ) dξ; its maximum
    // times B √(u 2a) is the factor, printed 1.11. With ξ = x − t² the integrand has no singularity.
    let rise = |x: f64| -> f64 {
        let n = 20_000;
        let end = (x + 1.0).sqrt();
        let dt = end / f64::from(n);
        (0..n)
            .map(|i| {
                let t = (f64::from(i) + 0.5) * dt;
                2.0 * hertz_line::pressure(x - t * t, 2.0 / PI, 1.0) * dt
            })
            .sum::<f64>()
            / PI.sqrt()
    };
    let largest = (0..100)
        .map(|i| rise(f64::from(i) * 0.01))
        .fold(0.0, f64::max);
    close(largest * 2f64.sqrt(), 1.11, 5.1e-3);
    // Both bodies at the same temperature: the heat splits as √u1 : √u2, and the sum of speeds cancels to |√u1 − √u2|.
    let source = HeatSource {
        load: 100.0,
        friction: 0.06,
        rolling: [4000.0, 1000.0],
        half_width: 0.08,
    };
    let heat = 0.06 * 100e3 * 3.0;
    let alone = |u: f64| 1.11 * heat / (13_000.0 * (u * 0.16e-3).sqrt());
    let shared = 1.0 / (1.0 / alone(4.0) + 1.0 / alone(1.0));
    close(flash_rise(&source, 13_000.0), shared, 1e-9);
}

#[test]
fn sliding_is_the_relative_turning_about_the_pitch_point() {
    // v = (ω1 + ω2) s, and the law of gearing keeps ω1 r_b1 = ω2 r_b2
    let pair = kinematics();
    let speeds = pair.pinion_speed * (1.0 + BASE[0] / BASE[1]);
    for path in [-5.2, -1.0, 0.0, 0.7, 4.8] {
        let motion = pair.motion(path);
        close(motion.sliding(), speeds * path, 1e-9);
        close(motion.sum(), 2.0 * motion.entraining(), 0.0);
        let [rho1, rho2] = pair.curvature_radii(path);
        close(rho1 + rho2, 80.0 * 20f64.to_radians().sin(), 1e-5);
    }
}

#[test]
fn friction_in_the_torque_balance() {
    // µ 0.1: +1.6 % at A, +3.8 % before and −3.5 % after the pitch point, −5.2 % at E
    let force = |path: f64, rho: f64| 100.0 * (BASE[0] / force_arm(BASE[0], path, rho, 0.1) - 1.0);
    close(force(-5.2, 4.0251), 1.6, 0.051);
    close(force(-1e-9, 9.2345), 3.8, 0.051);
    close(force(1e-9, 9.2345), -3.5, 0.051);
    close(force(4.8, 14.0455), -5.2, 0.051);
    assert_eq!(force(0.0, 9.2345), 0.0);
}

#[test]
fn local_friction_follows_its_exponents() {
    let base = Flank {
        load: 119.4,
        rolling_sum: 3868.0,
        radius: 6.0,
        viscosity_pa_s: 0.015,
        roughness_ra_um: 0.4,
        lubricant: 1.0,
    };
    let mu = local_coefficient(&base);
    // Mineral oil on ground steel: 0.03 to 0.12.
    assert!((0.03..0.12).contains(&mu), "{mu}");
    // By hand: 0.048 (119.4/(3.868·6))^0.2 15^−0.05 0.4^0.25
    close(
        mu,
        0.048 * 5.14477_f64.powf(0.2) * 0.873_353 * 0.795_271,
        1e-6,
    );
    let double = |change: fn(&mut Flank)| {
        let mut flank = base;
        change(&mut flank);
        (local_coefficient(&flank) / mu).log2()
    };
    close(double(|f| f.load *= 2.0), 0.2, 1e-12);
    close(double(|f| f.rolling_sum *= 2.0), -0.2, 1e-12);
    close(double(|f| f.radius *= 2.0), -0.2, 1e-12);
    close(double(|f| f.viscosity_pa_s *= 2.0), -0.05, 1e-12);
    close(double(|f| f.roughness_ra_um *= 2.0), 0.25, 1e-12);
    close(double(|f| f.lubricant *= 2.0), 1.0, 1e-12);
}

#[test]
fn film_exponents_and_inlet_heating() {
    let film = |speed: f64, load: f64| Film {
        load,
        radius: 6.0,
        contact_modulus: 115_385.0,
        entraining_speed: speed,
        viscosity_pa_s: 0.015,
        pressure_viscosity_per_gpa: 18.0,
    };
    let base = film(2000.0, 119.0);
    close(
        (film(4000.0, 119.0).minimum() / base.minimum()).log2(),
        0.70,
        1e-12,
    );
    close(
        (film(2000.0, 238.0).minimum() / base.minimum()).log2(),
        -0.13,
        1e-12,
    );
    close(
        (film(4000.0, 119.0).central() / base.central()).log2(),
        8.0 / 11.0,
        1e-12,
    );
    // No heating without speed; more sliding, thinner film. L for β_η 0.04/K, 0.015 Pa s, 4 m/s, 0.14 W/(m K) by hand.
    assert_eq!(inlet_heating_factor(0.5, 0.0), 1.0);
    let l = thermal_loading(0.04, 0.015, 4000.0, 0.14);
    close(l, 0.04 * 0.015 * 16.0 / 0.14, 1e-15);
    assert!(inlet_heating_factor(0.5, l) < inlet_heating_factor(0.0, l));
    close(inlet_heating_factor(0.0, 1.0), 1.0 / 1.1, 1e-15);
}
