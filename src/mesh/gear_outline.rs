//! The outline of a whole gear with its edges as the mesh wants them.

use super::gear_mesh::MeshSpec;
use super::profile::{
    Curve, flank_down, involute_down, involute_up, ledge, root, rounding_down, tip_land,
};
use super::{Loop, Outline, SizeField};
use crate::gear::{Gear, WornFlank};
use crate::numeric::{Vec2, cross, rotate};

/// A finely divided flank in the outline.
pub(super) struct FineFlank {
    /// Tooth number as asked for.
    pub(super) tooth: i32,
    /// Outline index of its uppermost corner; the next ones follow downwards.
    pub(super) start: usize,
    /// Arc coordinates of its corners, from the tip down, mm.
    pub(super) arcs: Vec<f64>,
}

/// The teeth counter-clockwise from tooth 0, the fine ones worn, then the bore; and where the fine flanks are.
pub(super) fn gear_outline(
    gear: &Gear,
    spec: &MeshSpec,
    worn: &WornFlank,
) -> (Outline, Vec<FineFlank>) {
    let z = gear.spec.teeth as i32;
    let tooth = Tooth::new(gear, spec, worn);
    let wanted = wanted_sizes(gear, spec, &tooth);
    let mut outer = Loop {
        points: Vec::new(),
        mids: Vec::new(),
    };
    let mut flanks = Vec::new();
    let shape = tooth.shape_sizes(gear, spec);
    for k in 0..z {
        let angle = f64::from(k) * gear.pitch_angle();
        let size = |p: Vec2| wanted.size(rotate(p, angle)).min(shape.size(p));
        let fine = spec.fine_teeth.iter().find(|t| t.rem_euclid(z) == k);
        match fine {
            Some(&number) => {
                let mut start = 0;
                for curve in tooth.before.iter().chain(&tooth.rounding) {
                    start = outer.add(curve, curve.divide(&size), angle);
                }
                flanks.push(FineFlank {
                    tooth: number,
                    start,
                    arcs: tooth.flank.arcs.clone(),
                });
                let edges = tooth.flank.arcs.len() - 1;
                let points = tooth.flank.points[..edges].iter();
                outer.points.extend(points.map(|p| rotate(*p, angle)));
                outer
                    .mids
                    .extend(tooth.flank.mids.iter().map(|p| rotate(*p, angle)));
                for curve in tooth.ledge.iter().chain(&tooth.rest) {
                    outer.add(curve, curve.divide(&size), angle);
                }
            }
            None => {
                for curve in tooth.coarse_before.iter().chain([&tooth.coarse_flank]) {
                    outer.add(curve, curve.divide(&size), angle);
                }
            }
        }
        let foot = outer.points.len();
        outer.add(&tooth.root, tooth.root.divide(&size), angle);
        if let (true, Some(lowest)) = (
            fine.is_some() && tooth.steps_down,
            tooth.flank.points.last(),
        ) {
            // a step too small for an edge of its own
            let shift = rotate(*lowest, angle) - outer.points[foot];
            outer.points[foot] += shift;
            outer.mids[foot] += 0.5 * shift;
        }
    }
    let bore = bore(gear, spec, &wanted);
    (
        Outline {
            loops: vec![outer, bore],
        },
        flanks,
    )
}

impl Loop {
    fn add(&mut self, curve: &Curve, cuts: Vec<f64>, angle: f64) -> usize {
        for w in cuts.windows(2) {
            self.points.push(rotate(curve.at(w[0]), angle));
            self.mids.push(rotate(curve.at(0.5 * (w[0] + w[1])), angle));
        }
        self.points.len()
    }
}

/// The pieces of one tooth, counter-clockwise; teeth that are not fine are unworn and keep a sharp corner.
struct Tooth {
    before: Vec<Curve>,
    rounding: Option<Curve>,
    flank: WornEdges,
    /// From the lowest point of the worn flank out to what is not worn.
    ledge: Option<Curve>,
    /// Whether that is too short for a curve of its own.
    steps_down: bool,
    rest: Option<Curve>,
    root: Curve,
    coarse_before: Vec<Curve>,
    coarse_flank: Curve,
}

