//! The published model (Kumar, Hirani & Agrawal 2018) and the verdict on every number the paper prints.
//!
//! Claims: our run gives each printed number inside its printed rounding, or the verdict says why not; the wear model agrees
//! with an independent reconstruction at 13 anchor points; each choice of the reconstruction, undone alone, misses what it
//! was seen to miss; the paper's trends hold or fail point by point as found.
//! Sources: the paper's tables (copied to `validation/paper/reference.csv` with an independent reconstruction's values),
//! and that reconstruction's anchor and one-change-at-a-time tables, copied below.
//! Tolerances: half the last printed digit of whatever is compared. Values "after" 50 000 cycles may mean in the last cycle
//! or after it: one cycle is 2e-5 of the change, and the pressure drops of the one-change table are up to ten cycles early.

use std::sync::LazyLock;

use gearwear::paper::reference::{Verdict, rows};
use gearwear::paper::{
    Corrections, Error, Geometry, Inputs, Outcome, Point, Reading, State, backlash,
    double_contact_length, run, run_with_states,
};

const STATES: [u64; 4] = [10_000, 20_000, 30_000, 40_000];

/// The published runs at 0, 0.5 and 1 mm.
static RUNS: LazyLock<[Outcome; 3]> = LazyLock::new(|| {
    [0.0, 0.5, 1.0]
        .map(|m| run_with_states(&Inputs::with_misalignment(m), &STATES).expect("Table 1 is valid"))
});

fn published(inputs: Inputs) -> Outcome {
    run(&inputs).expect("valid inputs")
}

fn at(outcome: &Outcome, number: usize) -> &Point {
    outcome.point(number).expect("a point of the grid")
}

fn loaded(outcome: &Outcome) -> impl Iterator<Item = &Point> {
    outcome.points.iter().filter(|p| p.load_per_width > 0.0)
}

/// Asserts that `ours` rounds to the printed number, half its last digit and `extra` allowed.
fn assert_rounds(ours: f64, printed: &str, extra: f64, what: &str) {
    let value: f64 = printed.parse().expect("a number");
    let (mantissa, exponent) = printed.split_once('e').unwrap_or((printed, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, d)| d.len() as i32);
    let half = 0.5 * 10f64.powi(exponent.parse::<i32>().expect("an exponent") - decimals);
    assert!(
        (ours - value).abs() <= half * (1.0 + 1e-6) + extra,
        "{what}: {ours} against {printed}"
    );
}

#[test]
fn geometry_of_table_2() {
    // misalignment, angle deg, circular pitch, path, contact ratio: involute geometry by hand, six digits
    let table = [
        (0.0, 20.0, std::f64::consts::TAU, 10.0204, 1.69714),
        (0.5, 20.9559, 6.32246, 8.59123, 1.45509),
        (1.0, 21.8608, 6.36173, 7.22146, 1.22309),
    ];
    for (m, angle, pitch, path, ratio) in table {
        let g = Geometry::new(&Inputs::with_misalignment(m)).expect("valid");
        for (ours, theirs) in [
            (g.operating_angle.to_degrees(), angle),
            (g.circular_pitch, pitch),
            (g.path_of_contact, path),
            (g.contact_ratio, ratio),
            (g.speed_ratio, 53.0 / 27.0),
        ] {
            assert!(
                (ours / theirs - 1.0).abs() < 5e-6,
                "{m}: {ours} against {theirs}"
            );
        }
    }
}

