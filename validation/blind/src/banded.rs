//! Cholesky of a symmetric matrix with a variable band (skyline by rows).

/// Lower triangle, row i holds columns first[i]..=i.
pub struct Skyline {
    first: Vec<usize>,
    start: Vec<usize>,
    values: Vec<f64>,
}

impl Skyline {
    pub fn new(first: Vec<usize>) -> Self {
        let mut start = Vec::with_capacity(first.len() + 1);
        let mut at = 0;
        for (i, &f) in first.iter().enumerate() {
            start.push(at);
            at += i - f + 1;
        }
        start.push(at);
        Self {
            first,
            start,
            values: vec![0.0; at],
        }
    }

    pub fn add(&mut self, i: usize, j: usize, v: f64) {
        let (i, j) = if i >= j { (i, j) } else { (j, i) };
        self.values[self.start[i] + j - self.first[i]] += v;
    }

    fn row(&self, i: usize) -> &[f64] {
        &self.values[self.start[i]..self.start[i + 1]]
    }

    pub fn factor(&mut self) {
        for i in 0..self.first.len() {
            let fi = self.first[i];
            let (before, rest) = self.values.split_at_mut(self.start[i]);
            let ri = &mut rest[..i - fi + 1];
            for j in fi..i {
                let fj = self.first[j];
                let from = fi.max(fj);
                let rj = &before[self.start[j]..self.start[j + 1]];
                let s = dot(&ri[from - fi..j - fi], &rj[from - fj..j - fj]);
                ri[j - fi] = (ri[j - fi] - s) / rj[j - fj];
            }
            let d = ri[i - fi] - dot(&ri[..i - fi], &ri[..i - fi]);
            assert!(d > 0.0, "matrix not positive definite at row {i}");
            ri[i - fi] = d.sqrt();
        }
    }

    /// b := L^-1 b. Then u·v of two such vectors is u^T A^-1 v.
    pub fn forward(&self, b: &mut [f64]) {
        for i in 0..b.len() {
            let fi = self.first[i];
            let row = self.row(i);
            let s = dot(&row[..i - fi], &b[fi..i]);
            b[i] = (b[i] - s) / row[i - fi];
        }
    }
}

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut acc = [0.0; 8];
    let (ca, cb) = (a.chunks_exact(8), b.chunks_exact(8));
    let tail: f64 = ca
        .remainder()
        .iter()
        .zip(cb.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in ca.zip(cb) {
        for k in 0..8 {
            acc[k] += x[k] * y[k];
        }
    }
    acc.iter().sum::<f64>() + tail
}
