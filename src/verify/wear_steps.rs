//! Time steps of wear: observed orders, and the limit beyond which explicit updates oscillate (benchmarks F3 and F8).
//!
//! ```text
//! Winkler      explicit Euler diverges for Δs > 2/(k K), alternates in sign for Δs > 1/(k K)
//! half plane   a saw tooth of element length h grows for Δs > (4/π) h/(k E*)
//! ```
//! The limits belong to explicit updates; they are shown here with an Euler loop that the product does not use.

use nalgebra::DVector;

use crate::analytic::half_plane::stable_sliding;
use crate::analytic::half_plane_elements::weighted_compliance;
use crate::verify::sliding::{SlidingContact, even_grid, history};
use crate::verify::wear_winkler::full_contact;
use crate::verify::{CaseError, Measured};
use crate::wear::integrator::{Jacobian, Stand, StepControl, WearSystem, advance};

/// k K of the full Winkler contact, 1/mm.
const DECAY: f64 = 0.1;

/// F3: order of the integrator with fixed steps, and of explicit Euler beside it; Euler's two limits.
///
/// # Errors
/// [`CaseError`] if contact or step control fails.
pub fn orders() -> Result<Vec<Measured>, CaseError> {
    let mut ros = Vec::new();
    let mut euler = Vec::new();
    for steps in [10, 20, 40] {
        ros.push(decay_error(&fixed_steps(steps)?)?);
        euler.push(decay_error(&euler_steps(
            2.0 / DECAY / steps as f64,
            steps,
        )?)?);
    }
    let order = |e: &[f64]| (e[1] / e[2]).log2();
    let mut out = vec![
        Measured::absolute(
            "F3",
            "observed order of the integrator (fixed steps)",
            order(&ros),
            2.0,
            0.1,
        ),
        Measured::absolute(
            "F3",
            "observed order of explicit Euler",
            order(&euler),
            1.0,
            0.1,
        ),
    ];
    // one Euler step multiplies the deviation from the mean pressure by 1 − k K Δs
    for factor in [0.9, 1.5, 2.1] {
        let mut system = full_contact(16);
        let before = deviation(&mut system, &euler_steps(factor / DECAY, 1)?)?;
        let after = deviation(&mut system, &euler_steps(factor / DECAY, 2)?)?;
        let growth = before.dot(&after) / before.dot(&before);
        out.push(Measured::absolute(
            "F3",
            format!("explicit Euler, step {factor}/(kK): factor per step"),
            growth,
            1.0 - factor,
            1e-6,
        ));
    }
    Ok(out)
}

/// Depths after `steps` equal steps of the integrator to kKs = 2.
fn fixed_steps(steps: usize) -> Result<Vec<f64>, CaseError> {
    let mut system = full_contact(16);
    let end = 2.0 / DECAY;
    let step = end / steps as f64;
    let loose = StepControl {
        ceiling: f64::INFINITY,
        tolerance: f64::MAX,
        floor: 1.0,
        first_step: step,
        hesitates: false,
        least_growth: 0.0,
    };
    let mut stand = Stand::new(vec![0.0; system.x.len()], loose);
    for i in 1..=steps {
        stand.step = step;
        advance(&mut system, &mut stand, step * i as f64, loose)?;
    }
    Ok(stand.u)
}

fn euler_steps(step: f64, count: usize) -> Result<Vec<f64>, CaseError> {
    let mut system = full_contact(16);
    let mut u = vec![0.0; system.x.len()];
    for _ in 0..count {
        let rate = system.rate(0.0, &u)?;
        u.iter_mut().zip(rate).for_each(|(u, r)| *u += step * r);
    }
    Ok(u)
}

/// Deviation of the pressure from its mean, MPa.
fn deviation(system: &mut SlidingContact, u: &[f64]) -> Result<DVector<f64>, CaseError> {
    let mean = system.load / 2.0;
    Ok(DVector::from_vec(
        system
            .contact(u)?
            .pressure
            .iter()
            .map(|p| p - mean)
            .collect(),
    ))
}

/// Largest pressure error at kKs = 2 relative to the mean.
fn decay_error(u: &[f64]) -> Result<f64, CaseError> {
    let mut system = full_contact(16);
    let fresh = deviation(&mut system, &vec![0.0; u.len()])?;
    let worn = deviation(&mut system, u)?;
    Ok((worn - fresh * (-2f64).exp()).amax() * 2.0 / system.load)
}

/// Half a length of the flat, mm; contact modulus, MPa; wear coefficient, mm²/N; mean pressure, MPa.
const FLAT: (f64, f64, f64, f64) = (0.5, 115_385.0, 1e-9, 850.0);

/// A flat on a half plane with a faint random roughness, `elements` across.
fn rough_flat(elements: usize) -> SlidingContact {
    let (a, modulus, k, mean) = FLAT;
    let h = 2.0 * a / elements as f64;
    let roughness = 1e-3 * h * mean / modulus;
    let gap = |x: f64| roughness * (2.399_963 * ((x + a) / h).round().powi(2)).sin();
    SlidingContact::new(
        even_grid(-a, a, elements),
        gap,
        |x, _| weighted_compliance(x, modulus, 8.0 * a),
        2.0 * a * mean,
        k,
    )
}