#[test]
fn point_numbers() {
    // fractional numbers of start, LPSTC, pitch, HPSTC, end (three decimals), y at the pitch point (five)
    let table = [
        (5.373, 18.559, 23.439, 26.822, 23, 6, -0.09353),
        (8.988, 18.559, 25.764, 34.439, 26, 9, 0.04771),
        (13.426, 18.559, 28.090, 42.531, 28, 14, -0.01752),
    ];
    for (outcome, (start, lpstc, pitch, hpstc, pitch_number, first, y)) in RUNS.iter().zip(table) {
        let g = &outcome.geometry;
        for (rho, expected) in [
            (g.start, start),
            (g.lowest_single, lpstc),
            (g.pitch, pitch),
            (g.highest_single, hpstc),
            (g.end, 51.0),
        ] {
            assert!((g.number(rho) - expected).abs() < 5.1e-4, "{expected}");
        }
        assert_eq!(g.pitch_point_number(), pitch_number);
        assert_eq!(g.first_contact_number(), first);
        assert!((at(outcome, pitch_number).y - y).abs() < 5.1e-6);
        let touched: Vec<usize> = loaded(outcome).map(|p| p.number).collect();
        assert_eq!(touched, (first..=50).collect::<Vec<_>>());
    }
    let full = |o: &Outcome| -> Vec<usize> {
        let most = at(o, 20).load_per_width;
        loaded(o)
            .filter(|p| p.load_per_width == most)
            .map(|p| p.number)
            .collect()
    };
    assert_eq!(full(&RUNS[0]), (19..=26).collect::<Vec<_>>());
    assert_eq!(full(&RUNS[1]), (19..=34).collect::<Vec<_>>());
    assert_eq!(full(&RUNS[2]), (19..=42).collect::<Vec<_>>());
    // 100 N m over 25.3717 mm and 33 mm
    assert!((at(&RUNS[0], 20).load_per_width - 119.44).abs() < 5e-3);
}

#[test]
fn anchors_of_the_reconstruction() {
    // case, point, p before, p after (MPa), first cycle (µm), wear (µm), angle change (deg), as printed
    let anchors = [
        (0, 6, "777.5", "745.96", "6.699e-4", "29.533", "1.0257"),
        (0, 19, "872.6", "872.41", "3.029e-5", "1.5027", "0.0153"),
        (0, 23, "848.9", "848.90", "2.6345e-7", "0.013165", "0.0001"),
        (0, 26, "835.8", "835.75", "8.329e-6", "0.41765", "0.0030"),
        (0, 50, "566.3", "566.35", "4.363e-4", "22.013", "0.0725"),
        (1, 9, "704.1", "693.38", "4.530e-4", "21.260", "0.4866"),
        (1, 26, "824.5", "824.50", "6.658e-8", "0.0033297", "0.0000"),
        (1, 50, "552.4", "552.31", "3.420e-4", "17.236", "0.0568"),
        (2, 14, "639.3", "636.90", "2.317e-4", "11.285", "0.1604"),
        (2, 19, "855.7", "854.78", "1.135e-4", "5.5908", "0.0567"),
        (2, 28, "806.9", "806.87", "8.782e-9", "0.00043908", "0.0000"),
        (2, 42, "772.9", "772.75", "1.663e-4", "8.3786", "0.0341"),
        (2, 50, "541.0", "540.94", "2.650e-4", "13.339", "0.0440"),
    ];
    for (case, number, before, after, first, wear, angle) in anchors {
        let p = at(&RUNS[case], number);
        let name = format!("case {case}, point {number}");
        assert_rounds(p.pressure_before, before, 0.0, &name);
        let cycle = 2e-5 * (p.pressure_before - p.pressure_after).abs();
        assert_rounds(p.pressure_after, after, cycle, &name);
        assert_rounds(p.first_cycle_depth * 1e3, first, 0.0, &name);
        assert_rounds(p.depth * 1e3, wear, 2e-5 * p.depth * 1e3, &name);
        assert_rounds(p.angle_change.to_degrees(), angle, 0.0, &name);
    }
}

#[test]
fn every_printed_number_gets_the_stated_verdict() {
    let rows = rows().expect("the table file is valid");
    assert_eq!(rows.len(), 49);
    for row in &rows {
        assert_eq!(row.verdict, row.stated.verdict, "{}", row.id);
        // Six printed digits; the pressure drop (Q1) differs by what "after" means, up to ten cycles of it.
        let close = |ours: f64, stated: f64| {
            let tolerance = if row.id == "Q1" { 2.5e-4 } else { 6e-6 };
            (ours - stated).abs() <= tolerance * stated.abs()
        };
        assert!(close(row.theory, row.stated.theory), "{row:?}");
        match (row.ours, row.stated.reconstruction) {
            (Some(ours), Some(stated)) => {
                // One reconstruction value is stated as cut to the print: the angle 20.95.
                let cut = row.id == "T2.2.a" && row.cut_gives_print(ours);
                assert!(close(ours, stated) || cut || row.id == "T2.3.a", "{row:?}");
            }
            (None, None) => {}
            _ => panic!("value missing on one side: {row:?}"),
        }
        let plain = matches!(row.verdict, Verdict::Input | Verdict::Reproduced);
        assert_eq!(row.note.is_empty(), plain, "{}", row.id);
    }
    let count = |v: Verdict| rows.iter().filter(|r| r.verdict == v).count();
    assert_eq!(count(Verdict::Input), 16);
    assert_eq!(count(Verdict::Reproduced), 17);
    assert_eq!(count(Verdict::Quirk), 10);
    assert_eq!(count(Verdict::NotReproduced), 3);
    assert_eq!(count(Verdict::ContradictsTheory), 3);
}

