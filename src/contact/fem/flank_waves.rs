//! How the flanks of one member give way under loads that vary along its axis, wave by wave, on a mesh of its section.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::flank_ends::{FlankEnds, LEAST_WAVES};
use crate::fem::{EndAnswer, FemError, Prism, Wave};
use crate::gear::Gear;
use crate::material::Elastic;
use crate::mesh::{Mesh, MeshError, MeshSpec, mesh_gear};
use crate::numeric::Vec2;

/// Edge length of the meshes for waves along fine flanks and in fillets, and on the other teeth, modules: differences of compliances are far from the
/// contact, and need no more.
const FINE: f64 = 0.2;
const COARSE: f64 = 0.8;

/// Neighbours of a tooth on either side that a load on it is felt at.
pub(super) const NEIGHBOURS: i32 = 2;

/// Change of one member's compliance with one wave, or what is felt of it at one distance from the load.
#[derive(Debug)]
pub(super) struct FlankChange {
    /// Curvature radii of the flank points, mm, ascending.
    pub(super) rho: Vec<f64>,
    /// By tooth from −[`NEIGHBOURS`] on: displacement at a flank point (row) per line load at one of tooth 0 (column), mm per N/mm.
    pub(super) change: Vec<DMatrix<f64>>,
}

/// Why there are no waves.
#[derive(Debug, thiserror::Error)]
pub enum WaveError {
    /// No acceptable mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The stiffness could not be factored.
    #[error(transparent)]
    Fem(#[from] FemError),
}

impl FlankChange {
    /// At the curvature radius `to` of tooth `tooth` per line load at `from` of tooth 0.
    pub(super) fn at(&self, tooth: i32, [to, from]: [f64; 2]) -> f64 {
        self.between(tooth, self.weights(to), self.weights(from))
    }

    /// The same for places between points.
    pub(super) fn between(
        &self,
        tooth: i32,
        to: [(usize, f64); 2],
        from: [(usize, f64); 2],
    ) -> f64 {
        let Some(change) = usize::try_from(tooth + NEIGHBOURS)
            .ok()
            .and_then(|place| self.change.get(place))
            .filter(|change| change.nrows() > 0)
        else {
            return 0.0;
        };
        let mut sum = 0.0;
        for (i, a) in to {
            for (j, b) in from {
                sum += a * b * change[(i, j)];
            }
        }
        sum
    }

