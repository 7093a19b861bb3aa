//! How the wear of one mesh position spreads over the flanks.
//!
//! A position stands for the path between its neighbours. Its rate profile, known on the contact's own grid, is carried
//! along both flanks at the speed of the contact, faded linearly towards the neighbours, times the sliding at each
//! instant, and gathered on the stations' hats:
//!
//! ```text
//! D_ki = 1/∫N_i ds · ∫ hat(y') |v(y')| ∫ N_k(ξ) N_i(s(ξ) + s' · (y' − y)) dξ dy'
//! ```
//! All of a pass is covered whatever the step between positions, so no scallops appear, and the worn area is conserved
//! exactly: Σ_i D_ki ∫N_i = ∫ hat |v| dy' · ∫ N_k dξ.

use crate::numeric::passed;
use crate::numeric::sparse::SparseRows;

/// Motion of a contact along one flank around a mesh position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Travel {
    /// Half width of the position's hat: spacing of positions along the path of contact, mm.
    pub step: f64,
    /// Arc travelled on this flank per path of contact, mm/mm (signed).
    pub speed: f64,
    /// Sliding distance per path of contact at the position, signed, mm/mm.
    pub slip: f64,
    /// Change of that per path of contact, 1/mm.
    pub slip_slope: f64,
}

impl Travel {
    /// The sliding distance that the position stands for, ∫ hat |v| dy, mm.
    ///
    /// ```text
    /// |v₀| s                      with one sign of v = v₀ + v' y over the hat of half width s
    /// |v₀| s + |v'| t³/(3 s)      where it changes its sign within it, at t = s − |v₀/v'| from the hat's end
    /// ```
    pub fn slid(&self) -> f64 {
        let beyond = (self.step - (self.slip / self.slip_slope).abs()).max(0.0);
        self.slip.abs() * self.step + self.slip_slope.abs() * beyond.powi(3) / (3.0 * self.step)
    }
}

/// The operator D of one flank: rows are the hats on `xi`, columns the stations `stations` (ascending arc, mm).
///
/// `arc` holds the flank's arc coordinate at each node of `xi`. What would fall beyond an end of the flank is laid down as far before it: between this
/// position and the next the contact comes to a stop at the corner. Kept at the end's own station it would dig a hole there, the deeper the
/// farther positions lie apart.
pub fn deposit(xi: &[f64], arc: &[f64], stations: &[f64], travel: Travel) -> SparseRows {
    let times = instants(travel, stations);
    let spacing = spacing(stations);
    let mut rows = Accumulator::new(stations);
    SparseRows::from_rows((0..xi.len()).map(|k| {
        // the interval after node k bears half of the hat there, and half of the next one
        if k + 1 < xi.len() {
            let length = arc[k + 1] - arc[k];
            // an interval longer than the stations' spacing is divided, or it would be felt at four of them only
            let pieces = (length.abs() / spacing).round().max(1.0);
            for piece in 0..pieces as usize {
                for (u, weight) in GAUSS {
                    let u = (piece as f64 + u) / pieces;
                    let area = weight / pieces * (xi[k + 1] - xi[k]);
                    for &(shift, slide) in &times {
                        let at = arc[k] + u * length + shift;
                        rows.add(at, [1.0 - u, u].map(|hat| hat * area * slide));
                    }
                }
            }
        }
        rows.take()
    }))
}

/// Four-point Gauss rule on (0, 1).
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Shift along the flank and weight (hat × sliding × dy) of the instants that stand for the position.
fn instants(travel: Travel, stations: &[f64]) -> Vec<(f64, f64)> {
    let spacing = spacing(stations);
    let mut cuts = vec![-travel.step, 0.0, travel.step];
    let zero = -travel.slip / travel.slip_slope;
    if zero.abs() < travel.step {
        cuts.push(zero);
    }
    cuts.sort_by(f64::total_cmp);
    let mut out = Vec::new();
    for cut in cuts.windows(2) {
        let width = cut[1] - cut[0];
        let pieces = (width * travel.speed.abs() / spacing).ceil().max(1.0);
        for piece in 0..pieces as usize {
            for (u, weight) in GAUSS {
                let y = cut[0] + width * (piece as f64 + u) / pieces;
                let fade = 1.0 - y.abs() / travel.step;
                let slide = (travel.slip + travel.slip_slope * y).abs();
                out.push((travel.speed * y, fade * slide * weight * width / pieces));
            }
        }
    }
    out
}

fn spacing(stations: &[f64]) -> f64 {
    (stations[stations.len() - 1] - stations[0]) / (stations.len() - 1) as f64
}

