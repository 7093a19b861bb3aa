//! Powers of ten in headers of cycles, and the decimal mark of depths that the program works out itself.

use super::doubtful::{text, workbook_of};
use super::{home, line, read, refused, rows, succeed};

const OPTIONS: &str = "--test A --member pinion --sigma 0.1";

/// `Lastwechsel [1E6]` is the unit of the checkpoints, wherever these stand, and no checkpoint itself.
#[test]
fn a_power_of_ten_beside_cycles_is_their_unit() {
    let home = home();
    let down = "26,5;0,5;1,0;2,0\n27,0;0,4;0,8;1,5\n";
    for text in [
        // above the header, in the first cell, and as the name of the first column
        format!(";Lastwechsel [1E6];;\nRadius [mm];0,25;0,5;1\n{down}"),
        format!("Lastwechsel [1E6];0,25;0,5;1\n{down}"),
        "Lastwechsel [10^6];26,5;27,0\n0,25;0,5;0,4\n0,5;1,0;0,8\n1;2,0;1,5\n".to_owned(),
        "Lastwechsel [Mio.];Radius [mm];Verschlei\u{df} [\u{b5}m]\n0,25;26,5;0,5\n0,25;27,0;0,4\n\
         0,5;26,5;1,0\n0,5;27,0;0,8\n1;26,5;2,0\n1;27,0;1,5\n"
            .to_owned(),
    ] {
        let (shown, written) = rows(&home, &text, OPTIONS);
        for row in [
            "A,pinion,250000,wear_depth,26.5,0.5,0.1,",
            "A,pinion,500000,wear_depth,27,0.8,0.1,",
            "A,pinion,1000000,wear_depth,26.5,2,0.1,",
        ] {
            assert!(written.contains(row), "{row} in {written}");
        }
        let said = shown.contains("each 1 stands for 1000000 revolutions")
            || shown.contains("cycles, 1000000 pinion revolutions each");
        assert!(said, "{shown}");
    }
    let masses = "Lastwechsel [1E3];Ritzel;Rad\n0;100,5;200,5\n250;100,4;200,1\n";
    let (shown, written) = rows(
        &home,
        masses,
        "--test A --quantity mass_loss --unit g --sigma 1",
    );
    assert!(
        written.contains("A,gear,250000,mass_loss,,400,1"),
        "{written}"
    );
    assert!(
        shown.contains("each 1 stands for 1000 revolutions"),
        "{shown}"
    );
}

/// Those of the gear stay those of the gear, and counts in full are not multiplied once more.
#[test]
fn a_power_of_ten_does_not_hide_what_else_is_said() {
    let home = home();
    let text = ";Lastwechsel Rad [1E6];\nRadius [mm];0,135;0,27\n26,5;0,5;1,0\n";
    let (shown, written) = rows(&home, text, OPTIONS);
    assert!(written.contains("A,pinion,530000,"), "{written}");
    assert!(shown.contains("from revolutions of the gear"), "{shown}");
    let text = "Lastwechsel [1E6];250000;500000\n26,5;0,5;1,0\n";
    let message = refused(&home, text, OPTIONS);
    assert!(
        message.contains("A1: `Lastwechsel [1E6]`: 250000 would be 2.5e11 revolutions"),
        "{message}"
    );
}

/// Counts that nothing says to be millions are read as they stand, and what they look like is told before anything is written.
#[test]
fn counts_that_look_like_millions_are_warned_of() {
    let home = home();
    let text = "Radius [mm];0,25;0,5;1\n26,5;0,5;1,0;2,0\n27,0;0,4;0,8;1,5\n";
    let (shown, _) = rows(&home, text, OPTIONS);
    assert!(
        shown.contains(
            "warning  the rows of test A end at 1.0 cycles where the study states 1000000"
        ),
        "{shown}"
    );
    assert!(shown.contains("they look like millions"), "{shown}");
}

/// A depth from whole deviations is written with the decimal commas of the other numbers.
#[test]
fn whole_deviations_stand_beside_decimal_commas() {
    let home = home();
    let header = "Radius [mm];Abweichung vorher [\u{b5}m];Abweichung nachher [\u{b5}m]";
    let text = format!("{header}\n26,5;2;0\n27,0;1,5;0,4\n27,5;1;0\n");
    let (_, written) = rows(&home, &text, &format!("{OPTIONS} --cycles 1000000"));
    for row in ["26.5,2,0.1,", "27,1.1,0.1,", "27.5,1,0.1,"] {
        let row = format!("A,pinion,1000000,wear_depth,{row}");
        assert!(written.contains(&row), "{row} in {written}");
    }
}

