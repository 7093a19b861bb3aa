//! Claim: helical gears are transverse sections that stand turned along the face and share one turn, one torque and one wear law.
//!
//! Sources: ISO 21771 (geometry), ISO 6336-1 and -2 (stiffness, contact stress), springs of which the test itself finds the balance,
//! equilibrium, symmetry, and spur gears as the limit of no helix. Tolerances: rounding where the same numbers follow another way; stated
//! where something converges or two theories meet.

#![expect(clippy::print_stderr, reason = "figures that the guide cites")]

use std::f64::consts::PI;

use gearwear::simulate::forward::{Conditions, Forward, GearSet, Variation};
use gearwear::simulate::history::{HistoryTangents, Progress};
use gearwear::simulate::members::Members;
use gearwear::simulate::numerics::Numerics;
use gearwear::simulate::wear_state::WearState;
use gearwear::study::Study;
use gearwear::verify::contact_and_wear::Effort;
use gearwear::verify::helical::{self, MODULE, Section, TEETH};

const MODULUS: f64 = 2.06e5;
/// Torque per face width, N·mm/mm.
const TORQUE: f64 = 9000.0;

/// A pair of steel gears: helix angle (deg), slices, face width (mm), and further tables.
fn study(helix: f64, slices: usize, width: f64, more: &str) -> Study {
    coupled("none", helix, slices, width, more)
}

/// The same with slices tied by the teeth.
fn tied(helix: f64, slices: usize, width: f64, more: &str) -> Study {
    coupled("teeth", helix, slices, width, more)
}

fn coupled(coupling: &str, helix: f64, slices: usize, width: f64, more: &str) -> Study {
    let text = format!(
        "[gears]\nmodule = {MODULE}\npressure_angle = 20.0\nface_width = {width}\n\
         [gears.pinion]\nteeth = {}\nbore_diameter = 30.0\n[gears.gear]\nteeth = {}\nbore_diameter = 60.0\n\
         [material]\nyoungs_modulus = {MODULUS}\npoisson_ratio = 0.3\ndensity = 7850.0\n\
         [operation]\ntorque = {}\nspeed = 1500.0\n[wear]\ncoefficient = 6e-10\ncycles = 1e5\n\
         [numerics]\npositions = 40\nelements_per_half_width = 2\n\
         [face]\nslices = {slices}\ncoupling = \"{coupling}\"\nhelix_angle = {helix}\n{more}",
        TEETH[0],
        TEETH[1],
        1e-3 * TORQUE * width
    );
    Study::parse(&text, "study.toml").unwrap_or_else(|error| panic!("{error}"))
}

/// Face width of an overlap ratio, mm.
fn width_of(overlap: f64, helix: f64) -> f64 {
    overlap * PI * MODULE / helix.to_radians().sin()
}

/// What a forward model needs.
struct Bench {
    set: GearSet,
    members: Option<Members>,
    conditions: Conditions,
    numerics: Numerics,
}

impl Bench {
    fn analytic(study: &Study) -> Self {
        Self {
            set: study.gear_set(),
            members: None,
            conditions: study.operation.simulated(&study.wear),
            numerics: study.resolution(),
        }
    }

    fn elastic(study: &Study) -> Self {
        let bench = Self::analytic(study);
        let members = bench
            .set
            .members(&bench.numerics, &[bench.conditions.torque], &[0.0]);
        Self {
            members: Some(members.unwrap()),
            ..bench
        }
    }

    fn forward(&self) -> Forward<'_> {
        let members = self.members.as_ref();
        Forward::new(&self.set, members, self.conditions, self.numerics).unwrap()
    }

    fn both(study: &Study) -> [Self; 2] {
        [Self::analytic(study), Self::elastic(study)]
    }
}

/// Worn to each of the ascending `stops`.
fn states(forward: &mut Forward<'_>, stops: &[f64]) -> (Vec<WearState>, Progress) {
    let mut progress = None;
    let mut states = Vec::new();
    let store = &mut |state| states.push(state);
    forward
        .wear(&mut progress, stops, &mut |_| true, store)
        .unwrap();
    (states, progress.unwrap())
}

fn largest<'v>(values: impl IntoIterator<Item = &'v f64>) -> f64 {
    values.into_iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}

fn apart(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let off: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a - b).collect();
    largest(&off) / largest(expected)
}

fn approaches(state: &WearState) -> Vec<f64> {
    state.contacts.iter().map(|c| c.approach).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Largest less smallest, over the mean.
fn ripple(values: &[f64]) -> f64 {
    let (low, high) = values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
            (a.min(*v), b.max(*v))
        });
    (high - low) / mean(values)
}

