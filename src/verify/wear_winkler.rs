//! Wear on a Winkler foundation, p = K w: exact solutions (benchmarks F2 to F5).
//!
//! ```text
//! full contact      p − p̄ = [p(x, 0) − p̄] exp(−k K s)
//! parabola x²/2R    a³ = a₀³ (1 + τ),  τ = k K s,  a₀³ = 3 F' R/(2K);  dp(0)/dτ + p(0) = (2/3) p₀ (1 + τ)^(−1/3)
//! long run          a³ = 1.5 k F' R s,  p = F'/2a
//! ```
//! The first follows from ∂(g + h − δ)/∂s = 0 at every point, the second from p = h = 0 at the moving edge.

use nalgebra::DMatrix;

use crate::analytic::winkler::{Parabola, full_contact_pressure, worn_half_width};
use crate::contact::mortar::Coupling;
use crate::verify::sliding::{SlidingContact, even_grid, half_width, history, value_at};
use crate::verify::{CaseError, Measured};

/// Foundation modulus K, MPa/mm.
const FOUNDATION: f64 = 1000.0;
/// Wear coefficient of both bodies together, mm²/N.
const COEFFICIENT: f64 = 1e-4;

/// Weighted compliance of the foundation: ∫ N_k N_l / K.
pub fn winkler(x: &[f64], coupling: &Coupling) -> DMatrix<f64> {
    let mut w = DMatrix::zeros(x.len(), x.len());
    for k in 0..x.len() {
        let (columns, values) = coupling.traces[0].row(k);
        for (&c, v) in columns.iter().zip(values) {
            w[(k, c as usize)] = v / FOUNDATION;
        }
    }
    w.fill_lower_triangle_with_upper_triangle();
    w
}

/// F2: flat on flat; both members wear as k₁ p s and k₂ p s.
///
/// # Errors
/// [`CaseError`] if contact or step control fails.
pub fn uniform_block(tolerance: f64) -> Result<Vec<Measured>, CaseError> {
    let (width, pressure, s) = (4.0, 25.0, 800.0);
    let shares = [0.7, 0.3];
    let mut system = SlidingContact::new(
        even_grid(0.0, width, 16),
        |_| 0.0,
        winkler,
        pressure * width,
        COEFFICIENT,
    );
    let end = &history(&mut system, &[s], tolerance, 1e-4)?[0];
    let depth = |share: f64| end.depth.iter().map(|h| share * h).fold(0.0, f64::max);
    let exact = COEFFICIENT * pressure * s;
    let spread = end
        .depth
        .iter()
        .fold(0.0f64, |m, h| m.max((h / exact - 1.0).abs()));
    Ok(vec![
        Measured::relative(
            "F2",
            "block: depth of the first body, mm",
            depth(shares[0]),
            shares[0] * exact,
            1e-8,
        ),
        Measured::relative(
            "F2",
            "block: depth of the second body, mm",
            depth(shares[1]),
            shares[1] * exact,
            1e-8,
        ),
        Measured::bound(
            "F2",
            "block: largest relative deviation of any node",
            spread,
            1e-8,
        ),
        balance("F2", &system, &end.depth, s),
    ])
}

/// The initial profile of F3, mm: asymmetric, everywhere closed by the load.
fn wavy(x: f64) -> f64 {
    0.004 * (1.3 * x).sin() + 0.003 * (x - 0.4).powi(2)
}

/// A full contact of half width 1 mm with the profile [`wavy`]; mean pressure 20 MPa.
pub(crate) fn full_contact(elements: usize) -> SlidingContact {
    SlidingContact::new(
        even_grid(-1.0, 1.0, elements),
        wavy,
        winkler,
        40.0,
        COEFFICIENT,
    )
}

