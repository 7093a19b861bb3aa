//! How many checkpoints rows have: running times in hours, rounded, make 399984 revolutions of 400000.

use super::Observation;

/// Relative deviation up to which two counts of cycles are one checkpoint.
const SAME: f64 = 1e-4;

/// Number of checkpoints of some rows, counts that differ by no more than rounding taken as one.
pub fn checkpoints<'a>(rows: impl IntoIterator<Item = &'a Observation>) -> usize {
    distinct(rows.into_iter().map(|o| o.cycles).collect())
}

fn distinct(mut cycles: Vec<f64>) -> usize {
    cycles.sort_by(f64::total_cmp);
    cycles.dedup_by(|later, kept| *later - *kept <= SAME * *later);
    cycles.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounded_hours_are_no_checkpoints_of_their_own() {
        assert_eq!(distinct(vec![400_000.0, 0.0, 399_984.0, 800_000.0, 0.0]), 3);
        assert_eq!(distinct(vec![399_900.0, 400_000.0]), 2);
        assert_eq!(distinct(Vec::new()), 0);
    }
}
