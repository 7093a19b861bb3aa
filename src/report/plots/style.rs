//! How curves look: colours, markers, widths.
use plotters::coord::Shift;
use plotters::prelude::*;

use super::Style;
use super::draw::{DrawError, FINE};

/// Okabe and Ito's palette without its yellow and sky blue, which are too light on white.
const KINDS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 140, 105),
    RGBColor(178, 90, 145),
    RGBColor(120, 120, 120),
    RGBColor(186, 130, 0),
];

/// The viridis map from where it is still seen on white to its dark end: the latest state is the strongest.
const RAMP: [RGBColor; 6] = [
    RGBColor(122, 190, 70),
    RGBColor(53, 175, 121),
    RGBColor(33, 145, 140),
    RGBColor(49, 104, 142),
    RGBColor(68, 57, 131),
    RGBColor(68, 1, 84),
];

/// A colour by number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::report) enum Hue {
    /// Of a kind.
    Kind(usize),
    /// Of a state in time, 0 to 1.
    Time(f64),
}

impl Style {
    pub(super) fn color(self) -> RGBColor {
        match self {
            Style::Kind(kind) | Style::Points(kind) | Style::Line(kind) | Style::Measured(kind) => {
                KINDS[kind % KINDS.len()]
            }
            Style::Time { index, count }
            | Style::TimeMeasured { index, count }
            | Style::TimeLine { index, count } => RAMP[ramp_place(index, count)],
        }
    }

    /// The colour by number, as scripts choose it.
    pub(in crate::report) fn hue(self) -> Hue {
        match self {
            Style::Kind(kind) | Style::Points(kind) | Style::Line(kind) | Style::Measured(kind) => {
                Hue::Kind(kind)
            }
            Style::Time { index, count }
            | Style::TimeMeasured { index, count }
            | Style::TimeLine { index, count } => {
                Hue::Time(index as f64 / (count.max(2) - 1) as f64)
            }
        }
    }

    /// The marker's number; none for a bare line.
    pub(in crate::report) fn shape(self) -> Option<usize> {
        Some(self.marker()).filter(|&marker| marker < NOTHING)
    }

    fn marker(self) -> usize {
        match self {
            Style::Kind(kind) | Style::Measured(kind) => kind % SHAPES,
            Style::Time { index, count } | Style::TimeMeasured { index, count } => {
                ramp_place(index, count) % SHAPES
            }
            Style::Points(_) => CROSS,
            Style::Line(_) | Style::TimeLine { .. } => NOTHING,
        }
    }

    /// Width of its line, if it has one.
    pub(in crate::report) fn line(self) -> Option<f64> {
        match self {
            Style::Kind(_) | Style::Time { .. } => Some(2.0),
            Style::Line(_) | Style::TimeLine { .. } => Some(1.5),
            Style::Points(_) | Style::Measured(_) | Style::TimeMeasured { .. } => None,
        }
    }

    /// Size of its markers: measured points are many.
    fn unit(self) -> i32 {
        match self {
            Style::Measured(_) | Style::TimeMeasured { .. } => FINE * 5 / 8,
            _ => FINE,
        }
    }
}

fn ramp_place(index: usize, count: usize) -> usize {
    if count < 2 {
        0
    } else {
        (index * (RAMP.len() - 1) + (count - 1) / 2) / (count - 1)
    }
}

const SHAPES: usize = 6;
const CROSS: usize = SHAPES;
const NOTHING: usize = SHAPES + 1;

/// Markers that differ in outline: disc, ring, square, triangle, open square, diamond; and a cross.
pub(super) fn draw_marker(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    style: Style,
    (x, y): (i32, i32),
) -> Result<(), DrawError> {
    let (color, unit) = (style.color(), style.unit());
    let line = color.stroke_width(2 * unit as u32);
    match style.marker() {
        NOTHING => Ok(()),
        0 => area.draw(&Circle::new((x, y), 4 * unit, color.filled())),
        1 => area.draw(&Circle::new((x, y), 4 * unit, line)),
        2 => area.draw(&Rectangle::new(
            [(x - 4 * unit, y - 4 * unit), (x + 4 * unit, y + 4 * unit)],
            color.filled(),
        )),
        3 => area.draw(&Polygon::new(
            vec![
                (x - 5 * unit, y + 4 * unit),
                (x + 5 * unit, y + 4 * unit),
                (x, y - 5 * unit),
            ],
            color,
        )),
        // an open rectangle's own stroke has no width
        4 => {
            let a = 4 * unit;
            let corners = [
                (x - a, y - a),
                (x + a, y - a),
                (x + a, y + a),
                (x - a, y + a),
            ];
            let around = corners.into_iter().chain([corners[0], corners[1]]);
            area.draw(&PathElement::new(around.collect::<Vec<_>>(), line))
        }
        5 => area.draw(&Polygon::new(
            vec![
                (x - 5 * unit, y),
                (x, y + 5 * unit),
                (x + 5 * unit, y),
                (x, y - 5 * unit),
            ],
            color,
        )),
        _ => {
            area.draw(&PathElement::new(
                vec![(x - 4 * unit, y - 4 * unit), (x + 4 * unit, y + 4 * unit)],
                line,
            ))?;
            area.draw(&PathElement::new(
                vec![(x - 4 * unit, y + 4 * unit), (x + 4 * unit, y - 4 * unit)],
                line,
            ))
        }
    }
}