/// The pair by numbers: 12°, module 3 in the normal section, 30 mm.
#[test]
fn contact_ratios_are_those_of_the_standard() {
    let study = study(12.0, 11, 30.0, "");
    let pair = study.gears.pair(0.0).unwrap();
    let section = Section::new(12.0);
    assert!((pair.base_pitch / section.pitch - 1.0).abs() < 1e-12);
    assert!((pair.contact_ratio / section.contact_ratio() - 1.0).abs() < 1e-9);
    let overlap = 30.0 * 12f64.to_radians().sin() / (PI * MODULE);
    assert!((pair.overlap_ratio(30.0) / overlap - 1.0).abs() < 1e-12);
    assert!((pair.base_helix / section.base_helix - 1.0).abs() < 1e-12);
    // as many mesh positions as hold the slices' places best, and no more than a quarter more
    assert!((40..=50).contains(&study.resolution().positions));
}

/// Springs that the test places along the helix itself, with the stiffness of ISO 6336-1 and Pedrero's fall along the path: the same
/// approach and the same line loads.
#[test]
fn analytic_line_loads_are_those_of_springs_along_the_helix() {
    for (helix, slope) in [(12.0, 0.0), (12.0, 25.0), (-20.0, 15.0)] {
        let width = width_of(1.0, f64::abs(helix));
        let lead = format!("[face.pinion]\nlead_slope = {slope}\n");
        let bench = Bench::analytic(&study(helix, 5, width, &lead));
        let forward = bench.forward();
        let (cycle, slices) = (forward.cycle(), forward.slices().unwrap());
        let state = states(&mut bench.forward(), &[0.0]).0.remove(0);
        let section = Section::new(helix);
        let ratio = section.contact_ratio();
        let top = 1e3 * section.theoretical() * helix.to_radians().cos();
        let fall = (0.5 * (1.11 + 0.5 * ratio).powi(2) - 1.17).powf(-0.5);
        let load = TORQUE / section.base_radius[0];
        let step = section.pitch / cycle.positions.len() as f64;
        let mut compared = 0;
        for (turn, position) in cycle.positions.iter().enumerate() {
            // slice, path, stiffness, gap
            let mut springs = Vec::new();
            let mut at_an_end = false;
            for (i, y) in slices.place.iter().enumerate() {
                for tooth in -4..=4 {
                    let path = (position.theta + f64::from(tooth)) * section.pitch
                        + y * section.base_helix.tan();
                    at_an_end |= section.ends.iter().any(|e| (path - e).abs() < 0.51 * step);
                    if path > section.ends[0] && path < section.ends[1] {
                        let along = (path - section.ends[0]) / section.pitch;
                        let stiffness = top * (fall * (along - 0.5 * ratio)).cos();
                        springs.push((i, path, stiffness, 1e-3 * slope * y / width));
                    }
                }
            }
            if at_an_end {
                continue;
            }
            compared += 1;
            let carried = |delta: f64| -> f64 {
                let each = springs.iter();
                each.map(|(_, _, c, gap)| c * (delta - gap).max(0.0) / 5.0)
                    .sum()
            };
            let (mut low, mut high) = (-0.1, 1.0);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if carried(middle) < load {
                    low = middle
                } else {
                    high = middle
                }
            }
            let approach = low / section.base_radius[0];
            let found = state.contacts[turn].approach;
            assert!((found / approach - 1.0).abs() < 1e-9, "{found} {approach}");
            for (i, path, stiffness, gap) in &springs {
                let q = slices.at(*i, turn, cycle.positions.len());
                let pairs = cycle.positions[q].pairs.iter();
                let nearest = pairs.min_by(|a, b| {
                    let off = |p: &f64| (p - path).abs();
                    off(&a.path).total_cmp(&off(&b.path))
                });
                let pair = nearest.unwrap();
                assert!((pair.path - path).abs() < 1e-9);
                let own = &state.slices[*i].contacts[q].pressure[pair.offset..];
                let found: f64 = pair.length.iter().zip(own).map(|(l, p)| l * p).sum();
                let expected = stiffness * (low - gap).max(0.0);
                assert!((found - expected).abs() < 1e-8 * load, "{found} {expected}");
            }
        }
        assert!(compared > 8, "{compared}");
    }
}

