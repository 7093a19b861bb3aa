//! The checks of a run on itself.

use super::RunError;
use super::stored_states::{Kept, Worn};
use crate::simulate::result::Check;

/// What failed, by how much, and what helps.
pub(super) fn failed_checks(checks: &[Check]) -> String {
    let failed = checks.iter().map(|c| {
        let help = match c.name.as_str() {
            WORN_AREA => "a smaller numerics.step_tolerance or more numerics.positions",
            _ => "more numerics.elements_per_half_width",
        };
        format!(
            "{} is off by {:.2e} (at most {:.0e} passes): {help}, or less wear, helps",
            c.name, c.value, c.limit
        )
    });
    let faults: Vec<String> = failed.collect();
    format!(
        "the result fails its own check and is not written: {}",
        faults.join("; ")
    )
}

/// The check that the worn flanks lack what the wear law took off them.
const WORN_AREA: &str = "worn area, law against geometry";

/// Largest relative difference of worn area by law and by geometry that passes as balanced (time steps of the two differ).
const BALANCE_LIMIT: f64 = 5e-3;

/// Largest penetration over the approach that passes.
const PENETRATION_LIMIT: f64 = 1e-3;

/// Largest relative difference of the torque that the contact forces carry from the load that passes: rounding.
const TORQUE_LIMIT: f64 = 1e-9;

/// The checks of what was worn, all of them passed.
pub(super) fn passed(worn: &Worn) -> Result<Vec<Check>, RunError> {
    let largest = |figure: fn(&Kept) -> f64| worn.kept.iter().map(figure).fold(0.0, f64::max);
    let checks = vec![
        check(WORN_AREA, worn.progress.balance.error(), BALANCE_LIMIT),
        check(
            "penetration over approach",
            largest(|k| k.penetration),
            PENETRATION_LIMIT,
        ),
        check(
            "torque from contact forces against the load",
            largest(|k| k.torque_error),
            TORQUE_LIMIT,
        ),
    ];
    let failed: Vec<Check> = (checks.iter().filter(|c| !c.passed())).cloned().collect();
    if failed.is_empty() {
        Ok(checks)
    } else {
        Err(RunError::Unsound(failed))
    }
}

fn check(name: &str, value: f64, limit: f64) -> Check {
    Check {
        name: name.to_owned(),
        value,
        limit,
        unit: "-".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_failed_is_named_with_its_size_and_what_helps() {
        let failed = vec![
            check(WORN_AREA, 0.013, BALANCE_LIMIT),
            check("penetration over approach", 2e-3, PENETRATION_LIMIT),
        ];
        let text = RunError::Unsound(failed).to_string();
        for part in [
            "worn area, law against geometry is off by 1.30e-2 (at most 5e-3 passes): a smaller numerics.step_tolerance",
            "penetration over approach is off by 2.00e-3 (at most 1e-3 passes): more numerics.elements_per_half_width",
            "is not written",
        ] {
            assert!(text.contains(part), "{text}");
        }
    }
}
