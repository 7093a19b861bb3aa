//! Tooth thickness as gauges feel it, the span over several teeth and the chord at a circle, and what wear of the loaded flanks takes from
//! both: one flank of each tooth wears, the anvil on the other side touches what is new.
//!
//! ```text
//! W_k = r_b (2 ψ_b + (k − 1) τ)                   base tangent length over k teeth, ψ_b half the tooth's angle at the base circle, τ pitch
//! s_c = 2 r sin ψ(r)                              chord at the circle of radius r
//! ```
//! ISO 21771 (2007), tooth span and normal chordal tooth thickness of a spur gear. A flank worn by h normal to itself lies, for the
//! curvature radius ρ, at ρ − h on the same tangent of the base circle. So with the flat anvil on the tangent ρ₀ = W_k/2
//!
//! ```text
//! W_k lost = min over ρ of  ρ₀ − (ρ − h(ρ)) cos δ + r_b sin δ,   δ = (ρ − ρ₀)/r_b          an even h: h
//! s_c lost = 2 r [sin ψ − sin(ψ − h(ρ)/(2 r_b))],   ρ − h(ρ) = √(r² − r_b²)                small h: h r/r_b cos ψ
//! ```

use super::tooth::Gear;
use crate::numeric::interpolate;

/// Worn depths along a loaded flank.
#[derive(Debug, Clone, Copy)]
pub struct WornDepths<'a> {
    /// Ascending arc coordinates, mm.
    pub arcs: &'a [f64],
    /// Depth normal to the flank at each, mm.
    pub depths: &'a [f64],
}

/// What a gauge reads less than on the new tooth, and which depth it feels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThicknessLoss {
    /// The loss, mm.
    pub loss: f64,
    /// Arc coordinate of the flank point on which it depends, mm.
    pub arc: f64,
    /// Derivative of the loss by the depth there.
    pub gain: f64,
}

/// Bisections and thirds of an interval: below rounding.
const HALVINGS: usize = 60;

impl WornDepths<'_> {
    fn at(&self, arc: f64) -> f64 {
        interpolate(self.arcs, self.depths, arc)
    }
}

impl Gear {
    /// Base tangent length over `teeth` teeth of the new gear, mm.
    pub fn span(&self, teeth: u32) -> f64 {
        let pitches = f64::from(teeth.max(1) - 1);
        self.base_radius * (2.0 * self.base_half_angle + pitches * self.pitch_angle())
    }

    /// The numbers of teeth over which a span touches the involute when its anvils stand symmetrically.
    pub fn spanned_teeth(&self) -> Vec<u32> {
        (1..self.spec.teeth)
            .filter(|&teeth| (self.rho_form..=self.rho_end).contains(&(0.5 * self.span(teeth))))
            .collect()
    }

    /// What the span over `teeth` teeth has lost: flat anvils, symmetric on the new gear, of which one rests on a worn flank.
    pub fn span_loss(&self, teeth: u32, worn: WornDepths<'_>) -> ThicknessLoss {
        let touched = 0.5 * self.span(teeth);
        let turned = |arc: f64| (self.rho_at_arc(arc) - touched) / self.base_radius;
        // ρ₀ − ρ cos δ + r_b sin δ with ρ = ρ₀ + r_b δ, without the difference of large numbers
        let short = |arc: f64| {
            let angle = turned(arc);
            let (sin, cos) = angle.sin_cos();
            let sag = 2.0 * touched * (0.5 * angle).sin().powi(2)
                + self.base_radius * (sin - angle * cos);
            worn.at(arc) * cos + sag
        };
        let best = (worn.arcs.iter().enumerate())
            .min_by(|a, b| short(*a.1).total_cmp(&short(*b.1)))
            .map_or(0, |(place, _)| place);
        let last = worn.arcs.len() - 1;
        let sides = [[best.saturating_sub(1), best], [best, (best + 1).min(last)]];
        let least = sides.map(|[a, b]| lowest(worn.arcs[a], worn.arcs[b], &short));
        let arc = if short(least[1]) < short(least[0]) {
            least[1]
        } else {
            least[0]
        };
        ThicknessLoss {
            loss: short(arc),
            arc,
            gain: turned(arc).cos(),
        }
    }

    /// What the chord at the circle of `radius` (mm, on the flank) has lost; where the tooth is worn away there, as at the last point of the flank.
    pub fn chord_loss(&self, radius: f64, worn: WornDepths<'_>) -> ThicknessLoss {
        let circle = self.rho_at_radius(radius);
        let beyond = |arc: f64| self.rho_at_arc(arc) - worn.at(arc) - circle;
        // the first place from the circle outwards that has come down to it
        let mut low = self.arc(circle);
        let mut high = low;
        for &arc in worn.arcs.iter().filter(|&&arc| arc > low) {
            high = arc;
            if beyond(arc) >= 0.0 {
                break;
            }
        }
        if beyond(low) < 0.0 {
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if beyond(middle) < 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
        } else {
            high = low;
        }
        let depth = worn.at(high);
        let half = self.half_angle(radius);
        let turned = 0.5 * depth / self.base_radius;
        let left = half - turned;
        // the point that has come down moves as the depth grows: dρ (1 − h′) = dh
        let next = worn.arcs.partition_point(|&arc| arc <= high);
        let slope = if next == 0 || next == worn.arcs.len() {
            0.0
        } else {
            let by_arc = (worn.depths[next] - worn.depths[next - 1])
                / (worn.arcs[next] - worn.arcs[next - 1]);
            by_arc * self.rho_at_arc(high) / self.base_radius
        };
        ThicknessLoss {
            // sin ψ − sin(ψ − t), as a product
            loss: 4.0 * radius * (half - 0.5 * turned).cos() * (0.5 * turned).sin(),
            arc: high,
            gain: radius / self.base_radius * left.cos() / (1.0 - slope),
        }
    }
}

