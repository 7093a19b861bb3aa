//! How places on a flank are told, and the positions of a measurement file that they are.

use crate::gear::Gear;
use crate::measure::{Place, Quantity};

/// How a place is told.
///
/// ```text
/// ρ = √(r² − r_b²) = r_b φ      r radius, r_b base radius, ρ roll length, φ roll angle
/// ```
/// ISO 21771, involute of a circle: the roll length is the generatrix from the base circle's tangent point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PositionKind {
    /// Radius, mm.
    Radius,
    /// Diameter, mm.
    Diameter,
    /// Roll angle from the base circle, degrees.
    RollAngle,
    /// Roll length from the base circle, mm.
    RollLength,
    /// Pinion rotation from the pitch point, base pitches: of what stands on no flank.
    Rotation,
    /// The number of teeth that a span goes over.
    Teeth,
}

impl PositionKind {
    /// Its name with its unit.
    pub fn name(self) -> &'static str {
        match self {
            PositionKind::Radius => "radius, mm",
            PositionKind::Diameter => "diameter, mm",
            PositionKind::RollAngle => "roll angle, deg",
            PositionKind::RollLength => "roll length, mm",
            PositionKind::Rotation => "rotation, base pitches",
            PositionKind::Teeth => "teeth spanned",
        }
    }

    /// Its name without a unit.
    pub fn word(self) -> &'static str {
        let name = self.name();
        name.split(',').next().unwrap_or(name)
    }

    /// Of a quantity's places: as stated, or as the header says; a radius if nothing says otherwise.
    pub(super) fn of(quantity: Quantity, stated: Option<Self>, header: &str) -> Self {
        match (quantity.place(), stated) {
            (Place::Rotation, _) => PositionKind::Rotation,
            (Place::Span, _) => PositionKind::Teeth,
            (_, Some(kind)) => kind,
            (_, None) => Self::of_header(header),
        }
    }

    /// What a header's words say; a radius if they say nothing else.
    fn of_header(text: &str) -> Self {
        let text = text.to_lowercase();
        let says = |words: &[&str]| words.iter().any(|word| text.contains(word));
        if says(&[
            "angle", "winkel", "angolo", "angulo", "ángulo", "[deg]", "(deg)", "[°]", "(°)", "_deg",
        ]) {
            PositionKind::RollAngle
        } else if says(&[
            "roll",
            "wälz",
            "waelz",
            "rotolamento",
            "roulement",
            "développement",
            "developpement",
            "développante",
            "developpante",
            "rodadura",
        ]) {
            PositionKind::RollLength
        } else if says(&[
            "diam",
            "diám",
            "diam\u{e8}",
            "durchmesser",
            "messkreis",
            "ø",
            "⌀",
        ]) {
            PositionKind::Diameter
        } else {
            PositionKind::Radius
        }
    }

    /// Whether it is stated, or a header names it and leaves it not to what is taken for granted.
    pub(super) fn is_said_by(self, stated: Option<Self>, header: &str) -> bool {
        let text = header.to_lowercase();
        let says = |word: &str| text.contains(word);
        let is_radius = ["radi", "raggi", "rayon"].into_iter().any(says)
            || text.split([' ', '_', '[', '(']).next() == Some("r");
        stated.is_some() || self != PositionKind::Radius || is_radius
    }

    /// Whether it has a unit of its own.
    pub(super) fn has_unit(self) -> bool {
        !matches!(self, PositionKind::Rotation | PositionKind::Teeth)
    }

    /// What a table says of a radius on a flank, the inverse of [`Self::position`].
    pub(super) fn told(self, radius: f64, gear: &Gear) -> f64 {
        let roll = || (radius.powi(2) - gear.base_radius.powi(2)).max(0.0).sqrt();
        match self {
            PositionKind::Radius | PositionKind::Rotation | PositionKind::Teeth => radius,
            PositionKind::Diameter => 2.0 * radius,
            PositionKind::RollAngle => (roll() / gear.base_radius).to_degrees(),
            PositionKind::RollLength => roll(),
        }
    }

    /// The radius, or the rotation or number of teeth as it is.
    pub(super) fn position(self, value: f64, gear: Option<&Gear>) -> f64 {
        let base = gear.map_or(0.0, |gear| gear.base_radius);
        match self {
            PositionKind::Radius | PositionKind::Rotation | PositionKind::Teeth => value,
            PositionKind::Diameter => 0.5 * value,
            PositionKind::RollAngle => base.hypot(base * value.to_radians()),
            PositionKind::RollLength => base.hypot(value),
        }
    }
}

/// Largest rounding of a stated radius, mm: half of the third decimal.
const ROUNDING: f64 = 5e-4;

/// Whether a radius (mm) lies on a gear's flank.
pub(super) fn on_flank(gear: &Gear, radius: f64) -> bool {
    (gear.form_radius - ROUNDING..=gear.tip_radius + ROUNDING).contains(&radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_tells_how_places_are_told() {
        for (header, kind) in [
            ("Radius [mm]", PositionKind::Radius),
            ("Ø [mm]", PositionKind::Diameter),
            ("⌀", PositionKind::Diameter),
            ("Messkreis", PositionKind::Diameter),
            ("Wälzlänge", PositionKind::RollLength),
            ("Longueur de développante (mm)", PositionKind::RollLength),
            ("roll [°]", PositionKind::RollAngle),
        ] {
            assert_eq!(PositionKind::of_header(header), kind, "{header}");
        }
    }
}
