//! Which points a sweep has: every combination of values, a design that fills ranges, or a table.

use std::path::Path;

use super::CliError;
use super::grid::{self, Axis};
use crate::numeric::latin_hypercube::latin_hypercube;

/// Most points of a sweep.
const MOST: usize = 100_000;
/// Most points of a Sobol sequence, the most that `sobol_burley` has.
const MOST_SOBOL: usize = 1 << 16;
/// Most keys of a Saltelli design: the sequence has 256 dimensions, and each key takes two.
const MOST_KEYS: usize = 128;

/// A design that fills ranges, with its number of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Filling {
    /// Latin hypercube.
    Lhs(usize),
    /// Sobol's sequence, scrambled as Owen does.
    Sobol(usize),
    /// Saltelli's design for Sobol's indices, with its number of rows: for each row of a Sobol sequence of twice the dimensions a point of
    /// the first half (A), one of the second (B), and A with each dimension in turn from B.
    Saltelli(usize),
}

impl Filling {
    /// Points over so many keys.
    fn count(self, keys: usize) -> usize {
        match self {
            Self::Lhs(count) | Self::Sobol(count) => count,
            Self::Saltelli(rows) => rows * (keys + 2),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Lhs(_) => "lhs",
            Self::Sobol(_) => "sobol",
            Self::Saltelli(_) => "saltelli",
        }
    }

    /// Points in the unit cube.
    fn points(self, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
        match self {
            Self::Lhs(count) => latin_hypercube(count, dimensions, seed),
            Self::Sobol(count) => sobol(count, dimensions, seed).collect(),
            Self::Saltelli(rows) => sobol(rows, 2 * dimensions, seed)
                .flat_map(|row| {
                    let (a, b) = row.split_at(dimensions);
                    let mixed = (0..dimensions).map(|d| {
                        let mut point = a.to_vec();
                        point[d] = b[d];
                        point
                    });
                    [a.to_vec(), b.to_vec()]
                        .into_iter()
                        .chain(mixed)
                        .collect::<Vec<_>>()
                })
                .collect(),
        }
    }
}

/// The scrambled Sobol sequence in the unit cube.
fn sobol(count: usize, dimensions: usize, seed: u64) -> impl Iterator<Item = Vec<f64>> {
    let mixed = (seed ^ (seed >> 32)) as u32;
    let at = move |i: usize, d: usize| f64::from(sobol_burley::sample(i as u32, d as u32, mixed));
    (0..count).map(move |i| (0..dimensions).map(|d| at(i, d)).collect())
}

/// Reads `lhs:N`, `sobol:N` or `saltelli:N`.
pub(super) fn filling(text: &str) -> Result<Filling, String> {
    let wrong = || {
        "write lhs:N or sobol:N with N points, or saltelli:N with N rows of points, from 2"
            .to_owned()
    };
    let (name, count) = text.split_once(':').ok_or_else(wrong)?;
    let count: usize = count.trim().parse().map_err(|_| wrong())?;
    let most = match name {
        "lhs" => MOST,
        "sobol" | "saltelli" => MOST_SOBOL,
        _ => return Err(wrong()),
    };
    match count {
        0 | 1 => Err(wrong()),
        count if count > most => Err(format!("{name} has at most {most} points")),
        count => Ok(match name {
            "lhs" => Filling::Lhs(count),
            "sobol" => Filling::Sobol(count),
            _ => Filling::Saltelli(count),
        }),
    }
}

/// The points of a sweep.
pub(super) struct Design {
    /// The varied keys.
    pub keys: Vec<String>,
    /// Values of each point, key by key.
    pub rows: Vec<Vec<String>>,
    /// The argument that a fault of them belongs to.
    pub said: &'static str,
    /// How they were chosen.
    pub kind: Kind,
}

/// How the points of a sweep were chosen.
pub(super) enum Kind {
    /// Every combination of the axes' values.
    Grid(Vec<Axis>),
    /// A design over the axes.
    Filling(Filling, u64, Vec<Axis>),
    /// A table.
    Table,
}

