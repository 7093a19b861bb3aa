//! One picture of a sweep: a panel for each output over the first varied key, a curve per combination of the others.
use super::{Plot, Style};
use crate::report::OutputError;
use crate::report::html::escape;

/// A curve: its label, and for each value of the first key a figure for every panel.
pub type SweepCurve = (String, Vec<(f64, Vec<Option<f64>>)>);

/// Most curves in a picture.
const MOST_CURVES: usize = 8;

/// The picture as SVG, a panel for each title with its unit; none if no panel has two points to draw.
///
/// # Errors
/// [`OutputError`] if a panel cannot be drawn.
pub fn sweep_picture(
    title: &str,
    key: &str,
    labels: &[(&str, &str)],
    curves: &[SweepCurve],
) -> Result<Option<String>, OutputError> {
    let mut panels = Vec::new();
    let mut legend = Plot::new("sweep", title, "", "");
    for (i, &(name, unit)) in labels.iter().enumerate() {
        let mut plot = Plot::new("sweep", name, key, unit);
        for (number, (label, points)) in curves.iter().take(MOST_CURVES).enumerate() {
            let points = points.iter().filter_map(|(x, y)| Some((*x, y[i]?)));
            let points: Vec<(f64, f64)> = points.collect();
            let style = Style::Kind(number);
            if legend.curves.iter().all(|known| known.label != *label) {
                legend = legend.curve(label, style, points.clone());
            }
            // all panels share one legend
            plot = plot.curve("", style, points);
        }
        if !plot.is_empty() {
            panels.push((name, plot.starting_at_zero().svg()?));
        }
    }
    if panels.is_empty() {
        return Ok(None);
    }
    Ok(Some(side_by_side(title, &legend.legend()?, &panels)))
}

/// Height of a panel's heading, pixels.
const HEADING: f64 = 30.0;

/// Complete SVG texts under their headings as one, two in a row, the legend above.
pub(super) fn side_by_side(
    title: &str,
    legend: &(String, u32),
    panels: &[(&str, String)],
) -> String {
    let (width, height) = size(&panels[0].1);
    let (columns, rows) = (panels.len().min(2), panels.len().div_ceil(2));
    let top = 8.0 + f64::from(legend.1);
    let title = escape(title);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{title}\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
         font-family=\"sans-serif\">\n<title>{title}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
         <g transform=\"translate(0 8)\">\n{}\n</g>\n",
        legend.0,
        w = width * columns as f64,
        h = (height + HEADING) * rows as f64 + top,
    );
    for (i, (name, panel)) in panels.iter().enumerate() {
        let x = width * (i % 2) as f64;
        let y = top + (height + HEADING) * (i / 2) as f64;
        out += &format!(
            "<text x=\"{}\" y=\"{}\" font-size=\"17\" font-weight=\"bold\" fill=\"#282828\">{}</text>\n\
             <g transform=\"translate({x} {})\">\n{panel}\n</g>\n",
            x + 30.0,
            y + 22.0,
            escape(name),
            y + HEADING
        );
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
