//! How slices of a face are tied by the teeth and bodies that they are cut from.
//!
//! A load that varies across the face bends a tooth less than an even one. For a prismatic gear this is known exactly, wave by wave
//! ([`crate::fem::Prism`]), and a wave hardly changes how the contact's own neighbourhood gives way, since it is long against the contact. So only
//! what a tooth pair gives way by as a whole is changed, on the contact point of each pair:
//!
//! ```text
//! f_j = Σ_n F_n c_n(j),  c_n(j) = cos(nπ(j + ½)/N)          line loads of N slices as waves κ_n = nπ/b across the face b
//! v_i = Σ_n≥1 [C(κ_n) − C(0)] F_n c_n(i)                    what slice i gives way by besides its own plane strain
//! ```
//! C is the normal displacement at one flank point per line load at another, of both members, of the same and of neighbouring teeth: the peaks under point loads
//! are the same for all waves and drop out. Even loads stay plane strain to the last bit. The ends of the face are mirrors.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::compliance::member_tooth;
use crate::contact::cycle::{Cycle, Position};
use crate::fem::{FemError, Prism};
use crate::gear::Gear;
use crate::material::Elastic;
use crate::mesh::{Mesh, MeshError, MeshSpec, mesh_gear};
use crate::numeric::Vec2;

/// Edge length of the meshes for waves along fine flanks and in fillets, and on the other teeth, modules: differences of compliances are far from the
/// contact, and need no more.
const FINE: f64 = 0.2;
const COARSE: f64 = 0.8;

/// Neighbours of a tooth on either side that a load on it is felt at.
const NEIGHBOURS: i32 = 2;

/// Changes of the flanks' compliance with the waves across a face.
#[derive(Debug)]
pub struct ToothWaves {
    /// Slices, as many as waves and the even load.
    slices: usize,
    /// By wave from the first on, pinion then gear.
    waves: Vec<[WaveChange; 2]>,
}

/// Change of one member's compliance with one wave.
#[derive(Debug)]
struct WaveChange {
    /// Curvature radii of the flank points, mm, ascending.
    rho: Vec<f64>,
    /// By tooth from −[`NEIGHBOURS`] on: displacement at a flank point (row) per line load at one of tooth 0 (column), mm per N/mm.
    change: Vec<DMatrix<f64>>,
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

impl ToothWaves {
    /// Of two gears with a face `width` (mm) in so many `slices`.
    ///
    /// # Errors
    /// [`WaveError`].
    pub fn new(
        gears: [&Gear; 2],
        materials: [Elastic; 2],
        width: f64,
        slices: usize,
    ) -> Result<Self, WaveError> {
        let wave_numbers: Vec<f64> = (0..slices)
            .map(|n| n as f64 * std::f64::consts::PI / width)
            .collect();
        let of_member = |side: usize| changes(gears[side], materials[side], &wave_numbers);
        let (pinion, gear) = rayon::join(|| of_member(0), || of_member(1));
        let waves = pinion?
            .into_iter()
            .zip(gear?)
            .map(|(p, g)| [p, g])
            .collect();
        Ok(Self { slices, waves })
    }

    /// For each position: how far (mm) tooth pair s of slice i gives way per line load (N/mm) of pair t in slice j, row i P + s and column j P + t of P pairs.
    pub fn ties(&self, cycle: &Cycle) -> Vec<DMatrix<f64>> {
        let of_position = |position: &Position| self.of_position(position);
        cycle.positions.par_iter().map(of_position).collect()
    }

    fn of_position(&self, position: &Position) -> DMatrix<f64> {
        let (pairs, n) = (position.pairs.len(), self.slices);
        let mut ties = DMatrix::zeros(n * pairs, n * pairs);
        for (wave, changes) in self.waves.iter().enumerate() {
            let cosine = |slice: usize| {
                let phase = (wave + 1) as f64 * (slice as f64 + 0.5) / n as f64;
                (std::f64::consts::PI * phase).cos()
            };
            let change = DMatrix::from_fn(pairs, pairs, |s, t| {
                let [to, from] = [s, t].map(|index| &position.pairs[index]);
                let of_side = |side: usize| {
                    let teeth = [to, from].map(|pair| member_tooth(pair, side));
                    let rho = [to, from].map(|pair| pair.frame.rho[side]);
                    changes[side].at(teeth[0] - teeth[1], rho)
                };
                of_side(0) + of_side(1)
            });
            for i in 0..n {
                for j in 0..n {
                    let share = 2.0 / n as f64 * cosine(i) * cosine(j);
                    let mut block = ties.view_mut((i * pairs, j * pairs), (pairs, pairs));
                    block += &change * share;
                }
            }
        }
        // rounding and interpolation between points leave no more than that
        0.5 * (&ties + ties.transpose())
    }
}

impl WaveChange {
    /// At the curvature radius `to` of tooth `tooth` per line load at `from` of tooth 0.
    fn at(&self, tooth: i32, [to, from]: [f64; 2]) -> f64 {
        let Some(change) = usize::try_from(tooth + NEIGHBOURS)
            .ok()
            .and_then(|place| self.change.get(place))
            .filter(|change| change.nrows() > 0)
        else {
            return 0.0;
        };
        let [rows, columns] = [to, from].map(|rho| self.weights(rho));
        let mut sum = 0.0;
        for (i, a) in rows {
            for (j, b) in columns {
                sum += a * b * change[(i, j)];
            }
        }
        sum
    }