/// With a whole number of base pitches between the ends of the face the contact lines have one total length at every turn (`validate S3`), and
/// the lag stays where it is; that of spur gears swings by a third of its mean.
#[test]
fn a_whole_overlap_keeps_the_lag_constant() {
    let width = width_of(1.0, 12.0);
    let helical = study(12.0, 10, width, "");
    let bench = Bench::elastic(&helical);
    let mut forward = bench.forward();
    let state = states(&mut forward, &[0.0]).0.remove(0);
    let spur = Bench::elastic(&study(0.0, 2, 30.0, ""));
    let upright = states(&mut spur.forward(), &[0.0]).0.remove(0);
    let ripples = [ripple(&approaches(&state)), ripple(&approaches(&upright))];
    eprintln!("lag, largest less smallest over the mean: helical {ripples:?} spur");
    // what is left comes and goes with the elements, two for each half width here
    assert!(ripples[1] > 0.25 && ripples[0] < 0.02, "{ripples:?}");
    // analytically a slice comes and goes with its full stiffness: in proportion to its width
    let analytic = |slices: usize| {
        let bench = Bench::analytic(&study(12.0, slices, width, ""));
        ripple(&approaches(&states(&mut bench.forward(), &[0.0]).0[0]))
    };
    let (coarse, fine) = (analytic(5), analytic(20));
    eprintln!("analytically by 5 and 20 slices: {coarse}, {fine}");
    assert!(coarse < 0.12 && fine < 0.3 * coarse, "{coarse} {fine}");
}

/// All tooth pairs of all slices carry the torque at every turn, new and worn; what is worn off is what the law says of the line loads.
#[test]
fn every_turn_carries_the_torque_and_the_worn_volume_is_that_of_sliding() {
    let lead = "[face.pinion]\nlead_slope = 15.0\ncrowning = 5.0\n";
    let [free, tied] = [study, tied].map(|of| of(12.0, 7, 30.0, lead));
    let [analytic, elastic] = Bench::both(&free);
    for bench in [analytic, elastic, Bench::elastic(&tied)] {
        let mut forward = bench.forward();
        let (states, progress) = states(&mut forward, &[0.0, 1e2, 1e5]);
        let (cycle, slices) = (forward.cycle(), forward.slices().unwrap());
        let positions = cycle.positions.len();
        for state in &states {
            for turn in 0..positions {
                let at_turn = |i: usize| &state.slices[i].contacts[slices.at(i, turn, positions)];
                let moment = |i: usize| -> f64 {
                    let q = slices.at(i, turn, positions);
                    let pairs = 0..cycle.positions[q].pairs.len();
                    pairs
                        .map(|index| forward.moment(q, index, at_turn(i)))
                        .sum()
                };
                let torque = slices.mean((0..7).map(moment)) / forward.torque();
                assert!((torque - 1.0).abs() < 1e-9, "{torque} at turn {turn}");
                let turned = (0..7).map(|i| at_turn(i).approach);
                let off = turned.map(|a| (a - state.contacts[turn].approach).abs());
                assert!(off.fold(0.0, f64::max) < 1e-15);
            }
        }
        assert!(progress.balance.error() < 3e-3);
        // V = k ∫ F_n |v_s| dt, F_n = F_bt/cos β_b, over all slices; v_s = (1 + 1/u) y/r_b1 per path y
        let section = Section::new(12.0);
        let slip = (1.0 + TEETH[0] / TEETH[1]) / section.base_radius[0];
        let step = section.pitch / positions as f64;
        let mut work = 0.0;
        for (slice, share) in states[0].slices.iter().zip(&slices.weight) {
            for (position, contact) in cycle.positions.iter().zip(&slice.contacts) {
                for pair in &position.pairs {
                    let own = &contact.pressure[pair.offset..];
                    let load: f64 = pair.length.iter().zip(own).map(|(l, p)| l * p).sum();
                    work += share * load * slip * pair.path.abs() * step;
                }
            }
        }
        let expected = 6e-10 * 1e2 * work / section.base_helix.cos();
        let lost: f64 = (cycle.stations.arc[0].windows(2))
            .zip(states[1].depth[0].windows(2))
            .map(|(s, h)| 0.5 * (s[1] - s[0]) * (h[0] + h[1]))
            .sum();
        // corners outside the path slide by another law, and new flanks change within 100 turns
        assert!((lost / expected - 1.0).abs() < 0.02, "{lost} {expected}");
    }
}

