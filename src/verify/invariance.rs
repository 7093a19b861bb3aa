//! Contact does not depend on how a problem is put (benchmark B7).
//!
//! A cylinder of elements off the middle of a block of elements, both non-matching and of different materials, is solved
//! as it is and again rotated, mirrored, with renumbered nodes, with lengths or stiffness and load scaled, and with the
//! bodies swapped (the other body then carries the grid). Then: bodies apart, just touching, and overlapping at the start.

mod problem;

use self::problem::{LOAD, PLAIN, View, build, offset};
use crate::contact::unilateral::{Drive, UnilateralError};
use crate::verify::sliding::value_at;
use crate::verify::{CaseError, Measured};

/// B7 with `per_half_width` edges on the half width.
///
/// # Errors
/// [`CaseError`] if a mesh is refused or a contact has no solution.
pub fn all(per_half_width: usize) -> Result<Vec<Measured>, CaseError> {
    let plain = Plain::new(per_half_width)?;
    let mut out = plain.seen_otherwise()?;
    out.extend(plain.swapped()?);
    out.extend(plain.apart()?);
    out.push(plain.just_touching()?);
    out.push(plain.overlapping()?);
    Ok(out)
}

/// A contact that was solved.
struct Solved {
    /// Points of the grid along the tangent, mm.
    xi: Vec<f64>,
    /// Pressures there, MPa.
    pressure: Vec<f64>,
    /// Approach of the bodies, mm.
    approach: f64,
}

impl Solved {
    fn of(view: View, per_half_width: usize, drive: Drive) -> Result<Self, CaseError> {
        let pair = build(view, per_half_width)?;
        let s = pair.solve(drive)?;
        Ok(Self {
            xi: pair.xi,
            pressure: s.pressure,
            approach: s.approach,
        })
    }

    /// Largest pressure, MPa.
    fn peak(&self) -> f64 {
        self.pressure.iter().fold(0.0f64, |m, p| m.max(*p))
    }
}

/// The problem as it is, with which the others are compared.
struct Plain {
    per_half_width: usize,
    solved: Solved,
    /// Largest pressure, MPa.
    peak: f64,
}

impl Plain {
    fn new(per_half_width: usize) -> Result<Self, CaseError> {
        let solved = Solved::of(PLAIN, per_half_width, Drive::Load(LOAD))?;
        Ok(Self {
            per_half_width,
            peak: solved.peak(),
            solved,
        })
    }

    /// The same problem put in another way.
    fn solve(&self, view: View, drive: Drive) -> Result<Solved, CaseError> {
        Solved::of(view, self.per_half_width, drive)
    }

    /// Largest difference of `pressure` times `scale` over the peak, at most 1e-8.
    fn same(&self, name: &str, pressure: &[f64], scale: f64) -> Measured {
        let largest = (self.solved.pressure.iter())
            .zip(pressure)
            .map(|(a, b)| (b * scale - a).abs())
            .fold(0.0, f64::max);
        Measured::bound(
            "B7",
            format!("{name}: largest change of p over its peak"),
            largest / self.peak,
            1e-8,
        )
    }

    /// Views in which the grid has the same points.
    fn seen_otherwise(&self) -> Result<Vec<Measured>, CaseError> {
        let rotated = |degrees: f64| View {
            rotation: degrees.to_radians(),
            ..PLAIN
        };
        let mirrored = View {
            mirror: true,
            ..PLAIN
        };
        let renumbered = View {
            renumber: true,
            ..PLAIN
        };
        let longer = View {
            length: 1000.0,
            ..PLAIN
        };
        let stiffer = View {
            stiffness: 1000.0,
            ..PLAIN
        };
        [
            ("rotated by 30 deg", rotated(30.0), LOAD, 1.0),
            ("rotated by 137 deg", rotated(137.0), LOAD, 1.0),
            ("mirrored", mirrored, LOAD, 1.0),
            ("renumbered", renumbered, LOAD, 1.0),
            ("lengths x 1000", longer, 1000.0 * LOAD, 1.0),
            ("E and load x 1000", stiffer, 1000.0 * LOAD, 1e-3),
        ]
        .into_iter()
        .map(|(name, view, load, scale)| {
            let mut pressure = self.solve(view, Drive::Load(load))?.pressure;
            if view.mirror {
                pressure.reverse();
            }
            Ok(self.same(name, &pressure, scale))
        })
        .collect()
    }

