//! The closed forms that everything else is judged by, judged themselves.
//!
//! Claims: each closed form satisfies the equations it solves (load balance, the half plane's displacement under it, the
//! differential equation of wear), and gives the published or independently computed numbers quoted beside each test.
//! Sources: Johnson, Contact Mechanics (1985); the gear program GEARpie's FZG report (D1, D2); ISO/TR 6336-30 example 1; an
//! independent boundary-element wear solver; formulas evaluated by hand.
//! Tolerances: half the last quoted digit for quoted numbers; the quadrature or panel error, stated in place, for equations.

use std::f64::consts::{FRAC_1_PI, PI};

use gearwear::analytic::archard_pass::{depth_per_pass, linear_load_share, pitch_point_depth};
use gearwear::analytic::cattaneo::PartialSlip;
use gearwear::analytic::iso6336::ToothPair;
use gearwear::analytic::punch_wear::{self, PunchWear};
use gearwear::analytic::winkler::{self, Parabola};
use gearwear::analytic::{cylinder_wear, half_plane, hertz_line};
use nalgebra::{DMatrix, DVector};

/// `∫ f dx` from −b to b by the substitution x = b sin θ and the midpoint rule: smooth for square-root ends.
fn integral(b: f64, f: impl Fn(f64) -> f64) -> f64 {
    let n = 2000;
    let step = PI / f64::from(n);
    (0..n)
        .map(|i| {
            let theta = -PI / 2.0 + (f64::from(i) + 0.5) * step;
            f(b * theta.sin()) * b * theta.cos() * step
        })
        .sum()
}

fn close(ours: f64, expected: f64, tolerance: f64) {
    assert!(
        (ours - expected).abs() <= tolerance,
        "{ours} against {expected} within {tolerance}"
    );
}

fn steel(e: f64) -> f64 {
    e / (2.0 * (1.0 - 0.09))
}

// ------------------------------------------------------------------------------------------------- contact

#[test]
fn hertz_numbers_of_the_mortar_literature() {
    // R 8 both, E 200, ν 0.3, F' 10: b 0.680778, p0 9.351351
    let (radius, e) = (hertz_line::relative_radius(8.0, 8.0), steel(200.0));
    let b = hertz_line::half_width(10.0, radius, e);
    let p0 = hertz_line::peak_pressure(10.0, radius, e);
    close(radius, 4.0, 1e-15);
    close(b, 0.680778, 5e-7);
    close(p0, 9.351351, 5e-7);
    close(2.0 * 10.0 / (PI * b), p0, 1e-13);
    close(hertz_line::load(p0, b), 10.0, 1e-13);
    // Midpoint rule on a smooth integrand: rounding only.
    close(integral(b, |x| hertz_line::pressure(x, p0, b)), 10.0, 1e-5);
    close(
        integral(b, |x| {
            hertz_line::pressure(x, p0, b) * x * x / (2.0 * radius)
        }) / 10.0,
        hertz_line::mean_gap(b, radius),
        1e-7,
    );
    assert_eq!(hertz_line::pressure(1.01 * b, p0, b), 0.0);
    assert_eq!(hertz_line::half_width(-1.0, radius, e), 0.0);
}

#[test]
fn hertz_pressure_bends_the_half_plane_to_the_cylinder() {
    // u(0) − u(x) = x²/(2R) for every x inside. 800 strips of constant pressure: error about 1e-5.
    let (load, radius, e) = (119.4, 5.6, 115_385.0);
    let b = hertz_line::half_width(load, radius, e);
    let p0 = hertz_line::peak_pressure(load, radius, e);
    let n = 801;
    let h = 2.0 * b / f64::from(n);
    let displacement = |x: f64| -> f64 {
        (0..n)
            .map(|i| {
                let from = -b + f64::from(i) * h;
                let middle = hertz_line::pressure(from + h / 2.0, p0, b);
                middle * half_plane::strip_displacement(x, from, from + h, e)
            })
            .sum()
    };
    for fraction in [0.25, 0.5, 0.75] {
        let x = fraction * b;
        let bent = displacement(0.0) - displacement(x);
        let gap = x * x / (2.0 * radius);
        assert!((bent / gap - 1.0).abs() < 1e-3, "{fraction}: {bent} {gap}");
    }
}

