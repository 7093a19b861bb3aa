//! The scatter of series too short for neighbours: a few weighings of one member in one test, without a sigma.
//!
//! ```text
//! y ≈ a N + b N²               least squares of each series; nothing is lost at the start
//! y ≈ a N + b (1 − e^(−N/T))   where it leaves clearly less in all series of the member together, T one for all of them
//! s² = Σ r²/ν,  ν = n − 2 of n points, times 1 − 1/Σν where T is fitted
//! ```
//! Running-in bends as the second, and no parabola follows it.
//!
//! ln s of ν degrees of freedom has the mean ½(ψ(ν/2) − ln(ν/2)) over ln σ and the variance ¼ψ'(ν/2) (moments of the logarithm of χ²; Johnson,
//! Kotz & Balakrishnan, Continuous Univariate Distributions 1, 1994, ch. 18). A law of wear that bends in another way counts as scatter.

use super::pooled_scatter::CurveScatter;

/// Bias and variance of ln s with 1, 2, 3 and 4 degrees of freedom.
const MOMENTS: [[f64; 2]; 4] = [
    [-0.635, 1.234],
    [-0.289, 0.411],
    [-0.184, 0.234],
    [-0.135, 0.161],
];

/// T over the last cycles of all series that are tried: from a shorter one on nothing bends within a series, and at the longest it is a parabola.
const SHORTEST: f64 = 0.02;
const LONGEST: f64 = 1.0;
const STEP: f64 = 1.25;
/// Degrees of freedom of a member's series from which T is fitted.
const FREEDOM: f64 = 6.0;
/// How much less T has to leave, in parts of what is left per degree of freedom: noise makes it so much less in one file of a hundred at most.
const CLEARLY: f64 = 8.0;

/// (cycles, value) of a member in one test.
pub(super) type Series = Vec<[f64; 2]>;

/// How the wear of a member grows, beside in proportion to the cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Bend {
    Parabola,
    /// With its cycles.
    RunningIn(f64),
}

/// Scatter of each series of one quantity and member; None of fewer than three points, or where more than four degrees of freedom are left: such a
/// series has neighbours. No less than `least` of its largest value.
pub(super) fn scatters(series: &[Series], least: f64) -> Vec<Option<CurveScatter>> {
    let by = |bend: Bend| -> Vec<Option<Left>> {
        series.iter().map(|points| Left::of(points, bend)).collect()
    };
    let parabolas = by(Bend::Parabola);
    let freedom: f64 = parabolas.iter().flatten().map(|left| left.freedom()).sum();
    let last = series.iter().flatten().map(|[x, _]| *x).fold(0.0, f64::max);
    let times = std::iter::successors(Some(SHORTEST), |time| Some(STEP * time));
    let known = |all: &Vec<Option<Left>>| {
        let mut alike = all.iter().zip(&parabolas);
        alike.all(|(own, parabola)| own.is_some() == parabola.is_some())
    };
    let best = (times.take_while(|time| *time <= LONGEST))
        .map(|time| by(Bend::RunningIn(time * last)))
        .filter(known)
        .min_by(|a, b| pooled(a).total_cmp(&pooled(b)));
    let (best, free) = match best {
        Some(best)
            if freedom >= FREEDOM
                && pooled(&parabolas) > (1.0 + CLEARLY / freedom) * pooled(&best) =>
        {
            (best, 1.0 - freedom.recip())
        }
        _ => (parabolas, 1.0),
    };
    let scatter = |left: &Option<Left>| Some(left.as_ref()?.scatter(free, least));
    best.iter().map(scatter).collect()
}

/// Squares that are left of all series, each in parts of its largest value.
fn pooled(all: &[Option<Left>]) -> f64 {
    (all.iter().flatten())
        .map(|left| left.squares / left.largest.powi(2))
        .sum()
}

/// What a smooth growth from nothing leaves of a series.
struct Left {
    squares: f64,
    points: usize,
    largest: f64,
}

impl Left {
    fn of(points: &[[f64; 2]], bend: Bend) -> Option<Self> {
        MOMENTS.get(points.len().checked_sub(3)?)?;
        let last = points.iter().map(|[x, _]| *x).fold(0.0, f64::max);
        let largest = points.iter().map(|[_, y]| y.abs()).fold(0.0, f64::max);
        let bases = |n: f64| match bend {
            Bend::Parabola => [n / last, (n / last).powi(2)],
            Bend::RunningIn(time) => [n / last, 1.0 - (-n / time).exp()],
        };
        let sum = |f: &dyn Fn([f64; 2], f64) -> f64| -> f64 {
            points.iter().map(|[x, y]| f(bases(*x), *y)).sum()
        };
        let [uu, uv, vv] = [
            sum(&|[u, _], _| u * u),
            sum(&|[u, v], _| u * v),
            sum(&|[_, v], _| v * v),
        ];
        let [uy, vy] = [sum(&|[u, _], y| u * y), sum(&|[_, v], y| v * y)];
        let determinant = uu * vv - uv * uv;
        if !(last > 0.0 && largest > 0.0 && determinant > f64::EPSILON * uu * vv) {
            return None;
        }
        let a = (uy * vv - vy * uv) / determinant;
        let b = (vy * uu - uy * uv) / determinant;
        Some(Self {
            squares: sum(&|[u, v], y| (y - a * u - b * v).powi(2)),
            points: points.len(),
            largest,
        })
    }