#[test]
fn the_five_wear_numbers_round_to_the_print_and_one_percent_more_would_not() {
    for row in rows().expect("valid") {
        if ["W1", "W2", "W3", "A2", "Q1"].contains(&row.id.as_str()) {
            let ours = row.ours.expect("computed");
            assert!(row.rounds_to_print(ours), "{row:?}");
            // The window of the angle is 3 % wide, the others at most 0.4 %.
            let wrong = if row.id == "A2" { 1.04 } else { 1.01 };
            assert!(!row.rounds_to_print(ours * wrong), "{row:?}");
        }
    }
}

#[test]
fn what_each_printed_number_pins_down() {
    use Reading::*;
    // W23, W26, W28 (µm), angle at 14 (deg), pressure drop at 6 (MPa), angle at 6 (deg), as the reconstruction lists them
    let table: [(Option<Reading>, [&str; 6]); 16] = [
        (
            None,
            [
                "1.316e-2", "3.330e-3", "4.391e-4", "0.160", "31.52", "1.026",
            ],
        ),
        (
            Some(FortyNineIntervals),
            ["6.9e-6", "3.30e-2", "1.15e-2", "0.150", "30.06", "0.991"],
        ),
        (
            Some(TrueSpeedRatio),
            [
                "1.325e-2", "3.351e-3", "4.418e-4", "0.161", "31.67", "1.031",
            ],
        ),
        (
            Some(PrintedAngle),
            [
                "1.316e-2", "3.761e-3", "4.197e-4", "0.160", "31.52", "1.026",
            ],
        ),
        (
            Some(LoadAtReferenceCircle),
            [
                "1.276e-2", "3.228e-3", "4.256e-4", "0.156", "29.86", "1.000",
            ],
        ),
        (
            Some(LoadNotPerWidth),
            ["7.54e-2", "1.92e-2", "2.52e-3", "0.790", "493.8", "3.30"],
        ),
        (
            Some(MeanPressure),
            [
                "1.034e-2", "2.615e-3", "3.449e-4", "0.127", "26.23", "0.841",
            ],
        ),
        (
            Some(HalfWidthAsPrinted),
            ["4.0e-6", "1.1e-6", "1.5e-7", "0.000", "0.00", "0.000"],
        ),
        (
            Some(RadiiAsPrinted),
            [
                "1.319e-2", "3.327e-3", "4.392e-4", "0.167", "36.05", "1.072",
            ],
        ),
        (
            Some(FullLoad),
            [
                "1.316e-2", "3.330e-3", "4.391e-4", "0.224", "57.02", "1.345",
            ],
        ),
        (
            Some(OneThird),
            [
                "1.316e-2", "3.330e-3", "4.391e-4", "0.132", "22.07", "0.869",
            ],
        ),
        (
            Some(SineOfAngle),
            [
                "1.317e-2", "3.330e-3", "4.391e-4", "0.161", "30.67", "1.029",
            ],
        ),
        (
            Some(InstantaneousAngle),
            [
                "1.315e-2", "3.353e-3", "4.445e-4", "0.157", "30.45", "0.988",
            ],
        ),
        (
            Some(ContactDwell),
            ["6.99e-2", "3.35e-2", "1.18e-2", "0.022", "4.85", "0.147"],
        ),
        (
            Some(LogarithmicUpdate),
            ["1.317e-2", "3.329e-3", "4.391e-4", "0.017", "0.97", "0.029"],
        ),
        (
            Some(BothFlanks),
            ["1.316e-2", "3.331e-3", "4.390e-4", "0.310", "50.4", "1.73"],
        ),
    ];
    for (reading, listed) in table {
        let [first, second, third] = [0.0, 0.5, 1.0].map(|m| {
            published(Inputs {
                reading,
                ..Inputs::with_misalignment(m)
            })
        });
        let six = at(&first, 6);
        let ours = [
            at(&first, 23).depth * 1e3,
            at(&second, 26).depth * 1e3,
            at(&third, 28).depth * 1e3,
            at(&third, 14).angle_change.to_degrees(),
            six.pressure_before - six.pressure_after,
            six.angle_change.to_degrees(),
        ];
        for (i, (&ours, listed)) in ours.iter().zip(listed).enumerate() {
            let late = if i == 4 { 2e-4 * ours } else { 0.0 };
            // 0.0114499 has become 1.15e-2 by rounding twice (0.01145, then 0.0115).
            let twice = if listed == "1.15e-2" { 1e-6 } else { 0.0 };
            assert_rounds(
                ours,
                listed,
                late + twice,
                &format!("{reading:?}, column {i}"),
            );
        }
        // Only the reconstruction meets all five windows at once.
        let inside = (ours[0] - 1.32e-2).abs() <= 5e-5
            && (ours[1] - 3.33e-3).abs() <= 5e-6
            && (ours[2] - 4.39e-4).abs() <= 5e-7
            && (ours[3] - 0.16).abs() <= 5e-3
            && (ours[4] - 31.5).abs() <= 0.05;
        assert_eq!(inside, reading.is_none(), "{reading:?} {ours:?}");
    }
}