#[test]
fn subsurface_stress_of_hertz() {
    // Johnson: largest shear 0.300 p0 at 0.786 b; at the surface both principal stresses are −p0.
    assert_eq!(hertz_line::axis_stress(0.0, 1.0, 1.0), [-1.0, -1.0]);
    let shear = |z: f64| {
        let [x, z] = hertz_line::axis_stress(z, 1.0, 1.0);
        0.5 * (x - z)
    };
    let best = (0..2000)
        .map(|i| f64::from(i) * 1e-3)
        .fold(0.0, |a, z| if shear(z) > shear(a) { z } else { a });
    close(best, 0.786, 1e-3);
    close(shear(best), 0.300, 5e-4);
}

#[test]
fn gear_pressures_of_a_public_gear_program() {
    // FZG-C at 200 N m, b 14, E 206 000: 5912.1 N, 1347.3 MPa and 0.19957 mm at C, 1441.9 at B, 1320.1 at D
    let (rb, length) = (
        33.82893,
        (33.82893 + 50.74340) * 22.43891_f64.to_radians().tan(),
    );
    let e = steel(206_000.0);
    let force = 200e3 / rb;
    close(force, 5912.1, 0.05);
    let radius = |rho: f64| hertz_line::relative_radius(rho, length - rho);
    let p0 = |rho: f64| hertz_line::peak_pressure(force / 14.0, radius(rho), e);
    close(radius(13.9702), 8.3821, 5e-4);
    close(p0(13.9702), 1347.3, 0.051);
    close(p0(10.4378), 1441.9, 0.051);
    close(p0(17.5792), 1320.1, 0.051);
    // The report's half width does not quite fit its own force and pressure, 2 F'/(π p0) = 0.19954: 0.1 % is asked of it.
    let half_width = hertz_line::half_width(force / 14.0, radius(13.9702), e);
    close(half_width, 0.19957, 2e-4);
    close(half_width, 2.0 * force / 14.0 / (PI * 1347.3), 6e-6);
    // FZG-A, load stage 12, 534.5 N m, b 20: 1842.7 MPa at the same pitch point
    let stage_12 = hertz_line::peak_pressure(534.5e3 / rb / 20.0, radius(13.9702), e);
    close(stage_12, 1842.7, 0.5);
    // The reference pair at 100 N m, b 33: F' 119.436; 875.8, 846.8, 832.7 at B, C, D
    let load = 100e3 / 25.37170 / 33.0;
    close(load, 119.436, 5e-4);
    let length = (25.37170 + 49.80371) * 20f64.to_radians().tan();
    for (rho, expected) in [(8.1413, 875.8), (9.2345, 846.8), (9.9294, 832.7)] {
        let r = hertz_line::relative_radius(rho, length - rho);
        close(
            hertz_line::peak_pressure(load, r, steel(210_000.0)),
            expected,
            0.051,
        );
    }
}

#[test]
fn partial_slip() {
    // b 0.680778, p0 9.351351, µ 0.2, Q' 0.93616: c 0.496511 (0.729328 b), peak 1.279571 at |x| = c
    let (b, p0) = (0.680778, 9.351351);
    let slip = PartialSlip::new(p0, b, 0.2, 0.93616);
    close(slip.stick, 0.496511, 1e-6);
    close(slip.stick / b, 0.729328, 1e-6);
    close(slip.peak_traction(), 1.279571, 2e-6);
    close(slip.force(), 0.93616, 1e-12);
    // The kink at c limits the midpoint rule to about 1e-5.
    close(integral(b, |x| slip.traction(x)), 0.93616, 2e-5);
    for i in -99..=99 {
        let x = b * f64::from(i) / 100.0;
        let q = slip.traction(x);
        let limit = 0.2 * hertz_line::pressure(x, p0, b);
        assert!(q <= limit + 1e-12 && q <= slip.peak_traction() + 1e-12);
        assert_eq!((q - limit).abs() < 1e-12, x.abs() >= slip.stick, "{x}");
    }
    let sliding = PartialSlip::new(p0, b, 0.2, 99.0);
    assert_eq!(sliding.stick, 0.0);
    close(sliding.traction(0.0), 0.2 * p0, 1e-12);
}

