//! What the proposed tests promise, by the figure that `plan` judges them by too: the expected difference in χ² after refitting.

use crate::learn::experiment::candidate_tests::{APART, CLEAR};
use crate::learn::experiment::next::NextExperiment;

/// What the tests that a diagnosis proposes are expected to do to its rivals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Outlook {
    /// They tell the rivals apart.
    Decide,
    /// They favour one clearly.
    Favour,
    /// They hardly tell them apart.
    Little,
    /// None is proposed.
    NoTest,
}

impl Outlook {
    /// Of the proposed test and those beside it.
    pub(super) fn of(next: Option<&NextExperiment>) -> Self {
        match next.map(|next| next.together_chi2) {
            None => Self::NoTest,
            Some(chi2) if chi2 >= APART => Self::Decide,
            Some(chi2) if chi2 >= CLEAR => Self::Favour,
            Some(_) => Self::Little,
        }
    }

    /// Whether the proposed tests are worth waiting for.
    pub(super) fn is_worth_a_test(self) -> bool {
        matches!(self, Self::Decide | Self::Favour)
    }

    /// What would decide whether a weak effect is missing.
    pub(super) fn of_a_weak_effect(self) -> &'static str {
        match self {
            Self::Decide => {
                "add nothing yet: the proposed tests, with all that was measured so far measured in them too, would decide"
            }
            Self::Favour => {
                "add nothing yet: the proposed tests, with all that was measured so far measured in them too, would favour one answer clearly, but not decide"
            }
            Self::Little => {
                "add nothing yet: even the best tests made like these would hardly tell; less noise, later in life or another quantity might (gearwear plan STUDY has the figures)"
            }
            Self::NoTest => {
                "add nothing yet: no test made like these would tell; less noise, later in life or another quantity might (gearwear plan STUDY has the figures)"
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::experiment::candidate_tests::NextTest;

    #[test]
    fn a_test_that_hardly_separates_is_not_said_to_decide() {
        let next = |together_chi2| NextExperiment {
            separates: Vec::new(),
            test: NextTest {
                torque: 100.0,
                speed: 2000.0,
                misalignment: 0.0,
                cycles: 1e6,
                reversed: false,
                bulk_temperature: None,
            },
            why: String::new(),
            expected_chi2: 0.5 * together_chi2,
            repeats: None,
            repetition_chi2: 0.0,
            further: Vec::new(),
            together_chi2,
        };
        let outlook = |chi2| Outlook::of(Some(&next(chi2)));
        assert_eq!(outlook(3.2), Outlook::Little);
        assert!(
            outlook(3.2)
                .of_a_weak_effect()
                .contains("would hardly tell")
        );
        assert!(!outlook(3.2).is_worth_a_test());
        assert!(outlook(8.0).of_a_weak_effect().ends_with("but not decide"));
        assert!(outlook(25.0).of_a_weak_effect().ends_with("would decide"));
        assert!(
            !Outlook::of(None)
                .of_a_weak_effect()
                .contains("would decide")
        );
    }
}
