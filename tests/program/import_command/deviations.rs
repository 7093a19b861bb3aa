//! Titles that are obeyed: deviations from the profile become depths, a mass above a table of members is its quantity, and what was used is not said to be
//! passed over.

use super::{home, refused, rows};

const OPTIONS: &str = "--test A --member pinion --sigma 0.1";
const DOWN: &str = "26,5;0,3;-0,7;-1,8\n27,0;0,2;-0,6;-1,2\n";

/// `Profilabweichung` with the new profile at 0: depth is what a place has less than when it was new.
#[test]
fn deviations_with_the_new_profile_are_differences() {
    let home = home();
    let table = format!("Profilabweichung [\u{b5}m]\nRadius [mm];0;250000;500000\n{DOWN}");
    let (shown, written) = rows(&home, &table, OPTIONS);
    for row in [
        "A,pinion,250000,wear_depth,26.5,1,0.1,",
        "A,pinion,500000,wear_depth,26.5,2.1,0.1,",
        "A,pinion,250000,wear_depth,27,0.8,0.1,",
    ] {
        assert!(written.contains(row), "{row} in {written}");
    }
    assert!(!written.contains("A,pinion,0,"), "{written}");
    assert!(
        shown.contains("layout   row 1, `Profilabweichung [\u{b5}m]`: wear depth, the change of the deviation since 0"),
        "{shown}"
    );
    assert!(!shown.contains("passed over"), "{shown}");
    // the same with its sign stated, either way
    let negative = table.replace("[\u{b5}m]", "[\u{b5}m], negativ = Material fehlt");
    assert_eq!(rows(&home, &negative, OPTIONS).1, written);
    let positive = negative
        .replace("negativ", "positiv")
        .replace("0,3;-0,7;-1,8", "-0,3;0,7;1,8")
        .replace("0,2;-0,6;-1,2", "-0,2;0,6;1,2");
    assert_eq!(rows(&home, &positive, OPTIONS).1, written);
    // a place without its new state
    let lacking = table.replace("27,0;0,2", "27,0;");
    let message = refused(&home, &lacking, OPTIONS);
    assert!(
        message.contains("C4: row 1 names deviations") && message.contains("none at 0"),
        "{message}"
    );
}

#[test]
fn deviations_without_the_new_profile_need_a_sign() {
    let home = home();
    let table =
        "Profilabweichung [\u{b5}m]\nRadius [mm];250000;500000\n26,5;-0,7;-1,8\n27,0;-0,6;-1,2\n";
    let message = refused(&home, table, OPTIONS);
    assert!(
        message.contains("row 1: `Profilabweichung [\u{b5}m]` names deviations, of which 4 of 4 are negative, and none is of the new profile: write"),
        "{message}"
    );
    let stated = table.replace("[\u{b5}m]", "[\u{b5}m]; negativ = Material fehlt");
    for (table, options) in [
        (table, format!("{OPTIONS} --turn-sign")),
        (stated.as_str(), OPTIONS.to_owned()),
    ] {
        let (_, written) = rows(&home, table, &options);
        assert!(
            written.contains("A,pinion,500000,wear_depth,26.5,1.8,0.1,"),
            "{written}"
        );
    }
    // depths stay what they are
    let depths = table.replace("Profilabweichung", "Verschlei\u{df}");
    let (_, written) = rows(&home, &depths, OPTIONS);
    assert!(written.contains(",26.5,-1.8,"), "{written}");
}

/// A row for each value is asked as a column for each checkpoint is.
#[test]
fn deviations_of_long_tables_need_a_sign_or_the_new_profile() {
    let home = home();
    let header = "Rad;Umdrehungen;Radius [mm];Profilabweichung [\u{b5}m]\n";
    let worn = "Ritzel;250000;26,5;-0,7\nRitzel;500000;26,5;-1,8\n";
    let options = "--test A --sigma 0.1";
    let last = |value: &str| format!("A,pinion,500000,wear_depth,26.5,{value},0.1,");
    for values in [worn.to_owned(), worn.replace(";-", ";")] {
        let message = refused(&home, &format!("{header}{values}"), options);
        assert!(
            message.contains("D1: `Profilabweichung [\u{b5}m]` names deviations, of which")
                && message.contains("and none is of the new profile: write"),
            "{message}"
        );
    }
    let (_, written) = rows(
        &home,
        &format!("{header}{worn}"),
        &format!("{options} --turn-sign"),
    );
    assert!(written.contains(&last("1.8")), "{written}");
    let (_, written) = rows(
        &home,
        &format!("{header}{worn}"),
        &format!("{options} --quantity wear_depth"),
    );
    assert!(written.contains(&last("-1.8")), "{written}");
    // what was worn is the change since the new profile
    let new = format!("{header}Ritzel;0;26,5;0,3\n{worn}");
    let (shown, written) = rows(&home, &new, options);
    assert!(
        written.contains(&last("2.1")) && !written.contains("A,pinion,0,"),
        "{written}"
    );
    assert!(
        shown.contains(
            "layout   D1, `Profilabweichung [\u{b5}m]`: wear depth, the change of the deviation since 0"
        ),
        "{shown}"
    );
}

