//! Rows above a header that state other gears or other conditions than the study: the table is of another test or of other gears.

use super::*;

const TABLE: &str = "radius [mm];100000;250000\n26;3.1;6.2\n27;1.2;2.5\n";

#[test]
fn other_gears_and_conditions_are_refused() {
    let home = home();
    for (title, says) in [
        ("Test A;pinion\nDrehmoment;170 Nm", "It is that of test B"),
        (
            "Test A, pinion, torque 120 Nm",
            "test A in the study, 100 N m",
        ),
        ("Run A\nTorque [Nm];120", "`Torque [Nm]: 120`"),
        ("Run A\nModul;2,5", "the study's, 2 mm"),
        ("Run A\nz = 29, m = 2", "27 and 53 teeth"),
        ("Run A\nZ\u{e4}hnezahl Ritzel: 28", "27 and 53 teeth"),
        ("Run A\nZ\u{e4}hnezahl: 53", "is it the other member's?"),
        ("Run A\nSpeed: 600 rpm", "2000 rpm of the pinion"),
        // by their units alone
        ("Test A, 600 rpm", "`600 rpm` is another speed"),
        ("Test A, z = 27, 170 Nm", "`170 Nm` is another torque"),
        ("Run A\nGear speed: 2000 rpm", "1019 rpm of the gear"),
    ] {
        let message = refused(
            &home,
            &format!("{title}\n{TABLE}"),
            "--member pinion --sigma 0.1",
        );
        assert!(message.contains(says), "{title}: {message}");
    }
    let long = "Run: A\nDrehmoment;170 Nm\ncycles;radius [mm];depth [um]\n100000;26;3.1\n";
    let message = refused(&home, long, "--member pinion --sigma 0.1");
    assert!(message.contains("It is that of test B"), "{message}");
    // above a table with a row for each value too, whose columns say of which test and member they are
    for (title, says) in [
        ("Modul: 2,75", "the study's, 2 mm"),
        ("Modul [mm];2,75", "the study's, 2 mm"),
        ("Z\u{e4}hnezahl Ritzel: 19", "27 and 53 teeth"),
        ("Drehmoment [Nm];170", "It is that of test B"),
        ("Run A, z = 27, 600 rpm", "`600 rpm` is another speed"),
    ] {
        let long = format!(
            "{title}\nTest;member;cycles;radius [mm];depth [um]\nA;pinion;100000;26;3.1\nA;pinion;100000;27;1.2\n"
        );
        let message = refused(&home, &long, "--sigma 0.1");
        assert!(message.contains(says), "{title}: {message}");
    }
    // of two tests it may be either one's torque
    let both = "Drehmoment [Nm];170\nTest;member;cycles;radius [mm];depth [um]\nA;pinion;100000;26;3.1\nB;pinion;100000;27;1.2\n";
    let (_, written) = rows(&home, both, "--sigma 0.1");
    assert_eq!(written.lines().count(), 2);
}

#[test]
fn the_study_s_own_pass_and_so_does_what_states_neither() {
    let home = home();
    let stated = format!("Run A\nModul: 2,0\nProbe: 4711\n{TABLE}");
    let (shown, _) = rows(&home, &stated, "--member pinion --sigma 0.1");
    assert!(
        shown.contains("row 2, `Modul: 2,0`: as in the study")
            && shown.contains("row 3 passed over: Probe"),
        "{shown}"
    );
    for title in [
        "Run A, pinion\nDrehmoment;100 Nm\nDrehzahl;2000 1/min\nModul;2,0\nz\u{e4}hlt nicht: 5",
        // the gear's
        "Run A\nTorque: 196.3 Nm\nSpeed: 1019 rpm",
        // by hand, about
        "Run A\nDrehzahl [1/min];1985",
        "Run A\nz1/z2 = 27/53\nTeeth;1;8;15",
        "Run A\nT = 60 \u{b0}C, m = 412 g\nProbe 4711, 3 teeth measured",
    ] {
        let text = format!("{title}\n{TABLE}");
        let (_, written) = rows(&home, &text, "--member pinion --sigma 0.1 --test A");
        assert_eq!(written.lines().count(), 4, "{title}");
    }
}

/// A helical gear is told by the module of its normal section, 2 mm, or of the transverse one, 2/cos 12° = 2.0447 mm; 2·cos 12° = 1.956 is neither.
#[test]
fn a_helical_gear_has_two_modules() {
    let home = home();
    let helical = STUDY.replace("centre_distance = 80.0", "centre_distance = 82.0")
        + "[face]\nslices = 5\nhelix_angle = 12.0\n";
    fs::write(home.path().join("study.toml"), helical).unwrap();
    for (module, is_own) in [("2", true), ("2.045", true), ("1.956", false)] {
        let table = TABLE.replace("\n26;", "\n26.5;");
        let table = format!("Run A\nModule: {module}\n{table}");
        let (code, _, message) = import(&home, &table, "--member pinion --sigma 0.1");
        assert_eq!(code == Some(0), is_own, "{module}: {message}");
        assert!(is_own || message.contains("the study's, 2 mm"), "{message}");
    }
}
