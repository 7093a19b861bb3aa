//! The face as several slices: sections in plane strain that turn together.
//!
//! ```text
//! slice i at face y_i with the width w_i b:   g_i = g + e_i l      e_i: material missing there, along the path of contact
//! Σ w_i T_i(φ) = T                            all slices close by the same turn φ
//! ```

/// Slices of the face.
#[derive(Debug, Clone, PartialEq)]
pub struct Slices {
    /// Middle of each slice from mid-face, mm, ascending.
    pub place: Vec<f64>,
    /// Share of the face width; their sum is 1.
    pub weight: Vec<f64>,
    /// Material missing on both flanks together, mm along the path of contact.
    pub offset: Vec<f64>,
}

impl Slices {
    /// `count` slices of one width over a face `width` (mm), without a lead deviation.
    pub fn even(count: usize, width: f64) -> Self {
        let share = 1.0 / count as f64;
        let place = |i: usize| width * ((i as f64 + 0.5) * share - 0.5);
        Self {
            place: (0..count).map(place).collect(),
            weight: vec![share; count],
            offset: vec![0.0; count],
        }
    }

    /// Number of slices.
    pub fn count(&self) -> usize {
        self.place.len()
    }

    /// The value at the place `face` (mm from mid-face) on the straight lines between the slices' middles; beyond the outer middles the
    /// line through the last two goes on to the end of the face.
    pub fn weights_at(&self, face: f64) -> [(usize, f64); 2] {
        let last = self.place.len() - 1;
        if last == 0 {
            return [(0, 1.0), (0, 0.0)];
        }
        let after = self.place.partition_point(|y| *y < face).clamp(1, last);
        let (a, b) = (self.place[after - 1], self.place[after]);
        let t = (face - a) / (b - a);
        [(after - 1, 1.0 - t), (after, t)]
    }

    /// The mean over the face of values that stand slice after slice.
    pub fn mean_of(&self, values: &[f64]) -> Vec<f64> {
        let size = values.len() / self.count();
        let at = |j: usize| self.mean((0..self.count()).map(|i| values[i * size + j]));
        (0..size).map(at).collect()
    }

    /// The mean over the face of one value per slice.
    pub fn mean(&self, values: impl IntoIterator<Item = f64>) -> f64 {
        self.weight.iter().zip(values).map(|(w, v)| w * v).sum()
    }
}

/// The flanks that meet at one mesh position: depths and places of every tooth pair in every slice.
#[derive(Debug, Clone)]
pub struct Flanks<'a> {
    /// Depths (mm at the stations of pinion and gear) by slice and, within a slice, by tooth pair.
    depths: Vec<[&'a [f64]; 2]>,
    /// How far each pair's teeth stand back, mm along the path of contact.
    pub back: Vec<f64>,
}

impl<'a> Flanks<'a> {
    /// The depths of `depths(slice, pair)`, nothing standing back.
    pub fn new(
        slices: usize,
        pairs: usize,
        depths: impl Fn(usize, usize) -> [&'a [f64]; 2],
    ) -> Self {
        let depths = &depths;
        let all = (0..slices).flat_map(|i| (0..pairs).map(move |j| depths(i, j)));
        Self {
            depths: all.collect(),
            back: vec![0.0; pairs],
        }
    }

    /// One section, with the same depths for all pairs.
    pub fn alike(pairs: usize, depth: [&'a [f64]; 2]) -> Self {
        Self::new(1, pairs, |_, _| depth)
    }

    /// What the pairs see in slice `i`.
    pub fn of(&self, i: usize) -> &[[&'a [f64]; 2]] {
        let pairs = self.back.len();
        &self.depths[i * pairs..(i + 1) * pairs]
    }
}

#[cfg(test)]
mod tests {
    use super::Slices;

    #[test]
    fn slices_fill_the_face_and_carry_straight_lines() {
        let slices = Slices::even(5, 30.0);
        assert!((slices.weight.iter().sum::<f64>() - 1.0).abs() < 1e-15);
        assert!((slices.place[0] + 12.0).abs() < 1e-12 && slices.place[2].abs() < 1e-12);
        let line = |y: f64| 1.0 + 0.2 * y;
        for face in [-15.0, -12.0, -3.3, 0.0, 7.1, 15.0] {
            let read: f64 = (slices.weights_at(face).iter())
                .map(|&(i, w)| w * line(slices.place[i]))
                .sum();
            assert!((read - line(face)).abs() < 1e-12, "{read} at {face}");
        }
        assert!((slices.mean(slices.place.iter().map(|y| line(*y))) - 1.0).abs() < 1e-14);
    }
}
