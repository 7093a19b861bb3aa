//! The stress pictures as files: each place whole, and the contact that carries most close up, with their scales.
use rayon::prelude::*;

use super::field::{chosen, highest_of, name, scale_end};
use super::palette::{MAP, palette};
use super::raster::Raster;
use super::view::View;
use super::{Picture, base64, opened};
use crate::numeric::Vec2;
use crate::report::bitmap;
use crate::report::error::OutputError;
use crate::report::html::escape;
use crate::simulate::result::{FieldFrame, Run};

/// Sizes of both panels, pixels.
const WHOLE: [usize; 2] = [880, 560];
const CLOSE: [usize; 2] = [560, 560];
/// Free space around the panels.
const MARGIN: usize = 16;
/// Heights of the title and of the scales.
const TITLE: usize = 44;
const SCALES: usize = 54;
const SIZE: [usize; 2] = [WHOLE[0] + CLOSE[0] + 3 * MARGIN, TITLE + WHOLE[1] + SCALES];
/// Least length of a measuring bar, pixels.
const BAR: f64 = 60.0;

/// One picture of each place that the page offers; none for a run without fields.
///
/// # Errors
/// [`OutputError`] if a picture cannot be encoded.
pub(in crate::report) fn stress_pictures(run: &Run) -> Result<Vec<Picture>, OutputError> {
    let frames = chosen(run);
    let Some(first) = frames.first() else {
        return Ok(Vec::new());
    };
    let whole = View::whole(run, WHOLE);
    let close: Vec<View> = frames.iter().map(|f| View::close(run, f, CLOSE)).collect();
    let ends = [whole.highest(first), highest_of(&frames, &close)];
    let last = first.cycles;
    (frames.par_iter().zip(&close).enumerate())
        .map(|(i, (frame, close))| {
            let file = if frame.cycles == last {
                format!("stress_{}", i + 1)
            } else {
                "stress_new".to_owned()
            };
            picture(file, frame, [whole, *close], ends)
        })
        .collect()
}

fn picture(
    file: String,
    frame: &FieldFrame,
    views: [View; 2],
    ends: [f64; 2],
) -> Result<Picture, OutputError> {
    let colors = palette();
    let title = format!("Von Mises stress and mesh: {}", name(frame));
    let layers: Vec<[Raster; 2]> = (views.into_iter().zip(ends))
        .map(|(view, end)| [view.stress(frame, end), view.lines(frame)])
        .collect();
    let mut images = String::new();
    for (i, [field, lines]) in layers.iter().enumerate() {
        for layer in [field.png(&colors)?, lines.shade()?] {
            images.push_str(&format!(
                "<image x=\"{}\" y=\"{TITLE}\" width=\"{}\" height=\"{}\" href=\"data:image/png;base64,{}\"/>\n",
                left(i),
                field.width,
                field.height,
                base64::encoded(&layer)
            ));
        }
    }
    let size = SIZE.map(|pixels| pixels as f64);
    let (open, over) = (opened(size, &title), overlay(&title, views, ends));
    let svg = format!(
        "{open}<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{images}{over}</svg>\n"
    );
    let png = bitmap::over(
        &file,
        &format!("{open}{over}</svg>\n"),
        1,
        |width, pixels| {
            for (i, [field, lines]) in layers.iter().enumerate() {
                blend(field, lines, &colors, [left(i), TITLE], width, pixels);
            }
        },
    )?;
    Ok(Picture {
        name: file,
        svg,
        png,
    })
}

/// Left edge of a panel.
fn left(panel: usize) -> usize {
    MARGIN + panel * (WHOLE[0] + MARGIN)
}

