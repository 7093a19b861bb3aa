//! One tooth of each member with the worn material, magnified.
use serde_json::{Value, json};

use super::{Drawing, opened, path};
use crate::gear::{self, Pair, ProfileResolution};
use crate::numeric::Vec2;
use crate::numeric::written::grouped;
use crate::report::plots::depths;
use crate::simulate::result::{Member, Run};

const SIZE: [f64; 2] = [440.0, 400.0];
/// Height of the largest depth in the drawing, modules.
const SEEN: f64 = 0.3;
/// Pixels per module.
const MODULE: f64 = 108.0;

/// Worn teeth and what scripts need to draw them at other states.
#[derive(Debug, Clone, PartialEq)]
pub struct Worn {
    /// Pinion and gear at the last state.
    pub drawings: Vec<Drawing>,
    /// Flank points and normals in pixels, by ascending path as in the plots of the depth; pixels per µm of depth.
    pub data: Value,
}

/// None for a run without wear.
pub fn worn_teeth(run: &Run, pair: &Pair) -> Option<Worn> {
    let last = run.last();
    let deepest = last.pinion.max_depth().max(last.gear.max_depth());
    if deepest <= 0.0 {
        return None;
    }
    let times = magnification(SEEN * pair.pinion.rack.module / (1e-3 * deepest));
    let scale = MODULE / pair.pinion.rack.module;
    let per_um = 1e-3 * times * scale;
    let mut drawings = Vec::new();
    let mut members = Vec::new();
    for member in Member::BOTH {
        let flank = Flank::new(run, pair, member, scale);
        let title = format!(
            "Worn profile of the {}'s tooth, depth {}\u{202f}× magnified",
            member.name(),
            grouped(&times.to_string())
        );
        drawings.push(Drawing {
            name: format!("worn_profile_{}", member.name()),
            content: flank.svg(per_um, &title),
            title,
            attributes: "data-tooth".to_owned(),
        });
        members.push(flank.data());
    }
    Some(Worn {
        drawings,
        data: json!({"magnified": per_um, "members": members}),
    })
}

/// 1, 2, 3 or 5 times a power of ten, at most `times`.
fn magnification(times: f64) -> f64 {
    let power = 10f64.powf(times.log10().floor());
    let lead = [5.0, 3.0, 2.0, 1.0]
        .into_iter()
        .find(|l| l * power <= times);
    lead.unwrap_or(1.0) * power
}

/// The loaded flank and the rest of the tooth, in pixels: tooth axis upright, loaded flank on the left.
struct Flank {
    member: Member,
    outline: Vec<[f64; 2]>,
    points: Vec<[f64; 2]>,
    normals: Vec<[f64; 2]>,
    depths: Vec<f64>,
}

impl Flank {
    fn new(run: &Run, pair: &Pair, member: Member, scale: f64) -> Self {
        let side = match member {
            Member::Pinion => gear::Member::Pinion,
            Member::Gear => gear::Member::Gear,
        };
        let wheel = pair.member(side);
        let top = wheel.tip_radius + 0.35 * wheel.rack.module;
        let at = |p: Vec2| [0.5 * SIZE[0] - scale * p.y, scale * (top - p.x)];
        let resolution = ProfileResolution {
            root: 6,
            fillet: 12,
            involute: 40,
            rounding: 6,
            tip: 4,
        };
        let (path, depths): (Vec<f64>, Vec<f64>) = depths(run.last(), member).into_iter().unzip();
        let rho: Vec<f64> = path.iter().map(|&y| pair.rho(side, y)).collect();
        let normal = |rho: f64| {
            let n = wheel.involute_normal(rho);
            [-n.y, -n.x]
        };
        Flank {
            member,
            outline: wheel
                .tooth_profile(resolution)
                .into_iter()
                .map(at)
                .collect(),
            points: rho.iter().map(|&r| at(wheel.involute_point(r))).collect(),
            normals: rho.iter().map(|&r| normal(r)).collect(),
            depths,
        }
    }

    /// Between the worn and the new flank.
    fn lost(&self, per_um: f64) -> String {
        let flank = self.points.iter().zip(&self.normals).zip(&self.depths);
        let worn = flank.map(|((p, n), depth)| {
            let deep = per_um * depth;
            [p[0] - deep * n[0], p[1] - deep * n[1]]
        });
        path(worn.chain(self.points.iter().rev().copied())) + "Z"
    }

    fn svg(&self, per_um: f64, title: &str) -> String {
        let body = path(self.outline.iter().copied());
        let fill = match self.member {
            Member::Pinion => "var(--tooth1,#dbe8f2)",
            Member::Gear => "var(--tooth2,#f6e3d6)",
        };
        let ends = [self.outline.first(), self.outline.last()];
        let [first, last] = ends.map(|end| end.copied().unwrap_or_default());
        let foot =
            path([last, [last[0], SIZE[1]], [first[0], SIZE[1]], first]).replacen('M', "L", 1);
        opened(SIZE, title)
            + &format!(
                "<path d=\"{body}{foot}Z\" fill=\"{fill}\"/>\n\
                 <path data-worn=\"{}\" d=\"{}\" fill=\"var(--k1,#d55e00)\" fill-opacity=\"0.85\"/>\n\
                 <path d=\"{body}\" fill=\"none\" stroke=\"var(--ink,#1c1f23)\" stroke-width=\"1.4\"/>\n</svg>\n",
                self.member.name(),
                self.lost(per_um)
            )
    }

    fn data(&self) -> Value {
        let rounded = |v: f64, unit: f64| (v * unit).round() / unit;
        let column = |of: &[[f64; 2]], axis: usize, unit: f64| -> Vec<f64> {
            of.iter().map(|p| rounded(p[axis], unit)).collect()
        };
        json!({
            "name": self.member.name(),
            "x": column(&self.points, 0, 1e2), "y": column(&self.points, 1, 1e2),
            "nx": column(&self.normals, 0, 1e4), "ny": column(&self.normals, 1, 1e4),
        })
    }
}