    /// The two points that a curvature radius lies between, with their weights; the outermost point beyond it.
    fn weights(&self, rho: f64) -> [(usize, f64); 2] {
        let last = self.rho.len() - 1;
        let after = self.rho.partition_point(|r| *r < rho).clamp(1, last);
        let (a, b) = (self.rho[after - 1], self.rho[after]);
        let t = ((rho - a) / (b - a)).clamp(0.0, 1.0);
        [(after - 1, 1.0 - t), (after, t)]
    }
}

/// Changes from the first wave number to each of the others.
fn changes(
    gear: &Gear,
    material: Elastic,
    wave_numbers: &[f64],
) -> Result<Vec<WaveChange>, WaveError> {
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
    let flanks: Vec<Flank> = (-NEIGHBOURS..=NEIGHBOURS)
        .map(|tooth| Flank::new(&mesh, gear, tooth))
        .collect();
    let compliances = wave_numbers
        .par_iter()
        .map(|&wave_number| compliance(&prism, &flanks, wave_number))
        .collect::<Result<Vec<_>, FemError>>()?;
    let (even, waves) = compliances.split_first().expect("the even load is one");
    let change = |wave: &Vec<DMatrix<f64>>| WaveChange {
        rho: flanks[NEIGHBOURS as usize].rho.clone(),
        change: wave.iter().zip(even).map(|(w, e)| w - e).collect(),
    };
    Ok(waves.iter().map(change).collect())
}

/// Points of one tooth's flank: the corners of its edges.
struct Flank {
    nodes: Vec<u32>,
    /// Into the tooth.
    normals: Vec<Vec2>,
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
fn compliance(
    prism: &Prism<'_>,
    flanks: &[Flank],
    wave_number: f64,
) -> Result<Vec<DMatrix<f64>>, FemError> {
    let wave = prism.wave(wave_number)?;
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
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::cycle::{CycleSpec, Stations};
    use crate::contact::frame::tests::reference;

    /// A body that gives way by c under an even load and not at all under a wave moves as one: the slices give way by c of their mean load, so the ties are
    /// −c (δ_ij − 1/N) from each member (the cosines are orthogonal, and with the even load complete).
    #[test]
    fn where_no_wave_bends_the_teeth_all_slices_move_by_their_mean_load() {
        const N: usize = 5;
        let pair = reference();
        let stations = Stations::new(&pair, 0.05);
        let spec = CycleSpec {
            positions: 8,
            spacing: 0.05,
            even: 0.2,
            window: 0.3,
            reach: 0.02,
        };
        let cycle = Cycle::new(&pair, &stations, spec);
        let stiff = |c: f64| WaveChange {
            rho: vec![0.0, 100.0],
            change: vec![DMatrix::from_element(2, 2, -c); 5],
        };
        let c = [3e-6, 2e-6];
        let waves = ToothWaves {
            slices: N,
            waves: (1..N).map(|_| c.map(stiff)).collect(),
        };
        let all = waves.ties(&cycle);
        assert!(
            all.iter()
                .zip(&cycle.positions)
                .any(|(_, p)| p.pairs.len() > 1)
        );
        for (ties, position) in all.iter().zip(&cycle.positions) {
            let pairs = position.pairs.len();
            for (i, j) in (0..N * pairs).flat_map(|i| (0..N * pairs).map(move |j| (i, j))) {
                let own = f64::from(u8::from(i / pairs == j / pairs));
                let expected = -(c[0] + c[1]) * (own - 1.0 / N as f64);
                assert!((ties[(i, j)] - expected).abs() < 1e-18);
            }
        }
    }
}