/// Millions behind `in`, in every header, and beside other names of load cycles.
#[test]
fn multiples_are_read_however_they_are_written() {
    let home = home();
    let down = "26,5;0,5;1,0;2,0\n27;0,4;0,8;1,5\n";
    for text in [
        format!("Verschlei\u{df} [\u{b5}m], Lastwechsel in Mio.\nRadius [mm];0,25;0,5;1\n{down}"),
        format!("Lastwechsel in Mio.;0,25;0,5;1\n{down}"),
        format!("Radius [mm];0,25 [1E6];0,5 [1E6];1 [1E6]\n{down}"),
        format!("Radius [mm];Lastwechsel 0,25 [1E6];Lastwechsel 0,5 [1E6];Lastwechsel 1 [1E6]\n{down}"),
        format!("Lastspielzahl [10^6];0,25;0,5;1\n{down}"),
        "Lastspielzahl in Mio.;Radius [mm];Verschlei\u{df} [\u{b5}m]\n0,25;26,5;0,5\n0,25;27,0;0,4\n\
         0,5;26,5;1,0\n0,5;27,0;0,8\n1;26,5;2,0\n1;27,0;1,5\n"
            .to_owned(),
    ] {
        let (shown, written) = rows(&home, &text, OPTIONS);
        for row in [
            "A,pinion,250000,wear_depth,26.5,0.5,0.1,",
            "A,pinion,500000,wear_depth,27,0.8,0.1,",
            "A,pinion,1000000,wear_depth,26.5,2,0.1,",
        ] {
            assert!(written.contains(row), "{row} in {written}\nof {text}");
        }
        let said = ["each 1 stands for 1000000 revolutions", "`: 250000 revolutions and the like", "1000000 pinion revolutions each"];
        assert!(said.iter().any(|words| shown.contains(words)), "{shown}");
        assert!(!shown.contains("passed over"), "{shown}");
    }
}

/// A number of a title is no count, and the title's multiple holds for what stands below.
#[test]
fn numbers_of_titles_are_no_counts() {
    let home = home();
    let table =
        "Test 12, load cycles [10^6]\nwear [um]\nradius;0.01;0.02\n26.5;1.0;2.0\n27.0;0.5;0.7\n";
    let (_, written) = rows(&home, table, OPTIONS);
    assert!(
        written.contains("A,pinion,20000,wear_depth,26.5,2,0.1,"),
        "{written}"
    );
    let table = "Pruefstand 3 (1E3)\nVerschleiss [um]\nradius;10000;20000\n26.5;1.0;2.0\n";
    let message = refused(&home, table, OPTIONS);
    assert!(
        message.contains("row 1: `Pruefstand 3 (1E3)` speaks of `a power of ten`"),
        "{message}"
    );
}

/// A header with a multiple in words stays one above a row of units, which are those of its columns.
#[test]
fn a_row_of_units_makes_no_title_of_the_header() {
    let home = home();
    let header = "Test;Lastwechsel in Mio.;Radius;Verschleiss";
    let table = format!("{header}\n;;mm;um\nA;0.01;26.5;1.0\n");
    for table in [table.replace(";;", "-;-;"), table] {
        let (shown, written) = rows(&home, &table, "--member pinion --sigma 0.1");
        assert_eq!(
            written, "A,pinion,10000,wear_depth,26.5,1,0.1,\n",
            "{table}"
        );
        assert!(
            shown.contains("layout   row 2 holds the columns' units\n"),
            "{shown}"
        );
    }
    let table = format!("{header}\n;;;\nA;0.01;26.5;1.0\nA;0.02;26.5;2.0\n");
    let (_, written) = rows(&home, &table, "--member pinion --sigma 0.1");
    assert!(
        written.contains("A,pinion,20000,wear_depth,26.5,2,0.1,"),
        "{written}"
    );
}

