//! A parameter of a plain shape: its range, and how it is searched.

use crate::study::rounded;

/// A parameter of a shape over a given range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::learn) struct ShapeParameter {
    /// Its name in formulas.
    pub(in crate::learn) name: &'static str,
    /// Least value.
    pub(in crate::learn) lower: f64,
    /// Largest value.
    pub(in crate::learn) upper: f64,
    /// Whether it is in the unit of the variable; a number else.
    pub(in crate::learn) in_units: bool,
    /// How many values are tried first, even or even in the logarithm.
    pub(super) tried: usize,
    /// Whether it is searched in its logarithm.
    pub(super) logarithmic: bool,
}

impl ShapeParameter {
    /// When something begins, pinion cycles; `longest`: those of the longest test.
    pub(super) fn moment(longest: f64) -> Self {
        Self {
            name: "from",
            lower: 0.0,
            upper: longest,
            in_units: false,
            tried: 0,
            logarithmic: false,
        }
    }

    /// The same with half of its range more at either end.
    pub(super) fn beyond(self) -> Self {
        let more = 0.5 * (self.upper - self.lower);
        Self {
            lower: rounded(self.lower - more),
            upper: rounded(self.upper + more),
            ..self
        }
    }

    /// The same of another name.
    pub(super) fn named(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    /// The scale on which values are tried.
    pub(super) fn scaled(&self, value: f64) -> f64 {
        if self.logarithmic { value.ln() } else { value }
    }

    /// The value at a place of that scale, within the bounds.
    pub(super) fn value(&self, scaled: f64) -> f64 {
        let value = if self.logarithmic {
            scaled.exp()
        } else {
            scaled
        };
        value.clamp(self.lower, self.upper)
    }

    /// Distance of values that are tried.
    pub(super) fn step(&self) -> f64 {
        let intervals = self.tried.saturating_sub(1).max(1);
        (self.scaled(self.upper) - self.scaled(self.lower)) / intervals as f64
    }

    /// The values that are tried first.
    pub(super) fn values(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.tried).map(|n| self.value(self.scaled(self.lower) + n as f64 * self.step()))
    }
}
