//! A mesh from a file. Tolerance: 1e-9 relative; the file holds the same doubles, only arc lengths are worked out again from
//! the nodes' radii (rounding of 1e-14 mm, grown by the contact solution's condition of about 1e4).
use std::fs;

use super::home::{FEM, Home};

#[test]
fn our_meshes_written_and_read_give_the_same_results() {
    let home = Home::with(&[
        ("mesh_pinion", "\"meshes/pinion.vtu\""),
        ("mesh_gear", "\"meshes/gear.vtu\""),
    ]);
    home.write("plain.toml", super::home::STUDY);
    home.succeed("mesh plain.toml -o meshes");
    home.succeed("run study.toml -o run");
    let (own, ours) = (home.result("run"), FEM.result("run"));
    for (name, columns) in [
        ("wear.csv", &["cycles", "radius", "path", "depth"][..]),
        (
            "contact.csv",
            &[
                "cycles",
                "position",
                "pair",
                "load_share",
                "line_load",
                "peak_pressure",
            ],
        ),
        ("transmission_error.csv", &["cycles", "position", "angle"]),
    ] {
        let (own, ours) = (own.table(name), ours.table(name));
        assert_eq!(own.len(), ours.len());
        for column in columns {
            let (own, ours) = (own.numbers(column), ours.numbers(column));
            let scale = ours.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            for (a, b) in own.iter().zip(&ours) {
                assert!((a - b).abs() <= 1e-9 * scale, "{name}, {column}: {a}, {b}");
            }
        }
    }
    let mesh = |folder: &super::home::Folder| folder.summary()["mesh"].clone();
    assert_eq!(mesh(&own)["nodes"], mesh(&ours)["nodes"]);
}

#[test]
fn an_unusable_mesh_is_refused_by_its_name() {
    let home = Home::with(&[]);
    home.succeed("mesh study.toml -o meshes");
    let good = fs::read(home.path("meshes/pinion.vtu")).unwrap();
    let files: [(&str, &[u8]); 4] = [
        ("short.vtu", &good[..good.len() / 2]),
        ("text.vtu", b"no mesh"),
        ("text.msh", b"no mesh"),
        ("bytes.msh", b"$MeshFormat\n\xff\xfe"),
    ];
    for (name, bytes) in files {
        fs::write(home.path(name), bytes).unwrap();
    }
    let unusable = [
        ("short.vtu", "short.vtu"),
        ("text.vtu", "text.vtu"),
        ("text.msh", "text.msh"),
        ("bytes.msh", "bytes.msh"),
        ("missing.vtu", "missing.vtu"),
        ("meshes", "meshes"),
        // the other member's mesh: its bore lies elsewhere
        ("meshes/gear.vtu", "bore"),
    ];
    for (file, said) in unusable {
        home.write(
            "study.toml",
            &super::home::study_with(&[("mesh_pinion", &format!("\"{file}\""))]),
        );
        let before = home.tree();
        for command in ["run", "mesh"] {
            let answer = home.gearwear(&format!("{command} study.toml -o out"));
            assert_eq!(
                (answer.code, answer.out.as_str()),
                (Some(2), ""),
                "{command} with {file}: {}",
                answer.err
            );
            assert!(
                answer.err.contains(said) && answer.err.contains("mesh_pinion"),
                "{command} with {file}: {}",
                answer.err
            );
            assert_eq!(home.tree(), before);
        }
    }
}

/// The ready mesh of the pinion has two fine flanks; four times the load bends a third tooth into contact.
#[test]
fn a_mesh_that_lacks_a_tooth_which_touches_is_refused() {
    let ready = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes/pinion_27.vtu");
    let home = Home::with(&[
        ("order", "2"),
        ("mesh_pinion", &format!("\"{}\"", ready.display())),
        ("torque", "400.0"),
    ]);
    let answer = home.gearwear("run study.toml -o run");
    assert_eq!((answer.code, answer.out.as_str()), (Some(2), ""));
    for part in ["mesh_pinion", "pinion_27.vtu", "has no fine flank"] {
        assert!(answer.err.contains(part), "{part}: {}", answer.err);
    }
    assert_eq!(home.tree(), ["study.toml"]);
}