/// Where `of` is lowest between `a` and `b`, by thirds.
fn lowest(mut a: f64, mut b: f64, of: &impl Fn(f64) -> f64) -> f64 {
    for _ in 0..HALVINGS {
        let third = (b - a) / 3.0;
        if of(a + third) <= of(b - third) {
            b -= third;
        } else {
            a += third;
        }
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gear::{BasicRack, ToothSpec};
    use crate::numeric::Vec2;

    fn gear() -> Gear {
        let spec = ToothSpec {
            profile_shift: 0.2,
            thickness_reduction: 0.05,
            ..ToothSpec::plain(30, 20.0)
        };
        Gear::new(BasicRack::iso53_a(2.0), spec).unwrap()
    }

    /// Span and chord of new gears: DIN 3960's closed forms in module, tooth number and shift.
    #[test]
    fn spans_of_new_gears_are_those_of_the_textbook() {
        let gear = gear();
        let (m, z, x): (f64, f64, f64) = (2.0, 30.0, 0.2);
        let alpha = 20.0_f64.to_radians();
        let inv = alpha.tan() - alpha;
        for teeth in gear.spanned_teeth() {
            let k = f64::from(teeth);
            let pi = std::f64::consts::PI;
            let textbook = m * alpha.cos() * ((k - 0.5) * pi + z * inv) + 2.0 * x * m * alpha.sin()
                - 0.05 * alpha.cos();
            assert!((gear.span(teeth) - textbook).abs() < 1e-12);
        }
        assert_eq!(gear.spanned_teeth(), [3, 4, 5]);
    }

    #[test]
    fn an_even_loss_takes_its_depth_from_the_span_and_more_from_the_chord() {
        let gear = gear();
        let arcs: Vec<f64> = (0..=200)
            .map(|i| {
                gear.arc(gear.rho_form + (gear.rho_tip - gear.rho_form) * f64::from(i) / 200.0)
            })
            .collect();
        for h in [1e-4, 0.02, 0.2] {
            let depths = vec![h; arcs.len()];
            let worn = WornDepths {
                arcs: &arcs,
                depths: &depths,
            };
            let span = gear.span_loss(4, worn);
            assert!((span.loss - h).abs() < 1e-10, "{span:?}");
            assert!((span.gain - 1.0).abs() < 1e-8);
            // the whole flank has turned by h/r_b
            let r = 30.2;
            let chord = gear.chord_loss(r, worn);
            let half = gear.half_angle(r);
            let turned = 2.0 * r * (half.sin() - (half - 0.5 * h / gear.base_radius).sin());
            assert!((chord.loss - turned).abs() < 1e-12, "{chord:?}");
        }
    }

    /// The worn flank as a polygon, measured with ruler and circle.
    #[test]
    fn uneven_losses_agree_with_a_polygon() {
        let gear = gear();
        let count = 400;
        let rho =
            |i: usize| gear.rho_form + (gear.rho_tip - gear.rho_form) * i as f64 / count as f64;
        let arcs: Vec<f64> = (0..=count).map(|i| gear.arc(rho(i))).collect();
        let depths: Vec<f64> = (0..=count)
            .map(|i| {
                let at = rho(i) / gear.rho_tip;
                0.3 * (1.0 - at).powi(2) + 0.05 * (7.0 * at).sin().powi(2)
            })
            .collect();
        let worn = WornDepths {
            arcs: &arcs,
            depths: &depths,
        };
        let fine: Vec<Vec2> = (0..=100 * count)
            .map(|i| {
                let rho = gear.rho_form
                    + (gear.rho_tip - gear.rho_form) * i as f64 / (100 * count) as f64;
                gear.involute_point(rho) - gear.involute_normal(rho) * worn.at(gear.arc(rho))
            })
            .collect();
        for teeth in [3, 4, 5] {
            let touched = 0.5 * gear.span(teeth);
            let normal = gear.involute_normal(touched);
            let reach = (fine.iter())
                .map(|p| p.dot(&normal))
                .fold(f64::MIN, f64::max);
            let loss = gear.involute_point(touched).dot(&normal) - reach;
            let found = gear.span_loss(teeth, worn);
            assert!((found.loss - loss).abs() < 1e-7, "{found:?} {loss}");
        }
        for radius in [29.0, 30.0, 31.0] {
            let (mut crossing, mut before) = (None, fine[0]);
            for p in &fine {
                if before.norm() < radius && p.norm() >= radius {
                    let part = (radius - before.norm()) / (p.norm() - before.norm());
                    crossing = Some(before + (p - before) * part);
                }
                before = *p;
            }
            let worn_side = crossing.unwrap();
            let new_side = {
                let half = gear.half_angle(radius);
                Vec2::new(radius * half.cos(), -radius * half.sin())
            };
            let new_chord = 2.0 * radius * gear.half_angle(radius).sin();
            let loss = new_chord - (worn_side - new_side).norm();
            let found = gear.chord_loss(radius, worn);
            assert!((found.loss - loss).abs() < 1e-6, "{found:?} {loss}");
        }
        // gains against differences
        for place in [0, 1] {
            let of = |by: f64| {
                let moved: Vec<f64> = depths.iter().map(|h| h + by).collect();
                let worn = WornDepths {
                    arcs: &arcs,
                    depths: &moved,
                };
                [gear.span_loss(4, worn), gear.chord_loss(30.0, worn)][place]
            };
            let slope = (of(1e-6).loss - of(-1e-6).loss) / 2e-6;
            assert!(
                (slope / of(0.0).gain - 1.0).abs() < 1e-3,
                "{slope} {:?}",
                of(0.0)
            );
        }
    }
}
