//! Sparse regression of what the base model leaves on the effects' signatures: a simple second opinion, and what the diagnosis must
//! beat on blind data.
//!
//! Orthogonal matching pursuit (Pati, Rezaiifar & Krishnaprasad 1993): the signature that lowers χ² most joins those chosen, which are
//! fitted anew together, until the Bayesian information criterion rises. Signatures are what the analytic model says that each effect
//! changes, without anything refitted but their amplitudes and k.

use nalgebra::DVector;

use super::context::Context;
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::Hypothesis;

/// Most effects that are chosen.
const MOST: usize = 3;
/// Share of a signature's length that must be left beside those chosen before, for it to say anything of its own.
const OWN: f64 = 1e-3;

/// The chosen effects, the strongest first.
pub(in crate::learn) fn selection(
    context: &Context<'_>,
    base: &BaseFit,
    screened: &[FittedCandidate],
) -> Vec<Hypothesis> {
    let of = |judged: &FittedCandidate| {
        (
            judged.candidate.hypothesis(),
            base.visible(&context.likelihood, &judged.change),
        )
    };
    let signatures: Vec<(Hypothesis, DVector<f64>)> = screened.iter().map(of).collect();
    pursuit(signatures, base.residual.clone(), context.likelihood.len())
}

fn pursuit<K: Clone + PartialEq>(
    mut signatures: Vec<(K, DVector<f64>)>,
    mut residual: DVector<f64>,
    rows: usize,
) -> Vec<K> {
    let lengths: Vec<f64> = signatures.iter().map(|s| s.1.norm()).collect();
    let mut chosen: Vec<K> = Vec::new();
    while chosen.len() < MOST {
        let best = (signatures.iter().zip(&lengths).enumerate())
            .filter(|(_, ((name, s), length))| !chosen.contains(name) && s.norm() > OWN * **length)
            .map(|(i, ((_, s), _))| (i, s.dot(&residual).max(0.0).powi(2) / s.norm_squared()))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        // one more amplitude costs ln n of χ²
        let Some((i, _)) = best.filter(|(_, drop)| *drop > (rows as f64).ln()) else {
            break;
        };
        chosen.push(signatures[i].0.clone());
        let direction = signatures[i].1.normalize();
        let without = |v: &DVector<f64>| v - &direction * direction.dot(v);
        residual = without(&residual);
        for (_, signature) in &mut signatures {
            *signature = without(signature);
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two of three directions make up the residual; the third, nearly along the first, adds nothing once the first is chosen.
    #[test]
    fn finds_the_parts_of_a_sum() {
        let vector = |x: [f64; 4]| DVector::from_row_slice(&x);
        let signatures = vec![
            ("a", vector([1.0, 0.0, 0.0, 0.0])),
            ("b", vector([0.0, 1.0, 0.0, 0.0])),
            ("c", vector([1.0, 0.1, 0.4, 0.0])),
        ];
        let found = pursuit(signatures.clone(), vector([9.0, 5.0, 0.0, 0.1]), 100);
        assert_eq!(found, ["a", "b"]);
        // an effect against its sign is none, and little is nothing
        assert!(pursuit(signatures, vector([-9.0, 1.0, 0.0, 0.0]), 100).is_empty());
    }
}