    /// The cylinder as body 0, with the grid on the block.
    fn swapped(&self) -> Result<Vec<Measured>, CaseError> {
        let view = View {
            swap: true,
            ..PLAIN
        };
        let swapped = self.solve(view, Drive::Load(LOAD))?;
        let mut out = vec![
            Measured::relative(
                "B7",
                "bodies swapped: largest p, MPa",
                swapped.peak(),
                self.peak,
                0.01,
            ),
            Measured::relative(
                "B7",
                "bodies swapped: approach, mm",
                swapped.approach,
                self.solved.approach,
                0.01,
            ),
        ];
        if self.per_half_width >= 40 {
            // coarser grids differ by their interpolation of the kink at the contact's edge
            out.push(Measured::bound(
                "B7",
                "bodies swapped: change of p, root mean square over that of p",
                self.change(&swapped),
                0.01,
            ));
        }
        Ok(out)
    }

    /// Root mean square of what swapping the bodies changes of the pressures, over that of these.
    fn change(&self, swapped: &Solved) -> f64 {
        let Solved { xi, pressure, .. } = &self.solved;
        // the other body's grid, whose origin is the block's middle, and the tangent runs the other way
        let change: Vec<f64> = (pressure.iter().zip(xi))
            .map(|(p, x)| {
                let there = -x - offset(self.per_half_width);
                p - value_at(&swapped.xi, &swapped.pressure, there)
            })
            .collect();
        let rms = |p: &[f64]| p.iter().map(|p| p * p).sum::<f64>().sqrt();
        rms(&change) / rms(pressure)
    }

    /// Bodies 0.1 mm apart: pushed by less than that, and under the load.
    fn apart(&self) -> Result<Vec<Measured>, CaseError> {
        let apart = View {
            shift: 0.1,
            ..PLAIN
        };
        let refused = matches!(
            self.solve(apart, Drive::Approach(0.05)),
            Err(CaseError::Contact(UnilateralError::Separated { .. }))
        );
        let loaded = self.solve(apart, Drive::Load(LOAD))?;
        Ok(vec![
            Measured::bound(
                "B7",
                "0.1 mm apart, pushed by 0.05 mm: 1 unless refused as separated",
                f64::from(u8::from(!refused)),
                0.0,
            ),
            self.same("0.1 mm apart under load", &loaded.pressure, 1.0),
            Measured::relative(
                "B7",
                "0.1 mm apart under load: approach, mm",
                loaded.approach,
                self.solved.approach + 0.1,
                1e-10,
            ),
        ])
    }

    fn just_touching(&self) -> Result<Measured, CaseError> {
        let touching = self.solve(PLAIN, Drive::Load(1e-12 * LOAD))?;
        let carried = touching.pressure.iter().filter(|p| **p > 0.0).count();
        Ok(Measured::bound(
            "B7",
            "just touching, 1e-12 of the load: points in contact",
            carried as f64,
            2.0,
        ))
    }

    /// Bodies that overlap by 0.1 mm at the start.
    fn overlapping(&self) -> Result<Measured, CaseError> {
        let view = View {
            shift: -0.1,
            ..PLAIN
        };
        let drive = Drive::Approach(self.solved.approach - 0.1);
        let overlap = self.solve(view, drive)?;
        Ok(self.same("initial overlap 0.1 mm", &overlap.pressure, 1.0))
    }
}