/// Colours with the mesh's lines over them into the RGBA bytes of rows of `width` pixels.
fn blend(
    field: &Raster,
    lines: &Raster,
    colors: &[[u8; 3]],
    at: [usize; 2],
    width: usize,
    pixels: &mut [u8],
) {
    for row in 0..field.height {
        for column in 0..field.width {
            let from = row * field.width + column;
            let level = usize::from(field.pixels[from]);
            if level == 0 {
                continue;
            }
            let light = 1.0 - f64::from(lines.pixels[from]) / 255.0;
            let to = 4 * ((at[1] + row) * width + at[0] + column);
            for (byte, color) in pixels[to..to + 3].iter_mut().zip(colors[level]) {
                *byte = (light * f64::from(color)).round() as u8;
            }
        }
    }
}

/// Title, frames, where the close-up lies, measuring bars, scales.
fn overlay(title: &str, views: [View; 2], ends: [f64; 2]) -> String {
    let mut out = format!(
        "<text x=\"{MARGIN}\" y=\"29\" font-size=\"20\" fill=\"#1c1f23\">{}</text>\n<defs><linearGradient id=\"map\">{}</linearGradient></defs>\n",
        escape(title),
        MAP.iter()
            .enumerate()
            .map(|(i, [r, g, b])| format!(
                "<stop offset=\"{}\" stop-color=\"rgb({r},{g},{b})\"/>",
                i as f64 / (MAP.len() - 1) as f64
            ))
            .collect::<String>()
    );
    let [whole, close] = views;
    let far = close.corner + Vec2::new(close.size[0] as f64, -(close.size[1] as f64)) / close.scale;
    let ([x0, y0], [x1, y1]) = (whole.at(close.corner), whole.at(far));
    out.push_str(&format!(
        "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"none\" stroke=\"#d55e00\" stroke-width=\"2\"/>\n",
        x0 + left(0) as f64,
        y0 + TITLE as f64,
        x1 - x0,
        y1 - y0
    ));
    for (i, (view, end)) in views.into_iter().zip(ends).enumerate() {
        let [width, height] = view.size.map(|pixels| pixels as f64);
        let (x, top) = (left(i) as f64, TITLE as f64);
        let stroke = ["#5a626b", "#d55e00"][i];
        out.push_str(&format!(
            "<rect x=\"{x}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"{stroke}\" stroke-width=\"{}\"/>\n",
            1 + i
        ));
        out.push_str(&bar(view, [x + 16.0, top + height - 18.0]));
        let below = top + height + 14.0;
        out.push_str(&format!(
            "<text x=\"{x}\" y=\"{0:.0}\" font-size=\"17\" fill=\"#1c1f23\">0</text><rect x=\"{1:.0}\" y=\"{below}\" \
             width=\"{2:.0}\" height=\"14\" fill=\"url(#map)\"/><text x=\"{3:.0}\" y=\"{0:.0}\" font-size=\"17\" \
             text-anchor=\"end\" fill=\"#1c1f23\">{4}</text>\n",
            below + 13.0,
            x + 18.0,
            width - 196.0,
            x + width,
            scale_end(end)
        ));
    }
    out
}

/// A bar of a round length with its length over it, in white with a dark edge.
fn bar(view: View, [x, y]: [f64; 2]) -> String {
    let least = BAR / view.scale;
    let power = 10f64.powf(least.log10().floor());
    let length = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|digit| digit * power)
        .find(|length| *length >= least)
        .unwrap_or(10.0 * power);
    let label = if length < 0.0995 {
        format!("{:.0} µm", 1e3 * length)
    } else {
        format!("{} mm", (100.0 * length).round() / 100.0)
    };
    let pixels = length * view.scale;
    format!(
        "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"34\" rx=\"4\" fill=\"#ffffff\" fill-opacity=\"0.85\"/><path \
         d=\"M{x:.1} {y:.1}h{pixels:.1}\" stroke=\"#1c1f23\" stroke-width=\"4\"/><text x=\"{:.1}\" y=\"{:.1}\" font-size=\"16\" \
         text-anchor=\"middle\" fill=\"#1c1f23\">{label}</text>\n",
        x - 8.0,
        y - 26.0,
        pixels + 16.0,
        x + 0.5 * pixels,
        y - 8.0
    )
}