/// Commas between the thousands of the headers, where the values have points as decimal marks.
#[test]
fn english_thousands_are_read_above_values_with_points() {
    let home = home();
    let table = "radius [mm],\"40,000 rev\",\"250,000 rev\"\n26.5,1.25,3.5\n27.5,0.75,2.5\n";
    let (_, written) = rows(&home, table, "--test A --member pinion --sigma 0.1");
    assert!(
        written.contains("A,pinion,40000,wear_depth,26.5,1.25,")
            && written.contains("A,pinion,250000,wear_depth,26.5,3.5,"),
        "{written}"
    );
    // `0,250` is no number of thousands, nor what stands beside it
    let table = "radius [mm],\"0,250\",\"1,000\"\n26.5,1.25,3.5\n27.5,0.75,2.5\n";
    let message = refused(&home, table, "--test A --member pinion --sigma 0.1");
    assert!(message.contains("1,000"), "{message}");
    // with decimal commas below nobody knows
    let table = "radius [mm];40,000 rev;250,000 rev\n26,5;1,25;3,5\n27,5;0,75;2,5\n";
    let message = refused(&home, table, "--test A --member pinion --sigma 0.1");
    assert!(message.contains("marked between thousands"), "{message}");
}

/// Two marks of a kind can only stand between thousands, and tell of a single one in the same column.
#[test]
fn counts_with_several_marks_are_read() {
    let home = home();
    let table = "Versuch;Rad;Lastspiele;Radius [mm];Verschlei\u{df} [\u{b5}m]\nA;Ritzel;250.000;26,5;1,2\nA;Ritzel;1.000.000;26,5;2,4\n";
    let (_, written) = rows(&home, table, "--sigma 0.1");
    assert!(
        written.contains("A,pinion,250000,wear_depth,26.5,1.2,")
            && written.contains("A,pinion,1000000,wear_depth,26.5,2.4,"),
        "{written}"
    );
    // down the first column of a wide table
    let table = "Lastspiele;26,5;27,0\n500.000;1,5;0,5\n1.000.000;2,5;1,5\n";
    let (_, written) = rows(&home, table, "--test A --member pinion --sigma 0.1");
    assert!(
        written.contains("A,pinion,500000,wear_depth,26.5,1.5,")
            && written.contains("A,pinion,1000000,wear_depth,27,1.5,"),
        "{written}"
    );
    // a single one alone may be either
    let alone = "test;member;cycles;radius;depth\nA;pinion;13.333;26.5;1.2\n";
    let message = refused(&home, alone, "--sigma 0.1");
    assert!(
        message.contains("13.333: is that 13333, or 13.333 with decimals?"),
        "{message}"
    );
}

/// What decides in measurement files decides here: beside decimal commas a point in a count stands between its thousands.
#[test]
fn points_between_thousands_of_counts_beside_decimal_commas() {
    let home = home();
    let table = |cycles: &str, value: &str| {
        format!(
            "Versuch;Teil;Umdrehungen;Radius [mm];Verschlei\u{df} [\u{b5}m]\nA;Ritzel;{cycles};26,5;{value}\n"
        )
    };
    let (_, written) = rows(&home, &table("40.000", "0,278"), "--sigma 0.1");
    assert!(
        written.starts_with("A,pinion,40000,wear_depth,26.5,0.278,"),
        "{written}"
    );
    // `1000.000` in the same column has decimals
    let both = table("40.000", "0,278") + "A;Ritzel;1000.000;26,5;1,278\n";
    let message = refused(&home, &both, "--sigma 0.1");
    assert!(message.contains("C2"), "{message}");
    // beside `0,15` millions have decimals, in a column and above one; `check` says what they look like
    let millions = table("0,15", "0,278") + "A;Ritzel;1,125;26,5;1,278\n";
    let (_, written) = rows(&home, &millions, "--sigma 0.1");
    assert!(written.contains("A,pinion,1.125,wear_depth,"), "{written}");
    let wide = "radius [mm],0.15,1.125\n26.5,1.25,3.5\n27.5,0.75,2.5\n";
    let (_, written) = rows(&home, wide, "--test A --member pinion --sigma 0.1");
    assert!(written.contains("A,pinion,1.125,wear_depth,"), "{written}");
}

