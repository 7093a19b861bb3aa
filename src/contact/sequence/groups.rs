//! Teeth that are nearly alike taken together, by numbers that tell them apart.

/// Numbers that differ by no more than rounding does.
pub(super) fn close(a: &[f64], b: &[f64]) -> bool {
    (a.iter().zip(b)).all(|(a, b)| (a - b).abs() <= 1e-9 * (1.0 + a.abs().max(b.abs())))
}

/// Things in groups, and one of each group that stands for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Groups {
    /// Group of each.
    pub(super) of: Vec<usize>,
    /// What stands for each group.
    pub(super) centres: Vec<usize>,
}

impl Groups {
    /// `count` things, each by itself.
    pub fn apart(count: usize) -> Self {
        Self {
            of: (0..count).collect(),
            centres: (0..count).collect(),
        }
    }

    /// Equal lists together and, where these would be more than `most` groups, those nearest to one of so many that lie as far apart as
    /// can be, the first one among them (farthest-point clustering; Gonzalez, Theor. Comput. Sci. 38, 1985).
    pub(super) fn new(all: &[Vec<f64>], most: usize) -> Self {
        let mut different: Vec<usize> = Vec::new();
        let mut of = Vec::with_capacity(all.len());
        for (i, own) in all.iter().enumerate() {
            let known = different.iter().position(|other| close(own, &all[*other]));
            of.push(known.unwrap_or(different.len()));
            if known.is_none() {
                different.push(i);
            }
        }
        if different.len() <= most {
            return Self {
                of,
                centres: different,
            };
        }
        let distance = |a: usize, b: usize| -> f64 {
            let squares = all[a].iter().zip(&all[b]).map(|(a, b)| (a - b).powi(2));
            squares.sum()
        };
        let nearest = |centres: &[usize], i: usize| {
            let each = centres.iter().map(|c| distance(*c, i)).enumerate();
            each.fold((0, f64::INFINITY), |m, d| if d.1 < m.1 { d } else { m })
        };
        let mut centres = vec![0];
        while centres.len() < most {
            let apart = different.iter().map(|i| (*i, nearest(&centres, *i).1));
            let farthest = apart.fold((0, 0.0), |m, d| if d.1 > m.1 { d } else { m });
            centres.push(farthest.0);
        }
        Self {
            of: (0..all.len()).map(|i| nearest(&centres, i).0).collect(),
            centres,
        }
    }
}
