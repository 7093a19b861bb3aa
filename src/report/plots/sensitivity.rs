//! One picture of Sobol indices: a panel for each output, first and total index of every key with intervals, or along a flank.
use super::sweep::side_by_side;
use super::{Plot, Style};
use crate::report::OutputError;

/// First and total index, each with half its interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndexBar {
    /// The first index.
    pub first: (f64, f64),
    /// The total index.
    pub total: (f64, f64),
}

/// One output.
#[derive(Debug, Clone, PartialEq)]
pub enum IndexPanel {
    /// A figure: its indices key by key.
    Keys {
        /// What it is.
        title: String,
        /// The indices.
        bars: Vec<IndexBar>,
    },
    /// A figure along a flank.
    Along {
        /// What it is.
        title: String,
        /// The indices key by key at ascending radii, mm.
        places: Vec<(f64, Vec<IndexBar>)>,
    },
}

/// How far first and total index stand beside each other, in keys.
const APART: f64 = 0.08;

/// The picture as SVG; none without panels.
///
/// # Errors
/// [`OutputError`] if a panel cannot be drawn.
pub fn index_picture(
    title: &str,
    keys: &[String],
    panels: &[IndexPanel],
) -> Result<Option<String>, OutputError> {
    // the names of the kinds of marks, once for all panels
    let mut legend = Plot::new("sensitivity", title, "", "");
    let mut named = |label: &str, style: Style| {
        if legend.curves.iter().all(|known| known.label != label) {
            legend = legend.clone().curve(label, style, vec![(0.0, 0.0)]);
        }
    };
    let mut drawn = Vec::new();
    for panel in panels {
        let (title, plot) = match panel {
            IndexPanel::Keys { title, bars } => {
                let each = |of: fn(&IndexBar) -> (f64, f64), aside: f64| {
                    let points = bars.iter().enumerate();
                    let points = points.map(|(i, bar)| (i as f64 + 1.0 + aside, of(bar).0));
                    (
                        points.collect(),
                        bars.iter().map(|bar| of(bar).1).collect::<Vec<f64>>(),
                    )
                };
                let (first, first_widths) = each(|bar| bar.first, -APART);
                let (total, total_widths) = each(|bar| bar.total, APART);
                named("first, alone", Style::Points(0));
                named("total, with interactions", Style::Points(1));
                let plot = Plot::new("sensitivity", title, "", "share of the variance")
                    .with_names(keys.iter().map(|key| short(key)).collect())
                    .with_errors("", Style::Points(0), first, first_widths)
                    .with_errors("", Style::Points(1), total, total_widths);
                (title, plot)
            }
            IndexPanel::Along { title, places } => {
                let mut plot = Plot::new(
                    "sensitivity",
                    title,
                    "radius, mm",
                    "total share of the variance",
                );
                for (number, key) in keys.iter().enumerate() {
                    let at = |(radius, bars): &(f64, Vec<IndexBar>)| {
                        Some((*radius, bars.get(number)?.total.0))
                    };
                    // apart from the two kinds of the other panels
                    let style = Style::Kind(number + 2);
                    named(key, style);
                    plot = plot.curve("", style, places.iter().filter_map(at).collect());
                }
                (title, plot)
            }
        };
        if !plot.is_empty() {
            drawn.push((title.as_str(), plot.starting_at_zero().svg()?));
        }
    }
    if drawn.is_empty() {
        return Ok(None);
    }
    Ok(Some(side_by_side(title, &legend.legend()?, &drawn)))
}

/// A key's name without its unit: it stands for all of its values here.
fn short(key: &str) -> String {
    key.split(',').next().unwrap_or(key).to_owned()
}
