//! How well a hidden cause could be seen: the drop of chi^2 on noise-free values when it is added to the refitted base.

/// Rows of one trace (or a single weighed value): where they stand among a test's rows, and the inverse square root of their covariance.
pub struct Block {
    pub rows: Vec<usize>,
    factor: Vec<f64>,
}

/// Prior standard deviation of a trace's datum (the study's default) and of ln k between tests.
pub const DATUM: f64 = 0.5;
pub const SCATTER: f64 = 0.2;
/// Correlated model error over the trace's largest value, and its correlation length over the trace's length.
const MODEL: f64 = 0.005;
const LENGTH: f64 = 0.15;

impl Block {
    /// `at`: positions of a trace (empty for a single value); `values` noise-free; `datum`: standard deviation of the trace's zero.
    pub fn new(rows: Vec<usize>, at: &[f64], values: &[f64], sigma: &[f64], datum: f64) -> Self {
        let n = rows.len();
        let top = values.iter().fold(0.0f64, |a, v| a.max(v.abs()));
        let trace = !at.is_empty();
        let span = if trace {
            (at[n - 1] - at[0]).abs().max(1e-9)
        } else {
            1.0
        };
        let mut c = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..n {
                let mut v = if i == j { sigma[i] * sigma[i] } else { 0.0 };
                if trace {
                    let x = (at[i] - at[j]) / (LENGTH * span);
                    v += datum * datum + (MODEL * top).powi(2) * (-0.5 * x * x).exp();
                } else {
                    v += (MODEL * top).powi(2);
                }
                c[i * n + j] = v;
            }
        }
        for i in 0..n {
            for j in 0..=i {
                let s: f64 = (0..j).map(|k| c[i * n + k] * c[j * n + k]).sum();
                c[i * n + j] = if i == j {
                    (c[i * n + i] - s).sqrt()
                } else {
                    (c[i * n + j] - s) / c[j * n + j]
                };
            }
        }
        Self { rows, factor: c }
    }

    fn whiten(&self, v: &[f64], out: &mut Vec<f64>) {
        let n = self.rows.len();
        let base = out.len();
        for i in 0..n {
            let s: f64 = (0..i).map(|k| self.factor[i * n + k] * out[base + k]).sum();
            out.push((v[self.rows[i]] - s) / self.factor[i * n + i]);
        }
    }
}