impl Tooth {
    fn new(gear: &Gear, spec: &MeshSpec, worn: &WornFlank) -> Tooth {
        // A short rest between form circle and fine part would only make small triangles.
        let lowest = gear.arc(gear.rho_form) + 0.5 * spec.flank_spacing;
        let wanted = spec.active_from_rho.max(0.0);
        let (from, rest) = if gear.arc(wanted) > lowest && wanted > gear.rho_form {
            (wanted, Some(involute_down(gear, wanted, gear.rho_form)))
        } else {
            (gear.rho_form, None)
        };
        let sharp = gear.half_angle(gear.tip_radius);
        // So is a rounding far below the spacing.
        let shown = gear.spec.tip_rounding > 0.25 * spec.flank_spacing;
        let rounding = rounding_down(gear).filter(|_| shown);
        let (top, unworn) = match rounding {
            Some(_) => (gear.rho_last, flank_down(gear, gear.rho_last, from)),
            None => (gear.rho_tip, involute_down(gear, gear.rho_tip, from)),
        };
        let back = worn.depth(gear.arc(top)) / gear.base_radius;
        let end = match rounding {
            Some(_) => gear.tip_land_half_angle(),
            None => sharp,
        };
        let lost = worn.depth(gear.arc(from));
        let ledge = ledge(gear, from, lost / gear.base_radius);
        let long = ledge.length > 0.5 * spec.flank_spacing;
        Tooth {
            before: vec![
                involute_up(gear, gear.rho_tip),
                tip_land(gear, -sharp, end - back),
            ],
            rounding: rounding.map(|curve| curve.turned(-back)),
            flank: WornEdges::new(gear, unworn, top, spec, worn),
            ledge: Some(ledge).filter(|_| long),
            steps_down: !long && rest.is_none() && lost != 0.0,
            rest,
            root: root(gear),
            coarse_before: vec![
                involute_up(gear, gear.rho_tip),
                tip_land(gear, -sharp, sharp),
            ],
            coarse_flank: involute_down(gear, gear.rho_tip, gear.rho_form),
        }
    }

    /// Sizes that the shape itself asks for, in the frame of tooth 0: edges turn by no more than about 30° and fit the land.
    fn shape_sizes(&self, gear: &Gear, spec: &MeshSpec) -> SizeField {
        const STEPS: usize = 48;
        let mut sources = Vec::new();
        let least = 0.05 * gear.rack.module;
        let curves = [&self.root, &self.coarse_flank, &self.coarse_before[1]];
        for curve in curves {
            let step = curve.length / STEPS as f64;
            let at = |i: usize| curve.at(step * i as f64);
            for i in 1..STEPS {
                let (u, v) = (at(i) - at(i - 1), at(i + 1) - at(i));
                let turn = cross(u, v).atan2(u.dot(&v)).abs();
                let h = (0.55 * step / turn).min(curve.length).max(least);
                if h < spec.coarse_spacing {
                    let p = at(i);
                    let mirrored = Vec2::new(p.x, -p.y);
                    let before = rotate(p, -gear.pitch_angle());
                    let after = rotate(mirrored, gear.pitch_angle());
                    sources.extend([p, mirrored, before, after].map(|p| (p, h)));
                }
            }
        }
        SizeField::new(sources, spec.growth, spec.coarse_spacing)
    }
}

/// The edges of a fine flank from the tip down.
struct WornEdges {
    /// Length of the edges where the flank is not steep against the unworn one, mm.
    edge: f64,
    /// Arc coordinates of the corners, mm.
    arcs: Vec<f64>,
    /// Corners where wear has left them, mm, tooth 0.
    points: Vec<Vec2>,
    /// Points half-way along each edge.
    mids: Vec<Vec2>,
}

/// Longest edge of a worn flank over the length that its unworn edges have.
const LONGEST: f64 = 1.4;