#[test]
fn flat_punch() {
    // p(0) = F'/(π a) = 0.318310 F'/a, p(a/2) = 0.367553 F'/a
    close(
        half_plane::flat_punch_pressure(0.0, 1.0, 1.0),
        FRAC_1_PI,
        5e-7,
    );
    close(
        half_plane::flat_punch_pressure(0.5, 1.0, 1.0),
        0.367553,
        5e-7,
    );
    assert_eq!(half_plane::flat_punch_pressure(1.5, 1.0, 1.0), 0.0);
    close(
        half_plane::flat_punch_mean_pressure(-2.0, 2.0, 7.0, 2.0),
        7.0 / 4.0,
        1e-14,
    );
    // The surface stays flat below the punch: 400 strips carrying their exact mean pressure, E* = 1, load 1.
    let n = 400;
    let h = 2.0 / f64::from(n);
    let displacement = |x: f64| -> f64 {
        (0..n)
            .map(|i| {
                let from = -1.0 + f64::from(i) * h;
                half_plane::flat_punch_mean_pressure(from, from + h, 1.0, 1.0)
                    * half_plane::strip_displacement(x, from, from + h, 1.0)
            })
            .sum()
    };
    let middle = displacement(0.5 * h);
    for i in [40, 100, 160] {
        let x = (f64::from(i) + 0.5) * h;
        // A pressure of 1/2 everywhere would differ by 0.1 to 0.3 there.
        close(displacement(x), middle, 1e-3);
    }
}

// ------------------------------------------------------------------------------------------------- wear

#[test]
fn winkler_parabola_table() {
    // a/a0, p(0)/p0, w(0)/δ0 at τ, from a³ = a0³ (1 + τ) and the equation of p(0), six digits
    let table = [
        (0.2, 1.062659, 0.935751, 0.193492),
        (0.6, 1.169607, 0.823396, 0.544585),
        (1.0, 1.259921, 0.732339, 0.855062),
        (2.0, 1.442250, 0.577441, 1.502643),
        (6.0, 1.912931, 0.371078, 3.288227),
        (20.0, 2.758924, 0.245752, 7.365911),
    ];
    let case = Parabola {
        foundation: 2000.0,
        radius: 7.0,
        load: 50.0,
        k: 1e-5,
    };
    let (a0, d0) = (case.half_width(0.0), case.approach(0.0));
    close(a0.powi(3), 1.5 * 50.0 * 7.0 / 2000.0, 1e-14);
    for (tau, a, p, w) in table {
        let s = tau / (case.k * case.foundation);
        close(case.half_width(s) / a0, a, 6e-7);
        close(case.centre_pressure(s) / (case.foundation * d0), p, 6e-7);
        close(case.centre_depth(s) / d0, w, 1.1e-6);
    }
    // The pressure ratio satisfies its equation; central difference of step 1e-4, error 1e-9.
    for tau in [0.3, 3.0, 60.0, 500.0] {
        let q = winkler::centre_pressure_ratio;
        let slope = (q(tau + 1e-4) - q(tau - 1e-4)) / 2e-4;
        close(
            slope + q(tau),
            2.0 / 3.0 * (1.0 + tau).powf(-1.0 / 3.0),
            1e-8,
        );
    }
    // Far on, the rigid-wear law: within 5 % from three times the unworn half width.
    let s = 27.0 / (case.k * case.foundation);
    assert!(case.half_width(s) > 3.0 * a0);
    let law = winkler::worn_half_width(case.k, case.load, case.radius, s);
    assert!((law / case.half_width(s) - 1.0).abs() < 0.05);
}

