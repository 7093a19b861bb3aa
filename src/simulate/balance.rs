//! The balance of worn area: what the wear law says was worn off, from the line loads alone, against what the flanks have lost.

/// Worn area per tooth flank: by the wear law and by geometry, pinion and gear, mm².
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct Balance {
    /// ∫ k ∮ f F'|v_s| dt and what effects add, integrated over cycles by the trapezoidal rule from the line loads alone.
    pub law: [f64; 2],
    /// ∫ h ds of the worn flanks.
    pub geometry: [f64; 2],
}

impl Balance {
    /// Largest difference of the two, relative to the law (0 before any wear).
    pub fn error(&self) -> f64 {
        (0..2)
            .map(|i| {
                if self.law[i] > 0.0 {
                    (self.geometry[i] / self.law[i] - 1.0).abs()
                } else {
                    0.0
                }
            })
            .fold(0.0, f64::max)
    }

    /// How far what the step from `before` took off is from what the law says, over [`STEP_BALANCE`], the worse of both flanks;
    /// `unit` is each flank's area of a mean depth of one module, mm²; `drift`: whether what stands already counts.
    pub(super) fn off(&self, before: &Self, unit: [f64; 2], drift: bool) -> f64 {
        let off = |i: usize| {
            let law = self.law[i] - before.law[i];
            let geometry = self.geometry[i] - before.geometry[i];
            let mut worn = (0.05 * self.law[i]).min(unit[i] * BALANCE_CEILING);
            let apart = before.geometry[i] - before.law[i];
            if drift && apart * (geometry - law) > 0.0 {
                // once the areas have come apart, steps do not add to it
                worn *= (1.0 - apart.abs() / (BALANCE_DRIFT * before.law[i])).max(0.0);
            }
            (geometry - law).abs() / (law + worn.max(unit[i] * BALANCE_FLOOR))
        };
        off(0).max(off(1)) / STEP_BALANCE
    }
}

/// How far the area that a step takes off the flanks may be from that by the wear law, relative to the step's own and to a twentieth
/// of all area worn so far (no more of it than [`BALANCE_CEILING`]); a step that is farther off is taken again, shorter. The result may
/// be off by 0.5 %.
const STEP_BALANCE: f64 = 1e-3;

/// Worn area below that of this mean depth is not balanced step by step, modules.
const BALANCE_FLOOR: f64 = 5e-6;

/// Of all area worn before a step no more than that of this mean depth counts for it, modules: deep flanks take many steps, whose
/// differences add up.
const BALANCE_CEILING: f64 = 1e-3;

/// From this difference of the worn areas on, relative to the law, area worn before a step counts for nothing where the step would make
/// it larger: however many steps a history takes, it ends well within what passes.
const BALANCE_DRIFT: f64 = 2e-3;

#[cfg(test)]
mod tests {
    use super::*;

    /// However many steps a history takes, each as far off to the same side as may pass, its areas end within half of what a result may
    /// be off by.
    #[test]
    fn steps_that_pass_do_not_add_up() {
        for (steps, to_mean_depth) in [(100, 1e-3), (1000, 0.05), (20_000, 0.3)] {
            for side in [1.0, -1.0] {
                let mut balance = Balance::default();
                for i in 1..=steps {
                    let before = balance;
                    // growing steps, as a history's
                    let share = |i: i32| (f64::from(i) / f64::from(steps)).powi(2);
                    let worn = (share(i) - share(i - 1)) * to_mean_depth;
                    let after = |off: f64| Balance {
                        law: before.law.map(|law| law + worn),
                        geometry: before.geometry.map(|area| area + worn * (1.0 + side * off)),
                    };
                    // the most that passes, by bisection
                    let (mut passes, mut fails) = (0.0, 100.0);
                    for _ in 0..60 {
                        let middle = 0.5 * (passes + fails);
                        if after(middle).off(&before, [1.0; 2], true) <= 1.0 {
                            passes = middle;
                        } else {
                            fails = middle;
                        }
                    }
                    balance = after(passes);
                }
                assert!(balance.error() > 5e-4, "the check is a check");
                assert!(
                    balance.error() < 2.5e-3,
                    "{steps} steps: {}",
                    balance.error()
                );
            }
        }
    }

    /// A step that is off back towards the law is judged by all that is worn so far, one that adds to the difference is not.
    #[test]
    fn only_what_adds_to_a_difference_is_held_back() {
        let before = Balance {
            law: [0.1; 2],
            geometry: [0.1 * (1.0 - BALANCE_DRIFT); 2],
        };
        let after = |off: f64| Balance {
            law: [0.101; 2],
            geometry: [before.geometry[0] + 0.001 + off; 2],
        };
        let judged = |off: f64| after(off).off(&before, [1.0; 2], true);
        let (adding, mending) = (judged(-1e-6), judged(1e-6));
        assert!((adding - 1e-6 / 1e-3 / STEP_BALANCE).abs() < 0.01 * adding);
        assert!((mending - 1e-6 / 2e-3 / STEP_BALANCE).abs() < 0.01 * mending);
    }
}
