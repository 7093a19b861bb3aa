//! Wear around a gear: the largest depth of every tooth as a bar outwards from a circle.
use std::f64::consts::TAU;

use super::{Drawing, opened, path};
use crate::numeric::written::significant;
use crate::simulate::result::{Member, Run};

const SIZE: [f64; 2] = [440.0, 440.0];
/// Circle that bars stand on, and where the deepest ends, pixels.
const RADII: [f64; 2] = [90.0, 195.0];
const INK: &str = "var(--ink,#1c1f23)";
const SOFT: &str = "var(--soft,#5a626b)";
/// Points along an arc of one tooth.
const STEPS: usize = 6;
/// Share of the pitch that a bar takes.
const WIDTH: f64 = 0.8;

/// Members of which teeth differ, at the last state; none where all are alike.
pub fn around(run: &Run) -> Vec<Drawing> {
    let of = |member: Member| {
        let classes = run.last().teeth.iter().filter(|c| c.member == member);
        let mut depths: Vec<(usize, f64)> = classes
            .clone()
            .flat_map(|class| class.teeth.iter().map(|tooth| (*tooth, class.deepest())))
            .collect();
        depths.sort_by_key(|(tooth, _)| *tooth);
        let deepest = depths.iter().fold(0.0, |m: f64, (_, h)| m.max(*h));
        (classes.count() > 1 && deepest > 0.0).then(|| drawing(member, &depths, deepest))
    };
    Member::BOTH.into_iter().filter_map(of).collect()
}

/// Tooth 1 at the top, the others clockwise in the order of coming into mesh.
fn drawing(member: Member, depths: &[(usize, f64)], deepest: f64) -> Drawing {
    let [inner, outer] = RADII;
    let centre = [0.5 * SIZE[0], 0.5 * SIZE[1]];
    let count = depths.len() as f64;
    let at = |radius: f64, tooth: f64| {
        let angle = TAU * tooth / count;
        [
            centre[0] + radius * angle.sin(),
            centre[1] - radius * angle.cos(),
        ]
    };
    let title = format!("Largest worn depth around the {}, µm", member.name());
    let mut content = opened(SIZE, &title);
    let fill = match member {
        Member::Pinion => "var(--tooth1,#dbe8f2)",
        Member::Gear => "var(--tooth2,#f6e3d6)",
    };
    for (i, (tooth, depth)) in depths.iter().enumerate() {
        let top = inner + (outer - inner) * depth / deepest;
        let arc = |radius: f64, step: usize| {
            let across = WIDTH * (step as f64 / STEPS as f64 - 0.5);
            at(radius, i as f64 + across)
        };
        let out = (0..=STEPS).map(|step| arc(top, step));
        let back = (0..=STEPS).rev().map(|step| arc(inner, step));
        content.push_str(&format!(
            "<path d=\"{}Z\" fill=\"{fill}\" stroke=\"{INK}\" stroke-width=\"0.8\"><title>tooth {tooth}: {} µm</title></path>\n",
            path(out.chain(back)),
            significant(*depth, 4)
        ));
    }
    for share in [0.5, 1.0] {
        let radius = inner + share * (outer - inner);
        content.push_str(&format!(
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"{radius:.1}\" fill=\"none\" stroke=\"{SOFT}\" stroke-width=\"0.6\" stroke-dasharray=\"3 3\"/>\n\
             <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\" fill=\"{SOFT}\">{}</text>\n",
            centre[0],
            centre[1],
            centre[0] + 0.72 * radius,
            centre[1] - 0.72 * radius,
            significant(share * deepest, 3)
        ));
    }
    content.push_str(&format!(
        "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"13\" text-anchor=\"middle\" fill=\"{INK}\">tooth 1 ↑, then clockwise</text>\n</svg>\n",
        centre[0], centre[1]
    ));
    Drawing {
        name: format!("wear_around_{}", member.name()),
        title,
        content,
        attributes: String::new(),
    }
}
