//! Von Mises stress and mesh where the teeth are loaded, at some of the stored states and positions: a figure of the page.
use rayon::prelude::*;

use super::palette::{MAP, palette};
use super::view::View;
use super::{Drawing, base64};
use crate::numeric::written::{count, plain, significant};
use crate::report::error::OutputError;
use crate::simulate::result::{FieldFrame, Run};

/// Size of a picture, pixels.
const SIZE: [usize; 2] = [880, 560];
/// Places shown at most.
const MOST: usize = 5;

/// One picture of the choice.
struct Picture {
    name: String,
    highest: f64,
    /// PNG as Base64.
    field: String,
    lines: String,
}

/// One figure with a choice of pictures, each place whole and close to its contact; none for a run without fields.
///
/// # Errors
/// [`OutputError`] if a picture cannot be encoded.
pub fn stresses(run: &Run) -> Result<Option<Drawing>, OutputError> {
    let frames = chosen(run);
    if frames.is_empty() {
        return Ok(None);
    }
    let whole = View::whole(run, SIZE);
    let close: Vec<View> = frames.iter().map(|f| View::close(run, f, SIZE)).collect();
    let highest = whole.highest(frames[0]);
    let highest_close = highest_of(&frames, &close);
    let mut wanted: Vec<(&FieldFrame, View, f64, String)> = Vec::new();
    for (frame, close) in frames.iter().zip(close) {
        wanted.push((frame, whole, highest, name(frame)));
        let close_up = format!("{}, close-up of the contact", name(frame));
        wanted.push((frame, close, highest_close, close_up));
    }
    let colors = palette();
    let pictures: Result<Vec<Picture>, OutputError> = wanted
        .into_par_iter()
        .map(|(frame, view, highest, name)| {
            Ok(Picture {
                field: base64::encoded(&view.stress(frame, highest).png(&colors)?),
                lines: base64::encoded(&view.lines(frame).shade()?),
                name,
                highest,
            })
        })
        .collect();
    Ok(Some(figure(&pictures?, &colors)))
}

/// The last state's positions, and the same place when the flanks were new.
pub(super) fn chosen(run: &Run) -> Vec<&FieldFrame> {
    let Some(last) = run.fields.last() else {
        return Vec::new();
    };
    let mut frames: Vec<&FieldFrame> = run
        .fields
        .iter()
        .filter(|frame| frame.cycles == last.cycles)
        .take(MOST - 1)
        .collect();
    let new = run.fields.first().filter(|new| new.cycles < last.cycles);
    frames.extend(new);
    frames
}

/// One scale for the close-ups of all frames.
pub(super) fn highest_of(frames: &[&FieldFrame], views: &[View]) -> f64 {
    let of = |(frame, view): (&&FieldFrame, &View)| view.highest(frame);
    frames.iter().zip(views).map(of).fold(0.0, f64::max)
}

/// Where and when, in words.
pub(super) fn name(frame: &FieldFrame) -> String {
    format!(
        "{} cycles, {} base pitches from the pitch point",
        count(frame.cycles),
        plain((1e4 * frame.position).round() / 1e4)
    )
}

/// The end of a colour scale in words.
pub(super) fn scale_end(highest: f64) -> String {
    format!("{} MPa and above", significant(highest, 2))
}

fn figure(pictures: &[Picture], colors: &[[u8; 3]]) -> Drawing {
    let mut html = String::from("<div class=\"scripts choice\" hidden><label>Seen at <select>");
    for (i, Picture { name, .. }) in pictures.iter().enumerate() {
        html.push_str(&format!("<option value=\"{i}\">{name}</option>"));
    }
    html.push_str("</select></label> <label><input type=\"checkbox\" checked> mesh</label> <output></output></div>\n");
    let [width, height] = SIZE;
    for (i, picture) in pictures.iter().enumerate() {
        let Picture {
            name,
            highest,
            field,
            lines,
        } = picture;
        let hidden = if i == 0 { "" } else { " hidden" };
        html.push_str(&format!(
            "<div class=\"picture\" data-highest=\"{highest}\" data-end=\"{end}\"{hidden}><img width=\"{width}\" height=\"{height}\" \
             alt=\"Von Mises stress at {name}\" src=\"data:image/png;base64,{field}\"><img class=\"lines\" alt=\"\" \
             src=\"data:image/png;base64,{lines}\"></div>\n",
            end = scale_end(*highest)
        ));
    }
    let stops: Vec<String> = MAP.map(|[r, g, b]| format!("rgb({r},{g},{b})")).to_vec();
    html.push_str(&format!(
        "<div class=\"scale\"><span>0</span><i style=\"background:linear-gradient(to right,{})\"></i><span class=\"end\">{}</span></div>\n",
        stops.join(","),
        scale_end(pictures[0].highest)
    ));
    let numbers: Vec<String> = colors[1..]
        .iter()
        .map(|[r, g, b]| (u32::from(*r) << 16 | u32::from(*g) << 8 | u32::from(*b)).to_string())
        .collect();
    Drawing {
        name: String::new(),
        title: format!("{TITLE}: {}", pictures[0].name),
        content: html,
        attributes: format!(
            "class=\"wide\" data-field data-title=\"{TITLE}\" data-palette=\"[{}]\"",
            numbers.join(",")
        ),
    }
}

const TITLE: &str = "Mesh and von Mises stress of the loaded teeth";
