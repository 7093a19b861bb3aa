//! Square matrices of which whole stretches may be zero.

use std::ops::{Index, Range};

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
        let rows = Rows::new(std::iter::once(0..size));
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
        for range in &rows.0 {
            let from = range.start / STRETCH * STRETCH;
            let place = &mut places[from / STRETCH];
            if *place == NOWHERE {
                *place = self.stretches.len() as u32;
                self.stretches.push([0.0; STRETCH]);
            }
            let target = &mut self.stretches[*place as usize];
            let target = &mut target[range.start - from..range.end - from];
            for (target, value) in target.iter_mut().zip(&column[range.clone()]) {
                *target += factor * value;
            }
        }
    }

    /// What has been written of column `j`: first row and values of each stretch, ascending.
    pub fn stretches(&self, j: usize) -> impl Iterator<Item = (usize, &[f64])> + '_ {
        let count = self.size.div_ceil(STRETCH);
        let places = self.places[j * count..][..count].iter().enumerate();
        let written = places.filter(|(_, place)| **place != NOWHERE);
        written.map(|(stretch, place)| {
            let first = stretch * STRETCH;
            let rows = STRETCH.min(self.size - first);
            (first, &self.stretches[*place as usize][..rows])
        })
    }

    /// Rows and values of column `j` that are not zero, by ascending row.
    pub fn column(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.stretches(j)
            .flat_map(|(first, values)| (first..).zip(values.iter().copied()))
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

/// Rows that are written together, ascending: ranges that lie within a stretch each.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rows(Vec<Range<usize>>);

impl Rows {
    /// The rows of these ranges, which may overlap.
    pub fn new(ranges: impl IntoIterator<Item = Range<usize>>) -> Self {
        let mut ranges: Vec<Range<usize>> = ranges.into_iter().collect();
        ranges.sort_unstable_by_key(|range| range.start);
        let mut joined: Vec<Range<usize>> = Vec::new();
        for range in ranges {
            match joined.last_mut() {
                Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
                _ => joined.push(range),
            }
        }
        let mut rows = Self::default();
        for Range { mut start, end } in joined {
            while start < end {
                let stop = end.min((start / STRETCH + 1) * STRETCH);
                rows.0.push(start..stop);
                start = stop;
            }
        }
        rows
    }

    /// The ranges.
    pub fn ranges(&self) -> &[Range<usize>] {
        &self.0
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
        matrix.add(7, &Rows::new([2499..2500, 31..33, 0..1]), 2.0, &column);
        matrix.add(7, &Rows::new([32..33, 2100..2101]), 1.0, &column);
        // what overlaps is written once
        let rows = Rows::new([60..70, 64..66, 70..71]);
        assert_eq!(rows.ranges(), [60..64, 64..71]);
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
