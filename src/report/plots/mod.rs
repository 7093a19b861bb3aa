//! Line plots as SVG text.
//!
//! [`Plot`] is the description (curves, axes with units, vertical marks), [`Plot::svg`] draws it with plotters' SVG backend,
//! which needs no fonts. Colours are told apart by colour-blind readers (Okabe and Ito 2008 for members and models, a dark to
//! light ramp for states in time), and never carry the meaning alone: each curve also has its own marker and a legend entry.
mod draw;
mod models;
mod run;

pub use models::of_models;
pub use run::of_run;

/// A line plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// File stem, for example `wear_pinion`.
    pub name: String,
    /// What it shows, as a sentence fragment; also the text for readers that cannot see it.
    pub title: String,
    /// Horizontal axis with its unit.
    pub x_label: String,
    /// Vertical axis with its unit.
    pub y_label: String,
    /// The curves, drawn in this order.
    pub curves: Vec<Curve>,
    /// Vertical lines with a letter each, such as the ends of single contact.
    pub marks: Vec<(f64, String)>,
    /// True if the vertical axis must include 0.
    pub from_zero: bool,
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Legend entry.
    pub label: String,
    /// Points in drawing order.
    pub points: Vec<(f64, f64)>,
    /// Colour and marker.
    pub style: Style,
}

/// How a curve looks. The number chooses colour and marker.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Style {
    /// One of a few things side by side (members, models).
    Kind(usize),
    /// State `index` of `count` in time, dark to light.
    Time {
        /// Which state, from 0.
        index: usize,
        /// Of how many.
        count: usize,
    },
    /// Single points without a line, crosses in the colour of kind `usize`.
    Points(usize),
}

impl Plot {
    /// A plot without curves.
    pub fn new(name: &str, title: &str, x_label: &str, y_label: &str) -> Self {
        Plot {
            name: name.to_owned(),
            title: title.to_owned(),
            x_label: x_label.to_owned(),
            y_label: y_label.to_owned(),
            curves: Vec::new(),
            marks: Vec::new(),
            from_zero: false,
        }
    }

    /// Adds a curve; one without a finite point is left out.
    pub fn curve(mut self, label: &str, style: Style, points: Vec<(f64, f64)>) -> Self {
        if points.iter().any(finite) {
            self.curves.push(Curve {
                label: label.to_owned(),
                points,
                style,
            });
        }
        self
    }

    /// Adds vertical lines with letters.
    pub fn with_marks(mut self, marks: impl IntoIterator<Item = (f64, String)>) -> Self {
        self.marks.extend(marks);
        self
    }

    /// Makes the vertical axis include 0.
    pub fn starting_at_zero(mut self) -> Self {
        self.from_zero = true;
        self
    }

    /// True if there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.curves.is_empty()
    }
}

fn finite(point: &(f64, f64)) -> bool {
    point.0.is_finite() && point.1.is_finite()
}
