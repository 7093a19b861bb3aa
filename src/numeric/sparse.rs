//! Short compressed sparse rows for the many small operators of a mesh cycle.

use std::ops::Range;

/// Adds `value` to the entry of `column`, which is expected near the end.
pub fn accumulate(row: &mut Vec<(u32, f64)>, column: u32, value: f64) {
    match row.iter_mut().rev().find(|entry| entry.0 == column) {
        Some(entry) => entry.1 += value,
        None => row.push((column, value)),
    }
}

/// A sparse matrix by rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SparseRows {
    start: Vec<u32>,
    column: Vec<u32>,
    value: Vec<f64>,
}

impl SparseRows {
    /// Builds from the dense accumulations of each row; entries come sorted by column.
    pub fn from_rows(rows: impl IntoIterator<Item = Vec<(u32, f64)>>) -> Self {
        let mut out = Self {
            start: vec![0],
            ..Self::default()
        };
        for mut row in rows {
            row.sort_by_key(|entry| entry.0);
            let first = out.column.len();
            for (column, value) in row {
                if out.column.len() > first && out.column.last() == Some(&column) {
                    *out.value.last_mut().expect("an entry was just pushed") += value;
                } else {
                    out.column.push(column);
                    out.value.push(value);
                }
            }
            out.start.push(out.column.len() as u32);
        }
        out
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// True if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Columns and values of row `i`.
    pub fn row(&self, i: usize) -> (&[u32], &[f64]) {
        let range = self.start[i] as usize..self.start[i + 1] as usize;
        (&self.column[range.clone()], &self.value[range])
    }

    /// Row `i` times `x`.
    pub fn dot(&self, i: usize, x: &[f64]) -> f64 {
        let (columns, values) = self.row(i);
        if let Some(range) = stretch(columns) {
            return values.iter().zip(&x[range]).map(|(v, x)| v * x).sum();
        }
        columns
            .iter()
            .zip(values)
            .map(|(&c, v)| v * x[c as usize])
            .sum()
    }

    /// `y += scale · (row i)ᵀ`.
    pub fn scatter(&self, i: usize, scale: f64, y: &mut [f64]) {
        let (columns, values) = self.row(i);
        if let Some(range) = stretch(columns) {
            let entries = y[range].iter_mut().zip(values);
            entries.for_each(|(y, v)| *y += scale * v);
            return;
        }
        for (&c, v) in columns.iter().zip(values) {
            y[c as usize] += scale * v;
        }
    }
}

/// The columns as one range where they are neighbours: a loop over a slice is several times as fast.
fn stretch(columns: &[u32]) -> Option<Range<usize>> {
    let (&first, &last) = columns.first().zip(columns.last())?;
    let range = first as usize..last as usize + 1;
    (range.len() == columns.len()).then_some(range)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adds_repeated_entries_and_multiplies() {
        let m = SparseRows::from_rows([vec![(2, 1.0), (0, 3.0), (2, 0.5)], vec![], vec![(1, 2.0)]]);
        assert_eq!(m.len(), 3);
        assert_eq!(m.row(0), (&[0u32, 2][..], &[3.0, 1.5][..]));
        assert_eq!(m.dot(0, &[1.0, 10.0, 100.0]), 153.0);
        let mut y = vec![0.0; 3];
        m.scatter(2, 2.0, &mut y);
        assert_eq!(y, [0.0, 4.0, 0.0]);
    }
}