/// Cells that hold no number say what to do about them.
#[test]
fn cells_that_hold_no_number_are_told_from_each_other() {
    let home = home();
    let message = |value: &str| {
        let table = format!(
            "Versuch;Teil;Umdrehungen;Radius [mm];Verschlei\u{df} [\u{b5}m]\nA;Ritzel;40000;26,5;0,278\nA;Ritzel;40000;27;{value}\n"
        );
        refused(&home, &table, "--sigma 0.1")
    };
    assert!(message("0,630 \u{b5}m").contains("write the unit into the header"));
    assert!(message("03.Dez").contains("made a date of it"));
    assert!(message("Verschlei\u{df} [\u{b5}m]").contains("delete that row"));
}

#[test]
fn points_between_thousands_are_told_by_the_length_of_the_test() {
    let home = home();
    let stated = "--test A --member pinion --unit um --sigma 0.1";
    let table = "radius [mm];nach 40.000 U;nach 250.000 U\n26;1;3\n27;2;5\n";
    let (_, written) = rows(&home, table, stated);
    assert!(
        written.contains("A,pinion,40000,wear_depth,26,1"),
        "{written}"
    );
    assert!(
        written.contains("A,pinion,250000,wear_depth,27,5"),
        "{written}"
    );
    // 2000 and 4000 revolutions are as likely as 2 and 4 in a test of a million
    let early = table.replace("40.000", "2.000").replace("250.000", "4.000");
    let message = refused(&home, &early, stated);
    assert!(message.contains("marked between thousands"), "{message}");
    // beside decimal points they are none between thousands
    let points = table.replace("27;2;5", "27;2.5;5");
    let message = refused(&home, &points, stated);
    assert!(message.contains("marked between thousands"), "{message}");
}

/// Blanks between thousands are plain ones where people type them, and no-break ones where programs write them.
#[test]
fn blanks_between_thousands_of_counts_are_left_out() {
    let home = home();
    let long = "Prova;Ruota;Cicli;Raggio [mm];Usura [\u{b5}m]\nA;pignone;80 000;26,5;1,293\nA;pignone;1 000 000;26,5;2,293\n";
    let wide = "Cicli;26,5;27\n80 000;1,293;1,1\n1 000 000;2,293;2,1\n";
    for (table, options) in [
        (long, "--sigma 0.1"),
        (wide, "--test A --member pinion --sigma 0.1"),
    ] {
        let (_, written) = rows(&home, table, options);
        assert!(
            written.contains("A,pinion,80000,wear_depth,26.5,1.293,")
                && written.contains("A,pinion,1000000,wear_depth,26.5,2.293,"),
            "{table}{written}"
        );
    }
    let message = refused(&home, &long.replace("80 000", "80 00"), "--sigma 0.1");
    assert!(message.contains("`80 00` is not a number"), "{message}");
}

/// Numbers that a spreadsheet holds as texts are read as those of a text are: beside decimal commas a point in a count stands between its thousands.
#[test]
fn counts_that_a_spreadsheet_holds_as_texts_are_read_beside_decimal_commas() {
    let home = home();
    let row = |cells: [&str; 5]| cells.map(text).concat();
    let header = row([
        "Versuch",
        "Rad",
        "Lastwechsel",
        "Radius [mm]",
        "Verschlei\u{df} [\u{b5}m]",
    ]);
    let import = "import dated.xlsx --study study.toml --sigma 0.1";
    let first = row(["A", "Ritzel", "80.000", "26,961", "1,293"]);
    let second = row(["A", "Ritzel", "81.234", "27,262", "0,951"]);
    workbook_of(&home, &[("w", &[&header, &first, &second])]);
    succeed(&home, &format!("{import} -o out.csv"));
    let written = read(&home, "out.csv");
    assert!(
        written.contains("A,pinion,80000,wear_depth,26.961,1.293,")
            && written.contains("A,pinion,81234,wear_depth,27.262,0.951,"),
        "{written}"
    );
    // beside numbers of its own nobody knows
    let number = |cell: &str| format!("<c><v>{cell}</v></c>");
    let own = [
        text("A"),
        text("Ritzel"),
        text("80.000"),
        number("26.961"),
        number("1.293"),
    ]
    .concat();
    workbook_of(&home, &[("w", &[&header, &own])]);
    let (code, _, message) = line(&home, import);
    assert_eq!(code, Some(2));
    assert!(message.contains("marked between thousands"), "{message}");
}
