//! One panel of a plot: axes, marks and curves over one horizontal axis.

use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{Area, DrawError, FINE, FONT, GRID, INK, MARK, TEXT, digits, tick};
use crate::numeric::written::significant;
use crate::report::plots::style::draw_marker;
use crate::report::plots::{Curve, Plot, Style};

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// What the axes of a panel span, and how they are labelled.
#[derive(Clone, Copy)]
struct Axes {
    x: (f64, f64),
    y: (f64, f64),
    /// Whether the horizontal axis has numbers and a name.
    named: bool,
}

impl Plot {
    /// Axes, marks and curves in `place`, a part of `area`; without `named` the horizontal axis has neither numbers nor name.
    pub(super) fn panel(
        &self,
        area: &Area<'_>,
        place: &Area<'_>,
        x: (f64, f64),
        named: bool,
    ) -> Result<(), DrawError> {
        let y = self.vertical();
        let axes = Axes { x, y, named };
        let top = if self.marks.iter().all(|mark| mark.1.is_empty()) {
            10 * FINE
        } else {
            24 * FINE
        };
        let mut chart = ChartBuilder::on(place)
            .margin_top(top)
            .margin_right(if x.1 >= 1e6 { 50 * FINE } else { 32 * FINE })
            .margin_bottom(6 * FINE)
            .margin_left(6 * FINE)
            .x_label_area_size(if named { 52 * FINE } else { 4 * FINE })
            .y_label_area_size(80 * FINE)
            .build_cartesian_2d(x.0..x.1, y.0..y.1)?;
        self.draw_axes(&mut chart, axes)?;
        self.draw_marks(area, &mut chart, axes)?;
        for (number, curve) in self.curves.iter().enumerate() {
            let shown: Vec<(f64, f64)> = self.seen(&curve.points).collect();
            self.draw_line_and_bars(&mut chart, curve, &shown)?;
            for at in curve.marker_places(&shown, x.1 - x.0, number) {
                let (px, py) = chart.backend_coord(&at);
                draw_marker(area, curve.style, (px, py))?;
            }
        }
        Ok(())
    }

    fn draw_axes(&self, chart: &mut Chart<'_, '_>, axes: Axes) -> Result<(), DrawError> {
        let Axes { x, y, named } = axes;
        let (x_digits, y_digits) = (digits(x), digits(y));
        let short = self.residuals;
        let x_tick = |v: &f64| match (named, self.names.is_empty()) {
            (false, _) => String::new(),
            (true, true) => tick(*v, x_digits),
            (true, false) => self.name_at(*v),
        };
        let y_tick = |v: &f64| {
            if self.logarithmic {
                significant(10f64.powf(*v), 2)
            } else {
                tick(*v, y_digits)
            }
        };
        chart
            .configure_mesh()
            .x_labels(if self.names.is_empty() {
                7
            } else {
                2 * self.names.len() + 1
            })
            .y_labels(if short { 5 } else { 6 })
            .bold_line_style(GRID.stroke_width(FINE as u32))
            .light_line_style(TRANSPARENT)
            .axis_style(INK.stroke_width(FINE as u32))
            .set_all_tick_mark_size(if named { 5 * FINE } else { 2 * FINE })
            .label_style((FONT, TEXT).into_font().color(&INK))
            .axis_desc_style((FONT, TEXT).into_font().color(&INK))
            .x_desc(if named { self.x_label.as_str() } else { "" })
            .y_desc(&self.y_label)
            .x_label_formatter(&x_tick)
            .y_label_formatter(&y_tick)
            .draw()
    }

    /// The vertical marks with their letters above, and the level 0 of residuals.
    fn draw_marks(
        &self,
        area: &Area<'_>,
        chart: &mut Chart<'_, '_>,
        axes: Axes,
    ) -> Result<(), DrawError> {
        let Axes { x, y, .. } = axes;
        let mark_text = TextStyle::from((FONT, TEXT).into_font())
            .color(&MARK)
            .pos(Pos::new(HPos::Center, VPos::Bottom));
        let level = self.residuals.then_some([(x.0, 0.0), (x.1, 0.0)]);
        let upright = self.marks.iter().filter(|(at, _)| (x.0..=x.1).contains(at));
        let lines = upright.clone().map(|(at, _)| [(*at, y.0), (*at, y.1)]);
        for line in lines.chain(level) {
            chart.draw_series([PathElement::new(
                line.to_vec(),
                MARK.stroke_width(FINE as u32),
            )])?;
        }
        for (at, letter) in upright.filter(|mark| !mark.1.is_empty()) {
            let (px, py) = chart.backend_coord(&(*at, y.1));
            area.draw(&Text::new(
                letter.clone(),
                (px, py - 4 * FINE),
                mark_text.clone(),
            ))?;
        }
        Ok(())
    }

    /// The line of a curve through the points that are `shown`, and the bars of its errors.
    fn draw_line_and_bars(
        &self,
        chart: &mut Chart<'_, '_>,
        curve: &Curve,
        shown: &[(f64, f64)],
    ) -> Result<(), DrawError> {
        let color = curve.style.color();
        if let Some(width) = curve.style.line() {
            chart.draw_series(LineSeries::new(
                shown.to_vec(),
                color.stroke_width((width * f64::from(FINE)) as u32),
            ))?;
        }
        // bars with curves or among many points stand back, few points alone need theirs seen
        let width = match curve.style {
            Style::Points(_) => 2 * FINE,
            _ => FINE,
        };
        for (&(at, value), sigma) in curve.points.iter().zip(&curve.errors) {
            let bar = [(at, value - sigma), (at, value + sigma)];
            let bar = PathElement::new(
                self.seen(&bar).collect::<Vec<_>>(),
                color.stroke_width(width as u32),
            );
            chart.draw_series([bar])?;
        }
        Ok(())
    }
}