#[test]
fn trends_of_the_profile_angle() {
    for outcome in RUNS.iter() {
        for state in &outcome.states {
            let angles: Vec<f64> = loaded(outcome)
                .map(|p| state.points[p.number - 1].angle)
                .collect();
            assert!(angles.is_sorted_by(|a, b| a < b), "at {}", state.cycles);
        }
        for pair in outcome.states.windows(2) {
            for p in loaded(outcome) {
                let i = p.number - 1;
                assert!(pair[1].points[i].angle > pair[0].points[i].angle);
            }
        }
    }
    // Largest at the first contact point, falling with misalignment.
    let largest = RUNS.each_ref().map(|o| {
        loaded(o)
            .max_by(|a, b| a.angle_change.total_cmp(&b.angle_change))
            .expect("points in contact")
    });
    assert_eq!(largest.map(|p| p.number), [6, 9, 14]);
    assert!(largest.map(|p| -p.angle_change).is_sorted());
    // At a given point misalignment raises it in the dedendum and lowers it in the addendum.
    compare_cases(|less, more, dedendum| (more.angle_change > less.angle_change) == dedendum);
}

#[test]
fn trends_of_the_pressure() {
    for (case, outcome) in RUNS.iter().enumerate() {
        let rising: Vec<usize> = loaded(outcome)
            .filter(|p| p.pressure_after >= p.pressure_before)
            .map(|p| p.number)
            .collect();
        assert_eq!(rising, if case == 0 { vec![49, 50] } else { vec![] });
        // Highest at the LPSTC (point 19), from there falling through the single-pair zone: its end is its lowest point.
        let highest =
            loaded(outcome).max_by(|a, b| a.pressure_before.total_cmp(&b.pressure_before));
        assert_eq!(highest.map(|p| p.number), Some(19));
        let all = at(outcome, 19).load_per_width;
        let single: Vec<f64> = loaded(outcome)
            .filter(|p| p.load_per_width == all)
            .map(|p| -p.pressure_before)
            .collect();
        assert!(single.is_sorted());
    }
    for p in [49, 50] {
        let p = at(&RUNS[0], p);
        let rise = p.pressure_after - p.pressure_before;
        assert!((0.005..0.035).contains(&rise), "{rise}");
    }
    // The start of contact, at half the load: 777 MPa against 622 just before the LPSTC.
    assert!((at(&RUNS[0], 18).pressure_before - 622.0).abs() < 0.51);
    assert!((at(&RUNS[0], 6).pressure_before - 777.0).abs() < 0.51);
    // Falls with misalignment where the number of loaded pairs stays, rises where it drops from two to one.
    for (case, last) in [(1, 34), (2, 42)] {
        let exceptions: Vec<usize> = loaded(&RUNS[case])
            .filter(|p| {
                let before = at(&RUNS[0], p.number);
                before.load_per_width > 0.0 && p.pressure_before >= before.pressure_before
            })
            .map(|p| p.number)
            .collect();
        assert_eq!(exceptions, (27..=last).collect::<Vec<_>>());
    }
}

