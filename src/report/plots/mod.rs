//! Line plots as SVG text.
//!
//! [`Plot`] is the description (curves, axes with units, vertical marks), [`Plot::svg`] draws it with plotters' SVG backend,
//! which needs no fonts; pages with scripts draw the same description again, with values under the pointer. Colours are told apart by colour-blind readers (Okabe and Ito 2008 for members and models, a dark to
//! light ramp for states in time), and never carry the meaning alone: each curve also has its own marker and a legend entry.
mod comparison;
mod draw;
mod ladder;
mod models;
mod run;
mod sensitivity;
mod sliding;
mod style;
mod sweep;

pub use comparison::{errors_by_place, of_comparison};
pub use ladder::of_ladder;
pub use models::of_models;
pub(in crate::report) use run::depths;
pub use run::{contact_of_run, live_states, of_run, oil_and_heat_of_run, wear_of_run};
pub use sensitivity::{IndexBar, IndexPanel, index_picture};
pub(in crate::report) use style::Hue;
pub use sweep::{SweepCurve, sweep_picture};

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
    /// True if the vertical axis is logarithmic; points must be above 0.
    pub logarithmic: bool,
    /// Names at 1, 2, 3, ... along the horizontal axis in place of numbers.
    pub names: Vec<String>,
    /// A second plot below over the same horizontal axis; it has no legend of its own.
    pub lower: Option<Box<Plot>>,
    /// True if the plot shows residuals: 0 is on the vertical axis, with a line.
    pub residuals: bool,
    /// What a page with scripts shows in place of `curves`; empty where it is the same.
    pub live: Vec<Live>,
    /// True if the live curves of earlier states stay in sight.
    pub history: bool,
}

/// A curve of a page with scripts.
#[derive(Debug, Clone, PartialEq)]
pub struct Live {
    /// The curve.
    pub curve: Curve,
    /// At which stored state, and in whose place: of curves in one place one is seen at a time. None is always seen.
    pub at: Option<(usize, &'static str)>,
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Legend entry; none if empty.
    pub label: String,
    /// Points in drawing order.
    pub points: Vec<(f64, f64)>,
    /// One standard deviation of each point, drawn as a bar up and down; none if empty.
    pub errors: Vec<f64>,
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
    /// A thin line without markers in the colour of kind `usize`.
    Line(usize),
    /// Measured points without a line in the colour of kind `usize`.
    Measured(usize),
    /// Measured points without a line at state `index` of `count` in time.
    TimeMeasured {
        /// Which state, from 0.
        index: usize,
        /// Of how many.
        count: usize,
    },
    /// A thin line without markers at state `index` of `count` in time.
    TimeLine {
        /// Which state, from 0.
        index: usize,
        /// Of how many.
        count: usize,
    },
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
            logarithmic: false,
            names: Vec::new(),
            lower: None,
            residuals: false,
            live: Vec::new(),
            history: false,
        }
    }

    /// Adds a curve; one without a finite point is left out.
    pub fn curve(mut self, label: &str, style: Style, points: Vec<(f64, f64)>) -> Self {
        if points.iter().any(finite) {
            self.curves.push(Curve {
                label: label.to_owned(),
                points,
                errors: Vec::new(),
                style,
            });
        }
        self
    }

    /// Adds points with one standard deviation each.
    pub fn with_errors(
        mut self,
        label: &str,
        style: Style,
        points: Vec<(f64, f64)>,
        errors: Vec<f64>,
    ) -> Self {
        let before = self.curves.len();
        self = self.curve(label, style, points);
        if let Some(added) = self.curves.get_mut(before) {
            added.errors = errors;
        }
        self
    }

    /// Adds a curve to what a page with scripts shows, if it has a finite point.
    pub fn live(
        mut self,
        at: Option<(usize, &'static str)>,
        label: &str,
        style: Style,
        points: Vec<(f64, f64)>,
    ) -> Self {
        if points.iter().any(finite) {
            let curve = Curve {
                label: label.to_owned(),
                points,
                errors: Vec::new(),
                style,
            };
            self.live.push(Live { curve, at });
        }
        self
    }

    /// Makes the vertical axis logarithmic.
    pub fn logarithmic(mut self) -> Self {
        self.logarithmic = true;
        self
    }

    /// Names the places 1, 2, 3, ... of the horizontal axis.
    pub fn with_names(mut self, names: Vec<String>) -> Self {
        self.names = names;
        self
    }

    /// Puts residuals below, over the same horizontal axis.
    pub fn above(mut self, mut lower: Plot) -> Self {
        lower.residuals = true;
        self.lower = Some(Box::new(lower));
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
