//! Which keys an output depends on: Sobol's indices of a Saltelli design, as a table, a document, a text and a picture.

use serde_json::json;

use super::design::{Design, Filling, Kind};
use super::figures::{Figures, Outputs, profile_name};
use super::points::Result;
use super::tables::with_unit;
use crate::numeric::interpolate;
use crate::numeric::sobol_indices::{Indices, Row, sobol_indices};
use crate::report::OutputError;
use crate::report::plots::{IndexBar, IndexPanel, index_picture};
use crate::simulate::result::Member;

/// Radii at which the indices of a wear profile are taken.
const RADII: usize = 41;
/// A depth that varies less than this part of the profile's largest variation has no indices: nothing wears there.
const HARDLY_WORN: f64 = 1e-4;

/// The indices of a sweep.
pub(super) struct Sensitivity {
    /// Rows of the design whose points have all come to figures, and all rows.
    rows: (usize, usize),
    keys: Vec<String>,
    outputs: Vec<Sensitive>,
}

/// The indices of one output, key by key.
struct Sensitive {
    name: String,
    title: String,
    /// Of a wear profile: where, mm.
    radius: Option<f64>,
    indices: Vec<Indices>,
}

/// The rows of a design whose points have all come to figures.
struct Whole<'a> {
    rows: Vec<Vec<&'a Figures>>,
    /// Of the intervals.
    seed: u64,
}

impl Whole<'_> {
    /// The indices of one figure, from the rows in which every point has it.
    fn indices(&self, of: impl Fn(&Figures) -> Option<f64>) -> Option<Vec<Indices>> {
        let rows = self.rows.iter().filter_map(|row| {
            let values: Option<Vec<f64>> = row.iter().map(|figures| of(figures)).collect();
            let mut values = values?;
            let mixed = values.split_off(2);
            Some(Row {
                a: values[0],
                b: values[1],
                mixed,
            })
        });
        sobol_indices(&rows.collect::<Vec<_>>(), self.seed)
    }

    /// The indices of a member's depths along its flank, where it wears.
    fn along_the_flank(&self, member: Member) -> Vec<Sensitive> {
        let depth = |figures: &Figures, at: f64| {
            let profile = figures.profile(member)?;
            let worn = !profile.radius.is_empty();
            worn.then(|| interpolate(&profile.radius, &profile.depth, at))
        };
        let radii = self.radii(member);
        let spreads: Vec<f64> = radii
            .iter()
            .map(|&at| spread(self.rows.iter().flatten().filter_map(|f| depth(f, at))))
            .collect();
        let largest = spreads.iter().copied().fold(0.0, f64::max);
        let mut found = Vec::new();
        for (at, spread) in radii.into_iter().zip(spreads) {
            if spread <= HARDLY_WORN * largest {
                continue;
            }
            if let Some(indices) = self.indices(|figures| depth(figures, at)) {
                found.push(Sensitive {
                    name: profile_name(member),
                    title: format!("Depth along the flank, {}", member.name()),
                    radius: Some(at),
                    indices,
                });
            }
        }
        found
    }

    /// Radii where all flanks are, mm; none where there is no such place.
    fn radii(&self, member: Member) -> Vec<f64> {
        let profiles = || {
            let all = self.rows.iter().flatten();
            all.filter_map(move |figures| figures.profile(member))
                .filter(|profile| !profile.radius.is_empty())
        };
        let ends = |end: fn(&[f64]) -> Option<&f64>| {
            profiles().filter_map(move |profile| end(&profile.radius).copied())
        };
        let low = ends(<[f64]>::first).fold(f64::NEG_INFINITY, f64::max);
        let high = ends(<[f64]>::last).fold(f64::INFINITY, f64::min);
        if low >= high || !(low.is_finite() && high.is_finite()) {
            return Vec::new();
        }
        (0..RADII)
            .map(|i| low + (high - low) * i as f64 / (RADII - 1) as f64)
            .collect()
    }
}

impl Sensitivity {
    /// The indices of every output; none for other designs.
    pub(super) fn of(design: &Design, outputs: &Outputs, results: &[Result]) -> Option<Self> {
        let Kind::Filling(Filling::Saltelli(_), seed, axes) = &design.kind else {
            return None;
        };
        let rows: Vec<&[Result]> = results.chunks_exact(axes.len() + 2).collect();
        let whole: Vec<Vec<&Figures>> = rows
            .iter()
            .filter_map(|row| row.iter().map(|result| result.as_ref().ok()).collect())
            .collect();
        let whole = Whole {
            rows: whole,
            seed: *seed,
        };
        let mut found = Vec::new();
        for &column in &outputs.columns {
            if let Some(indices) = whole.indices(|figures| figures.value(column)) {
                found.push(Sensitive {
                    name: column.name.to_owned(),
                    title: column.title.to_owned(),
                    radius: None,
                    indices,
                });
            }
        }
        for &member in &outputs.profiles {
            found.extend(whole.along_the_flank(member));
        }
        Some(Self {
            rows: (whole.rows.len(), rows.len()),
            keys: design.keys.clone(),
            outputs: found,
        })
    }