pub fn whiten(blocks: &[Block], v: &[f64]) -> Vec<f64> {
    let mut out = Vec::with_capacity(v.len());
    for b in blocks {
        b.whiten(v, &mut out);
    }
    out
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Sum of squares about their mean: what a common k leaves of ln k per test.
fn scattered(e: &[f64]) -> f64 {
    let mean = e.iter().sum::<f64>() / e.len() as f64;
    e.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (SCATTER * SCATTER)
}

/// chi^2 of the best base model. `base(t, x)`: its values in test t with k scaled by e^x. Returns the chi^2 and the x.
pub fn refit(
    truth: &[Vec<f64>],
    blocks: &[Vec<Block>],
    base: &dyn Fn(usize, f64) -> Vec<f64>,
    limit: f64,
) -> (f64, Vec<f64>) {
    let tests = truth.len();
    let residual = |t: usize, x: f64| {
        let model = base(t, x);
        let r: Vec<f64> = truth[t].iter().zip(&model).map(|(a, b)| a - b).collect();
        whiten(&blocks[t], &r)
    };
    let cost = |x: &[f64]| {
        (0..tests)
            .map(|t| {
                let r = residual(t, x[t]);
                product(&r, &r)
            })
            .sum::<f64>()
            + scattered(x)
    };
    let mut x = vec![0.0; tests];
    // A common start by a scan, then each test its own.
    let mut best = f64::MAX;
    for k in -12..=12 {
        let v = (0.15 * f64::from(k)).min(limit);
        let c = cost(&vec![v; tests]);
        if c < best {
            best = c;
            x = vec![v; tests];
        }
    }
    let mut damp = 1e-3;
    for _ in 0..40 {
        let mut a = vec![0.0; tests * tests];
        let mut g = vec![0.0; tests];
        let mean = x.iter().sum::<f64>() / tests as f64;
        for t in 0..tests {
            let r = residual(t, x[t]);
            let h = 2e-3;
            let (p, m) = (residual(t, (x[t] + h).min(limit)), residual(t, x[t] - h));
            let j: Vec<f64> = p
                .iter()
                .zip(&m)
                .map(|(a, b)| (a - b) / ((x[t] + h).min(limit) - x[t] + h))
                .collect();
            a[t * tests + t] += product(&j, &j) * (1.0 + damp) + 1e-9;
            g[t] -= product(&j, &r);
            let q = 1.0 / (SCATTER * SCATTER);
            for u in 0..tests {
                a[t * tests + u] += q * (f64::from(u8::from(t == u)) - 1.0 / tests as f64);
            }
            g[t] -= q * (x[t] - mean);
        }
        let step = solve(a, g);
        let next: Vec<f64> = x
            .iter()
            .zip(&step)
            .map(|(a, b)| (a + b.clamp(-0.5, 0.5)).clamp(-4.0, limit))
            .collect();
        let c = cost(&next);
        if c < best {
            let gain = best - c;
            x = next;
            best = c;
            damp *= 0.3;
            if gain < 1e-6 * (1.0 + best) {
                break;
            }
        } else {
            damp = damp.max(1e-6) * 10.0;
            if damp > 1e6 {
                break;
            }
        }
    }
    (best, x)
}

/// What is left of a small change `r` (per test) when ln k of each test and more amplitudes are refitted, linearly.
pub fn left_over(
    r: &[Vec<f64>],
    blocks: &[Vec<Block>],
    by_k: &[Vec<f64>],
    by_amplitudes: &[Vec<Vec<f64>>],
) -> f64 {
    let white = |v: &[Vec<f64>]| -> Vec<Vec<f64>> {
        v.iter().zip(blocks).map(|(v, b)| whiten(b, v)).collect()
    };
    let by_amplitudes: Vec<Vec<Vec<f64>>> = by_amplitudes.iter().map(|v| white(v)).collect();
    let by_amplitudes: Vec<&[Vec<f64>]> = by_amplitudes.iter().map(Vec::as_slice).collect();
    left_over_white(&white(r), &white(by_k), &by_amplitudes).0
}

/// The same on whitened values; and those amplitudes.
pub fn left_over_white(
    r: &[Vec<f64>],
    by_k: &[Vec<f64>],
    by_amplitudes: &[&[Vec<f64>]],
) -> (f64, Vec<f64>) {
    let tests = r.len();
    let n = tests + by_amplitudes.len();
    let mut a = vec![0.0; n * n];
    let mut g = vec![0.0; n];
    let mut all = 0.0;
    let q = 1.0 / (SCATTER * SCATTER);
    for t in 0..tests {
        let (w, k) = (&r[t], &by_k[t]);
        all += product(w, w);
        a[t * n + t] += product(k, k);
        for u in 0..tests {
            a[t * n + u] += q * (f64::from(u8::from(t == u)) - 1.0 / tests as f64);
        }
        g[t] = product(k, w);
        for (i, s) in by_amplitudes.iter().enumerate() {
            let row = tests + i;
            a[t * n + row] = product(k, &s[t]);
            a[row * n + t] = a[t * n + row];
            g[row] += product(&s[t], w);
            for (j, other) in by_amplitudes.iter().enumerate() {
                a[row * n + tests + j] += product(&s[t], &other[t]);
            }
        }
    }
    for i in 0..n {
        a[i * n + i] = a[i * n + i] * (1.0 + 1e-9) + 1e-12;
    }
    let x = solve(a, g.clone());
    ((all - product(&x, &g)).max(0.0), x[tests..].to_vec())
}

pub fn penalty(e: &[f64]) -> f64 {
    scattered(e)
}

/// Gauss elimination with pivoting, small.
fn solve(mut a: Vec<f64>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for c in 0..n {
        let p = (c..n)
            .max_by(|&i, &j| a[i * n + c].abs().total_cmp(&a[j * n + c].abs()))
            .unwrap_or(c);
        for j in 0..n {
            a.swap(c * n + j, p * n + j);
        }
        b.swap(c, p);
        for i in c + 1..n {
            let f = a[i * n + c] / a[c * n + c];
            for j in c..n {
                a[i * n + j] -= f * a[c * n + j];
            }
            b[i] -= f * b[c];
        }
    }
    for c in (0..n).rev() {
        for j in c + 1..n {
            b[c] -= a[c * n + j] * b[j];
        }
        b[c] /= a[c * n + c];
    }
    b
}
