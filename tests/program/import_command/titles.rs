//! Titles that name a test and say something of the values too.

use super::*;

/// As `Componente` and `Pezzo`.
#[test]
fn an_element_above_a_table_is_a_member() {
    let home = home();
    for title in ["Elemento: pignone", "Element: Ritzel"] {
        let table = format!("Prova: A\n{title}\nUsura [um]\nRaggio [mm];100000\n26,5;1,5\n");
        let (_, written) = rows(&home, &table, "--sigma 0.1 --no-traces");
        assert_eq!(written, "A,pinion,100000,wear_depth,26.5,1.5,0.1,\n");
    }
}

/// A title may name the test and state the unit: both are obeyed.
#[test]
fn a_title_that_names_the_test_states_the_unit_too() {
    let home = home();
    for title in [
        "Verschlei\u{df}tiefe [mm], Versuch A, Ritzel",
        "Wear depth in mm, test A, pinion",
        "Wear depth (mm), test A, pinion",
    ] {
        let table = format!(
            "{title}\nradius [mm];100000;250000\n26;0.0521;0.2083\n27;0.0421;0.1783\n28;0.0321;0.1583\n"
        );
        let (shown, written) = rows(&home, &table, "--sigma 1");
        assert!(shown.contains("in mm (the title says so)"), "{shown}");
        assert!(
            written.starts_with("A,pinion,100000,wear_depth,26,52.1,"),
            "{written}"
        );
    }
    for title in [
        "\"Mass loss (g), test A\"",
        "Massenverlust [g], Versuch A",
        "Massenverlust [g] seit Versuchsbeginn, Versuch A",
    ] {
        let table = format!(
            "{title}\nPinion revs;Pinion;Gear\n40000;0.0145;0.0223\n400000;0.1291;0.1840\n"
        );
        let (_, written) = rows(&home, &table, "--quantity mass_loss --sigma 1");
        assert!(
            written.starts_with("A,pinion,40000,mass_loss,,14.5,"),
            "{title}: {written}"
        );
    }
}

/// Nor does a test in it hide that the values are others.
#[test]
fn a_title_that_names_the_test_is_refused_where_the_values_are_others() {
    let home = home();
    let table = "Verschlei\u{df}rate [\u{b5}m/h], Versuch A, Ritzel\nradius [mm];100000;250000\n26;3.1;6.2\n27;1.2;2.5\n";
    let message = refused(&home, table, "--sigma 0.1");
    assert!(message.contains("rates"), "{message}");
}

#[test]
fn inches_in_a_title_are_read() {
    let home = home();
    for title in [
        "Wear depth (in)",
        "Wear depth in inches",
        "Verschlei\u{df} [Zoll]",
    ] {
        let table = format!(
            "{title}\nradius [mm];100000;250000\n26;0.000122;0.000244\n27;0.000047;0.000098\n"
        );
        let (shown, written) = rows(&home, &table, "--test A --member pinion --sigma 0.1");
        assert!(shown.contains("in inches (the title says so)"), "{shown}");
        let value: f64 = written.split(',').nth(5).unwrap().parse().unwrap();
        assert!((value - 0.000122 * 25.4e3).abs() < 1e-6, "{written}");
    }
}

/// Behind rows of another test a table in another unit is refused as it is alone.
#[test]
fn a_table_in_millimetres_is_refused_behind_others_too() {
    let home = home();
    let other = "radius [mm];100000;250000\n26;3.1;6.2\n27;1.2;2.5\n28;1.4;2.6\n";
    let first = import(
        &home,
        other,
        "--test A --member pinion --sigma 0.1 -o own.csv",
    );
    assert_eq!(first.0, Some(0), "{}", first.2);
    // places enough for the scatter of the values
    let depth = |i: u32| 1e-3 * (3.0 + 0.2 * f64::from(i % 3) + 0.1 * f64::from(i));
    let of = |i: u32| {
        let place = 51.5 + 0.1 * f64::from(i);
        format!("{place:.2};{:.4};{:.4}\n", depth(i), 2.0 * depth(i))
    };
    let lines: String = (0..15).map(of).collect();
    let in_mm = format!("radius [mm];100000;250000\n{lines}");
    let message = refused(&home, &in_mm, "--test A --member gear -o own.csv --append");
    assert!(
        message.contains("every wear_depth is smaller than 0.05"),
        "{message}"
    );
}

/// An id of letters and digits in a title needs no word for tests before it.
#[test]
fn a_title_names_its_test_by_an_id_that_is_no_word() {
    let home = home();
    let study = std::fs::read_to_string(home.path().join("study.toml")).unwrap();
    let study = study.replace("id = \"A\"", "id = \"V3\"");
    std::fs::write(home.path().join("study.toml"), study).unwrap();
    let table = "Prüfling V3 Ritzel; Verschleißtiefe in µm\nRadius [mm];5000;20000\n26,1;0,78;2,32\n26,6;0,70;2,00\n27,1;0,59;1,88\n";
    let (_, written) = rows(&home, table, "--sigma 0.1");
    assert!(
        written.contains("V3,pinion,5000,wear_depth,26.1,0.78,"),
        "{written}"
    );
    // a test named A is no such id
    let message = refused(&home, &table.replace("V3", "B"), "--sigma 0.1");
    assert!(message.contains("name the test with --test"), "{message}");
}
