//! Square matrices of which whole stretches may be zero.

use std::ops::Index;

/// Rows of one stretch.
const STRETCH: usize = 32;

/// No place: nothing has been written to the stretch.
const NOWHERE: u32 = u32::MAX;

/// A square matrix that keeps only the stretches of its columns that have been written.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchyMatrix {
    size: usize,
    /// By column and stretch, where the stretch lies in `stretches`.
    places: Vec<u32>,
    stretches: Vec<[f64; STRETCH]>,
}

impl PatchyMatrix {
    /// A matrix of `size` rows and columns without entries.
    pub fn new(size: usize) -> Self {
        Self {
            size,
            places: vec![NOWHERE; size * size.div_ceil(STRETCH)],
            stretches: Vec::new(),
        }
    }

    /// The matrix of the entries that `of` gives for row and column.
    pub fn from_fn(size: usize, of: impl Fn(usize, usize) -> f64) -> Self {
        let mut out = Self::new(size);
        let rows = Rows::new((0..size).collect());
        for j in 0..size {
            let column: Vec<f64> = (0..size).map(|i| of(i, j)).collect();
            out.add(j, &rows, 1.0, &column);
        }
        out
    }

    /// Number of rows, and of columns.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Adds `factor` times the entries of `column` (of all rows) in `rows` to column `j`.
    pub fn add(&mut self, j: usize, rows: &Rows, factor: f64, column: &[f64]) {
        let count = self.size.div_ceil(STRETCH);
        let places = &mut self.places[j * count..][..count];
        for of_stretch in rows.0.chunk_by(|a, b| a / STRETCH == b / STRETCH) {
            let from = of_stretch[0] / STRETCH * STRETCH;
            let place = &mut places[from / STRETCH];
            if *place == NOWHERE {
                *place = self.stretches.len() as u32;
                self.stretches.push([0.0; STRETCH]);
            }
            let target = &mut self.stretches[*place as usize];
            for &i in of_stretch {
                target[i - from] += factor * column[i];
            }
        }
    }

    /// Rows and values of column `j` that are not zero, by ascending row.
    pub fn column(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let count = self.size.div_ceil(STRETCH);
        let places = self.places[j * count..][..count].iter().enumerate();
        places
            .filter(|(_, place)| **place != NOWHERE)
            .flat_map(|(stretch, place)| {
                let values = self.stretches[*place as usize];
                (stretch * STRETCH..).zip(values)
            })
            .filter(|(_, value)| *value != 0.0)
    }
}

impl Index<(usize, usize)> for PatchyMatrix {
    type Output = f64;

    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        match self.places[j * self.size.div_ceil(STRETCH) + i / STRETCH] {
            NOWHERE => &0.0,
            place => &self.stretches[place as usize][i % STRETCH],
        }
    }
}

/// Rows that are written together.
#[derive(Debug, Clone, PartialEq)]
pub struct Rows(Vec<usize>);

impl Rows {
    /// These rows, ascending.
    pub fn new(rows: Vec<usize>) -> Self {
        Self(rows)
    }

    /// The rows.
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.0.iter().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums of what was added, and no entry where nothing was: two overlapping patches of a matrix of several stretches and words.
    #[test]
    fn entries_are_those_that_were_added() {
        let n = 2500;
        let mut matrix = PatchyMatrix::new(n);
        let column: Vec<f64> = (0..n).map(|i| i as f64).collect();
        matrix.add(7, &Rows::new(vec![0, 31, 32, 2499]), 2.0, &column);
        matrix.add(7, &Rows::new(vec![32, 2100]), 1.0, &column);
        let found: Vec<(usize, f64)> = matrix.column(7).collect();
        let expected = vec![(31, 62.0), (32, 96.0), (2100, 2100.0), (2499, 4998.0)];
        assert_eq!(found, expected);
        assert_eq!(matrix[(2100, 7)], 2100.0);
        assert_eq!(matrix.column(8).count(), 0);
        let full = PatchyMatrix::from_fn(70, |i, j| (i * 70 + j) as f64);
        assert!((0..70).all(|j| full.column(j).all(|(i, v)| v == (i * 70 + j) as f64)));
        assert_eq!(full.column(3).count(), 70);
    }
}
