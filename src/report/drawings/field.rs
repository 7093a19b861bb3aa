//! Von Mises stress and mesh where the teeth are loaded, at some of the stored states and positions.
use rayon::prelude::*;

use super::raster::Raster;
use super::{Drawing, base64};
use crate::mesh::Cells;
use crate::numeric::{Vec2, rotate};
use crate::report::error::OutputError;
use crate::report::format::{count, plain, significant};
use crate::simulate::result::{FieldFrame, MemberField, Run};

/// Size of a picture, pixels.
const SIZE: [usize; 2] = [880, 560];
/// Pictures at most.
const MOST: usize = 5;
/// Share of the loaded region's pixels that may lie above the scale: stresses under tip corners have no bound.
const ABOVE: f64 = 0.0005;
/// Strongest mesh line, of 255.
const LINE: f64 = 150.0;
/// Length from which an edge has its full strength, pixels.
const CLEAR: f64 = 14.0;
/// The viridis map (van der Walt and Smith 2015) at eighths, dark to bright.
const MAP: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 45, 123],
    [59, 82, 139],
    [44, 114, 142],
    [33, 145, 140],
    [40, 174, 128],
    [94, 201, 98],
    [173, 220, 48],
    [253, 231, 37],
];

/// One figure with a choice of pictures; none for a run without fields.
///
/// # Errors
/// [`OutputError`] if a picture cannot be encoded.
pub fn stresses(run: &Run) -> Result<Option<Drawing>, OutputError> {
    let frames = chosen(run);
    if frames.is_empty() {
        return Ok(None);
    }
    let view = View::new(run);
    let highest = highest(frames[0], &view);
    let colors = palette();
    let pictures: Result<Vec<[String; 2]>, OutputError> = frames
        .par_iter()
        .map(|frame| {
            let field = view.stress(frame, highest).png(&colors)?;
            let lines = view.lines(frame).shade()?;
            Ok([base64::encoded(&field), base64::encoded(&lines)])
        })
        .collect();
    let named: Vec<String> = frames.iter().map(|frame| name(frame)).collect();
    Ok(Some(figure(&pictures?, &named, highest, &colors)))
}

