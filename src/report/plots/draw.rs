//! From [`Plot`] to SVG.

mod panel;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::style::draw_marker;
use super::{Curve, Plot, Style, finite};
use crate::report::error::OutputError;
use crate::report::html::escape;

/// Size in which the plot is meant to be seen, pixels.
const SIZE: (u32, u32) = (600, 390);
/// Height of a plot below another.
const LOWER: u32 = 190;
/// plotters rounds to whole units: drawn this many times larger and shown smaller, curves have no steps.
pub(super) const FINE: i32 = 8;
const TEXT: i32 = 19 * FINE;
const INK: RGBColor = RGBColor(40, 40, 40);
const GRID: RGBColor = RGBColor(222, 222, 222);
const MARK: RGBColor = RGBColor(130, 130, 130);
const FONT: &str = "sans-serif";

impl Plot {
    /// The plot as a complete SVG document without a background of its own.
    pub fn svg(&self) -> Result<String, OutputError> {
        let height = SIZE.1 + self.lower.as_ref().map_or(0, |_| LOWER);
        let mut text = String::new();
        {
            let area =
                SVGBackend::with_string(&mut text, (SIZE.0 * FINE as u32, height * FINE as u32))
                    .into_drawing_area();
            self.draw(&area).map_err(|error| OutputError::Plot {
                title: self.title.clone(),
                message: error.to_string(),
            })?;
        }
        Ok(accessible(&text, &self.title, height))
    }

    /// The legend alone as a complete SVG document, and its height in pixels.
    pub(super) fn legend(&self) -> Result<(String, u32), OutputError> {
        let rows = self.labelled().count().div_ceil(self.legend_columns()) as i32;
        let height = ((rows * LEGEND_ROW + 8 * FINE) / FINE) as u32;
        let mut text = String::new();
        {
            let size = (SIZE.0 * FINE as u32, height * FINE as u32);
            let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
            let drawn = self.draw_legend(&area).and_then(|()| area.present());
            drawn.map_err(|error| OutputError::Plot {
                title: self.title.clone(),
                message: error.to_string(),
            })?;
        }
        Ok((accessible(&text, &self.title, height), height))
    }

    fn draw(&self, area: &Area<'_>) -> Result<(), DrawError> {
        let legend_rows = self.labelled().count().div_ceil(self.legend_columns()) as i32;
        let (legend, below) = area.split_vertically(legend_rows * LEGEND_ROW + 8 * FINE);
        let mut x = self.horizontal();
        if let Some(lower) = &self.lower {
            let theirs = lower.horizontal();
            x = (x.0.min(theirs.0), x.1.max(theirs.1));
            let upper_height = (SIZE.1 as i32 - 52) * FINE - legend_rows * LEGEND_ROW;
            let (upper_area, lower_area) = below.split_vertically(upper_height);
            self.panel(area, &upper_area, x, false)?;
            lower.panel(area, &lower_area, x, true)?;
        } else {
            self.panel(area, &below, x, true)?;
        }
        self.draw_legend(&legend)?;
        area.present()
    }

