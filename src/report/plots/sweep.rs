//! One picture of a sweep: four panels over the first varied key, a curve per combination of the others.
use super::{Plot, Style};
use crate::report::OutputError;

/// A curve: its label, and for each value of the first key peak pressure (MPa), transmission error (µrad) and the largest depth of
/// pinion and gear (µm).
pub type SweepCurve = (String, Vec<(f64, [Option<f64>; 4])>);

/// Most curves in a picture.
const MOST_CURVES: usize = 8;

/// The picture as SVG; none if no panel has two points to draw.
///
/// # Errors
/// [`OutputError`] if a panel cannot be drawn.
pub fn sweep_picture(
    title: &str,
    key: &str,
    curves: &[SweepCurve],
) -> Result<Option<String>, OutputError> {
    let labels = [
        ("Peak pressure, unworn", "MPa"),
        ("Transmission error, unworn", "peak to peak, µrad"),
        ("Wear of the pinion", "largest depth, µm"),
        ("Wear of the gear", "largest depth, µm"),
    ];
    let mut panels = Vec::new();
    for (i, (name, unit)) in labels.into_iter().enumerate() {
        let mut plot = Plot::new("sweep", name, key, &format!("{name}: {unit}"));
        for (number, (label, points)) in curves.iter().take(MOST_CURVES).enumerate() {
            let points = points.iter().filter_map(|(x, y)| Some((*x, y[i]?)));
            plot = plot.curve(label, Style::Kind(number), points.collect());
        }
        if !plot.is_empty() {
            panels.push(plot.starting_at_zero().svg()?);
        }
    }
    if panels.is_empty() {
        return Ok(None);
    }
    Ok(Some(side_by_side(title, &panels)))
}

/// Complete SVG texts as one, two in a row.
fn side_by_side(title: &str, panels: &[String]) -> String {
    let (width, height) = size(&panels[0]);
    let (columns, rows) = (panels.len().min(2), panels.len().div_ceil(2));
    let title = title
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('"', "&quot;");
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{title}\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\">\n\
         <title>{title}</title>\n",
        w = width * columns as f64,
        h = height * rows as f64,
    );
    for (i, panel) in panels.iter().enumerate() {
        let (x, y) = (width * (i % 2) as f64, height * (i / 2) as f64);
        out += &format!("<g transform=\"translate({x} {y})\">\n{panel}\n</g>\n");
    }
    out + "</svg>\n"
}

/// Width and height that an SVG text states.
fn size(svg: &str) -> (f64, f64) {
    let of = |name: &str| {
        let at = svg.find(&format!(" {name}=\""))? + name.len() + 3;
        svg[at..].split('"').next()?.parse::<f64>().ok()
    };
    (of("width").unwrap_or(600.0), of("height").unwrap_or(390.0))
}