#[test]
fn the_other_hand_mirrors_the_face() {
    type Model = fn(f64, &str) -> Bench;
    let models: [Model; 3] = [
        |helix, lead| Bench::analytic(&study(helix, 5, 30.0, lead)),
        |helix, lead| Bench::elastic(&study(helix, 5, 30.0, lead)),
        |helix, lead| Bench::elastic(&tied(helix, 5, 30.0, lead)),
    ];
    for model in models {
        let worn = |helix: f64, slope: f64| {
            let bench = model(helix, &format!("[face.gear]\nlead_slope = {slope}\n"));
            states(&mut bench.forward(), &[1e5]).0.remove(0)
        };
        let (right, left) = (worn(15.0, 12.0), worn(-15.0, -12.0));
        for (a, b) in right.slices.iter().zip(left.slices.iter().rev()) {
            assert!((a.face + b.face).abs() < 1e-12);
            for side in 0..2 {
                let worst = apart(&a.depth[side], &b.depth[side]);
                assert!(worst < 1e-9, "{worst:e}");
            }
        }
        assert!(apart(&approaches(&right), &approaches(&left)) < 1e-9);
        // and is not the same as the same hand with the other wedge
        let other = worn(15.0, -12.0);
        let ends = [&right.slices[0], &other.slices[4]].map(|s| largest(&s.depth[0]));
        assert!((ends[0] / ends[1] - 1.0).abs() > 1e-6, "{ends:?}");
    }
}

#[test]
fn without_a_helix_they_are_spur_gears() {
    let lead = "[face.pinion]\nlead_slope = 12.0\n";
    let [none, hardly] = [0.0, 1e-4].map(|helix| {
        let bench = Bench::elastic(&study(helix, 5, 30.0, lead));
        states(&mut bench.forward(), &[0.0, 1e5]).0
    });
    for (spur, helical) in none.iter().zip(&hardly) {
        let worst = apart(&approaches(helical), &approaches(spur));
        eprintln!("lag without a helix {worst:e}");
        assert!(worst < 1e-6, "{worst:e}");
        for (a, b) in helical.slices.iter().zip(&spur.slices) {
            if spur.cycles > 0.0 {
                let worst = apart(&a.depth[0], &b.depth[0]);
                eprintln!("depth without a helix {worst:e}");
                assert!(worst < 1e-5, "{worst:e}");
            }
        }
    }
    // and the swing of the lag falls steadily from theirs
    let mut before = f64::INFINITY;
    for helix in [0.0, 3.0, 6.0, 9.0] {
        let bench = Bench::elastic(&study(helix, 9, 30.0, ""));
        let swing = ripple(&approaches(&states(&mut bench.forward(), &[0.0]).0[0]));
        eprintln!("{helix} deg: lag swings by {swing}");
        assert!(swing < before, "{swing} after {before}");
        before = swing;
    }
}

/// Contact stress and mesh stiffness against the standard, contact lines of a whole overlap.
#[test]
fn the_validation_family_of_helical_gears_passes() {
    let figures = helical::all(Effort::Quick).unwrap();
    assert_eq!(figures.len(), 9);
    for figure in &figures {
        eprintln!("{figure}");
        assert!(figure.passed(), "{figure}");
    }
}

/// The lead of an effect is the lead of the study, whose slope is positive where the end +b/2 is the open one.
#[test]
fn an_effect_across_the_face_acts_as_the_lead_it_is() {
    let by_lead = study(12.0, 5, 30.0, "[face.pinion]\nlead_slope = 14.0\n");
    let by_effect = study(
        12.0,
        5,
        30.0,
        "[[effect]]\nkind = \"lead_misalignment\"\nslope = -14.0\n",
    );
    let acting = by_effect.acting(&by_effect.operation).unwrap();
    for (bench, of_effect) in Bench::both(&by_lead).iter().zip(Bench::both(&by_effect)) {
        let expected = states(&mut bench.forward(), &[0.0]).0.remove(0);
        let mut forward = Forward::with_effects(
            &of_effect.set,
            of_effect.members.as_ref(),
            of_effect.conditions,
            of_effect.numerics,
            Some(&acting),
        )
        .unwrap();
        let found = states(&mut forward, &[0.0]).0.remove(0);
        assert!(apart(&approaches(&found), &approaches(&expected)) < 1e-9);
    }
}

