//! Claim: every number of a run stands in the tables and in summary.json, under the promised names, digit for digit.
use serde_json::Value;
use std::fs;

use gearwear::report::write_run;

use super::{read, synthetic, written};

#[test]
fn tables_read_back_to_the_same_doubles() {
    let (dir, run) = written();
    let text = read(&dir, "wear.csv");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("cycles,member,radius,path,depth"));
    let mut expected = Vec::new();
    for state in &run.states {
        for (name, flank) in [("pinion", &state.pinion), ("gear", &state.gear)] {
            for i in 0..flank.radius.len() {
                expected.push((
                    state.cycles,
                    name,
                    flank.radius[i],
                    flank.path[i],
                    flank.depth[i],
                ));
            }
        }
    }
    let found: Vec<_> = lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let number = |i: usize| cells[i].parse::<f64>().unwrap();
            assert_eq!(cells.len(), 5);
            (
                number(0),
                if cells[1] == "pinion" {
                    "pinion"
                } else {
                    "gear"
                },
                number(2),
                number(3),
                number(4),
            )
        })
        .collect();
    assert_eq!(found, expected);

    let text = read(&dir, "contact.csv");
    let header = text.lines().next().unwrap();
    assert!(
        header
            .starts_with("cycles,position,pair,path,load_share,line_load,peak_pressure,half_width")
    );
    let pairs: usize = run.states.iter().map(|state| state.pairs().count()).sum();
    assert_eq!(text.lines().count(), 1 + pairs);
    let last: Vec<f64> = text
        .lines()
        .last()
        .unwrap()
        .split(',')
        .take(12)
        .map(|cell| cell.parse().unwrap())
        .collect();
    let pair = run.last().pairs().last().unwrap();
    assert_eq!(
        last[3..8],
        [
            pair.path,
            pair.load_share,
            pair.line_load,
            pair.peak_pressure,
            pair.half_width
        ]
    );
    assert_eq!(
        last[10..],
        [pair.sliding.speed, pair.sliding.film_ratio.unwrap()]
    );
    // no flash temperature: an empty cell
    assert_eq!(text.lines().last().unwrap().split(',').nth(13), Some(""));

    let text = read(&dir, "transmission_error.csv");
    assert_eq!(text.lines().next(), Some("cycles,position,angle"));
    let last: Vec<f64> = text
        .lines()
        .last()
        .unwrap()
        .split(',')
        .map(|cell| cell.parse().unwrap())
        .collect();
    let position = run.last().cycle.last().unwrap();
    assert_eq!(last, [50_000.0, position.position, position.angle_urad]);
}

#[test]
fn summary_has_the_promised_keys_and_figures() {
    let (dir, run) = written();
    let text = read(&dir, "summary.json");
    let summary: Value = serde_json::from_str(&text).unwrap();
    let promised = [
        (
            "/geometry",
            "working_pressure_angle contact_ratio path_of_contact base_pitch backlash_um speed_ratio",
        ),
        ("/mesh", "nodes elements dof min_angle flank_spacing"),
        (
            "/contact",
            "peak_pressure te_peak_to_peak_urad single_pair_stiffness",
        ),
        ("/wear", "balance_error"),
        (
            "/wear/pinion",
            "max_depth_um max_depth_radius worn_area_mm2 mass_loss_mg",
        ),
        (
            "/wear/gear",
            "max_depth_um max_depth_radius worn_area_mm2 mass_loss_mg",
        ),
        (
            "/cost",
            "seconds factorisations contact_solves wear_steps peak_memory_mb threads",
        ),
    ];
    for (place, keys) in promised {
        for key in keys.split(' ') {
            let value = summary.pointer(&format!("{place}/{key}"));
            assert!(
                value.is_some_and(Value::is_number),
                "{place}/{key} is {value:?}"
            );
        }
    }
    assert_eq!(summary["mesh"]["nodes"], 24_310 + 31_877);
    // REF pair at C, independent finite elements: 119.436 N/mm over 344.56 µrad × 25.3717 mm = 13.662 N/(mm·µm).
    let k = summary["contact"]["single_pair_stiffness"]
        .as_f64()
        .unwrap();
    assert!((k - 13.662).abs() < 1e-3, "{k}");
    let angles = || run.first().cycle.iter().map(|p| p.angle_urad);
    let span = angles().fold(f64::MIN, f64::max) - angles().fold(f64::MAX, f64::min);
    // Compared as digits: this reader may be off by one in the last place.
    assert!(
        text.contains(&format!("\"te_peak_to_peak_urad\": {span}")),
        "{span}"
    );
    let deepest = run.last().pinion.depth.iter().copied().fold(0.0, f64::max);
    assert!(
        text.contains(&format!("\"max_depth_um\": {deepest}")),
        "{deepest}"
    );
}

#[test]
fn a_model_without_a_mesh_is_written_too() {
    let dir = tempfile::tempdir().unwrap();
    let mut run = synthetic::run();
    (run.mesh, run.fields) = (None, Vec::new());
    run.states.truncate(1);
    let done = write_run(&run, &dir.path().join("run")).unwrap();
    assert!(!done.folder.join("fields").exists());
    let summary: Value =
        serde_json::from_slice(&fs::read(done.folder.join("summary.json")).unwrap()).unwrap();
    assert_eq!(summary["mesh"]["nodes"], 0);
    assert!(done.files.iter().any(|name| name == "plots/load_share.svg"));
}