#[test]
fn a_mass_above_a_table_of_members_is_its_quantity() {
    let home = home();
    let table =
        "Massenverlust [g]\nLastwechsel;Ritzel;Rad\n250000;0,012;0,015\n500000;0,020;0,024\n";
    let (shown, written) = rows(&home, table, "--test A --sigma 1");
    assert!(
        written.contains("A,gear,250000,mass_loss,,15,1,"),
        "{written}"
    );
    assert!(shown.contains("in g (the title says so)"), "{shown}");
    assert!(!shown.contains("passed over"), "{shown}");
}

#[test]
fn a_title_that_is_obeyed_is_not_passed_over() {
    let home = home();
    let table = "Versuch: A\nBauteil: Ritzel\nFlanke: rechts\nPr\u{fc}fer: M. Muster\nVerschlei\u{df} in \u{b5}m\nRadius [mm];250000\n26,5;0,7\n27,0;0,6\n";
    let (shown, _) = rows(&home, table, "--sigma 0.1");
    assert!(
        shown.contains("layout   row 1, `Versuch`: test A\n"),
        "{shown}"
    );
    assert!(
        shown.contains("layout   row 2, `Bauteil`: member pinion\n"),
        "{shown}"
    );
    assert_eq!(shown.matches("passed over").count(), 1, "{shown}");
    assert!(
        shown.contains("title    row 4 passed over: Pr\u{fc}fer: M. Muster"),
        "{shown}"
    );
}

/// What stands in other rows, and deviations of other things than profiles, turn nothing round; what the user states wins.
#[test]
fn only_deviations_of_profiles_are_turned_round() {
    let home = home();
    let down = "radius;0;10000;20000\n26.5;2.0;1.0;0.5\n27.0;1.0;0.5;0.1\n";
    let table = format!("Wear test 7\nProfile deviation [um]\n{down}");
    let (_, written) = rows(&home, &table, OPTIONS);
    assert!(
        written.contains("A,pinion,20000,wear_depth,26.5,1.5,0.1,"),
        "{written}"
    );
    let stated = format!("{OPTIONS} --quantity wear_depth");
    for (title, options) in [
        ("Torque deviation below 2 percent", OPTIONS),
        ("Profile deviation [um]", stated.as_str()),
    ] {
        let (_, written) = rows(&home, &format!("{title}\n{down}"), options);
        assert!(
            written.contains("A,pinion,20000,wear_depth,26.5,0.5,0.1,"),
            "{title}: {written}"
        );
    }
}

/// Without a sign nothing is read where nothing shows which one it is.
#[test]
fn deviations_that_do_not_show_their_sign_are_refused() {
    let home = home();
    for (down, why) in [
        (
            "radius;10000;20000\n26.5;2.0;1.0\n27.0;1.0;-0.5\n",
            "1 of 4 are negative, and none is of the new profile",
        ),
        (
            "radius;0;10000;20000\n26.5;0;1.0;2.0\n27.0;0;0.5;1.0\n",
            "all 0 at 0, and 4 of 4 depths would be negative",
        ),
        (
            "radius;0\n26.5;2.0\n27.0;1.0\n",
            "at 0 alone, of the new profile",
        ),
    ] {
        let message = refused(&home, &format!("Profile deviation [um]\n{down}"), OPTIONS);
        assert!(message.contains(why), "{message}");
    }
}

#[test]
fn missing_values_say_nothing_of_the_sign() {
    let home = home();
    let down = "radius;10000;20000\n26.5;1.0;2.0\n27.0;0.5;0.7\n";
    let (_, written) = rows(
        &home,
        &format!("Missing values are negative\nVerschleiss [um]\n{down}"),
        OPTIONS,
    );
    assert!(
        written.contains("A,pinion,20000,wear_depth,26.5,2,0.1,"),
        "{written}"
    );
}

/// A title may say after what the profile was measured; one that speaks of wear first means depths, and these are nothing at the start.
#[test]
fn a_title_that_names_wear_behind_deviations_is_one_of_deviations() {
    let home = home();
    let table = |title: &str| {
        format!("{title};;\nradius [mm];0;250000\n26,5;-6,0;-7,0\n27,0;0,5;-0,5\n27,5;0,0;-1,5\n")
    };
    let options = "--test A --member pinion --sigma 0.1";
    let title = "Profilabweichung nach Verschlei\u{df} [\u{b5}m]";
    let (_, written) = rows(&home, &table(title), options);
    assert!(
        written.contains("A,pinion,250000,wear_depth,26.5,1,0.1,")
            && !written.contains("A,pinion,0,"),
        "{written}"
    );
    let (shown, _) = rows(&home, &table("Verschlei\u{df}, Profil [\u{b5}m]"), options);
    assert!(
        shown.contains("after 0 cycles at 26.5: -6 \u{b5}m, where nothing is worn yet"),
        "{shown}"
    );
}