#[test]
fn winkler_parabola_against_a_plain_simulation() {
    // The law of the foundation marched with 4000 explicit steps on 1500 points per half width: errors below 0.1 %.
    let (n, steps, tau) = (3000_usize, 4000, 1.0);
    let x = |i: usize| 1.5 * (i as f64 + 0.5) / n as f64;
    let h = 1.5 / n as f64;
    let load = 2.0 / 3.0; // half of (4/3) a0 p0 with a0 = 1, p0 = 1
    let mut worn = vec![0.0; n];
    let mut delta = 1.0;
    let pressure = |worn: &[f64], delta: f64, i: usize| (delta - x(i) * x(i) - worn[i]).max(0.0);
    for _ in 0..steps {
        // Newton on the load: it is convex and piecewise linear in δ.
        for _ in 0..4 {
            let carried: f64 = (0..n).map(|i| pressure(&worn, delta, i) * h).sum();
            let touching = (0..n).filter(|&i| pressure(&worn, delta, i) > 0.0).count();
            delta += (load - carried) / (touching as f64 * h);
        }
        let now: Vec<f64> = (0..n).map(|i| pressure(&worn, delta, i)).collect();
        for (w, p) in worn.iter_mut().zip(now) {
            *w += tau / f64::from(steps) * p;
        }
    }
    close(delta.sqrt(), 1.259921, 1.3e-3);
    close(pressure(&worn, delta, 0), 0.732339, 8e-4);
    close(worn[0], 0.855062, 1e-3);
}

#[test]
fn winkler_full_contact_and_its_step_limit() {
    let (k, foundation, mean) = (1e-5, 2000.0, 3.0);
    let exact = |s: f64| winkler::full_contact_pressure(5.0, mean, k, foundation, s);
    assert_eq!(exact(0.0), 5.0);
    // One relaxation length, e^−1.
    close(
        exact(1.0 / (k * foundation)),
        mean + 2.0 * (-1.0_f64).exp(),
        1e-14,
    );
    // Explicit Euler of the same law: first order, and unstable beyond the limit.
    let euler = |step: f64, n: u32| (0..n).fold(5.0, |p, _| p - k * foundation * step * (p - mean));
    let errors = [200, 400, 800].map(|n| euler(40.0 / f64::from(n), n) - exact(40.0));
    for pair in errors.windows(2) {
        close(pair[0] / pair[1], 2.0, 0.01);
    }
    let limit = winkler::stable_sliding(k, foundation);
    assert!((euler(1.02 * limit, 200) - mean).abs() > 2.0);
    assert!((euler(0.98 * limit, 200) - mean).abs() < 2.0);
}

#[test]
fn punch_modes_by_panels() {
    // Panel eigenvalues converge with h² to the independent program's (five digits).
    let [coarse, medium, fine] = [75, 150, 300].map(PunchWear::new);
    for (n, expected) in punch_wear::EIGENVALUES.iter().enumerate() {
        let [c, m, f] = [&coarse, &medium, &fine].map(|p| p.eigenvalues()[n]);
        close(f + (f - m) / 3.0, *expected, 8e-6);
        let order = ((m - c) / (f - m)).log2();
        assert!((order - 2.0).abs() < 0.1, "mode {n}: order {order}");
    }
    close(
        punch_wear::decay_rate(1.566, 1e-3, 100.0, 2.0),
        PI * 0.1 / (4.0 * 1.566),
        1e-15,
    );
}

#[test]
fn punch_pressure_history() {
    // The independent program's table; panels of 1/150 a against its 1/800: 0.1 % inside, 0.3 % beside the corner.
    let punch = PunchWear::new(300);
    let x = punch.positions();
    let start = punch.flat_punch();
    for (sliding, expected) in punch_wear::HISTORY {
        let p = punch.history(&start, sliding);
        let mean = p.iter().sum::<f64>() / p.len() as f64;
        close(mean, 1.0, 1e-12);
        for (at, expected, tolerance) in [
            (0.0, expected[0], 1e-3),
            (0.5, expected[1], 1e-3),
            (0.9, expected[2], 3e-3),
        ] {
            let i = x.partition_point(|&v| v <= at);
            let f = (at - x[i - 1]) / (x[i] - x[i - 1]);
            let ours = p[i - 1] * (1.0 - f) + p[i] * f;
            assert!(
                (ours / expected - 1.0).abs() < tolerance,
                "S {sliding}, x {at}: {ours} against {expected}"
            );
        }
    }
}

#[test]
fn a_tilt_decays_with_the_first_mode() {
    // The moment of an antisymmetric pressure falls with µ1 once the faster odd modes have gone.
    let punch = PunchWear::new(200);
    let x = punch.positions();
    let moment = |s: f64| -> f64 {
        let tilted: Vec<f64> = x.iter().map(|v| 1.0 + 0.1 * v).collect();
        punch
            .history(&tilted, s)
            .iter()
            .zip(&x)
            .map(|(p, x)| p * x)
            .sum()
    };
    let rate = (moment(1.0) / moment(2.0)).ln();
    let first = punch_wear::decay_rate(punch_wear::EIGENVALUES[0], 1.0, 1.0, 1.0);
    assert!((rate / first - 1.0).abs() < 0.03, "{rate} against {first}");
}

