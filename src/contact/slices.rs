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

    /// The slices of which what is read at the place `face` (mm from mid-face) is a sum, with their weights, where `value` is what each has:
    /// a depth or a pressure.
    ///
    /// That is [`Slices::weights_at`] but for one case. Where part of the face carries, the line that goes on beyond the last middle would fall
    /// below zero. Nothing is worn there, so nothing is read; where the last slice itself stands below zero (displaced material), it is read.
    pub fn read_at(&self, face: f64, value: impl Fn(usize) -> f64) -> Vec<(usize, f64)> {
        let line = self.weights_at(face);
        let last = self.place.len() - 1;
        let end = if face < self.place[0] {
            0
        } else if face > self.place[last] {
            last
        } else {
            return line.to_vec();
        };
        let on_line: f64 = line.iter().map(|&(i, weight)| weight * value(i)).sum();
        let at_end = value(end);
        if on_line >= at_end.min(0.0) {
            line.to_vec()
        } else if at_end < 0.0 {
            vec![(end, 1.0)]
        } else {
            Vec::new()
        }
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

    #[test]
    fn nothing_below_zero_is_read_beyond_the_outer_slices() {
        let slices = Slices::even(5, 30.0);
        let read = |values: [f64; 5], face: f64| -> f64 {
            let parts = slices.read_at(face, |i| values[i]);
            parts.iter().map(|&(i, weight)| weight * values[i]).sum()
        };
        // two slices carry: the line through the last two middles is at -0.5 at the end of the face
        let wedge = [9.0, 6.0, 3.0, 1.0, 0.0];
        assert_eq!(read(wedge, 15.0), 0.0);
        assert!((read(wedge, 12.0)).abs() < 1e-12 && (read(wedge, 9.0) - 0.5).abs() < 1e-12);
        assert!((read(wedge, -15.0) - 10.5).abs() < 1e-12);
        // displaced material is read as far as a slice has it
        assert_eq!(read([0.0, 0.0, 0.0, 2.0, -1.0], 15.0), -1.0);
        assert_eq!(
            Slices::even(1, 30.0).read_at(15.0, |_| 2.0),
            vec![(0, 1.0), (0, 0.0)]
        );
    }
}
