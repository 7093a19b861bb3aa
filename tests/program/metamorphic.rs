//! Claim: a study told in another way wears the same. Twice as large gears under the same pressures wear twice as deep; twice the face
//! under twice the torque, half the wear coefficient over twice the cycles and the other direction of drive change nothing; twice the moduli
//! under twice the torque with half the wear coefficient press twice as hard and wear the same.
//!
//! Source: dimensional analysis of plane elasticity and of Archard's law, and the mirror symmetry of a gear pair. Tolerance: 1e-9 of the
//! largest depth and pressure, rounding that contact and step control have carried on.

use std::fs;

use crate::common::succeed;
use proptest::prelude::*;

/// A pair in the keys of a study file.
#[derive(Debug, Clone)]
struct Told {
    /// mm.
    module: f64,
    teeth: [u32; 2],
    /// Modules.
    shift: f64,
    /// mm.
    face: f64,
    /// µm, over half a module.
    relief: f64,
    /// mm.
    misalignment: f64,
    /// MPa.
    moduli: [f64; 2],
    /// N m.
    torque: f64,
    /// mm²/N.
    coefficient: f64,
    cycles: f64,
    reversed: bool,
}

impl Told {
    fn study(&self) -> String {
        let Self {
            module: m,
            teeth,
            shift,
            face,
            relief,
            misalignment,
            moduli,
            torque,
            coefficient,
            cycles,
            reversed,
        } = self;
        let member = |i: usize| {
            let (name, z, e) = (["pinion", "gear"][i], teeth[i], moduli[i]);
            let (bore, x) = (0.5 * m * f64::from(z), [shift, &0.0][i]);
            format!(
                "[gears.{name}]\nteeth = {z}\nprofile_shift = {x}\nbore_diameter = {bore}\ntip_relief_amount = {relief}\n\
                 tip_relief_length = {}\n[material.{name}]\nyoungs_modulus = {e}\npoisson_ratio = 0.3\ndensity = 7850.0\n",
                0.5 * m
            )
        };
        format!(
            "[gears]\nmodule = {m}\npressure_angle = 20.0\nface_width = {face}\n{}{}\
             [operation]\ntorque = {torque}\nspeed = 1000.0\nmisalignment = {misalignment}\n\
             [wear]\ncoefficient = {coefficient:e}\ncycles = {cycles}\n\
             [numerics]\nelements_per_half_width = 2\npositions = 24\nstored_states = 1\nfields = 0\n\
             [[test]]\nid = \"A\"\nreversed = {reversed}\n",
            member(0),
            member(1),
        )
    }

    /// Depths (µm) and peak pressures (MPa) at the end.
    fn worn(&self) -> [Vec<f64>; 2] {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("study.toml"), self.study()).unwrap();
        succeed(&folder, "run study.toml --test A -o out --quiet");
        [("wear", "depth"), ("contact", "peak_pressure")].map(|(file, column)| {
            let text = fs::read_to_string(folder.path().join(format!("out/{file}.csv"))).unwrap();
            let mut lines = text.lines().map(|l| l.split(',').collect::<Vec<_>>());
            let header = lines.next().unwrap();
            let at = |name: &str| header.iter().position(|h| *h == name).unwrap();
            let (cycles, value) = (at("cycles"), at(column));
            let rows = lines.map(|l| [cycles, value].map(|i| l[i].parse::<f64>().unwrap()));
            rows.filter(|[cycles, _]| *cycles > 0.0)
                .map(|[_, value]| value)
                .collect()
        })
    }
}

/// The largest difference over the largest value.
fn difference(of: &[f64], from: &[f64], factor: f64) -> f64 {
    assert_eq!(of.len(), from.len());
    let largest = from.iter().fold(0.0, |m: f64, a| m.max(*a));
    assert!(largest > 0.0);
    let off = of.iter().zip(from).map(|(a, b)| (a / factor - b).abs());
    off.fold(0.0, f64::max) / largest
}

fn told() -> impl Strategy<Value = Told> {
    let pressure = 200.0..900.0f64;
    let soft = prop_oneof![Just(1.0), 0.3..1.0f64];
    (
        1.0..5.0f64,
        [18u32..40, 18u32..60],
        0.0..0.3f64,
        0.0..8.0f64,
        pressure,
        soft,
        0.0..0.1f64,
    )
        .prop_map(|(module, teeth, shift, relief, pressure, soft, apart)| {
            let face = 10.0 * module;
            let sin = 20f64.to_radians().sin();
            let rho = teeth.map(|z| 0.5 * module * f64::from(z) * sin);
            let load = std::f64::consts::PI * rho[0] * rho[1] / (rho[0] + rho[1])
                * pressure.powi(2)
                / 1.15e5;
            let cycles = 1e5;
            Told {
                module,
                teeth,
                shift,
                face,
                relief,
                misalignment: apart * module,
                moduli: [2.1e5, 2.1e5 * soft],
                torque: 1e-3 * load * face * 0.5 * module * f64::from(teeth[0]),
                // about half a per cent of the module in all: members are condensed again for some
                coefficient: 5e-3 * module / (load * cycles),
                cycles,
                reversed: false,
            }
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2, rng_seed: proptest::test_runner::RngSeed::Fixed(22), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_study_told_in_another_way_wears_the_same(plain in told()) {
        let [depth, pressure] = plain.worn();
        let changed = |change: &dyn Fn(&mut Told)| {
            let mut told = plain.clone();
            change(&mut told);
            told.worn()
        };
        let lengths = changed(&|t| {
            for length in [&mut t.module, &mut t.face, &mut t.relief, &mut t.misalignment] {
                *length *= 2.0;
            }
            t.torque *= 8.0;
        });
        let moduli = changed(&|t| {
            t.moduli = t.moduli.map(|e| 2.0 * e);
            t.torque *= 2.0;
            t.coefficient *= 0.5;
        });
        let face = changed(&|t| {
            t.face *= 2.0;
            t.torque *= 2.0;
        });
        let time = changed(&|t| {
            t.coefficient *= 0.5;
            t.cycles *= 2.0;
        });
        let mirrored = changed(&|t| t.reversed = true);
        for (name, told, deeper, harder) in [
            ("lengths", lengths, 2.0, 1.0),
            ("moduli", moduli, 1.0, 2.0),
            ("face", face, 1.0, 1.0),
            ("time", time, 1.0, 1.0),
            ("mirrored", mirrored, 1.0, 1.0),
        ] {
            let off = [difference(&told[0], &depth, deeper), difference(&told[1], &pressure, harder)];
            prop_assert!(off.iter().all(|off| *off < 1e-9), "{name}: {off:?}");
        }
    }
}
