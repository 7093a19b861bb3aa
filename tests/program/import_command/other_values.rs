//! Tables of which the numbers are not what they would be read as: teeth for checkpoints, rates and the like for depths.

use super::*;

#[test]
fn a_title_that_speaks_of_other_values_is_refused() {
    let home = home();
    for (title, says) in [
        ("Depth [0.1 um]", "a number with the unit (0.1 um)"),
        ("Wear depth in 1/1000 mm", "1/1000 mm"),
        ("Verschlei\u{df}rate [\u{b5}m/h]", "rates"),
        ("Wear depth [%]", "values in %"),
        ("Verschlei\u{df} beider Flanken [\u{b5}m]", "both flanks"),
        ("wear since last inspection [um]", "increments"),
    ] {
        let table = format!("{title}\nradius [mm];100000;250000\n26;3.1;6.2\n27;1.2;2.5\n");
        let message = refused(&home, &table, "--test A --member pinion --sigma 0.1");
        assert!(
            message.contains(says) && message.contains("row 1"),
            "{message}"
        );
    }
    let table = "mass loss per tooth [mg]\nmember;100000;250000\npinion;0.31;0.62\n";
    let message = refused(&home, table, "--test A --sigma 0.01 --quantity mass_loss");
    assert!(message.contains("single teeth"), "{message}");
}

#[test]
fn numbers_of_teeth_are_no_checkpoints() {
    let home = home();
    let table = "radius [mm];Zahn 1;Zahn 7\n26;3.1;3.4\n27;1.2;1.5\n28;1.4;1.6\n";
    let options = "--member pinion --sigma 0.1 --test A";
    let (shown, written) = rows(&home, table, &format!("{options} --cycles 250000"));
    assert!(
        shown.contains("a curve of each of the teeth 1, 7"),
        "{shown}"
    );
    assert_eq!(written.lines().count(), 6, "{written}");
    assert!(
        written.contains("A,pinion,250000,wear_depth,27,1.5,0.1,A-pinion-250000-tooth7"),
        "{written}"
    );
    // the title says when
    let titled = format!("Revolutions of pinion: 250000\n{table}");
    let (_, same) = rows(&home, &titled, options);
    assert_eq!(same, written);
    // a message names a cell where it stands
    let slipped = table.replace("1.5", "x");
    let message = refused(&home, &slipped, &format!("{options} --cycles 250000"));
    assert!(message.contains("C3"), "{message}");
    // and without
    let message = refused(&home, table, options);
    assert!(message.contains("with --cycles"), "{message}");
    // nor are those of profiles and positions
    for word in ["profile", "position", "trace"] {
        let table = format!("radius [mm];{word} 1;{word} 2\n26;3.1;3.4\n27;1.2;1.5\n28;1.4;1.6\n");
        let message = refused(&home, &table, options);
        assert!(
            message.contains("counts stages, teeth or measurements"),
            "{message}"
        );
    }
}

#[test]
fn masses_with_members_down_the_first_column_are_known_by_their_title() {
    let home = home();
    let options = "--test A --sigma 0.1";
    for table in [
        "Massenverlust [mg]\n;100000;250000\nRitzel;3,1;6,2\nRad;4,1;8,3\n",
        "Massenverlust [mg];100000;250000\nRitzel;3,1;6,2\nRad;4,1;8,3\n",
    ] {
        let (_, written) = rows(&home, table, options);
        assert!(
            written.contains("A,pinion,250000,mass_loss,,6.2,0.1,")
                && written.contains("A,gear,100000,mass_loss,,4.1,0.1,"),
            "{written}"
        );
    }
}