#[test]
fn worn_cylinder_repeated_by_panels() {
    // One row of the table of the elastic cylinder, σ = 1, by 40 panels per a0 and backward Euler, 40 and 80 steps
    // extrapolated. Units: a0 = R = 1, E* = 2, hence p0 = 1, F' = π/2, k = 1, s = σ.
    let row = cylinder_wear::HISTORY[2];
    let [coarse, fine] = [40, 80].map(|steps| wear_cylinder(40, row.sliding, steps));
    let twice = |i: usize| 2.0 * fine[i] - coarse[i];
    close(fine[0], row.half_width, 0.007 + 1.0 / 40.0);
    // The table's own accuracy is some 0.1 %; panels and steps add as much.
    assert!((twice(1) / row.pressure - 1.0).abs() < 3e-3, "{}", twice(1));
    assert!((twice(2) / row.depth - 1.0).abs() < 3e-3, "{}", twice(2));
    // What is worn in all is exact: (π/2) σ.
    close(fine[3], cylinder_wear::worn_area(1.0, 1.0, 1.0), 1e-9);
    for row in cylinder_wear::HISTORY {
        let rough = cylinder_wear::rough_half_width(row.sliding);
        let low = 1.0 - rough / row.half_width;
        assert!((0.015..0.045).contains(&low), "{low}");
    }
    close(
        12.390 * 1e-3 * 109.8901 / (2.0 * 0.680778),
        cylinder_wear::dimensionless_sliding(1e-3, 109.8901, 12.390, 0.680778),
        1e-15,
    );
}

/// Half width, central pressure, central depth and worn area; symmetric, so one half is computed.
fn wear_cylinder(per_a0: usize, sliding: f64, steps: u32) -> [f64; 4] {
    let n = 2 * per_a0;
    let h = 1.0 / per_a0 as f64;
    let x = |i: usize| (i as f64 + 0.5) * h;
    let compliance = DMatrix::from_fn(n, n, |i, j| {
        half_plane::strip_influence(x(i) - x(j), h, 2.0)
            + half_plane::strip_influence(x(i) + x(j), h, 2.0)
    });
    let ds = sliding / f64::from(steps);
    let mut worn = vec![0.0; n];
    let mut touching = per_a0;
    let mut pressure = vec![0.0; n];
    for _ in 0..steps {
        // The contact is the first `touching` panels; move its end until pressure ends and gap begins there.
        loop {
            let m = touching;
            let system = DMatrix::from_fn(m + 1, m + 1, |i, j| match (i < m, j < m) {
                (true, true) => compliance[(i, j)] + if i == j { ds } else { 0.0 },
                (true, false) => -1.0,
                (false, true) => 2.0 * h,
                (false, false) => 0.0,
            });
            let shape = |i: usize| x(i) * x(i) / 2.0 + worn[i];
            let right = DVector::from_fn(m + 1, |i, _| if i < m { -shape(i) } else { PI / 2.0 });
            let solution = system.lu().solve(&right).expect("regular");
            let delta = solution[m];
            let gap: f64 = (0..m)
                .map(|j| compliance[(m, j)] * solution[j])
                .sum::<f64>()
                + shape(m)
                - delta;
            if solution[m - 1] < 0.0 {
                touching -= 1;
            } else if gap < 0.0 {
                touching += 1;
            } else {
                pressure.fill(0.0);
                pressure[..m].copy_from_slice(&solution.as_slice()[..m]);
                break;
            }
        }
        for (w, p) in worn.iter_mut().zip(&pressure) {
            *w += ds * p;
        }
    }
    let area = worn.iter().sum::<f64>() * 2.0 * h;
    [touching as f64 * h, pressure[0], worn[0], area]
}

