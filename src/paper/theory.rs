//! What correct theory says where the paper's print does not: three short formulas, independent of the rest of the crate.

use super::geometry::inv;
use super::{Geometry, Inputs};

/// Depth worn off a point of one flank in one pass of a line contact, mm.
///
/// ```text
/// h = k F' |1 − v2/v1|        k F' mm, v1 and v2 the speeds of the own and the other surface through the contact
/// ```
/// Andersson & Eriksson 1990 (single-point observation); Flodin & Andersson 1997: sliding distance 2 a_H |1 − v2/v1| at the
/// mean pressure F'/(2 a_H). Pressure shape and contact width cancel. `k_load` is k F'.
pub fn depth_per_pass(k_load: f64, own_speed: f64, other_speed: f64) -> f64 {
    k_load * (1.0 - other_speed / own_speed).abs()
}

/// Circular backlash on the operating pitch circle, mm, when the pair has `nominal` (mm) at its nominal centre distance.
///
/// ```text
/// j = (a'/CD)·[ j0 + m (z1 + z2) (inv α' − inv α) ]
/// ```
/// Tooth thickness at a diameter and the operating pressure angle, Maitra, Handbook of Gear Design; the paper's Eq. 5 drops
/// m (z1 + z2)/2, which also leaves it without a unit of length. For a pair without profile shift.
pub fn backlash(inputs: &Inputs, geometry: &Geometry, nominal: f64) -> f64 {
    let z = f64::from(inputs.teeth[0]) + f64::from(inputs.teeth[1]);
    let widening = inv(geometry.operating_angle) - inv(inputs.pressure_angle);
    geometry.centre_distance / inputs.centre_distance * (nominal + inputs.module * z * widening)
}

/// Length of the path of contact along which two pairs touch, mm: twice what exceeds one base pitch.
pub fn double_contact_length(geometry: &Geometry) -> f64 {
    2.0 * (geometry.path_of_contact - geometry.base_pitch)
}