/// F3: full contact; the deviation from the mean pressure decays exponentially.
///
/// # Errors
/// [`CaseError`] if contact or step control fails.
pub fn full_winkler(tolerance: f64) -> Result<Vec<Measured>, CaseError> {
    let mut system = full_contact(40);
    let fresh = system.contact(&vec![0.0; system.x.len()])?.pressure.clone();
    let mean = system.load / 2.0;
    let mut out = Vec::new();
    let taus = [0.3, 1.0, 3.0];
    let stops = taus.map(|tau| tau / (COEFFICIENT * FOUNDATION));
    for (tau, snap) in taus
        .iter()
        .zip(history(&mut system, &stops, tolerance, 1e-5)?)
    {
        let worst = snap
            .pressure
            .iter()
            .zip(&fresh)
            .map(|(p, p0)| {
                let exact = full_contact_pressure(*p0, mean, COEFFICIENT, FOUNDATION, snap.s);
                (p - exact).abs() / mean
            })
            .fold(0.0, f64::max);
        out.push(Measured::bound(
            "F3",
            format!("full Winkler contact, kKs = {tau}: largest pressure error over the mean"),
            worst,
            1e-3,
        ));
        out.push(balance("F3", &system, &snap.depth, snap.s));
    }
    Ok(out)
}

/// F4 and F5: a cylinder of radius R on the foundation with `per_half_width` elements on the first half width.
///
/// # Errors
/// [`CaseError`] if contact or step control fails.
pub fn parabola(per_half_width: usize, tolerance: f64) -> Result<Vec<Measured>, CaseError> {
    let (radius, a0) = (10.0, 0.5f64);
    let load = 2.0 * FOUNDATION * a0.powi(3) / (3.0 * radius);
    let approach = a0 * a0 / (2.0 * radius);
    let p0 = FOUNDATION * approach;
    let h = a0 / per_half_width as f64;
    let cells = (3.3 * per_half_width as f64).ceil() as usize;
    let x = even_grid(-h * cells as f64, h * cells as f64, 2 * cells);
    let mut system = SlidingContact::new(x, |x| x * x / (2.0 * radius), winkler, load, COEFFICIENT);
    let exact = Parabola {
        foundation: FOUNDATION,
        radius,
        load,
        k: COEFFICIENT,
    };
    let taus = [0.2, 0.6, 1.0, 2.0, 6.0, 20.0, 28.0];
    let stops = taus.map(|tau| tau / (COEFFICIENT * FOUNDATION));
    let mut out = Vec::new();
    for (tau, snap) in taus
        .iter()
        .zip(history(&mut system, &stops, tolerance, 1e-3 * approach)?)
    {
        let a = half_width(&system.x, &snap.active);
        let centre = snap.pressure[cells];
        if *tau <= 20.0 {
            out.push(Measured::absolute(
                "F4",
                format!("tau {tau}: a/a0"),
                a / a0,
                exact.half_width(snap.s) / a0,
                h / a0,
            ));
            out.push(Measured::relative(
                "F4",
                format!("tau {tau}: p(0)/p0"),
                centre / p0,
                exact.centre_pressure(snap.s) / p0,
                5e-3,
            ));
            out.push(Measured::relative(
                "F4",
                format!("tau {tau}: w(0)/delta0"),
                snap.depth[cells] / approach,
                exact.centre_depth(snap.s) / approach,
                5e-3,
            ));
        } else {
            let rigid = worn_half_width(COEFFICIENT, load, radius, snap.s);
            out.push(Measured::relative(
                "F5",
                format!("tau {tau}: a against the rigid limit, mm"),
                a,
                rigid,
                0.05,
            ));
            out.push(Measured::relative(
                "F5",
                format!("tau {tau}: p(0) against F'/2a, MPa"),
                centre,
                load / (2.0 * rigid),
                0.05,
            ));
            let half = value_at(&system.x, &snap.pressure, 0.5 * rigid);
            out.push(Measured::relative(
                "F5",
                format!("tau {tau}: p(a/2) against F'/2a, MPa"),
                half,
                load / (2.0 * rigid),
                0.05,
            ));
        }
        out.push(balance("F4", &system, &snap.depth, snap.s));
    }
    Ok(out)
}

/// F1: worn area against k F' s.
pub(crate) fn balance(
    id: &'static str,
    system: &SlidingContact,
    depth: &[f64],
    s: f64,
) -> Measured {
    let law = system.coefficient * system.load * s;
    Measured::relative(
        id,
        format!("F1 balance: worn area at s = {s:.4} mm, mm2"),
        system.worn_area(depth),
        law,
        1e-6,
    )
}