    fn freedom(&self) -> f64 {
        self.points as f64 - 2.0
    }

    /// `free`: part of the degrees of freedom that is left.
    fn scatter(&self, free: f64, least: f64) -> CurveScatter {
        let [bias, variance] = MOMENTS[self.points - 3];
        let scatter = (self.squares / (free * self.freedom())).sqrt() * (-bias).exp();
        CurveScatter {
            scatter: scatter.max(least * self.largest),
            largest: self.largest,
            points: self.points,
            variance,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of one series by itself.
    fn scatter(points: &[[f64; 2]], least: f64) -> Option<CurveScatter> {
        scatters(&[points.to_vec()], least)[0]
    }

    #[test]
    fn a_parabola_from_nothing_has_no_scatter() {
        let points = [1.0, 2.0, 3.0, 5.0].map(|x| [1e5 * x, 3.0 * x - 0.2 * x * x]);
        let found = scatter(&points, 1e-3).unwrap();
        assert!((found.scatter - 1e-3 * found.largest).abs() < 1e-12);
        assert!(scatter(&points[..2], 1e-3).is_none());
        assert!(scatter(&[[0.0, 1.0]; 4], 1e-3).is_none());
    }

    /// Six tests of 600 000 to 1 500 000 cycles that run in (three and a half times as much wear at the start, 150 000 cycles), stopped at other
    /// cycles each, and noise of 0.3 mg: no parabola follows their growth, and the noise is found all the same.
    #[test]
    fn running_in_is_no_scatter() {
        let mut noise = normals();
        let grown = |n: f64| n / 1e5 + 3.75 * (1.0 - (-n / 1.5e5).exp());
        let mut logs = Vec::new();
        for _ in 0..300 {
            let series: Vec<Series> = [6e5, 8e5, 1e6, 1e6, 1.2e6, 1.5e6]
                .map(|end| {
                    [0.1, 0.25, 0.5, 0.75, 1.0]
                        .map(|part| [part * end, 1.2 * grown(part * end) + 0.3 * noise()])
                        .to_vec()
                })
                .into();
            logs.extend(
                scatters(&series, 0.0)
                    .iter()
                    .flatten()
                    .map(|s| (s.scatter / 0.3).ln()),
            );
            let parabola = Left::of(&series[0], Bend::Parabola).unwrap();
            assert!(parabola.squares > 0.0);
        }
        let mean = logs.iter().sum::<f64>() / logs.len() as f64;
        assert!(mean.abs() < 0.1, "{mean}");
    }

    /// Without noise nothing is left of it but what T is off the nearest that is tried.
    #[test]
    fn a_running_in_from_nothing_has_hardly_any_scatter() {
        let grown = |n: f64| n / 1e5 + 3.75 * (1.0 - (-n / 1.5e5).exp());
        let series: Vec<Series> = [8e5, 1e6, 1.5e6]
            .map(|end| {
                [0.1, 0.25, 0.5, 0.75, 1.0]
                    .map(|part| [part * end, grown(part * end)])
                    .to_vec()
            })
            .into();
        for scatter in scatters(&series, 0.0).into_iter().flatten() {
            assert!(scatter.scatter < 3e-3 * scatter.largest, "{scatter:?}");
        }
        let parabola = Left::of(&series[1], Bend::Parabola)
            .unwrap()
            .scatter(1.0, 0.0);
        assert!(parabola.scatter > 0.02 * parabola.largest, "{parabola:?}");
    }

    /// Normal numbers, the same in every run.
    fn normals() -> impl FnMut() -> f64 {
        let mut state = 7u64;
        let mut uniform = move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            ((state >> 11) as f64 + 0.5) / (1u64 << 53) as f64
        };
        move || (-2.0 * uniform().ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos()
    }

    /// Median over many series of ln s is ln σ, and ln s has the stated variance: noise of known quantiles in all orders.
    #[test]
    fn scatter_has_no_bias_in_the_logarithm() {
        let mut normal = normals();
        for (count, [_, variance]) in (3..).zip(MOMENTS) {
            let logs: Vec<f64> = (0..4000)
                .map(|_| {
                    let points: Vec<[f64; 2]> = (1..=count)
                        .map(|i| [f64::from(i), 5.0 * f64::from(i) + 0.3 * normal()])
                        .collect();
                    (scatter(&points, 0.0).unwrap().scatter / 0.3).ln()
                })
                .collect();
            let mean = logs.iter().sum::<f64>() / logs.len() as f64;
            let spread = logs.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / logs.len() as f64;
            assert!(mean.abs() < 0.06, "{count}: {mean}");
            assert!((spread / variance - 1.0).abs() < 0.15, "{count}: {spread}");
        }
    }
}
