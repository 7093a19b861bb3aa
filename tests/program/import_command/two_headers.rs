//! Tables whose header is more than one row, or whose members stand in a row of their own.

use super::*;

/// The rows of the file that a table becomes.
fn imported(home: &TempDir, table: &str, options: &str) -> String {
    rows(home, table, options).1
}

#[test]
fn a_checkpoint_stands_above_its_value_and_sigma() {
    let home = home();
    let flank = "Verschlei\u{df}tiefe Ritzel [\u{b5}m], Versuch A;;;;\n;80.000 LW;;200.000 LW;\n\
                 Radius [mm];Wert;Streuung;Wert;Streuung\n26,0;2,31;0,10;5,02;0,12\n26,5;1,91;0,10;4,12;0,12\n27,0;1,20;0,10;2,82;0,12\n";
    let file = imported(&home, flank, "");
    assert!(
        file.contains("A,pinion,80000,wear_depth,26,2.31,0.1,"),
        "{file}"
    );
    assert!(
        file.contains("A,pinion,200000,wear_depth,27,2.82,0.12,"),
        "{file}"
    );
    let masses = "Perdita di massa [g];;;;;;\n;;Ciclo 80000;;Ciclo 200000;;\nProva;Elemento;Perdita;Dev. std;Perdita;Dev. std;\n\
                  A;pignone;0,0124;0,0005;0,0301;0,0006;\nA;ruota;0,0129;0,0005;0,0297;0,0006;\n";
    let (code, _, told) = import(&home, masses, "");
    assert_eq!(code, Some(2));
    assert!(
        told.contains("write its unit in the header too: the values are in g"),
        "{told}"
    );
    let masses = masses.replace("Dev. std", "Dev. std [g]");
    let file = imported(&home, &masses, "");
    assert!(
        file.contains("A,pinion,80000,mass_loss,,12.4,0.5"),
        "{file}"
    );
    assert!(file.contains("A,gear,200000,mass_loss,,29.7,0.6"), "{file}");
}

#[test]
fn a_row_of_members_says_whose_the_columns_below_it_are() {
    let home = home();
    let rows = [
        "18;2,31;5,02;;18;1,31;3,02",
        "20;1,91;4,12;;20;1,11;2,62",
        "22;1,20;2,82;;22;0,80;1,82",
    ];
    let side_by_side = format!(
        "Prova A\nUsura [\u{b5}m]\nPignone;;;;Corona;;\nAngolo di rotolamento [deg];80.000 cicli;200.000 cicli;;Angolo di rotolamento [deg];80.000 cicli;200.000 \
         cicli\n{}\n",
        rows.join("\n")
    );
    let file = imported(&home, &side_by_side, "--sigma 0.2");
    let of = |member: &str| file.lines().filter(|line| line.contains(member)).count();
    assert_eq!((of("A,pinion,"), of("A,gear,")), (6, 6), "{file}");
    // the tests of each member in a second row
    let labelled = "Depth [um]\n,Pinion,,Gear,\n,A,,B,\nRoll angle [deg],80000,200000,80000,200000\n18,2.31,5.02,1.31,3.02\n20,1.91,4.12,1.11,2.62\n";
    let file = imported(&home, labelled, "--sigma 0.2");
    assert!(
        file.contains("A,pinion,80000") && file.contains("B,gear,200000"),
        "{file}"
    );
    assert!(
        !file.contains("A,gear") && !file.contains("B,pinion"),
        "{file}"
    );
}

#[test]
fn weighings_of_both_members_stand_in_one_row() {
    let home = home();
    let table = "Versuch;Ritzel m0 [g];Ritzel 80.000 LW [g];Ritzel 200.000 LW [g];Rad m0 [g];Rad 80.000 LW [g];Rad 200.000 LW [g]\n\
                 A;612,4312;612,4097;612,3758;1893,1177;1893,0954;1893,0700\n";
    let file = imported(&home, table, "--sigma 0.2");
    assert!(file.contains("A,pinion,80000,mass_loss,,21.5"), "{file}");
    assert!(file.contains("A,gear,200000,mass_loss,,47.7"), "{file}");
}