#[test]
fn trends_of_the_wear() {
    for outcome in RUNS.iter() {
        for pair in outcome.states.windows(2) {
            for p in loaded(outcome) {
                let rate = |s: &State| s.points[p.number - 1].depth_per_cycle;
                assert_eq!(rate(&pair[1]) < rate(&pair[0]), p.y < 0.0, "{}", p.number);
            }
        }
    }
    compare_cases(|less, more, dedendum| (more.depth > less.depth) == dedendum);
    // Where most is worn: start, start, end.
    let ends = |o: &Outcome| {
        (
            at(o, o.geometry.first_contact_number()).depth * 1e3,
            at(o, 50).depth * 1e3,
        )
    };
    for (outcome, (start, end)) in RUNS.iter().zip([(29.5, 22.0), (21.3, 17.2), (11.3, 13.3)]) {
        let ours = ends(outcome);
        assert!((ours.0 - start).abs() < 0.051 && (ours.1 - end).abs() < 0.051);
        let most = outcome
            .points
            .iter()
            .map(|p| p.depth * 1e3)
            .fold(0.0, f64::max);
        assert_eq!(most, ours.0.max(ours.1));
    }
}

/// Walks all points in contact on the same side of the pitch point at a smaller and a larger misalignment.
fn compare_cases(holds: impl Fn(&Point, &Point, bool) -> bool) {
    let mut compared = 0;
    for (less, more) in [(0, 1), (1, 2), (0, 2)] {
        for after in loaded(&RUNS[more]) {
            let before = at(&RUNS[less], after.number);
            if before.load_per_width == 0.0 || before.y.signum() != after.y.signum() {
                continue;
            }
            compared += 1;
            assert!(
                holds(before, after, after.y < 0.0),
                "point {} from case {less} to {more}",
                after.number
            );
        }
    }
    assert!(compared > 100);
}

#[test]
fn geometry_that_the_paper_gets_wrong() {
    // 8.232 to 2.634 mm of double contact, 68 %; backlash 420.5 and 816.5 µm; Eq. 5 literally 4.68 and 9.63 µm
    let [first, second, third] = RUNS.each_ref().map(|o| &o.geometry);
    assert!((double_contact_length(first) - 8.232).abs() < 5.1e-4);
    assert!((double_contact_length(third) - 2.634).abs() < 5.1e-4);
    let table_1 = Inputs::default();
    for (geometry, stated, printed) in [(second, 420.5, 4.68), (third, 816.5, 9.63)] {
        let correct = backlash(&table_1, geometry, 0.0455) * 1e3;
        assert!((correct - stated).abs() < 0.051, "{correct}");
        assert!((geometry.backlash.literal * 1e3 - printed).abs() < 5.1e-3);
    }
    assert!((first.profile_angle(23).to_degrees() - 19.81).abs() < 5.1e-3);
    assert!((first.pitch_radius - first.grid.radius(23) - 0.032).abs() < 5.1e-4);
}