/// The last state's positions, and the same place when the flanks were new.
fn chosen(run: &Run) -> Vec<&FieldFrame> {
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

fn name(frame: &FieldFrame) -> String {
    format!(
        "{} cycles, {} base pitches from the pitch point",
        count(frame.cycles),
        plain((1e4 * frame.position).round() / 1e4)
    )
}

/// The seen part of the fixed frame: upper left corner, mm; pixels per mm.
struct View {
    corner: Vec2,
    scale: f64,
}

impl View {
    /// The path of contact and a tooth's height around it.
    fn new(run: &Run) -> Self {
        let g = &run.geometry;
        let [a, .., e] = g.path_limits;
        let width = (e - a) + 3.6 * g.module;
        let scale = SIZE[0] as f64 / width;
        let pitch = Vec2::new(g.pinion.pitch_radius, 0.0);
        let half = Vec2::new(0.5 * SIZE[0] as f64, -0.5 * SIZE[1] as f64) / scale;
        View {
            corner: pitch - half,
            scale,
        }
    }

    /// Levels 1 to 255 of the stress.
    fn stress(&self, frame: &FieldFrame, highest: f64) -> Raster {
        let mut field = Raster::new(SIZE[0], SIZE[1]);
        let level = |v: f64| 1 + (254.0 * (v / highest).clamp(0.0, 1.0)).round() as u8;
        for member in [&frame.pinion, &frame.gear] {
            let nodes = self.nodes(member);
            self.each(member, &nodes, |element| {
                let parts: &[[usize; 3]] = match element.len() {
                    3 => &[[0, 1, 2]],
                    _ => &[[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
                };
                for part in parts {
                    field.triangle(part.map(|i| nodes[element[i] as usize]), level);
                }
            });
        }
        field
    }

    /// The elements' edges, fainter where they are short.
    fn lines(&self, frame: &FieldFrame) -> Raster {
        let mut lines = Raster::new(SIZE[0], SIZE[1]);
        for member in [&frame.pinion, &frame.gear] {
            let nodes = self.nodes(member);
            self.each(member, &nodes, |element| {
                for side in 0..3 {
                    let ends = [element[side], element[(side + 1) % 3]];
                    let [from, to] = ends.map(|i| nodes[i as usize]).map(|[x, y, _]| [x, y]);
                    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
                    let strength = LINE * (length / CLEAR).min(1.0);
                    if strength > 32.0 {
                        lines.line(from, to, strength);
                    }
                }
            });
        }
        lines
    }

    /// Pixels and stress of every node, under load.
    fn nodes(&self, member: &MemberField) -> Vec<[f64; 3]> {
        let centre = Vec2::from(member.centre);
        let places = member.worn.iter().zip(&member.displacement);
        places
            .zip(&member.von_mises)
            .map(|((x, u), stress)| {
                let p = centre + rotate(Vec2::from(*x) + Vec2::from(*u), member.rotation);
                [
                    self.scale * (p.x - self.corner.x),
                    self.scale * (self.corner.y - p.y),
                    *stress,
                ]
            })
            .collect()
    }

    /// Calls `draw` with every element that may be seen.
    fn each(&self, member: &MemberField, nodes: &[[f64; 3]], mut draw: impl FnMut(&[u32])) {
        let seen = |corners: &[u32]| {
            (0..2).all(|axis| {
                let at = |i: &u32| nodes[*i as usize][axis];
                let size = SIZE[axis] as f64;
                corners.iter().any(|i| at(i) > 0.0) && corners.iter().any(|i| at(i) < size)
            })
        };
        match &member.cells {
            Cells::T3(cells) => cells.iter().filter(|c| seen(&c[..])).for_each(|c| draw(c)),
            Cells::T6(cells) => cells.iter().filter(|c| seen(&c[..3])).for_each(|c| draw(c)),
        }
    }
}

/// The end of the scale: only a few pixels lie above it; two digits.
fn highest(frame: &FieldFrame, view: &View) -> f64 {
    let largest = [&frame.pinion, &frame.gear]
        .into_iter()
        .flat_map(|member| member.von_mises.iter().copied())
        .fold(0.0, f64::max);
    // levels of a two hundred and fifty-fourth each of the largest value: fine enough for two digits after a second look
    let mut top = largest.max(1e-9);
    for _ in 0..2 {
        let field = view.stress(frame, top);
        let mut levels = [0usize; 256];
        for &pixel in &field.pixels {
            levels[usize::from(pixel)] += 1;
        }
        let filled: usize = levels[1..].iter().sum();
        let mut above = 0;
        let mut level = 255;
        while level > 1 && (above + levels[level]) as f64 <= ABOVE * filled as f64 {
            above += levels[level];
            level -= 1;
        }
        top *= level as f64 / 255.0;
    }
    let step = 10f64.powf(top.log10().floor() - 1.0);
    (top / step).ceil() * step
}

fn palette() -> Vec<[u8; 3]> {
    (0..256)
        .map(|level: usize| {
            let at = level.saturating_sub(1) as f64 / 254.0 * (MAP.len() - 1) as f64;
            let i = (at as usize).min(MAP.len() - 2);
            let mix = |j: usize| {
                let [a, b] = [MAP[i][j], MAP[i + 1][j]].map(f64::from);
                (a + (at - i as f64) * (b - a)).round() as u8
            };
            [mix(0), mix(1), mix(2)]
        })
        .collect()
}

fn figure(pictures: &[[String; 2]], named: &[String], highest: f64, colors: &[[u8; 3]]) -> Drawing {
    let mut html = String::from("<div class=\"scripts choice\" hidden><label>Seen at <select>");
    for (i, name) in named.iter().enumerate() {
        html.push_str(&format!("<option value=\"{i}\">{name}</option>"));
    }
    html.push_str("</select></label> <label><input type=\"checkbox\" checked> mesh</label> <output></output></div>\n");
    let [width, height] = SIZE;
    for (i, ([field, lines], name)) in pictures.iter().zip(named).enumerate() {
        let hidden = if i == 0 { "" } else { " hidden" };
        html.push_str(&format!(
            "<div class=\"picture\"{hidden}><img width=\"{width}\" height=\"{height}\" alt=\"Von Mises stress at {name}\" \
             src=\"data:image/png;base64,{field}\"><img class=\"lines\" alt=\"\" src=\"data:image/png;base64,{lines}\"></div>\n"
        ));
    }
    let stops: Vec<String> = MAP.map(|[r, g, b]| format!("rgb({r},{g},{b})")).to_vec();
    html.push_str(&format!(
        "<div class=\"scale\"><span>0</span><i style=\"background:linear-gradient(to right,{})\"></i><span>{} MPa and above</span></div>\n",
        stops.join(","),
        significant(highest, 2)
    ));
    let numbers: Vec<String> = colors[1..]
        .iter()
        .map(|[r, g, b]| (u32::from(*r) << 16 | u32::from(*g) << 8 | u32::from(*b)).to_string())
        .collect();
    Drawing {
        name: String::new(),
        title: format!(
            "Mesh and von Mises stress of the loaded teeth: {}",
            named[0]
        ),
        content: html,
        attributes: format!(
            "class=\"wide\" data-field data-highest=\"{highest}\" data-palette=\"[{}]\"",
            numbers.join(",")
        ),
    }
}
