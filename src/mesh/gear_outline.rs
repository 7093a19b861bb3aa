//! The outline of a whole gear with its edges as the mesh wants them.

use super::gear_mesh::MeshSpec;
use super::profile::{Curve, involute_down, involute_up, root, rounding_down, tip_land};
use super::{Loop, Outline, SizeField};
use crate::gear::Gear;
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

/// The teeth counter-clockwise from tooth 0, then the bore; and where the fine flanks are.
pub(super) fn gear_outline(gear: &Gear, spec: &MeshSpec) -> (Outline, Vec<FineFlank>) {
    let z = gear.spec.teeth as i32;
    let tooth = Tooth::new(gear, spec);
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
        let mut add = |curve: &Curve, cuts: Vec<f64>| {
            for w in cuts.windows(2) {
                outer.points.push(rotate(curve.at(w[0]), angle));
                outer
                    .mids
                    .push(rotate(curve.at(0.5 * (w[0] + w[1])), angle));
            }
            outer.points.len()
        };
        match spec.fine_teeth.iter().find(|t| t.rem_euclid(z) == k) {
            Some(&number) => {
                let mut start = 0;
                for curve in tooth.before.iter().chain(&tooth.rounding) {
                    start = add(curve, curve.divide(&size));
                }
                let cuts = tooth.fine_cuts(spec);
                let top = gear.arc(tooth.top);
                flanks.push(FineFlank {
                    tooth: number,
                    start,
                    arcs: cuts.iter().map(|s| top - s).collect(),
                });
                add(&tooth.active, cuts);
                if let Some(rest) = &tooth.rest {
                    add(rest, rest.divide(&size));
                }
            }
            None => {
                for curve in tooth.coarse_before.iter().chain([&tooth.coarse_flank]) {
                    add(curve, curve.divide(&size));
                }
            }
        }
        add(&tooth.root, tooth.root.divide(&size));
    }
    let bore = bore(gear, spec, &wanted);
    (
        Outline {
            loops: vec![outer, bore],
        },
        flanks,
    )
}

/// The pieces of one tooth, counter-clockwise; teeth that are not fine keep a sharp corner.
struct Tooth {
    before: Vec<Curve>,
    rounding: Option<Curve>,
    active: Curve,
    rest: Option<Curve>,
    root: Curve,
    /// Curvature radius at the upper end of the active part.
    top: f64,
    coarse_before: Vec<Curve>,
    coarse_flank: Curve,
}

impl Tooth {
    fn new(gear: &Gear, spec: &MeshSpec) -> Tooth {
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
        let (top, end) = if rounding.is_some() {
            (gear.rho_end, gear.tip_land_half_angle())
        } else {
            (gear.rho_tip, sharp)
        };
        Tooth {
            before: vec![involute_up(gear, gear.rho_tip), tip_land(gear, -sharp, end)],
            rounding,
            active: involute_down(gear, top, from),
            rest,
            root: root(gear),
            top,
            coarse_before: vec![
                involute_up(gear, gear.rho_tip),
                tip_land(gear, -sharp, sharp),
            ],
            coarse_flank: involute_down(gear, gear.rho_tip, gear.rho_form),
        }
    }

    fn fine_cuts(&self, spec: &MeshSpec) -> Vec<f64> {
        let length = self.active.length;
        let n = (length / spec.flank_spacing - 1e-9).ceil().max(1.0) as usize;
        (0..=n).map(|i| length * i as f64 / n as f64).collect()
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

/// Sizes wanted near fine flanks and fillets, growing away from them without an upper limit.
fn wanted_sizes(gear: &Gear, spec: &MeshSpec, tooth: &Tooth) -> SizeField {
    let mut sources = Vec::new();
    let pitch = gear.pitch_angle();
    for k in &spec.fine_teeth {
        let angle = f64::from(*k) * pitch;
        let cuts = tooth.fine_cuts(spec);
        let edge = cuts[1] - cuts[0];
        sources.extend(
            cuts.iter()
                .map(|s| (rotate(tooth.active.at(*s), angle), edge)),
        );
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