/// The derivatives of depths by ln k, along the steps taken, are those of differences.
#[test]
fn derivatives_are_those_of_differences() {
    let lead = "[face.pinion]\nlead_slope = 12.0\n";
    let [free, tied] = [study, tied].map(|of| of(12.0, 5, 30.0, lead));
    let [analytic, elastic] = Bench::both(&free);
    for bench in [analytic, elastic, Bench::elastic(&tied)] {
        let template = bench.forward();
        let end = 1e4;
        let k = bench.conditions.coefficient[0];
        let variation = [Variation {
            coefficient: [1.0; 2],
            effects: None,
            step: 1e-7,
        }];
        let mut forward = template.again([k; 2], None).unwrap();
        let (mut progress, mut tangents) = (None, HistoryTangents::default());
        let taken = std::cell::RefCell::new(Vec::new());
        forward
            .wear_with_tangents(
                &mut progress,
                end,
                (&variation, &mut tangents),
                &mut |_, p, _| {
                    taken.borrow_mut().push(p.stand.n);
                    true
                },
            )
            .unwrap();
        let taken = taken.into_inner();
        let apart_by = 3e-7;
        let ends = [-apart_by, apart_by].map(|h: f64| {
            let mut forward = template.again([k * h.exp(); 2], None).unwrap();
            let mut progress = None;
            forward
                .wear_along(&mut progress, &taken, &mut |_| ())
                .unwrap();
            progress.unwrap().stand.u
        });
        let difference: Vec<f64> = (ends[0].iter().zip(&ends[1]))
            .map(|(a, b)| (b - a) / (2.0 * apart_by))
            .collect();
        let worst = apart(&tangents.depth[0], &difference);
        eprintln!("derivative {worst:e}");
        assert!(worst < 1e-4, "{worst:e}");
    }
}

/// The example, coarse and short: one command, with what the report needs of the face and of the turn.
#[test]
fn the_example_runs_as_one_command() {
    let text = include_str!("../../examples/helical.toml")
        .replace("slices = 11", "slices = 5")
        .replace("cycles = 1e6", "cycles = 1e5");
    let folder = tempfile::tempdir().unwrap();
    let coarse = "[numerics]\npositions = 24\nelements_per_half_width = 2\nfields = 1\n";
    let path = folder.path().join("helical.toml");
    let out = folder.path().join("out");
    let run = |study: String, out: &std::path::Path| {
        std::fs::write(&path, study).unwrap();
        let run = std::process::Command::new(env!("CARGO_BIN_EXE_gearwear"))
            .args(["run", "-o"])
            .args([out, &path])
            .output()
            .unwrap();
        let error = String::from_utf8_lossy(&run.stderr);
        assert!(run.status.success(), "{error}");
        String::from_utf8(run.stdout).unwrap()
    };
    // two slices stand a third of a base pitch apart, which is said
    let few = text.replace("slices = 5", "slices = 2");
    let said = run(
        format!("{few}{coarse}[model]\ncontact = \"hertz\"\n"),
        &folder.path().join("few"),
    );
    assert!(
        said.contains("note: 2 slices for an overlap ratio of 0.662"),
        "{said}"
    );
    let said = run(format!("{text}{coarse}"), &out);
    assert!(!said.contains("slices for an overlap"), "{said}");
    assert!(
        said.contains("normal module 3 mm, helix angle 12°"),
        "{said}"
    );
    let summary = std::fs::read_to_string(out.join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let number = |pointer: &str| summary.pointer(pointer).and_then(|v| v.as_f64()).unwrap();
    // worked out by hand: ε_α 1.6444, ε_β 0.6618
    assert!((number("/geometry/helix/total_contact_ratio") - 2.3062).abs() < 1e-4);
    assert!((number("/geometry/helix/overlap_ratio") - 0.6618).abs() < 1e-4);
    assert!(number("/face/first/load_factor") > 1.2);
    assert!(number("/face/last/load_factor") < number("/face/first/load_factor"));
    // the axis off by 20 µm swings the lag by 40 µm at the base circle of 33.05 mm, besides its swing over a base pitch
    let swing = number("/transmission_error_over_a_turn_urad/first");
    let over_a_pitch = number("/contact/te_peak_to_peak_urad");
    let turned = 2.0 * 20.0 / Section::new(12.0).base_radius[0] * 1e3;
    assert!(
        (swing - turned).abs() < over_a_pitch + 5.0,
        "{swing} {turned}"
    );
    let report = std::fs::read_to_string(out.join("report.html")).unwrap();
    for part in [
        "The helix",
        "total contact ratio",
        "Load per width across the face",
        "over one turn",
        "radius over the place across the face",
        "slices tied by the teeth carry more",
    ] {
        assert!(report.contains(part), "{part}");
    }
}
