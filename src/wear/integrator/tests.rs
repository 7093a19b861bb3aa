//! The integrator against problems with known solutions, and its step control.

use super::*;

/// Prothero & Robinson's stiff problem with a known solution, time as its first unknown: u = (n, sin n).
struct Stiff(f64);

impl WearSystem for Stiff {
    type Error = std::convert::Infallible;
    fn rate(&mut self, _: f64, u: &[f64]) -> Result<Vec<f64>, Self::Error> {
        Ok(vec![1.0, -self.0 * (u[1] - u[0].sin()) + u[0].cos()])
    }
    fn jacobian(&mut self, _: f64, u: &[f64]) -> Result<Option<Jacobian>, Self::Error> {
        let j = [[0.0, 0.0], [self.0 * u[0].cos() - u[0].sin(), -self.0]];
        let full = || Jacobian::Full(PatchyMatrix::from_fn(2, |i, k| j[i][k]));
        Ok((self.0 > 10.0).then(full))
    }
}

fn fixed_step_error(stiffness: f64, steps: usize) -> f64 {
    let loose = StepControl {
        tolerance: 1e9,
        floor: 1.0,
        ceiling: f64::INFINITY,
        first_step: 1.0 / steps as f64,
        hesitates: false,
        least_growth: 0.0,
    };
    let mut stand = Stand::new(vec![0.0, 0.0], loose);
    for _ in 0..steps {
        stand.step = 1.0 / steps as f64;
        let end = stand.n + stand.step;
        advance(&mut Stiff(stiffness), &mut stand, end, loose).unwrap();
    }
    (stand.u[1] - 1f64.sin()).abs()
}

#[test]
fn is_of_second_order_with_and_without_a_jacobian() {
    for stiffness in [1.0, 12.0] {
        let order = (fixed_step_error(stiffness, 40) / fixed_step_error(stiffness, 80)).log2();
        assert!((order - 2.0).abs() < 0.2, "observed order {order}");
    }
}

#[test]
fn steps_far_beyond_the_explicit_limit_stay_bounded() {
    assert!(fixed_step_error(1e6, 10) < 1e-2);
}

/// Depths that all grow by 1 and then differ as they do in [`Stiff`]: with the ceiling the error is that of shallow flanks.
#[test]
fn deep_flanks_are_worn_no_more_coarsely_than_the_ceiling_allows() {
    let error = |ceiling| {
        let control = StepControl {
            tolerance: 1e-3,
            floor: 1e-3,
            ceiling,
            first_step: 1e-3,
            hesitates: false,
            least_growth: 1e-9,
        };
        let mut stand = Stand::new(vec![100.0, 100f64.sin()], control);
        while stand.n < 10.0 {
            advance(&mut Stiff(100.0), &mut stand, 10.0, control).unwrap();
        }
        (stand.u[1] - 110f64.sin()).abs()
    };
    assert!(error(1.0) < 2e-3, "{}", error(1.0));
    assert!(error(f64::INFINITY) > 5.0 * error(1.0));
}

/// A rate that jumps where the first unknown passes 1: the step that is refused there is not followed by a longer one.
#[test]
fn hesitates_after_a_refused_step() {
    struct Jump;
    impl WearSystem for Jump {
        type Error = std::convert::Infallible;
        fn rate(&mut self, _: f64, u: &[f64]) -> Result<Vec<f64>, Self::Error> {
            Ok(vec![if u[0] < 1.0 { 1.0 } else { 1.5 }])
        }
        fn jacobian(&mut self, _: f64, _: &[f64]) -> Result<Option<Jacobian>, Self::Error> {
            Ok(None)
        }
    }
    let grown = |hesitates| {
        let control = StepControl {
            tolerance: 0.1,
            floor: 1.0,
            ceiling: f64::INFINITY,
            first_step: 0.9,
            hesitates,
            least_growth: 1e-9,
        };
        let mut stand = Stand::new(vec![0.5], control);
        let step = advance(&mut Jump, &mut stand, 1e9, control).unwrap();
        assert!(stand.rejected > 0);
        stand.step / step.length()
    };
    assert!(grown(false) > 1.0);
    assert!(grown(true) <= 1.0);
}

#[test]
fn follows_its_tolerance() {
    let error = |tolerance| {
        let control = StepControl {
            tolerance,
            floor: 1.0,
            ceiling: f64::INFINITY,
            first_step: 1e-3,
            hesitates: false,
            least_growth: 1e-9,
        };
        let mut stand = Stand::new(vec![0.0, 0.0], control);
        while stand.n < 1.0 {
            advance(&mut Stiff(1e4), &mut stand, 1.0, control).unwrap();
        }
        assert_eq!(stand.n, 1.0);
        (stand.u[1] - 1f64.sin()).abs()
    };
    assert!(error(1e-3) < 1e-3);
    assert!(error(1e-5) < 1e-5);
}