    /// The table `sensitivity.csv`.
    pub(super) fn csv(&self) -> String {
        let mut out = "# first: share of the variance that the key causes alone; total: with all its interactions; half widths of intervals of 95 %\n\
                       output,radius,key,first,first_half_width,total,total_half_width\n"
            .to_owned();
        for output in &self.outputs {
            let radius = output.radius.map_or(String::new(), |r| format!("{r:.4}"));
            for (key, indices) in self.keys.iter().zip(&output.indices) {
                let (first, total) = (indices.first, indices.total);
                out += &format!(
                    "{},{radius},{key},{:.5},{:.5},{:.5},{:.5}\n",
                    output.name, first.value, first.half_width, total.value, total.half_width
                );
            }
        }
        out
    }

    /// What the sweep's document holds of it.
    pub(super) fn document(&self) -> serde_json::Value {
        let outputs = self.outputs.iter().map(|output| {
            let keys = self.keys.iter().zip(&output.indices);
            let keys = keys.map(|(key, indices)| {
                json!({
                    "key": key,
                    "first": indices.first.value,
                    "first_half_width": indices.first.half_width,
                    "total": indices.total.value,
                    "total_half_width": indices.total.half_width,
                })
            });
            let mut document = json!({"output": output.name, "keys": keys.collect::<Vec<_>>()});
            if let Some(radius) = output.radius {
                document["radius"] = json!(radius);
            }
            document
        });
        json!({
            "rows": self.rows.0,
            "rows_of_design": self.rows.1,
            "outputs": outputs.collect::<Vec<_>>(),
        })
    }

    /// What a person reads.
    pub(super) fn text(&self) -> String {
        let (used, all) = self.rows;
        let mut out = format!(
            "Sobol indices, shares of the variance that a key causes alone (first) and with its interactions (total), of {used} rows\n"
        );
        if used < all {
            out += &format!(
                "{} rows are left out: some of their points have no figures; the indices are of the others\n",
                all - used
            );
        }
        let width = self.keys.iter().map(|key| key.chars().count()).max();
        let width = width.unwrap_or(0);
        for output in self.outputs.iter().filter(|output| output.radius.is_none()) {
            out += &format!("  {}\n", output.name);
            for (key, indices) in self.keys.iter().zip(&output.indices) {
                let (first, total) = (indices.first, indices.total);
                out += &format!(
                    "    {key:width$}  first {:6.3} ± {:.3}   total {:6.3} ± {:.3}\n",
                    first.value, first.half_width, total.value, total.half_width
                );
            }
        }
        out
    }

    /// The picture `sensitivity.svg`; none where no output varies.
    ///
    /// # Errors
    /// [`OutputError`] if a panel cannot be drawn.
    pub(super) fn picture(
        &self,
        title: &str,
        outputs: &Outputs,
    ) -> std::result::Result<Option<String>, OutputError> {
        let shown: Vec<&str> = outputs.shown().iter().map(|column| column.name).collect();
        let mut panels: Vec<IndexPanel> = Vec::new();
        for output in &self.outputs {
            let bars = || {
                output.indices.iter().map(|indices| IndexBar {
                    first: (indices.first.value, indices.first.half_width),
                    total: (indices.total.value, indices.total.half_width),
                })
            };
            match (output.radius, panels.last_mut()) {
                (None, _) if !shown.contains(&output.name.as_str()) => {}
                (None, _) => panels.push(IndexPanel::Keys {
                    title: output.title.clone(),
                    bars: bars().collect(),
                }),
                (Some(at), Some(IndexPanel::Along { title, places })) if *title == output.title => {
                    places.push((at, bars().collect()));
                }
                (Some(at), _) => panels.push(IndexPanel::Along {
                    title: output.title.clone(),
                    places: vec![(at, bars().collect())],
                }),
            }
        }
        let keys: Vec<String> = self.keys.iter().map(|key| with_unit(key)).collect();
        index_picture(title, &keys, &panels)
    }
}

/// Variance of some values.
fn spread(values: impl Iterator<Item = f64>) -> f64 {
    let (mut count, mut mean, mut squares) = (0.0, 0.0, 0.0);
    for value in values {
        count += 1.0;
        let off: f64 = value - mean;
        mean += off / count;
        squares += off * (value - mean);
    }
    squares / f64::max(count, 1.0)
}