#[test]
fn saw_tooth_limit() {
    // steel, h 0.01, p 850: 0.094 µm per update
    close(
        half_plane::stable_depth(0.01, 850.0, 115_385.0) * 1e3,
        0.094,
        5e-4,
    );
    let depth = 6e-10 * 850.0 * half_plane::stable_sliding(0.01, 6e-10, 115_385.0);
    close(
        depth,
        half_plane::stable_depth(0.01, 850.0, 115_385.0),
        1e-15,
    );
    // Compliance of a real saw-tooth of strips against (2/π) h/E*: 1.166 at the middles, 0.853 on average. The alternating
    // sum is ended by the mean of its last two partial sums.
    let alternate = |term: &dyn Fn(f64) -> f64| {
        let n = 4000;
        let sign = |i: i32| if i % 2 == 0 { 1.0 } else { -1.0 };
        let inner: f64 = (-n + 1..n).map(|i| sign(i) * term(f64::from(i))).sum();
        inner + 0.5 * (term(f64::from(n)) + term(f64::from(-n))) * sign(n)
    };
    let middles =
        alternate(&|i| half_plane::strip_displacement(0.0, i - 0.5, i + 0.5, 1.0)) * PI / 2.0;
    let means = alternate(&|i| half_plane::strip_influence(i, 1.0, 1.0)) * PI / 2.0;
    close(middles, 1.166, 1e-3);
    close(means, 0.853, 1e-3);
}

#[test]
fn gear_wear_per_pass() {
    // h/k in N/mm with the 1/3 to 2/3 share at A, B (2/3), B (1), C, D (1), E; ρ1 there; five digits
    struct Case {
        load: f64,
        ratio: f64,
        length: f64,
        rho: [f64; 5],
        pinion: [f64; 6],
        gear: [f64; 6],
    }
    let tangent = |rb: [f64; 2], deg: f64| (rb[0] + rb[1]) * deg.to_radians().tan();
    // ρ at A and E from the tip radii, B and D one base pitch off, all to rounding.
    let limits = |ra: [f64; 2], rb: [f64; 2], deg: f64, pitch: f64| {
        let length = tangent(rb, deg);
        let a = length - (ra[1].powi(2) - rb[1].powi(2)).sqrt();
        let e = (ra[0].powi(2) - rb[0].powi(2)).sqrt();
        [a, e - pitch, rb[0] * deg.to_radians().tan(), a + pitch, e]
    };
    let c20 = 20f64.to_radians().cos();
    let reference = [27.0 * c20, 53.0 * c20];
    let fzg = [36.0 * c20, 54.0 * c20];
    let cases = [
        Case {
            load: 100e3 / reference[0] / 33.0,
            ratio: 27.0 / 53.0,
            length: tangent(reference, 20.0),
            rho: limits([29.0, 55.0], reference, 20.0, 2.0 * PI * c20),
            pinion: [77.774, 16.140, 24.210, 0.0, 12.616, 20.584],
            gear: [26.333, 13.420, 20.130, 0.0, 14.106, 42.619],
        },
        Case {
            load: 372.6e3 / fzg[0] / 14.0,
            ratio: 16.0 / 24.0,
            length: tangent(fzg, 22.43891),
            rho: limits([41.31765, 59.27175], fzg, 22.43891, 4.5 * PI * c20),
            pinion: [984.71, 295.83, 443.75, 0.0, 269.19, 179.68],
            gear: [207.09, 189.15, 283.72, 0.0, 409.21, 570.71],
        },
    ];
    for case in &cases {
        let [a, b, c, d, e] = case.rho;
        let share = |rho: f64| linear_load_share(rho, [a, b, d, e]);
        let places = [
            (a, share(a)),
            (b, 2.0 / 3.0),
            (b, share(b)),
            (c, share(c)),
            (d, share(d)),
            (e, share(e)),
        ];
        for (i, (rho, share)) in places.into_iter().enumerate() {
            let (u1, u2) = (rho, (case.length - rho) * case.ratio);
            let load = share * case.load;
            let h1 = depth_per_pass(1.0, load, u1, u2);
            let h2 = depth_per_pass(1.0, load, u2, u1);
            // Five digits, and the second pair's operating angle to 1e-5 deg.
            let digit = |v: f64| 5e-6 * v + if v >= 100.0 { 5.1e-3 } else { 5.1e-4 };
            close(h1, case.pinion[i], digit(case.pinion[i]));
            close(h2, case.gear[i], digit(case.gear[i]));
        }
        close(share(a - 1e-9) + share(e + 1e-9), 0.0, 0.0);
        close(share(b - 1e-9), 2.0 / 3.0, 1e-8);
        close(share(d + 1e-9), 2.0 / 3.0, 1e-8);
    }
    // REF, k 6e-10, 50 000 turns: 2.333 µm at A on the pinion, 0.402 and 0.651 µm at the mates of A and E
    let first = &cases[0];
    let um = |h: f64, contacts: f64| h * 6e-10 * contacts * 1e3;
    close(um(first.pinion[0], 5e4), 2.333, 5.1e-4);
    close(um(first.gear[0], 5e4 * first.ratio), 0.402, 5.1e-4);
    close(um(first.gear[5], 5e4 * first.ratio), 0.651, 5.1e-4);
    // FZG-C at the pitch point: 26.3 N/mm per k from the width of the contact
    let second = &cases[1];
    let c = second.rho[2];
    let r = hertz_line::relative_radius(c, second.length - c);
    let half_width = hertz_line::half_width(second.load, r, steel(206_000.0));
    let bump = pitch_point_depth(1.0, second.load, second.ratio, fzg[0], c, half_width);
    close(bump, 26.3, 0.051);
    // The same by brute force: the point's own sliding path through a Hertz contact centred on the pitch point.
    let p0 = hertz_line::peak_pressure(second.load, r, steel(206_000.0));
    let swept = integral(half_width, |x| {
        // Contact x off the point: sliding speed over rolling speed there, (1 + z1/z2) |x|, over ρ1 and r_b1.
        hertz_line::pressure(x, p0, half_width) * (1.0 + second.ratio) * x.abs() * fzg[0] / (c * c)
    });
    close(swept / bump, 1.0, 1e-4);
}

