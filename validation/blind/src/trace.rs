//! Where across the face traces are taken, and whether the file says so.

use clap::ValueEnum;

use crate::dice::Dice;
use crate::layout::Place;
use crate::observe::Row;
use crate::uneven;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Trace {
    /// At mid-face.
    Mid,
    /// At the end of the face where material stands.
    Loaded,
    /// At the other end.
    Open,
    /// Mean over the face.
    Mean,
    /// Three traces: both ends and mid-face, always stated.
    Three,
}

/// The ends of the face are traced at this part of half its width.
const END: f64 = 0.85;

impl Trace {
    pub fn name(self) -> &'static str {
        ["mid", "loaded", "open", "mean", "three"][self as usize]
    }

    pub fn draw(d: &mut Dice) -> Self {
        *d.pick(Self::value_variants())
    }

    /// `side`: which end is the loaded one, -1 or 1.
    pub fn places(self, side: f64) -> Vec<Place> {
        match self {
            Self::Mid => vec![Place::Face(0.0)],
            Self::Loaded => vec![Place::Face(END * side)],
            Self::Open => vec![Place::Face(-END * side)],
            Self::Mean => vec![Place::Mean],
            Self::Three => [-END, 0.0, END].map(Place::Face).into(),
        }
    }
}

/// How the file states places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    None,
    Face,
    Tooth,
}

impl Column {
    /// `across`: traces have places across the face; `wanted`: whether the file says so where that is left to choose.
    pub fn of(named: &[(&str, &str)], across: bool, trace: Trace, wanted: bool) -> Self {
        if named.iter().any(|n| uneven::TEETH.contains(n)) {
            return if wanted { Self::Tooth } else { Self::None };
        }
        if across && (wanted || trace == Trace::Three) {
            Self::Face
        } else {
            Self::None
        }
    }

    pub fn name(self) -> Option<&'static str> {
        [None, Some("face"), Some("tooth")][self as usize]
    }

    /// What it says of a row; the measured tooth is number 1.
    pub fn cell(self, row: &Row, width: f64) -> Option<String> {
        let said = match (self, row.place) {
            (Self::None, _) => return None,
            _ if !row.is_depth() => String::new(),
            (Self::Tooth, _) => "1".into(),
            (Self::Face, Place::Face(eta)) => format!("{:.2}", 0.5 * eta * width),
            (Self::Face, Place::Mean) => "mean".into(),
            (Self::Face, Place::Usual) => "0".into(),
        };
        Some(said)
    }
}