/// Sums contributions to neighbouring stations, for one row and for the next.
struct Accumulator<'s> {
    stations: &'s [f64],
    /// The inverse of each station's [`tributary`], 1/mm.
    per_length: Vec<f64>,
    sums: [Sums; 2],
}

/// What has been added up at each station, and the first and one past the last station that has been added to.
struct Sums {
    areas: Vec<f64>,
    touched: (usize, usize),
}

impl<'s> Accumulator<'s> {
    fn new(stations: &'s [f64]) -> Self {
        let last = stations.len() - 1;
        let inverse = |i| tributary(stations, i).recip();
        Self {
            stations,
            per_length: (0..=last).map(inverse).collect(),
            sums: [0, 1].map(|_| Sums {
                areas: vec![0.0; stations.len()],
                touched: (stations.len(), 0),
            }),
        }
    }

    /// Adds an area of this row and one of the next at the place `s`.
    fn add(&mut self, s: f64, areas: [f64; 2]) {
        let stations = self.stations;
        let last = stations.len() - 1;
        let ends = [stations[0], stations[last]];
        // past an end of the flank, back from it; farther past than a flank is long nothing is carried
        let beyond = s - s.clamp(ends[0], ends[1]);
        let s = (s - 2.0 * beyond).clamp(ends[0], ends[1]);
        let next = passed(stations, s).clamp(1, last);
        let t = (s - stations[next - 1]) / (stations[next] - stations[next - 1]);
        for (sums, area) in self.sums.iter_mut().zip(areas) {
            sums.areas[next - 1] += (1.0 - t) * area;
            sums.areas[next] += t * area;
            sums.touched = (sums.touched.0.min(next - 1), sums.touched.1.max(next + 1));
        }
    }

    /// The sums of this row; the next one becomes this one.
    fn take(&mut self) -> Vec<(u32, f64)> {
        self.sums.swap(0, 1);
        let [_, Sums { areas, touched }] = &mut self.sums;
        let (from, to) = std::mem::replace(touched, (areas.len(), 0));
        (from..to)
            .map(|i| (i as u32, std::mem::take(&mut areas[i]) * self.per_length[i]))
            .collect()
    }
}

