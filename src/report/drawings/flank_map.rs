//! Maps of the flanks where the face has slices: worn depth and largest pressure over radius and face.

use super::palette::palette;
use super::{Drawing, opened};
use crate::numeric::interpolate;
use crate::numeric::written::significant;
use crate::report::html::escape;
use crate::simulate::result::{FaceSlice, Member, Run, State};

/// Size of a drawing, of each map in it and of the space around maps, pixels.
const SIZE: [f64; 2] = [640.0, 330.0];
const MAP: [f64; 2] = [230.0, 210.0];
const LEFT: f64 = 58.0;
const TOP: f64 = 40.0;
const BETWEEN: f64 = 68.0;
/// Most rows of a map: a flank has more points than can be seen.
const ROWS: usize = 70;
const INK: &str = "var(--ink,#1c1f23)";

/// Pressure when new and last, depth last; none for a run of one section.
pub fn flank_maps(run: &Run) -> Vec<Drawing> {
    if run.last().slices.len() < 2 {
        return Vec::new();
    }
    // sharp corners would leave the flanks' no colours
    let pressure: (Values, End) = (
        |slice, side| &slice.pressure[side],
        |slice| slice.peak_pressure,
    );
    let depth: (Values, End) = (
        |slice, side| &slice.depth[side],
        |slice| slice.depth.iter().flatten().fold(0.0, |m, h| m.max(*h)),
    );
    let mut maps = vec![(
        "flank_pressure_new",
        "Largest pressure on the flanks, new (sharp corners beyond the colours)",
        "MPa",
        run.first(),
        pressure,
    )];
    if run.states.len() > 1 {
        maps.push((
            "flank_pressure",
            "Largest pressure on the flanks, worn (sharp corners beyond the colours)",
            "MPa",
            run.last(),
            pressure,
        ));
        maps.push((
            "flank_depth",
            "Depth worn off the flanks",
            "µm",
            run.last(),
            depth,
        ));
    }
    maps.into_iter()
        .map(|(name, title, unit, state, values)| {
            let title = format!("{title}: radius over the place across the face");
            Drawing {
                name: name.to_owned(),
                content: drawn(state, &title, unit, values),
                title,
                attributes: String::new(),
            }
        })
        .collect()
}

/// Values of a slice at the radii of one member's profile.
type Values = fn(&FaceSlice, usize) -> &Vec<f64>;

/// The largest value that has a colour of its own.
type End = fn(&FaceSlice) -> f64;

fn drawn(state: &State, title: &str, unit: &str, (values, end): (Values, End)) -> String {
    let most = state.slices.iter().map(end).fold(0.0, f64::max);
    let mut out = opened(SIZE, title);
    for (side, member) in Member::BOTH.into_iter().enumerate() {
        let left = LEFT + side as f64 * (MAP[0] + BETWEEN);
        out += &map(state, (side, member), left, most, values);
    }
    out += &scale(most, unit);
    out + "</svg>\n"
}

fn text(x: f64, y: f64, anchor: &str, words: &str) -> String {
    format!(
        "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"13\" text-anchor=\"{anchor}\" fill=\"{INK}\">{}</text>\n",
        escape(words)
    )
}

fn map(
    state: &State,
    (side, member): (usize, Member),
    left: f64,
    most: f64,
    values: Values,
) -> String {
    let radii = &state.profile(member).radius;
    let (low, high) = (radii[0], radii[radii.len() - 1]);
    let rows = ROWS.min(radii.len());
    let (width, height) = (MAP[0] / state.slices.len() as f64, MAP[1] / rows as f64);
    let colours = palette();
    let mut out = text(left + 0.5 * MAP[0], TOP - 12.0, "middle", member.name());
    for (i, slice) in state.slices.iter().enumerate() {
        for row in 0..rows {
            let [from, to] = [row, row + 1].map(|r| low + (high - low) * r as f64 / rows as f64);
            let own = values(slice, side);
            let within = (radii.iter().zip(own)).filter(|(r, _)| (from..=to).contains(*r));
            let middle = interpolate(radii, own, 0.5 * (from + to));
            let value = within.map(|(_, v)| *v).fold(middle, f64::max);
            let value = value.min(most);
            let level = if most > 0.0 {
                1.0 + 254.0 * value / most
            } else {
                1.0
            };
            let [r, g, b] = colours[level.round() as usize];
            out += &format!(
                "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"#{r:02x}{g:02x}{b:02x}\"/>\n",
                left + i as f64 * width,
                TOP + MAP[1] - (row + 1) as f64 * height,
                // no seams between neighbours
                width + 0.3,
                height + 0.3,
            );
        }
    }
    let bottom = TOP + MAP[1];
    let half = 0.5 * (state.slices[1].face - state.slices[0].face);
    let ends = [
        state.slices[0].face - half,
        state.slices[state.slices.len() - 1].face + half,
    ];
    out += &text(left, bottom + 17.0, "middle", &significant(ends[0], 3));
    out += &text(left + 0.5 * MAP[0], bottom + 17.0, "middle", "face, mm");
    out += &text(
        left + MAP[0],
        bottom + 17.0,
        "middle",
        &significant(ends[1], 3),
    );
    out += &text(left - 5.0, bottom, "end", &significant(low, 4));
    out += &text(left - 5.0, TOP + 10.0, "end", &significant(high, 4));
    out + &text(left - 5.0, TOP + 0.5 * MAP[1], "end", "radius")
}

/// The colours from 0 to the largest value.
fn scale(most: f64, unit: &str) -> String {
    let (left, top, width) = (LEFT + 0.5 * MAP[0], TOP + MAP[1] + 34.0, MAP[0] + BETWEEN);
    let colours = palette();
    let steps = 64;
    let mut out = String::new();
    for i in 0..steps {
        let [r, g, b] = colours[1 + 254 * i / (steps - 1)];
        out += &format!(
            "<rect x=\"{:.2}\" y=\"{top}\" width=\"{:.2}\" height=\"12\" fill=\"#{r:02x}{g:02x}{b:02x}\"/>\n",
            left + width * i as f64 / steps as f64,
            width / steps as f64 + 0.3
        );
    }
    out += &text(left - 6.0, top + 11.0, "end", "0");
    out + &text(
        left + width + 6.0,
        top + 11.0,
        "start",
        &format!("{} {unit}", significant(most, 4)),
    )
}
