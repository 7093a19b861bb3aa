//! Measured points, the model's line and their difference along the flank or the rotation: what pictures are drawn from.

use std::collections::BTreeMap;

use super::residual_statistics::fitted;
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::region::FlankRegions;
use crate::measure::{Dataset, Quantity, Subject};
use crate::study::{Role, Study};

/// One trace, or the rows without a trace of one test, member, quantity and number of cycles.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Number of the test in the study.
    pub test: usize,
    /// Its role.
    pub role: Role,
    /// On what.
    pub member: Subject,
    /// What.
    pub quantity: Quantity,
    /// When, pinion revolutions.
    pub cycles: f64,
    /// Name of the trace.
    pub trace: Option<String>,
    /// Its most probable datum, in the quantity's unit.
    pub datum: f64,
    /// By ascending position.
    pub points: Vec<CurvePoint>,
}

/// One point of a curve, in the quantity's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Radius, mm, or rotation, base pitches; 0 for the whole member.
    pub position: f64,
    /// Distance along the path of contact from the pitch point, mm, of points on a flank.
    pub path: Option<f64>,
    /// Measured value minus what datum, tilt and shift of the trace make here.
    pub measured: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// What the model says.
    pub model: f64,
    /// Model minus measured.
    pub residual: f64,
}

/// The most probable datum of a trace.
fn datum(fit: &Fit, trace: usize) -> f64 {
    let own = fit.datums.iter().find(|datum| datum.trace == trace);
    own.map_or(0.0, |datum| datum.value)
}

/// All curves, by test, member, quantity, cycles and trace.
pub fn curves(study: &Study, data: &Dataset, fit: &Fit) -> Vec<Curve> {
    let map = FlankRegions::new(study, data);
    let mut curves: BTreeMap<_, Curve> = BTreeMap::new();
    for (o, row) in fitted(data, fit) {
        let key = (o.test, o.member, o.quantity, o.cycles.to_bits(), o.trace);
        let curve = curves.entry(key).or_insert_with(|| Curve {
            test: o.test,
            role: study.tests[o.test].role,
            member: o.member,
            quantity: o.quantity,
            cycles: o.cycles,
            trace: o.trace.map(|trace| data.traces[trace].name.clone()),
            datum: o.trace.map_or(0.0, |trace| datum(fit, trace)),
            points: Vec::new(),
        });
        curve.points.push(CurvePoint {
            position: o.position.unwrap_or(0.0),
            path: map.path(o),
            measured: o.value - row.datum,
            sigma: o.sigma,
            model: row.model,
            residual: row.residual,
        });
    }
    let mut curves: Vec<Curve> = curves.into_values().collect();
    for curve in &mut curves {
        curve
            .points
            .sort_by(|a, b| a.position.total_cmp(&b.position));
    }
    curves
}