impl WornEdges {
    /// `unworn` runs from curvature radius `top` down. Its edges are of equal arcs; where wear has left ledges they are divided.
    fn new(gear: &Gear, unworn: Curve, top: f64, spec: &MeshSpec, worn: &WornFlank) -> WornEdges {
        let (top, length) = (gear.arc(top), unworn.length);
        let n = (length / spec.flank_spacing - 1e-9).ceil().max(1.0);
        let edge = length / n;
        let place = |d: f64, h: f64| gear.turned_back(unworn.at(d), h);
        let depth = |d: f64| worn.depth(top - d);
        let mut cuts = vec![0.0];
        for i in 0..n as usize {
            let mut ahead = vec![length * (i + 1) as f64 / n];
            while let Some(to) = ahead.pop() {
                let from = cuts[cuts.len() - 1];
                let chord = (place(from, depth(from)) - place(to, depth(to))).norm();
                if chord > LONGEST * edge && to - from > 1e-9 * length {
                    ahead.extend([to, 0.5 * (from + to)]);
                } else {
                    cuts.push(to);
                }
            }
        }
        let mids = cuts.windows(2).map(|w| {
            // the depth is taken as linear along an edge: a mid-side node at a kink would spoil the element
            let h = 0.5 * (depth(w[0]) + depth(w[1]));
            place(0.5 * (w[0] + w[1]), h)
        });
        WornEdges {
            edge,
            arcs: cuts.iter().map(|d| top - d).collect(),
            points: cuts.iter().map(|d| place(*d, depth(*d))).collect(),
            mids: mids.collect(),
        }
    }
}

/// Sizes wanted near fine flanks and fillets, growing away from them without an upper limit.
fn wanted_sizes(gear: &Gear, spec: &MeshSpec, tooth: &Tooth) -> SizeField {
    let mut sources = Vec::new();
    let pitch = gear.pitch_angle();
    for k in &spec.fine_teeth {
        let angle = f64::from(*k) * pitch;
        let edge = tooth.flank.edge;
        let on_flank = tooth.flank.points.iter();
        sources.extend(on_flank.map(|p| (rotate(*p, angle), edge)));
        if let Some(curve) = &tooth.ledge {
            let n = (curve.length / edge).ceil();
            let at = |i: usize| curve.at(curve.length * i as f64 / n);
            sources.extend((0..=n as usize).map(|i| (rotate(at(i), angle), edge)));
        }
        if let Some(curve) = &tooth.rounding {
            let size = edge.min(curve.length);
            let n = (curve.length / size).ceil() as usize;
            sources.extend((0..=n).map(|i| {
                (
                    rotate(curve.at(curve.length * i as f64 / n as f64), angle),
                    size,
                )
            }));
        }
        let half = 0.5 * tooth.root.length;
        let n = (half / spec.root_spacing).ceil().max(1.0) as usize;
        for i in 0..=n {
            let s = half * i as f64 / n as f64;
            sources.push((rotate(tooth.root.at(s), angle), spec.root_spacing));
            sources.push((
                rotate(tooth.root.at(half + s), angle - pitch),
                spec.root_spacing,
            ));
        }
    }
    SizeField::new(sources, spec.growth, f64::INFINITY)
}

/// The bore, clockwise, with equal curved edges unless a fine part is near.
fn bore(gear: &Gear, spec: &MeshSpec, wanted: &SizeField) -> Loop {
    let r = gear.bore_radius();
    let from_teeth = spec.coarse_spacing + spec.growth * (gear.root_radius - r);
    let most = spec.bore_spacing.min(from_teeth);
    let at = move |s: f64| r * Vec2::new((s / r).cos(), -(s / r).sin());
    let circle = Curve::new(std::f64::consts::TAU * r, 24, at);
    let cuts = circle.divide(&|p| wanted.size(p).min(most));
    let mut l = Loop {
        points: Vec::new(),
        mids: Vec::new(),
    };
    for w in cuts.windows(2) {
        l.points.push(at(w[0]));
        l.mids.push(at(0.5 * (w[0] + w[1])));
    }
    l
}
