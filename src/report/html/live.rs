//! What the scripts of a page draw from: plots as JSON, and the scripts themselves.
use serde_json::{Map, Value, json};

use crate::report::plots::{Curve, Hue, Plot};

/// uPlot 1.6.32 with its licence line, and what we add to it.
const SCRIPTS: [&str; 9] = [
    include_str!("script/theme.js"),
    include_str!("script/marks.js"),
    include_str!("script/panel.js"),
    include_str!("script/chart.js"),
    include_str!("script/tooth.js"),
    include_str!("script/field.js"),
    include_str!("script/slider.js"),
    include_str!("script/selftest.js"),
    include_str!("script/start.js"),
];

/// Style sheet of the charts.
pub(super) const STYLE: &str = include_str!("vendor/uPlot.min.css");

/// Data and scripts at the end of a page; `states` name the places of its sliders, `tooth` the worn profile.
pub(super) fn scripts(plots: &[&Plot], states: &[String], tooth: Option<&Value>) -> String {
    let charts: Vec<Value> = plots.iter().map(|plot| chart(plot, None)).collect();
    let data = json!({"charts": charts, "states": states, "tooth": tooth});
    let mut out = format!(
        "<script type=\"application/json\" id=\"live-data\">{}</script>\n<script>\n{}</script>\n<script>\n(() => {{\n\"use strict\";\n",
        inside_a_script(&data),
        include_str!("vendor/uPlot.iife.min.js")
    );
    for script in SCRIPTS {
        out.push_str(script);
    }
    out.push_str("})();\n</script>\n");
    out
}

/// JSON that cannot end the element it stands in.
pub(super) fn inside_a_script(data: &Value) -> String {
    data.to_string().replace('<', "\\u003c")
}

fn chart(plot: &Plot, above: Option<&Plot>) -> Value {
    let mut xs: Vec<Vec<f64>> = Vec::new();
    let mut curves = Vec::new();
    if plot.live.is_empty() {
        for (number, curve) in plot.curves.iter().enumerate() {
            let label = label(plot, number, above);
            curves.push(Value::Object(drawn(plot, curve, &label, &mut xs)));
        }
    }
    for live in &plot.live {
        let mut curve = drawn(plot, &live.curve, &live.curve.label, &mut xs);
        if let Some((state, slot)) = live.at {
            curve.insert("state".to_owned(), json!(state));
            if !slot.is_empty() {
                curve.insert("slot".to_owned(), json!(slot));
            }
        }
        curves.push(Value::Object(curve));
    }
    let lower = plot.lower.as_ref().map(|lower| chart(lower, Some(plot)));
    let (short, brief) = names(&plot.x_label);
    json!({
        "name": plot.name, "title": plot.title, "x": plot.x_label, "y": plot.y_label, "short": short, "brief": brief,
        "zero": plot.from_zero, "log": plot.logarithmic, "residuals": plot.residuals, "history": plot.history,
        "names": plot.names, "marks": plot.marks, "xs": xs, "curves": curves, "lower": lower,
    })
}

/// The horizontal axis beside a value, and below a narrow chart.
fn names(label: &str) -> (&str, &str) {
    if label.starts_with("distance along the path") {
        ("path, mm", "path from the pitch point, mm")
    } else if label.starts_with("pinion rotation") {
        ("rotation", "pinion rotation, base pitches")
    } else {
        (label, label)
    }
}

fn drawn(plot: &Plot, curve: &Curve, label: &str, xs: &mut Vec<Vec<f64>>) -> Map<String, Value> {
    let finite = |point: &(f64, f64)| {
        point.0.is_finite() && point.1.is_finite() && (!plot.logarithmic || point.1 > 0.0)
    };
    let kept: Vec<usize> = (0..curve.points.len())
        .filter(|&i| finite(&curve.points[i]))
        .collect();
    let column = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
        kept.iter().map(|&i| rounded(value(i))).collect()
    };
    let x = column(&|i| curve.points[i].0);
    let at = xs.iter().position(|known| *known == x).unwrap_or(xs.len());
    if at == xs.len() {
        xs.push(x);
    }
    let color = match curve.style.hue() {
        Hue::Kind(kind) => json!({"k": kind}),
        Hue::Time(share) => json!({"t": share}),
    };
    let mut map = Map::new();
    map.insert("label".to_owned(), json!(label));
    map.insert("x".to_owned(), json!(at));
    map.insert("y".to_owned(), json!(column(&|i| curve.points[i].1)));
    if !curve.errors.is_empty() {
        map.insert("e".to_owned(), json!(column(&|i| curve.errors[i])));
    }
    map.insert("color".to_owned(), color);
    map.insert(
        "line".to_owned(),
        json!(curve.style.line().unwrap_or_default()),
    );
    let marker = curve.style.shape().map_or(json!(-1), |shape| json!(shape));
    map.insert("marker".to_owned(), marker);
    map.insert("small".to_owned(), json!(curve.points.len() > 12));
    map
}

/// A curve without a name of its own is the model's beside the measured one after it, or, in the lower plot, the error of
/// that in the upper one.
fn label(plot: &Plot, number: usize, above: Option<&Plot>) -> String {
    let own = &plot.curves[number].label;
    if !own.is_empty() {
        return own.clone();
    }
    match above {
        Some(upper) => upper
            .curves
            .iter()
            .filter(|curve| !curve.label.is_empty())
            .nth(number)
            .map_or("error".to_owned(), |curve| {
                format!("error, {}", curve.label)
            }),
        None => plot
            .curves
            .get(number + 1)
            .filter(|next| next.style.hue() == plot.curves[number].style.hue())
            .map_or("model".to_owned(), |next| format!("model, {}", next.label)),
    }
}

/// Six digits: enough for any screen.
fn rounded(value: f64) -> f64 {
    // a sum with 0 is no -0
    format!("{value:.5e}").parse().unwrap_or(value) + 0.0
}
