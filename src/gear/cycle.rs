//! Mesh positions: which teeth can touch where while the pinion turns through one base pitch.

use super::pair::Pair;

/// One pair of teeth at a mesh position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothContact {
    /// The pinion's tooth j, in its member frame.
    pub pinion_tooth: i32,
    /// The gear's tooth −j, in its member frame.
    pub gear_tooth: i32,
    /// Path coordinate of the nominal contact point, mm.
    pub path: f64,
}

/// Part of the path of contact, from its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Region {
    /// A to B: two pairs share the load, the mate's tip region works.
    LowerDouble,
    /// B to C.
    SingleLower,
    /// C to D.
    SingleUpper,
    /// D to E.
    UpperDouble,
}

impl Region {
    /// All regions from the start of contact.
    pub const ALL: [Region; 4] = [
        Region::LowerDouble,
        Region::SingleLower,
        Region::SingleUpper,
        Region::UpperDouble,
    ];

    /// The name used in result files.
    pub fn name(self) -> &'static str {
        match self {
            Region::LowerDouble => "lower_double",
            Region::SingleLower => "single_lower",
            Region::SingleUpper => "single_upper",
            Region::UpperDouble => "upper_double",
        }
    }
}

/// The tooth pairs that can touch at the pinion rotation `theta` (base pitches from the pitch point, any real number;
/// 0 to 1 covers the cycle), by ascending path coordinate.
///
/// Pinion tooth j touches gear tooth −j at the path coordinate (theta + j) p_b when the pinion's frame is turned by
/// `pair.pinion_angle(theta p_b)` and the gear's by `pair.gear_angle(theta p_b)`. Pairs up to `margin` (mm) before A and
/// after E are included: loaded teeth bend into contact there.
pub fn contacts_at(pair: &Pair, theta: f64, margin: f64) -> Vec<ToothContact> {
    let [a, .., e] = pair.path_points();
    let pitch = pair.base_pitch;
    let first = ((a - margin) / pitch - theta).ceil() as i32;
    let last = ((e + margin) / pitch - theta).floor() as i32;
    (first..=last)
        .map(|j| ToothContact {
            pinion_tooth: j,
            gear_tooth: -j,
            path: (theta + f64::from(j)) * pitch,
        })
        .collect()
}

impl Pair {
    /// The region of the path coordinate `y`, mm. Points before A belong to the first, after E to the last region; with a
    /// contact ratio of 2 or more there is no single contact and the pitch point parts the two double regions.
    pub fn region(&self, y: f64) -> Region {
        let [_, b, _, d, _] = self.path_points();
        if b > d {
            return if y < 0.0 {
                Region::LowerDouble
            } else {
                Region::UpperDouble
            };
        }
        if y < b {
            Region::LowerDouble
        } else if y > d {
            Region::UpperDouble
        } else if y < 0.0 {
            Region::SingleLower
        } else {
            Region::SingleUpper
        }
    }

    /// Smallest and largest pinion tooth number that can touch at any position of the cycle 0 <= theta < 1, with `margin`
    /// (mm) beyond A and E. The gear's are the negatives.
    pub fn tooth_range(&self, margin: f64) -> (i32, i32) {
        let [a, .., e] = self.path_points();
        let first = ((a - margin) / self.base_pitch - 1.0).floor() as i32 + 1;
        let last = ((e + margin) / self.base_pitch).floor() as i32;
        (first, last)
    }
}