// ------------------------------------------------------------------------------------------------- gears

#[test]
fn iso_6336_stiffness() {
    // c'th, c', c_γ evaluated by hand, five digits
    let shifted = ToothPair {
        profile_shift: [0.1817, 0.1715],
        ..ToothPair::spur(16, 24)
    };
    let table = [
        (ToothPair::spur(27, 53), 1.69714, [17.284, 13.482, 20.531]),
        (shifted, 1.46243, [15.776, 12.305, 16.573]),
        (ToothPair::spur(30, 30), 1.65351, [16.391, 12.785, 19.051]),
    ];
    for (pair, contact_ratio, [theoretical, single, mesh]) in table {
        close(pair.theoretical(), theoretical, 5.1e-4);
        close(pair.single(), single, 5.1e-4);
        close(pair.mesh(contact_ratio), mesh, 5.1e-4);
    }
    // ISO/TR 6336-30 example 1: m 8, 17/103, x 0.145/0, β 15.8°, rack D (h_fP 1.4); virtual teeth given to three decimals
    let example = ToothPair {
        teeth: [18.905, 114.543],
        profile_shift: [0.145, 0.0],
        dedendum: 1.4,
        pressure_angle_deg: 20.0,
        helix_angle_deg: 15.8,
        blank: 1.0,
    };
    close(example.theoretical(), 17.85584, 3e-5);
    close(example.single(), 12.37047, 3e-5);
    close(
        example.mesh((17.46485 / 12.37047 - 0.25) / 0.75),
        17.46485,
        3e-5,
    );
}

#[test]
fn stiffness_of_other_materials_is_that_of_springs_in_series() {
    use gearwear::analytic::iso6336::material_factor;
    close(material_factor([206_000.0; 2]), 1.0, 1e-15);
    // two teeth of the same shape, each as stiff as its modulus, one behind the other
    let (steel, plastic) = (206_000.0, 3_000.0);
    let each = |modulus: f64| 2.0 * modulus / steel;
    let series = 1.0 / (1.0 / each(steel) + 1.0 / each(plastic));
    close(material_factor([steel, plastic]), series, 1e-14);
    close(material_factor([plastic, steel]), series, 1e-14);
    // grey cast iron as the standard has it: 0.59 on itself makes it 0.74 on steel, both rounded to two digits
    let iron = 0.59 * steel;
    close(material_factor([iron; 2]), 0.59, 1e-12);
    assert!((material_factor([iron, steel]) - 0.74).abs() < 0.005);
}