impl Design {
    /// Every combination of the axes' values, the last axis fastest.
    ///
    /// # Errors
    /// [`CliError::Unusable`] for a range without a number of values, and for too many points.
    pub(super) fn grid(axes: &[Axis]) -> Result<Self, CliError> {
        if let Some(axis) = axes.iter().find(|axis| axis.values.is_empty()) {
            return Err(CliError::Unusable(format!(
                "--vary {}: a range of a grid needs its number of values, FROM..TO:COUNT; or fill it by --design lhs:N",
                axis.key
            )));
        }
        let count = axes.iter().map(|axis| axis.values.len()).product::<usize>();
        if count > MOST {
            return Err(CliError::Unusable(format!(
                "--vary: {count} combinations, at most {MOST} are possible"
            )));
        }
        let row = |number: usize| {
            let mut rest = number;
            let mut values = vec![String::new(); axes.len()];
            for (value, axis) in values.iter_mut().zip(axes).rev() {
                *value = axis.values[rest % axis.values.len()].clone();
                rest /= axis.values.len();
            }
            values
        };
        Ok(Self {
            keys: axes.iter().map(|axis| axis.key.clone()).collect(),
            rows: (0..count).map(row).collect(),
            said: "--vary",
            kind: Kind::Grid(axes.to_vec()),
        })
    }

    /// Points that fill the axes' ranges; the values of a list stand for equal parts of its axis.
    ///
    /// # Errors
    /// [`CliError::Unusable`] for too many points or keys.
    pub(super) fn filled(axes: &[Axis], filling: Filling, seed: u64) -> Result<Self, CliError> {
        let count = filling.count(axes.len());
        let keys = axes.len();
        if count > MOST || (matches!(filling, Filling::Saltelli(_)) && keys > MOST_KEYS) {
            return Err(CliError::Unusable(format!(
                "--design {}: {count} points over {keys} keys; at most {MOST} points and, for saltelli, {MOST_KEYS} keys are possible",
                filling.name()
            )));
        }
        let points = filling.points(axes.len(), seed);
        let row = |point: Vec<f64>| {
            let each = axes.iter().zip(point);
            each.map(|(axis, share)| axis.at(share)).collect()
        };
        Ok(Self {
            keys: axes.iter().map(|axis| axis.key.clone()).collect(),
            rows: points.into_iter().map(row).collect(),
            said: "--vary",
            kind: Kind::Filling(filling, seed, axes.to_vec()),
        })
    }