    /// The two points that a curvature radius lies between, with their weights; the outermost point beyond it.
    pub(super) fn weights(&self, rho: f64) -> [(usize, f64); 2] {
        let last = self.rho.len() - 1;
        let after = self.rho.partition_point(|r| *r < rho).clamp(1, last);
        let (a, b) = (self.rho[after - 1], self.rho[after]);
        let t = ((rho - a) / (b - a)).clamp(0.0, 1.0);
        [(after - 1, 1.0 - t), (after, t)]
    }
}

/// Changes from the even load to each of the waves across a face `width` (mm) in so many `slices`, and what free ends let the flanks give way by
/// if loads push along the axis too, so many times what they are.
pub(super) fn changes(
    gear: &Gear,
    material: Elastic,
    width: f64,
    slices: usize,
    free_ends: Option<f64>,
) -> Result<(Vec<FlankChange>, Option<FlankEnds>), WaveError> {
    let Compliances { rho, by_wave, ends } = compliances(gear, material, width, slices, free_ends)?;
    let (even, waves) = by_wave.split_first().expect("the even load is one");
    let change = |wave: &Vec<DMatrix<f64>>| FlankChange {
        rho: rho.clone(),
        change: wave.iter().zip(even).map(|(w, e)| w - e).collect(),
    };
    Ok((waves.iter().map(change).collect(), ends))
}

/// Compliances of one member's flank points.
pub(super) struct Compliances {
    /// Their curvature radii, mm, ascending.
    pub(super) rho: Vec<f64>,
    /// By wave number and tooth, as in [`FlankChange`].
    pub(super) by_wave: Vec<Vec<DMatrix<f64>>>,
    /// Of free ends.
    pub(super) ends: Option<FlankEnds>,
}

/// Compliances by wave across a face `width` (mm) in so many `slices`, the even load first.
pub(super) fn compliances(
    gear: &Gear,
    material: Elastic,
    width: f64,
    slices: usize,
    free_ends: Option<f64>,
) -> Result<Compliances, WaveError> {
    let module = gear.rack.module;
    // a gear of few teeth has each of them once
    let reach = NEIGHBOURS.min((gear.spec.teeth as i32 - 1) / 2);
    let spec = MeshSpec {
        root_spacing: FINE * module,
        coarse_spacing: COARSE * module,
        bore_spacing: 2.0 * module,
        growth: 0.5,
        ..MeshSpec::new(
            gear,
            (-reach..=reach).collect(),
            FINE * module,
            gear.rho_form,
        )
    };
    let mesh = mesh_gear(gear, &spec)?;
    let prism = Prism::new(&mesh, material, &mesh.bore)?;
    let mut flanks: Vec<Flank> = (-NEIGHBOURS..=NEIGHBOURS)
        .map(|tooth| Flank::new(&mesh, gear, tooth))
        .collect();
    let count = if free_ends.is_some() {
        slices.max(LEAST_WAVES)
    } else {
        slices
    };
    let ends = free_ends
        .map(|s| FlankEnds::of_prism(&prism, &flanks, module, width, s != 0.0))
        .transpose()?;
    // factors of all waves at once would fill the memory
    let of_wave = |n: usize| {
        let wave = prism.wave(n as f64 * std::f64::consts::PI / width)?;
        let own = (n < slices).then(|| compliance(&wave, &flanks));
        Ok((own, ends.as_ref().map(|ends| ends.answer(&wave, n))))
    };
    let of_waves = (0..count).into_par_iter().map(of_wave);
    let of_waves: Vec<_> = of_waves.collect::<Result<_, FemError>>()?;
    let (by_wave, answers): (Vec<_>, Vec<_>) = of_waves.into_iter().unzip();
    let by_wave = by_wave.into_iter().flatten().collect();
    let answers: Vec<EndAnswer> = answers.into_iter().flatten().collect();
    let ends = ends.zip(free_ends).map(|(ends, inclined)| {
        let modes = ends.modes(&answers)?;
        Ok::<_, FemError>(FlankEnds::new(&modes, &flanks, width, slices, inclined))
    });
    let ends = ends.transpose()?;
    let loaded = flanks.swap_remove(NEIGHBOURS as usize);
    Ok(Compliances {
        rho: loaded.rho,
        by_wave,
        ends,
    })
}

/// Points of one tooth's flank: the corners of its edges.
pub(super) struct Flank {
    pub(super) nodes: Vec<u32>,
    /// Into the tooth.
    pub(super) normals: Vec<Vec2>,
    rho: Vec<f64>,
}

impl Flank {
    /// Without points where the mesh has no such fine tooth.
    fn new(mesh: &Mesh, gear: &Gear, tooth: i32) -> Self {
        let chain = mesh.flanks.iter().find(|chain| chain.tooth == tooth);
        let nodes: Vec<u32> = chain.map_or_else(Vec::new, |chain| {
            chain.nodes.iter().copied().step_by(2).collect()
        });
        let at = |node: &u32| mesh.points[*node as usize];
        let normal = |node: &u32| {
            let point = at(node);
            let radius = point.norm();
            let cosine = (gear.base_radius / radius).min(1.0);
            let outward = point / radius;
            let along = Vec2::new(-outward.y, outward.x);
            -(outward * (1.0 - cosine * cosine).sqrt() + along * cosine)
        };
        let rho = |node: &u32| gear.rho_at_radius(at(node).norm());
        Self {
            normals: nodes.iter().map(normal).collect(),
            rho: nodes.iter().map(rho).collect(),
            nodes,
        }
    }
}

/// By tooth: displacements along the normals at its points (rows) per line load at those of tooth 0 (columns).
fn compliance(wave: &Wave<'_>, flanks: &[Flank]) -> Vec<DMatrix<f64>> {
    let loaded = &flanks[NEIGHBOURS as usize];
    let empty = |flank: &Flank| DMatrix::zeros(flank.nodes.len(), loaded.nodes.len());
    let mut out: Vec<DMatrix<f64>> = flanks.iter().map(empty).collect();
    for (column, (node, normal)) in loaded.nodes.iter().zip(&loaded.normals).enumerate() {
        let nodes: Vec<u32> = flanks.iter().flat_map(|f| &f.nodes).copied().collect();
        let mut moved = wave.solve(&[(*node, *normal)], &nodes).into_iter();
        for (out, flank) in out.iter_mut().zip(flanks) {
            for (row, normal) in flank.normals.iter().enumerate() {
                out[(row, column)] = moved.next().map_or(0.0, |u| u.dot(normal));
            }
        }
    }
    out
}