#[test]
fn theory_at_the_published_points() {
    // Correct Archard wear (µm, no change of the angle) where the paper prints a depth
    let theory = |misalignment, no_angle_feedback| {
        published(Inputs {
            corrections: Corrections {
                hertz_dwell: true,
                true_speed_ratio: true,
                no_angle_feedback,
                ..Corrections::default()
            },
            ..Inputs::with_misalignment(misalignment)
        })
    };
    for (misalignment, number, um) in [
        (0.0, 23, "0.0553"),
        (0.5, 26, "0.0264"),
        (1.0, 28, "0.0093"),
    ] {
        let depth = at(&theory(misalignment, true), number).depth * 1e3;
        assert_rounds(depth, um, 0.0, "wear at the nearest point");
    }
    // The same wear fed into Eq. 6
    let (first, third) = (theory(0.0, false), theory(1.0, false));
    assert_rounds(at(&first, 6).depth * 1e3, "3.1", 0.0, "wear at point 6");
    assert_rounds(
        at(&first, 6).angle_change.to_degrees(),
        "0.12",
        0.0,
        "angle at point 6",
    );
    assert_rounds(
        at(&third, 14).angle_change.to_degrees(),
        "0.018",
        0.0,
        "angle at point 14",
    );
    assert_rounds(first.largest_pressure_drop().1, "3.9", 0.0, "drop");
    assert_eq!(first.largest_pressure_drop().0, 6);
    // Eq. A4 makes wear about 9.5 times too large at point 6, 9 times at point 14: "about" is read as 2 %
    for (ours, theirs, number, times) in [(&RUNS[0], &first, 6, 9.5), (&RUNS[2], &third, 14, 9.0)] {
        let ratio = at(ours, number).depth / at(theirs, number).depth;
        assert!((ratio / times - 1.0).abs() < 0.02, "{ratio}");
    }
}

#[test]
fn all_corrections_give_the_closed_form_of_gear_wear() {
    // h/k = F' |1 − v2/v1| = 20.584 N/mm at the pinion tip with a third of the load (independent table, five digits)
    let inputs = Inputs {
        corrections: Corrections::ALL,
        ..Inputs::default()
    };
    let outcome = published(inputs.clone());
    let tip = at(&outcome, 50);
    assert!((tip.radius - 29.0).abs() < 1e-12);
    let per_k = tip.depth / (inputs.k * inputs.cycles as f64);
    assert!((per_k - 20.584).abs() < 5.1e-4, "{per_k}");
    assert_eq!(tip.angle_change, 0.0);
    assert_eq!(tip.pressure_before, tip.pressure_after);
    for (name, corrections) in Corrections::each() {
        let changed = published(Inputs {
            corrections,
            cycles: 1000,
            ..Inputs::default()
        });
        let plain = published(Inputs {
            cycles: 1000,
            ..Inputs::default()
        });
        assert!(changed.points != plain.points, "{name} changes nothing");
    }
}

#[test]
fn states_are_what_a_shorter_run_ends_with() {
    let long = &RUNS[1];
    let short = published(Inputs {
        cycles: 20_000,
        ..Inputs::with_misalignment(0.5)
    });
    assert_eq!(
        long.states.iter().map(|s| s.cycles).collect::<Vec<_>>(),
        [0, 10_000, 20_000, 30_000, 40_000, 50_000]
    );
    assert_eq!(long.states[2].points, short.states[1].points);
    let beyond = run_with_states(
        &Inputs {
            cycles: 5,
            ..Inputs::default()
        },
        &[9, 5, 3, 3],
    );
    let cycles: Vec<u64> = beyond
        .expect("valid")
        .states
        .iter()
        .map(|s| s.cycles)
        .collect();
    assert_eq!(cycles, [0, 3, 5]);
}

#[test]
fn inputs_that_the_model_cannot_take() {
    let refused = |inputs: Inputs| run(&inputs).expect_err("refused");
    let table = Inputs::default;
    assert!(matches!(
        refused(Inputs {
            torque: f64::NAN,
            ..table()
        }),
        Error::NotPositive { name: "torque", .. }
    ));
    assert!(matches!(
        refused(Inputs {
            points: 1,
            ..table()
        }),
        Error::TooFewPoints { points: 1 }
    ));
    assert!(matches!(
        refused(Inputs::with_misalignment(-6.0)),
        Error::TooClose { .. }
    ));
    assert!(matches!(
        refused(Inputs::with_misalignment(2.4)),
        Error::ContactRatio { .. }
    ));
    assert!(matches!(
        refused(Inputs {
            tip_radius: [26.0, 59.0],
            ..table()
        }),
        Error::BelowBaseCircle { .. }
    ));
    let diverged = refused(Inputs { k: 6e-3, ..table() });
    assert!(
        matches!(diverged, Error::Diverged { point: 6, .. }),
        "{diverged:?}"
    );
}