    /// Finite points as the axes show them.
    fn seen<'p>(&self, points: &'p [(f64, f64)]) -> impl Iterator<Item = (f64, f64)> + use<'p> {
        let logarithmic = self.logarithmic;
        points
            .iter()
            .map(move |&(x, y)| (x, if logarithmic { y.log10() } else { y }))
            .filter(finite)
    }

    /// The name at a tick, if it stands at a whole number.
    fn name_at(&self, tick: f64) -> String {
        let near = (tick - tick.round()).abs() < 1e-6 && tick >= 0.5;
        let name = near.then(|| self.names.get(tick.round() as usize - 1));
        name.flatten().cloned().unwrap_or_default()
    }

    fn labelled(&self) -> impl Iterator<Item = &Curve> {
        self.curves.iter().filter(|curve| !curve.label.is_empty())
    }

    fn draw_legend(&self, area: &DrawingArea<SVGBackend<'_>, Shift>) -> Result<(), DrawError> {
        let style = TextStyle::from((FONT, TEXT).into_font())
            .color(&INK)
            .pos(Pos::new(HPos::Left, VPos::Center));
        let columns = self.legend_columns();
        let column = (SIZE.0 as i32 - 40) * FINE / columns as i32;
        for (number, curve) in self.labelled().enumerate() {
            let x = 30 * FINE + (number % columns) as i32 * column;
            let y = 14 * FINE + (number / columns) as i32 * LEGEND_ROW;
            let color = curve.style.color();
            // the line of what was measured is the model's, of the same colour and without an entry of its own
            let line = match curve.style {
                Style::Measured(_) | Style::TimeMeasured { .. } => Some(1.5),
                style => style.line(),
            };
            if let Some(width) = line {
                area.draw(&PathElement::new(
                    vec![(x, y), (x + 28 * FINE, y)],
                    color.stroke_width((width * f64::from(FINE)) as u32),
                ))?;
            }
            draw_marker(area, curve.style, (x + 14 * FINE, y))?;
            area.draw(&Text::new(
                curve.label.clone(),
                (x + 36 * FINE, y),
                style.clone(),
            ))?;
        }
        Ok(())
    }

    /// Three columns where the labels are short enough, else two or one.
    fn legend_columns(&self) -> usize {
        match self
            .curves
            .iter()
            .map(|curve| curve.label.chars().count())
            .max()
            .unwrap_or(0)
        {
            0..=16 => 3,
            17..=28 => 2,
            _ => 1,
        }
    }

    /// What the horizontal axis spans: all finite points and the vertical marks.
    fn horizontal(&self) -> (f64, f64) {
        if !self.names.is_empty() {
            return (0.5, self.names.len() as f64 + 0.5);
        }
        let points = self
            .curves
            .iter()
            .flat_map(|curve| self.seen(&curve.points));
        let marks = self.marks.iter().map(|mark| mark.0);
        widened(span(points.map(|p| p.0).chain(marks)))
    }

    /// What the vertical axis spans: all finite points and their bars with a little air above and below.
    fn vertical(&self) -> (f64, f64) {
        let ends = self.curves.iter().flat_map(|curve| {
            let bars = curve.points.iter().zip(&curve.errors);
            bars.flat_map(|(&(x, y), sigma)| [(x, y - sigma), (x, y + sigma)])
        });
        let ends: Vec<(f64, f64)> = ends.collect();
        let points = self
            .curves
            .iter()
            .flat_map(|curve| self.seen(&curve.points))
            .chain(self.seen(&ends));
        let level = self.residuals.then_some(0.0);
        let (low, high) = widened(span(points.map(|p| p.1).chain(level)));
        let air = 0.05 * (high - low);
        if self.from_zero && low >= 0.0 {
            (0.0, high + air)
        } else {
            (low - air, high + air)
        }
    }
}

fn span(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
        (low.min(v), high.max(v))
    })
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

pub(super) type DrawError = DrawingAreaErrorKind<std::io::Error>;

const LEGEND_ROW: i32 = 23 * FINE;

impl Curve {
    /// About nine markers along a line, shifted from curve to curve; every point where there is no line or few points.
    fn marker_places(&self, shown: &[(f64, f64)], width: f64, number: usize) -> Vec<(f64, f64)> {
        if self.style.line().is_none() || shown.len() <= 12 {
            return shown.to_vec();
        }
        let spacing = width / 9.0;
        let mut wanted = spacing * (0.25 + 0.3 * number as f64).fract();
        let mut last = shown[0].0;
        let mut places = Vec::new();
        for &point in shown {
            if (point.0 - last).abs() >= wanted {
                places.push(point);
                (last, wanted) = (point.0, spacing);
            }
        }
        places
    }
}

/// A range that is not empty.
fn widened((low, high): (f64, f64)) -> (f64, f64) {
    if !(low.is_finite() && high.is_finite()) {
        (0.0, 1.0)
    } else if high - low > 1e-9 * high.abs().max(low.abs()) {
        (low, high)
    } else {
        let air = if high == 0.0 { 1.0 } else { 0.1 * high.abs() };
        (low - air, high + air)
    }
}

/// Decimals that tell ticks about a tenth of the range apart.
fn digits((low, high): (f64, f64)) -> usize {
    (1.0 - (high - low).log10().floor()).clamp(0.0, 9.0) as usize
}

/// A tick label; a true minus sign, no trailing zeros, thousands apart.
fn tick(value: f64, digits: usize) -> String {
    let mut text = format!("{value:.digits$}");
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    crate::numeric::written::grouped(&text)
}

/// Adds what a screen reader says, and sets the size in which the drawing is seen.
fn accessible(svg: &str, title: &str, height: u32) -> String {
    let title = escape(title);
    let tag = format!("<svg role=\"img\" aria-label=\"{title}\" font-family=\"sans-serif\" ");
    let large = format!(
        "width=\"{}\" height=\"{}\"",
        SIZE.0 * FINE as u32,
        height * FINE as u32
    );
    let shown = format!("width=\"{}\" height=\"{height}\"", SIZE.0);
    let text = svg.replacen("<svg ", &tag, 1).replacen(&large, &shown, 1);
    match text.find('>') {
        Some(end) => format!(
            "{}<title>{title}</title>{}",
            &text[..=end],
            &text[end + 1..]
        ),
        None => text,
    }
}