/// F8: explicit updates of 0.5 and 3 times the limit over 200 updates, and the integrator's own steps, on a flat with
/// `elements` elements.
///
/// The flat is worn to even pressure first (its corners would dominate otherwise). Saw tooth is the second difference of
/// the pressure of neighbouring nodes over 4 p̄, the largest over the inner nodes.
///
/// # Errors
/// [`CaseError`] if contact or step control fails.
pub fn explicit_limit(elements: usize, tolerance: f64) -> Result<Vec<Measured>, CaseError> {
    let (a, modulus, k, mean) = FLAT;
    let h = 2.0 * a / elements as f64;
    let limit = stable_sliding(h, k, modulus);
    let floor = 1e-2 * a * mean / modulus;
    let mut system = rough_flat(elements);
    let even_after = 40.0 * a / (k * modulus);
    let worn = history(
        &mut system,
        &[0.01 * even_after, 0.1 * even_after, even_after],
        tolerance,
        floor,
    )?;
    let settled = &worn[2].depth;
    // the fastest decay of the discrete system decides the true limit of explicit steps
    let nodal = 2.0 / fastest_decay(&mut system, settled)?;
    let mut out = vec![
        Measured::relative(
            "F8",
            "explicit limit of the hats over (4/pi) h/(k E*)",
            nodal / limit,
            1.0,
            0.1,
        ),
        Measured::bound(
            "F8",
            "saw tooth of the integrator's result, 1 % of the way",
            saw_tooth(&worn[0].pressure, mean),
            0.02,
        ),
        Measured::bound(
            "F8",
            "saw tooth of the integrator's result, end",
            saw_tooth(&worn[2].pressure, mean),
            1e-3,
        ),
    ];
    // a saw tooth of one part in 10⁵ of the pressure is put on top
    let disturbed: Vec<f64> = settled
        .iter()
        .enumerate()
        .map(|(i, u)| u + if i % 2 == 0 { 1e-5 } else { -1e-5 } * h * mean / modulus)
        .collect();
    for (factor, bound) in [(0.5, true), (3.0, false)] {
        let saw = explicit_updates(&mut system, disturbed.clone(), factor * limit)?;
        let name = format!(
            "explicit Euler at {factor} x limit, 200 updates: largest saw tooth over the first"
        );
        // far beyond the limit it must be seen to grow: the error is that of the reciprocal
        out.push(if bound {
            Measured::bound("F8", name, saw.worst / saw.start, 1.001)
        } else {
            let name = format!("{name} (reciprocal)");
            Measured::bound("F8", name, saw.start / saw.worst, 1e-2)
        });
    }
    // the product, asked to step far beyond that limit from the same disturbed state
    let control = StepControl {
        ceiling: f64::INFINITY,
        tolerance,
        floor,
        first_step: 100.0 * limit,
        hesitates: false,
        least_growth: 0.0,
    };
    let (saw, updates) = integrated(&mut system, disturbed, 2e4 * limit, control)?;
    out.push(Measured::bound(
        "F8",
        format!("integrator, {updates} steps of 100 x limit and more: saw tooth over the first"),
        saw.worst / saw.start,
        1.0,
    ));
    Ok(out)
}

/// The saw tooth of the pressure before any update, and the largest after one.
struct SawTooth {
    start: f64,
    worst: f64,
}

/// Of 200 explicit updates of this length (mm of sliding).
fn explicit_updates(
    system: &mut SlidingContact,
    mut u: Vec<f64>,
    step: f64,
) -> Result<SawTooth, CaseError> {
    let (.., mean) = FLAT;
    let start = saw_tooth(&system.contact(&u)?.pressure, mean);
    let mut worst = 0.0f64;
    for _ in 0..200 {
        let rate = system.rate(0.0, &u)?;
        u.iter_mut().zip(rate).for_each(|(u, r)| *u += step * r);
        worst = worst.max(saw_tooth(&system.contact(&u)?.pressure, mean));
    }
    Ok(SawTooth { start, worst })
}

/// Of the integrator's own steps to `end` (mm of sliding), and how many it took.
fn integrated(
    system: &mut SlidingContact,
    u: Vec<f64>,
    end: f64,
    control: StepControl,
) -> Result<(SawTooth, usize), CaseError> {
    let (.., mean) = FLAT;
    let start = saw_tooth(&system.contact(&u)?.pressure, mean);
    let mut stand = Stand::new(u, control);
    let mut worst = 0.0f64;
    let mut updates = 0;
    while stand.n < end {
        advance(system, &mut stand, end, control)?;
        worst = worst.max(saw_tooth(&system.contact(&stand.u)?.pressure, mean));
        updates += 1;
    }
    Ok((SawTooth { start, worst }, updates))
}

fn saw_tooth(p: &[f64], mean: f64) -> f64 {
    let inner = &p[2..p.len() - 2];
    inner
        .windows(3)
        .map(|w| (w[0] - 2.0 * w[1] + w[2]).abs() / (4.0 * mean))
        .fold(0.0, f64::max)
}

/// Largest decay rate of the linearised wear system, 1/mm, by power iteration.
fn fastest_decay(system: &mut SlidingContact, u: &[f64]) -> Result<f64, CaseError> {
    let Some(Jacobian::Full(j)) = system.jacobian(0.0, u)? else {
        unreachable!("sliding contact has a Jacobian of one piece")
    };
    let n = u.len();
    let mut v: Vec<f64> = (0..n)
        .map(|i| if i % 2 == 0 { 1.0 } else { -1.0 })
        .collect();
    let mut rate = 0.0;
    for _ in 0..300 {
        let mut image = vec![0.0; n];
        for (c, &x) in v.iter().enumerate() {
            for (r, y) in image.iter_mut().enumerate() {
                *y += j[(r, c)] * x;
            }
        }
        rate = image.iter().fold(0.0f64, |m, y| m.max(y.abs()));
        v = image.iter().map(|y| y / rate).collect();
    }
    Ok(rate)
}