    /// The points of a table: keys in its first line, a point in every other.
    ///
    /// # Errors
    /// [`CliError`] if there is no such file, or no table in it.
    pub(super) fn table(path: &Path) -> Result<Self, CliError> {
        let text = std::fs::read_to_string(path).map_err(|error| {
            CliError::Unusable(format!("cannot read {}: {error}", path.display()))
        })?;
        let fault = |line: u64, what: &str| {
            CliError::Unusable(format!("{}:{line}: {what}", path.display()))
        };
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.trim_start_matches('\u{feff}').as_bytes());
        let place = |error: &csv::Error| error.position().map_or(1, csv::Position::line);
        let head = reader.headers().cloned();
        let head = head.map_err(|error| fault(place(&error), &error.to_string()))?;
        let keys: Vec<String> = head.iter().map(str::to_owned).collect();
        if keys.iter().any(String::is_empty) {
            let what = "a column without a key; the first line holds keys of the study, such as operation.torque,wear.cycles";
            return Err(fault(1, what));
        }
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| fault(place(&error), &error.to_string()))?;
            let line = record.position().map_or(0, csv::Position::line);
            if let Some(empty) = record.iter().position(str::is_empty) {
                return Err(fault(line, &format!("no value for {}", keys[empty])));
            }
            rows.push(record.iter().map(str::to_owned).collect());
            if rows.len() > MOST {
                return Err(fault(line, &format!("more than {MOST} points")));
            }
        }
        if rows.is_empty() {
            return Err(fault(1, "no points; every line below the keys is one"));
        }
        Ok(Self {
            keys,
            rows,
            said: "--points",
            kind: Kind::Table,
        })
    }

    /// What a result says of it: the keys with what they were varied over, and of designs their kind.
    pub(super) fn documents(&self) -> (serde_json::Value, Option<serde_json::Value>) {
        use serde_json::json;
        let listed = |axis: &Axis| {
            let values = axis.values.iter().map(|value| grid::json(value));
            json!({"key": axis.key, "values": values.collect::<Vec<_>>()})
        };
        match &self.kind {
            Kind::Grid(axes) => (axes.iter().map(listed).collect(), None),
            Kind::Filling(filling, seed, axes) => {
                let told = |axis: &Axis| match axis.range {
                    Some(range) => json!({
                        "key": axis.key, "from": range.from, "to": range.to, "log": range.log,
                    }),
                    None => listed(axis),
                };
                let mut design =
                    json!({"kind": filling.name(), "points": self.rows.len(), "seed": seed});
                if let Filling::Saltelli(rows) = filling {
                    design["rows"] = json!(rows);
                }
                (axes.iter().map(told).collect(), Some(design))
            }
            Kind::Table => (
                self.keys.iter().map(|key| json!({"key": key})).collect(),
                Some(json!({"kind": "points", "points": self.rows.len()})),
            ),
        }
    }

    /// Where each point lies between the least (0) and the largest (1) value of a key; texts by the order of their appearance.
    pub(super) fn places(&self, key: usize) -> Vec<f64> {
        let texts: Vec<&str> = self.rows.iter().map(|row| row[key].as_str()).collect();
        let numbers: Option<Vec<f64>> = texts.iter().map(|t| grid::leading_number(t)).collect();
        let mut places = numbers.unwrap_or_else(|| {
            let mut known: Vec<&str> = Vec::new();
            let mut place = |text| match known.iter().position(|k| *k == text) {
                Some(place) => place,
                None => {
                    known.push(text);
                    known.len() - 1
                }
            };
            texts.iter().map(|text| place(text) as f64).collect()
        });
        if let Kind::Filling(_, _, axes) = &self.kind
            && axes[key].range.is_some_and(|range| range.log)
        {
            places.iter_mut().for_each(|place| *place = place.ln());
        }
        let low = places.iter().copied().fold(f64::INFINITY, f64::min);
        let high = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let width = if high > low { high - low } else { 1.0 };
        places.iter().map(|place| (place - low) / width).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn designs_fill_their_ranges() {
        let axes = ["a.b=50..200", "c.d=1e-10..1e-8:log", "e=fem,hertz"];
        let axes = axes.map(|text| grid::axis(text).unwrap());
        for filling in [Filling::Lhs(64), Filling::Sobol(64)] {
            let filled = |seed| Design::filled(&axes, filling, seed).unwrap();
            let design = filled(3);
            assert_eq!(design.rows.len(), 64);
            let number = |row: &[String], i: usize| row[i].parse::<f64>().unwrap();
            for quarter in 0..4 {
                let low = 50.0 + 37.5 * f64::from(quarter);
                let inside = |row: &&Vec<String>| (low..low + 37.5).contains(&number(row, 0));
                assert_eq!(design.rows.iter().filter(inside).count(), 16, "{filling:?}");
            }
            let small = design.rows.iter().filter(|row| number(row, 1) < 1e-9);
            assert_eq!(small.count(), 32);
            let fem = design.rows.iter().filter(|row| row[2] == "fem");
            assert_eq!(fem.count(), 32);
            assert_eq!(filled(3).rows, design.rows);
            assert_ne!(filled(4).rows, design.rows);
        }
        assert!(Design::grid(&axes).is_err());
        for wrong in ["lhs", "lhs:1", "lhs:x", "sobol:65537", "random:10"] {
            assert!(filling(wrong).is_err(), "{wrong}");
        }
        assert_eq!(filling("sobol:128"), Ok(Filling::Sobol(128)));
    }

    /// Rows of A, B and A with each key in turn from B; A and B are different points.
    #[test]
    fn saltellis_design_changes_one_key_at_a_time() {
        let axes = ["a.b=0..1", "c.d=0..1", "e=0..1"].map(|text| grid::axis(text).unwrap());
        let design = Design::filled(&axes, Filling::Saltelli(16), 3).unwrap();
        assert_eq!(design.rows.len(), 16 * 5);
        for row in design.rows.chunks(5) {
            let (a, b) = (&row[0], &row[1]);
            assert!((0..3).all(|key| a[key] != b[key]));
            for (key, mixed) in row[2..].iter().enumerate() {
                for i in 0..3 {
                    assert_eq!(mixed[i], if i == key { &b[i] } else { &a[i] }.as_str());
                }
            }
        }
        assert_eq!(filling("saltelli:16"), Ok(Filling::Saltelli(16)));
        assert!(Design::filled(&axes, Filling::Saltelli(60_000), 3).is_err());
    }
}
