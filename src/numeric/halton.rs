//! Points that fill a cube ever more evenly.

/// Bases of the coordinates.
const PRIMES: [usize; 8] = [2, 3, 5, 7, 11, 13, 17, 19];

/// Point number `i` (from 0) of Halton's sequence in so many dimensions, coordinates in (0, 1): each is the number written in a
/// prime base with its digits mirrored at the point (J.H. Halton, Numer. Math. 2, 1960). From the ninth on, bases repeat.
pub fn halton(i: usize, dimensions: usize) -> Vec<f64> {
    let bases = PRIMES.iter().cycle().take(dimensions);
    bases.map(|&base| mirrored(i + 1, base)).collect()
}

fn mirrored(mut i: usize, base: usize) -> f64 {
    let (mut value, mut digit) = (0.0, 1.0);
    while i > 0 {
        digit /= base as f64;
        value += digit * (i % base) as f64;
        i /= base;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::halton;

    /// The first points in bases 2 and 3 as they stand in Halton's paper.
    #[test]
    fn first_points() {
        let expected = [
            [1.0 / 2.0, 1.0 / 3.0],
            [1.0 / 4.0, 2.0 / 3.0],
            [3.0 / 4.0, 1.0 / 9.0],
        ];
        for (i, point) in expected.iter().enumerate() {
            for (x, y) in halton(i, 2).iter().zip(point) {
                assert!((x - y).abs() < 1e-15, "{x} {y}");
            }
        }
    }
}
