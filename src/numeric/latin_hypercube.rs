//! Latin hypercube designs (McKay, Beckman and Conover 1979): every one of `n` equal parts of each dimension holds one point.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// `count` points in the unit cube of `dimensions`, each at random in its parts; the same for the same seed, on every machine.
pub fn latin_hypercube(count: usize, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut points = vec![vec![0.0; dimensions]; count];
    for dimension in 0..dimensions {
        let mut source = ChaCha8Rng::seed_from_u64(seed);
        source.set_stream(dimension as u64);
        let mut unit = || (source.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        // Fisher and Yates
        let mut parts: Vec<usize> = (0..count).collect();
        for last in (1..count).rev() {
            let other = (unit() * (last + 1) as f64) as usize;
            parts.swap(last, other.min(last));
        }
        for (point, part) in points.iter_mut().zip(parts) {
            point[dimension] = (part as f64 + unit()) / count as f64;
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::latin_hypercube;

    #[test]
    fn every_part_of_every_dimension_holds_one_point() {
        for seed in [0, 1, 99] {
            let points = latin_hypercube(50, 3, seed);
            for dimension in 0..3 {
                let mut parts: Vec<usize> = (points.iter())
                    .map(|point| (point[dimension] * 50.0) as usize)
                    .collect();
                parts.sort_unstable();
                assert_eq!(parts, (0..50).collect::<Vec<_>>());
            }
            assert_eq!(points, latin_hypercube(50, 3, seed));
        }
        assert_ne!(latin_hypercube(50, 3, 1), latin_hypercube(50, 3, 2));
    }

    /// The design's point: the mean of a sum over the dimensions is far closer than that of as many points at random, whose error is
    /// √(d/12/n) = 0.07 here.
    #[test]
    fn the_mean_of_a_sum_is_close() {
        let points = latin_hypercube(50, 3, 7);
        let mean = points.iter().flatten().sum::<f64>() / 50.0;
        assert!((mean - 1.5).abs() < 0.01, "{mean}");
    }
}