/// ∫ N_i ds: the flank length that belongs to station `i`, mm.
pub fn tributary(stations: &[f64], i: usize) -> f64 {
    let last = stations.len() - 1;
    0.5 * (stations[(i + 1).min(last)] - stations[i.saturating_sub(1)])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is laid down along the flank is the sliding distance times the length of each hat, also at the pitch point and
    /// where the flank ends.
    #[test]
    fn the_area_laid_down_is_the_sliding_distance_in_closed_form() {
        let stations: Vec<f64> = (0..=40).map(|i| 0.01 * f64::from(i)).collect();
        let xi = [-0.03, -0.01, 0.02, 0.05];
        for (slip, slip_slope, centre) in [
            (0.3, 0.2, 0.2),
            (-0.004, 0.2, 0.2),
            (0.0, -0.2, 0.2),
            (0.01, -0.3, 0.01),
            (0.02, 0.3, 0.39),
        ] {
            let travel = Travel {
                step: 0.08,
                speed: -0.7,
                slip,
                slip_slope,
            };
            let arc: Vec<f64> = xi.iter().map(|x| centre + 1.1 * x).collect();
            let d = deposit(&xi, &arc, &stations, travel);
            let lengths = [0.01, 0.025, 0.03, 0.015];
            for (k, length) in lengths.iter().enumerate() {
                let mut depth = vec![0.0; stations.len()];
                d.scatter(k, 1.0, &mut depth);
                let area: f64 = (0..stations.len())
                    .map(|i| depth[i] * tributary(&stations, i))
                    .sum();
                assert!((area / (length * travel.slid()) - 1.0).abs() < 1e-12);
            }
        }
    }

    /// Each hat's wear lies about its own middle, moved the way in which the sliding grows:
    ///
    /// ```text
    /// ∫ N_k ξ dξ / ∫ N_k dξ = (ξ_{k-1} + ξ_k + ξ_{k+1})/3       of the first and the last hat (2 ξ_k + ξ_next)/3
    /// ∫ hat |v| s' y dy / ∫ hat |v| dy = s' v' step²/(6 v₀)      with one sign of v = v₀ + v' y
    /// ```
    #[test]
    fn the_middle_of_what_is_laid_down_is_in_closed_form() {
        let stations: Vec<f64> = (0..=40).map(|i| 0.01 * f64::from(i)).collect();
        let xi = [-0.03, -0.01, 0.02, 0.05];
        let middles = [-0.07 / 3.0, -0.02 / 3.0, 0.06 / 3.0, 0.12 / 3.0];
        for (slip, slip_slope, speed) in [(0.3, 2.0, -0.7), (0.3, -1.5, 0.7), (-0.4, 2.0, 0.7)] {
            let travel = Travel {
                step: 0.08,
                speed,
                slip,
                slip_slope,
            };
            let moved = speed * slip_slope * travel.step.powi(2) / (6.0 * slip);
            let arc: Vec<f64> = xi.iter().map(|x| 0.2 + 1.1 * x).collect();
            let d = deposit(&xi, &arc, &stations, travel);
            for (k, middle) in middles.iter().enumerate() {
                let mut depth = vec![0.0; stations.len()];
                d.scatter(k, 1.0, &mut depth);
                let areas: Vec<f64> = (0..stations.len())
                    .map(|i| depth[i] * tributary(&stations, i))
                    .collect();
                let moment: f64 = areas.iter().zip(&stations).map(|(a, s)| a * s).sum();
                let found = moment / areas.iter().sum::<f64>();
                let expected = 0.2 + 1.1 * middle + moved;
                assert!((found - expected).abs() < 1e-12, "{found} {expected}");
            }
        }
    }

    #[test]
    fn worn_area_is_conserved_and_a_pass_leaves_no_scallops() {
        let stations: Vec<f64> = (0..=300).map(|i| 0.01 * f64::from(i)).collect();
        let xi: Vec<f64> = (-6..=6).map(|i| 0.015 * f64::from(i)).collect();
        let pressure: Vec<f64> = xi
            .iter()
            .map(|x| (1.0 - (x / 0.09f64).powi(2)).max(0.0).sqrt())
            .collect();
        let (speed, step) = (0.7, 0.11);
        let mut depth = vec![0.0; stations.len()];
        // constant sliding: a contact that passes with constant profile must leave a flat floor
        for q in 0..30 {
            let centre = 0.3 + speed * step * f64::from(q);
            let arc: Vec<f64> = xi.iter().map(|x| centre + x).collect();
            let d = deposit(
                &xi,
                &arc,
                &stations,
                Travel {
                    step,
                    speed,
                    slip: 0.4,
                    slip_slope: 1e-30,
                },
            );
            for (k, p) in pressure.iter().enumerate() {
                d.scatter(k, *p, &mut depth);
            }
        }
        let area: f64 = (0..stations.len())
            .map(|i| depth[i] * tributary(&stations, i))
            .sum();
        let load: f64 = xi
            .windows(2)
            .zip(pressure.windows(2))
            .map(|(x, p)| 0.5 * (x[1] - x[0]) * (p[0] + p[1]))
            .sum();
        assert!((area / (load * 0.4 * 30.0 * step) - 1.0).abs() < 1e-12);
        let floor = load * 0.4 / speed;
        for (s, h) in stations.iter().zip(&depth) {
            if (0.7..2.2).contains(s) {
                assert!((h / floor - 1.0).abs() < 2e-3, "{h} against {floor} at {s}");
            }
        }
    }

    /// A contact that passes out over the flank's end with constant load leaves a flat floor up to the end, however coarse the positions.
    #[test]
    fn a_pass_over_the_end_digs_no_hole_there() {
        let stations: Vec<f64> = (0..=300).map(|i| 0.01 * f64::from(i)).collect();
        let xi: Vec<f64> = (-6..=6).map(|i| 0.015 * f64::from(i)).collect();
        let pressure = xi.iter().map(|x| (1.0 - (x / 0.09f64).powi(2)).max(0.0));
        let pressure: Vec<f64> = pressure.collect();
        for (speed, step) in [(0.7_f64, 0.4), (0.7, 0.11), (-0.7, 0.11)] {
            let mut depth = vec![0.0; stations.len()];
            for q in 0..8 {
                let before = speed.abs() * step * (f64::from(q) + 0.5);
                let centre = if speed > 0.0 { 3.0 - before } else { before };
                let arc: Vec<f64> = xi.iter().map(|x| centre + x).collect();
                let travel = Travel {
                    step,
                    speed,
                    slip: 0.4,
                    slip_slope: 1e-30,
                };
                let d = deposit(&xi, &arc, &stations, travel);
                for (k, p) in pressure.iter().enumerate() {
                    d.scatter(k, *p, &mut depth);
                }
            }
            let load: f64 = (xi.windows(2).zip(pressure.windows(2)))
                .map(|(x, p)| 0.5 * (x[1] - x[0]) * (p[0] + p[1]))
                .sum();
            let floor = load * 0.4 / speed.abs();
            let passed = |s: &f64| if speed > 0.0 { *s > 2.6 } else { *s < 0.4 };
            for (s, h) in stations.iter().zip(&depth).filter(|(s, _)| passed(s)) {
                assert!((h / floor - 1.0).abs() < 0.01, "{h} against {floor} at {s}");
            }
        }
    }
}
