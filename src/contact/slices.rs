//! The face as several slices: sections in plane strain that turn together.
//!
//! ```text
//! slice i at face y_i with the width w_i b:   g_i = g + e_i l      e_i: material missing there, along the path of contact
//! Σ w_i T_i(φ) = T                            all slices close by the same turn φ
//! ```
//! Helical teeth are sections that stand turned along the face: at the turn number t a slice is at the section position t + n_i, with
//! n_i = y_i tan β_b/p_bt in mesh positions, rounded. What a slice has is kept by its own section positions; what all have at one turn
//! is found by [`Slices::at`].

/// Slices of the face.
#[derive(Debug, Clone, PartialEq)]
pub struct Slices {
    /// Middle of each slice from mid-face, mm, ascending.
    pub place: Vec<f64>,
    /// Share of the face width; their sum is 1.
    pub weight: Vec<f64>,
    /// Material missing on both flanks together, mm along the path of contact.
    pub offset: Vec<f64>,
    /// How many mesh positions each slice stands ahead of mid-face; 0 for spur gears.
    pub ahead: Vec<i64>,
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
            ahead: vec![0; count],
        }
    }

    /// The same turned along the face, by `pitches` base pitches per mm, on `positions` mesh positions for each base pitch; negative: the
    /// other hand.
    pub fn turned(mut self, pitches: f64, positions: usize) -> Self {
        let ahead = |y: &f64| (y * pitches * positions as f64).round() as i64;
        self.ahead = self.place.iter().map(ahead).collect();
        self
    }

    /// From `least` to a quarter more mesh positions for each base pitch: so many that slices turned by `pitches` base pitches per mm are
    /// nearest to where they should be.
    pub fn positions_that_hold(&self, pitches: f64, least: usize) -> usize {
        // differences that rounding makes are none
        let off = |positions: &usize| {
            let turned = self.clone().turned(pitches, *positions);
            (1e9 * turned.off(pitches, *positions)).round()
        };
        let all = least..=least + least / 4;
        all.min_by(|a, b| off(a).total_cmp(&off(b)))
            .unwrap_or(least)
    }

    /// How far from its place a slice may be computed because it stands at one of so many `positions`, base pitches of the mesh.
    pub fn off(&self, pitches: f64, positions: usize) -> f64 {
        let each = self.place.iter().zip(&self.ahead);
        let off = each.map(|(y, ahead)| (y * pitches - *ahead as f64 / positions as f64).abs());
        off.fold(0.0, f64::max)
    }

    /// The section position of slice `i` at the turn `turn`, of so many `positions` over a base pitch.
    pub fn at(&self, i: usize, turn: usize, positions: usize) -> usize {
        (turn as i64 + self.ahead[i]).rem_euclid(positions as i64) as usize
    }

    /// How many base pitches slice `i` is on from its section position at the turn `turn`: what is pair j of the section there is the tooth that is pair j less
    /// so many at mid-face.
    pub fn passed(&self, i: usize, turn: usize, positions: usize) -> i32 {
        (turn as i64 + self.ahead[i]).div_euclid(positions as i64) as i32
    }

    /// The section positions of all slices at the turn `turn`.
    pub fn all_at(&self, turn: usize, positions: usize) -> Vec<usize> {
        (0..self.count())
            .map(|i| self.at(i, turn, positions))
            .collect()
    }

    /// The turn at which slice `i` is at a section position.
    pub fn turn_of(&self, i: usize, section: usize, positions: usize) -> usize {
        (section as i64 - self.ahead[i]).rem_euclid(positions as i64) as usize
    }

    /// Puts what slice `i` has, in the order of turns, into that of its section positions.
    pub fn by_section<T>(&self, i: usize, by_turn: &mut [T]) {
        let ahead = self.ahead[i].rem_euclid(by_turn.len().max(1) as i64);
        by_turn.rotate_right(ahead as usize);
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
    /// First pair of each slice, and the end of the last.
    first: Vec<usize>,
    /// How far each pair's teeth stand back, mm along the path of contact, likewise.
    pub back: Vec<f64>,
}

impl<'a> Flanks<'a> {
    /// The depths of `depths(slice, pair)` for so many `pairs` in each slice, nothing standing back.
    pub fn new(pairs: &[usize], depths: impl Fn(usize, usize) -> [&'a [f64]; 2]) -> Self {
        let depths = &depths;
        let slices = pairs.iter().enumerate();
        let all: Vec<_> = slices
            .flat_map(|(i, count)| (0..*count).map(move |j| depths(i, j)))
            .collect();
        let mut first = vec![0];
        for count in pairs {
            first.push(first[first.len() - 1] + count);
        }
        Self {
            back: vec![0.0; all.len()],
            depths: all,
            first,
        }
    }

    /// One section, with the same depths for all pairs.
    pub fn alike(pairs: usize, depth: [&'a [f64]; 2]) -> Self {
        Self::new(&[pairs], |_, _| depth)
    }

    /// What the pairs see in slice `i`.
    pub fn of(&self, i: usize) -> &[[&'a [f64]; 2]] {
        &self.depths[self.first[i]..self.first[i + 1]]
    }

    /// How far the pairs' teeth stand back in slice `i`, mm along the path of contact.
    pub fn back_of(&self, i: usize) -> &[f64] {
        &self.back[self.first[i]..self.first[i + 1]]
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
    fn slices_of_helical_teeth_come_to_a_section_one_after_the_other() {
        let slices = Slices::even(5, 30.0).turned(0.025, 40);
        assert_eq!(slices.ahead, vec![-12, -6, 0, 6, 12]);
        assert_eq!(
            Slices::even(5, 30.0).turned(-0.025, 40).ahead,
            vec![12, 6, 0, -6, -12]
        );
        for i in 0..5 {
            for turn in 0..40 {
                assert_eq!(slices.turn_of(i, slices.at(i, turn, 40), 40), turn);
            }
            let mut by_turn: Vec<usize> = (0..40).collect();
            slices.by_section(i, &mut by_turn);
            for (section, turn) in by_turn.iter().enumerate() {
                assert_eq!(slices.at(i, *turn, 40), section);
            }
        }
        assert!(slices.off(0.025, 40) < 1e-12);
        // half a position at most, and none where so many positions hold all slices
        let uneven = Slices::even(7, 30.0).turned(0.0211, 40).off(0.0211, 40);
        assert!(uneven > 1e-4 && uneven <= 0.5 / 40.0);
        assert_eq!(Slices::even(5, 30.0).positions_that_hold(0.025, 37), 40);
        assert_eq!(Slices::even(5, 30.0).positions_that_hold(0.0, 37), 37);
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
