//! Tables with a column for each checkpoint or place.

use super::*;

#[test]
fn a_sheet_with_a_column_for_each_checkpoint_is_shown_and_then_written() {
    let home = home();
    let shown = succeed(&home, PINION);
    for part in [
        "table    tables.xlsx, sheet pinion\n",
        "header   row of A3 `radius [mm]`\n",
        "down     radius, mm, 26 to 28.5\n",
        "across   pinion revolutions, 100000 250000\n",
        "values   wear_depth of the pinion in test A, in mm, their sign turned\n",
        "empty    1 cell without a value passed over\n",
        "A,pinion,100000,wear_depth,26,3.1,0.2,A-pinion-100000\n",
        "nothing is written yet",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    assert!(!home.path().join("m.csv").exists());
    let told = succeed(&home, &format!("{PINION} -o m.csv"));
    assert!(
        told.ends_with("wrote m.csv: 5 rows\nnext: gearwear check study.toml\n"),
        "{told}"
    );
    assert_eq!(
        read(&home, "m.csv"),
        "test,member,cycles,quantity,position,value,sigma,trace\n\
         A,pinion,100000,wear_depth,26,3.1,0.2,A-pinion-100000\n\
         A,pinion,100000,wear_depth,27,1.2,0.2,A-pinion-100000\n\
         A,pinion,100000,wear_depth,28.5,1.7,0.2,A-pinion-100000\n\
         A,pinion,250000,wear_depth,26,6.2,0.2,A-pinion-250000\n\
         A,pinion,250000,wear_depth,27,2.5,0.2,A-pinion-250000\n"
    );
    // the other orientation, behind the rows that are there
    let gear = "import tables.xlsx --sheet gear --study study.toml --test A --member gear --sigma 0.1 --no-traces -o m.csv";
    let (code, _, message) = line(&home, gear);
    assert_eq!(code, Some(2));
    assert!(
        message.contains("--append") && message.contains("--force"),
        "{message}"
    );
    succeed(&home, &format!("{gear} --append"));
    let rows = read(&home, "m.csv");
    assert_eq!(rows.lines().count(), 10, "{rows}");
    assert!(
        rows.ends_with(
            "A,gear,250000,wear_depth,52,2.9,0.1,\nA,gear,250000,wear_depth,53.5,1.4,0.1,\n"
        ),
        "{rows}"
    );
    // a sheet that is a measurement file is one
    let told = succeed(
        &home,
        "import tables.xlsx --sheet rows --study study.toml -o rows.csv",
    );
    // which is not the one that the study reads
    assert!(
        told.contains(
            "the study reads m.csv: put file = \"rows.csv\" under its [measurements]\nnext: "
        ),
        "{told}"
    );
    assert_eq!(
        read(&home, "rows.csv"),
        "test,member,cycles,quantity,position,value,sigma,trace\n\
         A,pinion,100000,wear_depth,26.5,2.5,0.1,p1\nA,gear,100000,mass_loss,,55,1.5,\n"
    );
}

#[test]
fn roll_angles_and_lengths_are_radii() {
    let home = home();
    let radii = |header: &str, places: [&str; 2], options: &str| {
        let text = format!("{header};100000\n{};1,5\n{};2,5\n", places[0], places[1]);
        fs::write(home.path().join("table.csv"), text).unwrap();
        let told = succeed(
            &home,
            &format!(
                "import table.csv --study study.toml --test A --sigma 0.2 -o out.csv --force {options}"
            ),
        );
        let rows = read(&home, "out.csv");
        let radius = |row: &str| row.split(',').nth(4).unwrap().parse::<f64>().unwrap();
        let found: Vec<f64> = rows.lines().skip(1).map(radius).collect();
        (found, told)
    };
    let near = |found: &[f64], expected: [f64; 2]| {
        assert!(
            found
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 1e-7),
            "{found:?}"
        );
    };
    let (by_angle, told) = radii("roll angle [deg]", ["12", "24"], "");
    near(&by_angle, [25.92219240, 27.50764687]);
    assert!(
        told.contains("down     roll angle, deg, 12 to 24"),
        "{told}"
    );
    let (by_length, _) = radii("where", ["7", "12,5"], "--position roll-length");
    near(&by_length, [26.31963525, 28.28379747]);
    let (by_diameter, _) = radii("diameter", ["52", "57"], "");
    near(&by_diameter, [26.0, 28.5]);
}

#[test]
fn headers_with_units_other_marks_and_repeated_measurements_are_read() {
    let home = home();
    let import = |text: &str, options: &str| {
        fs::write(home.path().join("table.csv"), text).unwrap();
        let command = format!("import table.csv --study study.toml --test A --sigma 0.2 {options}");
        line(&home, &command)
    };
    let rows = |options: &str, text: &str| {
        let (code, told, error) = import(text, options);
        assert_eq!(code, Some(0), "{error}");
        (told, read(&home, "out.csv"))
    };
    let (told, written) = rows(
        "-o out.csv",
        "Radius [mm];Verschlei\u{df} [mm] nach 250000\n26,5;0,001\n27,5;0,0025\n",
    );
    assert!(told.contains("in mm (the header says so)"), "{told}");
    assert!(
        written.contains("250000,wear_depth,26.5,1,0.2"),
        "{written}"
    );
    assert!(
        written.contains("250000,wear_depth,27.5,2.5,0.2"),
        "{written}"
    );
    let unclear = "radius;100000\n26.500;1.234\n27.000;2.512\n";
    let (_, written) = rows("-o out.csv --force --decimal point", unclear);
    assert!(written.contains("wear_depth,26.5,1.234,"), "{written}");
    // one number that can be no thousand tells
    let (_, written) = rows(
        "-o out.csv --force",
        "radius;100000\n26.500;1.234\n27.000;0.512\n",
    );
    assert!(written.contains("wear_depth,27,0.512,"), "{written}");
    // scatter that grows with the value: √(0.2² + (0.3·1)²)
    let (told, _) = rows(
        "-o rel.csv --relative-sigma 0.3",
        "radius;100000\n26,5;1,0\n",
    );
    assert!(
        told.contains("0.2 µm and 30 % of the value, as the root of their squares"),
        "{told}"
    );
    assert!(read(&home, "rel.csv").contains("26.5,1,0.3606,"));
    // the same table once more is a mistake, a repeated measurement is none
    let (code, _, error) = import(unclear, "-o out.csv --append --decimal point");
    assert_eq!(
        (code, error.contains("--repeat 2")),
        (Some(2), true),
        "{error}"
    );
    let (_, written) = rows("-o out.csv --append --decimal point --repeat 2", unclear);
    assert!(written.ends_with(",A-pinion-100000-r2\n"), "{written}");
    assert_eq!(written.lines().count(), 5, "{written}");
}

/// Revolutions by their short names, points between thousands above decimal commas, and thousands behind each number.
#[test]
fn counts_in_headers_are_read_as_people_write_them() {
    let home = home();
    let wide = |one: &str, two: &str| {
        format!("Radius [mm];{one};{two}\n26,512;0,885;1,027\n27,133;0,810;0,940\n")
    };
    let options = "--test A --member pinion --sigma 0.1";
    for (one, two) in [
        ("40000 Umdr. Ritzel", "100000 Umdr. Ritzel"),
        ("40000 U", "100000 U"),
        ("40000 rev pinion", "100000 rev pinion"),
        ("40.000", "100.000"),
        ("40.000 Umdr.", "100.000 Umdr."),
        ("40 Tsd.", "100 Tsd."),
        ("40 k", "100 k"),
        ("40k", "0,1 Mio."),
    ] {
        let (_, written) = rows(&home, &wide(one, two), options);
        let first = "A,pinion,40000,wear_depth,26.512,0.885,";
        assert!(written.starts_with(first), "{one}: {written}");
        assert!(
            written.contains("A,pinion,100000,wear_depth,27.133,0.94,"),
            "{two}: {written}"
        );
    }
    // 27000 revolutions of the gear are 53000 of the pinion
    for of_gear in ["Umdr. Rad", "rev gear", "U Rad"] {
        let (_, written) = rows(
            &home,
            &wide(&format!("27000 {of_gear}"), &format!("54000 {of_gear}")),
            options,
        );
        assert!(
            written.starts_with("A,pinion,53000,"),
            "{of_gear}: {written}"
        );
    }
    // points may be decimal ones, and radii are no counts
    let points = "Radius [mm];40.000;100.000\n26.512;0.885;1.027\n27.133;0.810;0.940\n";
    assert!(refused(&home, points, options).contains("is that 40000, or 40.000 with decimals?"));
    let radii = "Lastwechsel;26.512;27.133\n40000;0,885;0,810\n100000;1,027;0,940\n";
    assert!(
        rows(&home, radii, options)
            .1
            .starts_with("A,pinion,40000,wear_depth,26.512,0.885,")
    );
    let masses = "Massenverlust [mg];40.000;100.000\nRitzel;0,885;1,027\nRad;0,810;0,940\n";
    let (_, written) = rows(&home, masses, "--test A --quantity mass_loss --sigma 0.1");
    assert!(
        written.starts_with("A,pinion,40000,mass_loss,,0.885,"),
        "{written}"
    );
}

#[test]
fn what_cannot_be_told_is_refused_with_its_cell() {
    let home = home();
    let table = "import table.csv --study study.toml --test A --sigma 0.2";
    for (text, command, says) in [
        ("radius;100000\n26;x\n", table, "B2: `x` is not a number"),
        (
            "radius;stop 1 100 000\n26;1\n",
            table,
            "B1: several numbers (write one, without marks between thousands) in the header `stop 1 100 000`",
        ),
        ("radius;100000\n;1\n", table, "A2: nothing stands here"),
        // numbers of which none tells what its mark is
        (
            "cycles;pinion;gear\n100000;1.234;2.512\n",
            "import table.csv --study study.toml --test A --sigma 0.2 --quantity mass_loss",
            "B2: is `1.234` 1.234 or 1234? No number of the table shows which: say --decimal point or --decimal comma",
        ),
        (
            "radius;100000 [um];200000 [mm]\n26,5;1;2\n",
            table,
            "the headers state several units: um, mm",
        ),
        (
            "radius;100000 [mm]\n26,5;1\n",
            "import table.csv --study study.toml --test A --sigma 0.2 --unit um",
            "the header says mm, --unit says um",
        ),
        (
            "radius [furlong];100000\n26,5;1\n",
            table,
            "positions in furlong are not read",
        ),
        // counts that may be marked between thousands, multiples, labels, times
        (
            "radius;250.000;500.000\n26.5;1.2;2.3\n27.5;1.1;2.2\n",
            table,
            "are the cycles `250.000` marked between thousands?",
        ),
        // nobody counts 18 revolutions to three decimals
        (
            "test,member,cycles,quantity,position,value\nA,pinion,18.000,wear_depth,26.5,1.2\n",
            "import table.csv --study study.toml --sigma 0.2",
            "are the cycles `18.000` marked between thousands?",
        ),
        (
            "radius;250M\n26;1\n",
            table,
            "a number with a letter, a multiple or a time",
        ),
        ("radius;3 days\n26;1\n", table, "a multiple or a time"),
        (
            "radius;1 h;100000\n26;1;2\n",
            table,
            "the header B1 `1 h` is a running time, C1 `100000` is not",
        ),
        ("radius;N1\n26;1\n", table, "a number with a letter"),
        (
            "radius;1.00.000\n26;1\n",
            table,
            "marks between thousands are left out",
        ),
        ("26,5;1,2;2,3\n27,5;1,1;2,2\n", table, "no header row"),
        (
            "radius;100000\n40;1\n",
            table,
            "neither the first column (40 to 40)",
        ),
        (
            "radius;100000\n52;1\n53;2\n54;3\n",
            "import table.csv --study study.toml --test A --member pinion --sigma 0.2",
            "the first column lies on the gear's flank (radius 51.",
        ),
        (
            "test;cycles;pair loss [mg]\nA;100000;3.1\n",
            table,
            "the loss of each by itself is wanted",
        ),
        (
            "radius;100000\n",
            table,
            "no row of numbers below the header",
        ),
        ("a;b\nc;d\n", table, "no header row"),
        (
            "radius;26\n27;1\n",
            table,
            "--columns checkpoints or --columns positions",
        ),
        (
            "radius;100000\n26;1\n",
            "import table.csv --study study.toml --sigma 0.2",
            "the study's tests: A, B",
        ),
        (
            "radius;100000\n26;1\n",
            "import table.csv --study study.toml --test C --sigma 0.2",
            "no test C",
        ),
        (
            "radius;100000\n26;1\n",
            "import table.csv --study study.toml --test A --sigma -0.1",
            "--sigma -0.1: one standard deviation",
        ),
        (
            "radius;2000000\n26;1\n",
            table,
            "the test A ends before these cycles",
        ),
        (
            "radius;100000\n26;1\n",
            "import table.csv --study study.toml --test A --sigma 0.2 --unit furlong",
            "units of wear_depth are um, mm",
        ),
        (
            "",
            "import tables.xlsx --study study.toml --test A --sigma 0.2",
            "name one with --sheet: pinion, gear, rows",
        ),
        (
            "",
            "import study.ods --study study.toml --test A --sigma 0.2",
            "save it as .xlsx or .csv",
        ),
    ] {
        fs::write(home.path().join("table.csv"), text).unwrap();
        let (code, _, message) = line(&home, command);
        assert_eq!(code, Some(2), "{text} {command}: {message}");
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
    // bytes that are no workbook, and every truncation of one
    let whole = fs::read(home.path().join("tables.xlsx")).unwrap();
    for end in (0..whole.len()).step_by(whole.len() / 12) {
        fs::write(home.path().join("part.xlsx"), &whole[..end]).unwrap();
        let (code, _, message) = line(
            &home,
            "import part.xlsx --study study.toml --test A --sigma 0.2",
        );
        assert_eq!(code, Some(2), "{end}: {message}");
    }
}

/// As a German spreadsheet saves it: Windows-1252, marks between thousands, a column for people.
#[test]
fn a_german_spreadsheet_is_read_as_it_is() {
    let home = home();
    let western = |text: &str| text.chars().map(|c| c as u8).collect::<Vec<u8>>();
    let table = "Verschlei\u{df}, Versuch A\nRadius [mm];100.000 LW;1.000.000 LW;;Bemerkung\n26,0;-3,1;-9,5;;\n27,0;-1,2;-4,1;;nach Reinigung\n";
    fs::write(home.path().join("rad.csv"), western(table)).unwrap();
    let command =
        "import rad.csv --study study.toml --test A --member pinion --sigma 0.2 --turn-sign";
    succeed(&home, &format!("{command} -o m.csv"));
    let masses = "Versuch;Rad;Lastspiele;Gr\u{f6}\u{df}e;Ort;Wert [g];Streuung [g];Spur;Kommentar\nA;Ritzel;100000;Massenverlust;;0,0042;0,0004;;ok\n";
    fs::write(home.path().join("massen.csv"), western(masses)).unwrap();
    succeed(&home, "import massen.csv --study study.toml -o masses.csv");
    assert_eq!(
        read(&home, "m.csv"),
        "test,member,cycles,quantity,position,value,sigma,trace\n\
         A,pinion,100000,wear_depth,26,3.1,0.2,A-pinion-100000\n\
         A,pinion,100000,wear_depth,27,1.2,0.2,A-pinion-100000\n\
         A,pinion,1000000,wear_depth,26,9.5,0.2,A-pinion-1000000\n\
         A,pinion,1000000,wear_depth,27,4.1,0.2,A-pinion-1000000\n"
    );
    let masses = read(&home, "masses.csv");
    assert!(!masses.to_lowercase().contains("kommentar"), "{masses}");
    assert!(
        masses.contains(",value,sigma,trace\nA,pinion,100000,mass_loss,,4.2,0.4,\n"),
        "{masses}"
    );
}

#[test]
fn every_listed_quantity_is_taken_and_masses_may_stand_in_a_wide_table() {
    let home = home();
    let help = succeed(&home, "import --help");
    let (code, _, message) = line(&home, "import table.csv --study study.toml --quantity dept");
    assert_eq!(code, Some(2));
    for quantity in [
        "wear_depth",
        "mass_loss",
        "mean_lag",
        "span_loss",
        "chordal_loss",
        "mesh_stiffness",
    ] {
        assert!(
            help.contains(quantity) && message.contains(quantity),
            "{quantity}"
        );
    }
    let masses = "--test A --quantity mass_loss --sigma 0.4";
    let expected = "A,pinion,100000,mass_loss,,4.2,0.4,\nA,gear,100000,mass_loss,,8.4,0.4,\nA,pinion,250000,mass_loss,,9,0.4,\n";
    let (shown, written) = rows(
        &home,
        "Umdrehungen;Ritzel [g];Rad [g]\n100000;0,0042;0,0084\n250000;0,009;\n",
        masses,
    );
    assert_eq!(written, expected);
    assert!(shown.contains("across   members, pinion gear\n"), "{shown}");
    let (_, written) = rows(
        &home,
        "mass in mg;100000;250000\npinion;4,2;9\ngear;8,4;\n",
        masses,
    );
    assert_eq!(written, expected);
    let (_, written) = rows(
        &home,
        "mass;100000\nloss;4,2\n",
        &format!("{masses} --member gear"),
    );
    assert_eq!(written, "A,gear,100000,mass_loss,,4.2,0.4,\n");
    let message = refused(&home, "radius;100000;250000\n26;4,2;9\n27;4,2;9\n", masses);
    assert!(message.contains("A2: `26` names no member"), "{message}");
    let (_, written) = rows(
        &home,
        "cycles;mean lag\n100000;310\n",
        "--test A --sigma 15",
    );
    assert_eq!(written, "A,pair,100000,mean_lag,,310,15,\n");
}

#[test]
fn nothing_that_a_wide_table_says_is_passed_over_silently() {
    let home = home();
    let options = "--test A --member pinion --sigma 0.2";
    // 53 000 revolutions of 53 teeth are 104 037.037 of 27
    for text in [
        "radius;53000 gear rev\n26;1\n",
        "radius;53000 Umdrehungen Rad\n26;1\n",
        "gear revolutions;26;27\n53000;1;2\n",
    ] {
        let (shown, written) = rows(&home, text, options);
        assert!(
            written.starts_with("A,pinion,104037.037,wear_depth,26,1,0.2,A-pinion-104037.037\n"),
            "{written}"
        );
        assert!(shown.contains("from revolutions of the gear"), "{shown}");
    }
    let (_, written) = rows(
        &home,
        "test,member,gear revolutions,radius,depth [um],sigma\nA,pinion,53000,26,1,0.2\n",
        "",
    );
    assert!(written.starts_with("A,pinion,104037.037,"), "{written}");
    let (shown, written) = rows(
        &home,
        "Wear depth in mm, negative = material lost;\nMonday;\nradius;100000\n26;-0,0015\n",
        options,
    );
    assert!(written.contains(",26,1.5,"), "{written}");
    for part in [
        "in mm (the title says so), their sign turned (the title says that lost material is negative)\n",
        "title    row 2 passed over: Monday\n",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    for (text, more, says) in [
        (
            "radius;53000 gear rev;100000\n26;1;2\n",
            "",
            "`100000` does not say so",
        ),
        (
            "Wear depth in mm\nradius;100000 [um]\n26;1\n",
            "",
            "the header says um, the title says mm",
        ),
        (
            "positive = material lost;\nradius;100000\n26;1\n",
            "--turn-sign",
            "leave out one of them",
        ),
        (
            "radius;100000;200000;100000\n26;1;2;3\n",
            "",
            "B1 and D1 both say 100000: take one out",
        ),
        (
            "radius;100000\n26;1\n27;2\n26;1\n",
            "",
            "A2 and A4 both say 26: take one out",
        ),
        (
            "radius;100000\n26.5;1.5\n27.5;0,5\n",
            "",
            "A2: `26.5` has a decimal point, B3: `0,5` a comma",
        ),
        (
            "radius,100000\n26.5,\"0,5\"\n",
            "",
            "A2: `26.5` has a decimal point, B2: `0,5` a comma",
        ),
        (
            "radius;100000\n26,5;1.5\n",
            "--decimal comma",
            "B2: `1.5` is no number with --decimal comma",
        ),
        (
            "roll length [in];100000\n26;1\n",
            "",
            "read as roll length in in: look at --member, at --position and at the unit in the header",
        ),
        (
            "radius;100000\n26.6465;1\n",
            "--columns positions",
            "--columns positions: only the numbers of the first column can be positions",
        ),
        (
            "radius;100000\n26;1\n",
            "--sigma 3%",
            "a share of each value goes by --relative-sigma 0.03",
        ),
        (
            "radius;1060000 gear rev\n26;1\n",
            "",
            "the headers count revolutions of the gear",
        ),
    ] {
        let options = if more.starts_with("--sigma") {
            "--test A"
        } else {
            options
        };
        let message = refused(&home, text, &format!("{options} {more}"));
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
}

#[test]
fn headers_of_a_wide_table_name_the_tests() {
    let home = home();
    let wide = "rayon [mm];essai A 140000 tours;essai A 280000 tours;essai B 140000 tours\n26,5;0,51;1,1;0,8\n27,5;0,61;1,2;\n";
    let (shown, written) = rows(&home, wide, "--sigma 0.1");
    assert_eq!(
        written,
        "A,pinion,140000,wear_depth,26.5,0.51,0.1,A-pinion-140000\nA,pinion,140000,wear_depth,27.5,0.61,0.1,A-pinion-140000\n\
         A,pinion,280000,wear_depth,26.5,1.1,0.1,A-pinion-280000\nA,pinion,280000,wear_depth,27.5,1.2,0.1,A-pinion-280000\n\
         B,pinion,140000,wear_depth,26.5,0.8,0.1,B-pinion-140000\n"
    );
    assert!(
        shown.contains("of the pinion in tests A, B (the headers say so), in µm"),
        "{shown}"
    );
    assert!(shown.contains("1 cell without a value"), "{shown}");
    let stated = refused(&home, wide, "--sigma 0.1 --test A");
    assert!(
        stated.contains(
            "D1: the header `essai B 140000 tours` says test B, --test says A: leave --test out"
        ),
        "{stated}"
    );
    let some = wide.replace("essai B", "essai C");
    let unnamed = refused(&home, &some, "--sigma 0.1");
    assert!(
        unnamed.contains(
            "D1: the header `essai C 140000 tours` names no test of the study, others do (test A)"
        ),
        "{unnamed}"
    );
    let units = wide.replace("essai B 140000 tours", "essai B 140000 tours [mm]");
    assert!(refused(&home, &units, "--sigma 0.1").contains("state other units, um and mm"));
}

#[test]
fn both_members_may_stand_side_by_side() {
    let home = home();
    let table = "Test;A\nPinion revolutions;40000\n\nRadius pinion [mm];Wear pinion [um];Radius gear [mm];Wear gear [um]\n\
                 26.5;2.5;52.5;1.5\n27;1.25;;\n";
    let (shown, written) = rows(&home, table, "--sigma 0.1");
    assert!(
        shown.contains("layout   the columns of the pinion and of the gear side by side\n"),
        "{shown}"
    );
    assert_eq!(
        written,
        "A,pinion,40000,wear_depth,26.5,2.5,0.1,A-pinion-40000\nA,pinion,40000,wear_depth,27,1.25,0.1,A-pinion-40000\n\
         A,gear,40000,wear_depth,52.5,1.5,0.1,\n"
    );
    let masses = "run,revolutions,pinion loss mg,gear loss mg\nA,5000,12,30\nB,6000,14,36\n";
    assert_eq!(
        rows(&home, masses, "--sigma 1").1,
        "A,pinion,5000,mass_loss,,12,1,\nB,pinion,6000,mass_loss,,14,1,\n\
         A,gear,5000,mass_loss,,30,1,\nB,gear,6000,mass_loss,,36,1,\n"
    );
    // a cell is named where it stands
    let wrong = table.replace("52.5;1.5", "52.5;much");
    assert!(refused(&home, &wrong, "--sigma 0.1").contains("D5: `much` is not a number"));
}

/// Every second cell would be the decimals of the one before it.
#[test]
fn decimal_commas_between_commas_are_refused() {
    let home = home();
    let wide = "radius,100000,250000\n26,0,1,5,2,5\n27,5,1,2,2,1\n";
    let long =
        "test,member,cycles,radius,depth [um]\nA,pinion,1e5,26,5,1,5\nA,pinion,1e5,27,5,1,2\n";
    let masses = "Run,Hours,Pinion (g),Wheel (g)\nA,0,5,0,0190,0,0151\nB,0,5,0,0744,0,0819\n";
    for (table, options, says) in [
        (
            wide,
            "--test A",
            "row 2 has 6 cells, the header in row 1 has 3",
        ),
        (long, "", "row 2 has 7 cells, the header in row 1 has 5"),
        (
            masses,
            "--quantity mass_loss",
            "row 2 has 7 cells, the header in row 1 has 4",
        ),
    ] {
        let message = refused(&home, table, &format!("{options} --sigma 0.1"));
        assert!(
            message.contains(says)
                && message.contains("cannot be told from the commas between the columns")
                && message.contains("with semicolons between its columns, or with decimal points"),
            "no `{says}` in: {message}"
        );
    }
    // in quotes they can, and a remark may have a comma
    let quoted = "test,member,cycles,radius,depth [um]\nA,pinion,1e5,\"26,5\",\"1,5\"\n";
    assert!(rows(&home, quoted, "--sigma 0.1").1.contains(",26.5,1.5,"));
    let remark =
        "test,member,cycles,radius,depth [um],note\nA,pinion,1e5,26.5,1.5,cleaned, dried\n";
    assert!(rows(&home, remark, "--sigma 0.1").1.contains(",26.5,1.5,"));
}

#[test]
fn a_unit_above_the_header_is_that_of_the_values() {
    let home = home();
    let options = "--test A --member pinion --sigma 0.1";
    for table in [
        "Unit: mm\nradius [mm],100000\n26,0.003\n",
        "Unit: mm\ncycles,radius [mm],wear depth\n100000,26,0.003\n",
    ] {
        let written = rows(&home, table, options).1;
        assert!(
            written.starts_with("A,pinion,100000,wear_depth,26,3,"),
            "{written}"
        );
    }
}

/// Source: `data/formulas.xlsx`, a workbook as programs write it that do not compute: C2 has a formula and no result.
#[test]
fn formulas_without_a_stored_result_are_refused() {
    let home = home();
    let tables = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/formulas.xlsx");
    fs::copy(tables, home.path().join("formulas.xlsx")).unwrap();
    let options = "--study study.toml --test A --member pinion --sigma 0.1";
    let (code, _, message) = line(
        &home,
        &format!("import formulas.xlsx --sheet bare {options}"),
    );
    assert_eq!(code, Some(2));
    assert!(
        message.contains("sheet bare: C2: a formula without a stored result: open the table in the spreadsheet program and save it"),
        "{message}"
    );
    // another sheet of it is read
    let shown = succeed(
        &home,
        &format!("import formulas.xlsx --sheet computed {options}"),
    );
    assert!(
        shown.contains("A,pinion,250000,wear_depth,26,3,"),
        "{shown}"
    );
}

/// Rigs stop after hours: the speed of the test in the study makes revolutions of them, in whichever direction the table goes.
#[test]
fn running_times_of_a_wide_table_become_revolutions_by_the_speed_of_the_test() {
    for (name, table) in [
        (
            "across.csv",
            "radius [mm];nach 1,0 h;after 2,5 [h]\n26;1,5;2,5\n27;1,2;2,2\n",
        ),
        (
            "down.csv",
            "running time [min];26;27\n60;1.5;1.2\n150;2.5;2.2\n",
        ),
    ] {
        let home = home();
        std::fs::write(home.path().join(name), table).unwrap();
        let line = format!(
            "import {name} --study study.toml --test A --member pinion --unit um --sigma 0.1 --no-traces -o m.csv"
        );
        let shown = succeed(&home, &line);
        assert!(
            shown.contains("turned into pinion revolutions by the 2000 rpm of test A in the study"),
            "{shown}"
        );
        let rows = read(&home, "m.csv");
        for row in [
            "A,pinion,120000,wear_depth,26,1.5,",
            "A,pinion,300000,wear_depth,27,2.2,",
        ] {
            assert!(rows.contains(row), "no `{row}` of {name} in:\n{rows}");
        }
    }
}

/// A header with one name fewer than the rows have cells: hours would be losses.
#[test]
fn numbers_below_no_name_are_refused() {
    let home = home();
    let shifted = "Versuch;Datum;Laufzeit [h];Ritzel Verlust [g];Rad Verlust [g]\nA;12.5.;Mi;5,00;0,0012;0,0034\nA;13.5.;Do;7,00;0,0022;0,0044\n";
    let message = refused(&home, shifted, "--sigma 1");
    assert!(
        message.contains("F2: `0,0034` stands in a column without a name: is a name missing in row 1, so that others stand above the wrong column? Name the column in F1, or take it out"),
        "{message}"
    );
    let weighings = "run;time [h];mass before [g];mass after [g]\nA;x;1;14,7174;14,7168\n";
    let message = refused(&home, weighings, "--member pinion --sigma 1");
    assert!(
        message.contains("E2: `14,7168` stands in a column without a name"),
        "{message}"
    );
    let wide = "radius;100000;\n26;1;2\n27;2;3\n";
    let message = refused(&home, wide, "--test A --sigma 1");
    assert!(
        message.contains("C2: `2` stands in a column without a name"),
        "{message}"
    );
    // nothing or words alone do no harm, nor does a count of the rows in the first column
    let words =
        "test;member;;cycles;mass loss [mg];;\nA;pinion;;100000;4;checked;\nA;pinion;;200000;8;;\n";
    let (shown, written) = rows(&home, words, "--sigma 1");
    assert_eq!(written.lines().count(), 2, "{written}");
    assert!(
        shown.contains("passed over the column `F1`: no name"),
        "{shown}"
    );
    let counted = ",test,member,cycles,mass loss [mg]\n0,A,pinion,100000,4\n1,A,pinion,200000,8\n";
    assert_eq!(rows(&home, counted, "--sigma 1").1.lines().count(), 2);
}

/// Machines begin a trace below the form circle and end it beyond the tip. The flank of the pinion reaches from 51.194 to 58 mm in diameter.
#[test]
fn places_a_little_off_the_flank_are_left_out() {
    let home = home();
    let options = "--test A --member pinion --sigma 0.1";
    let places = |from: f64, count: usize| -> Vec<f64> {
        (0..count).map(|i| from + 0.5 * i as f64).collect()
    };
    let table = |head: &str, places: &[f64]| {
        let rows: String = places
            .iter()
            .map(|d| format!("{d};1,5;2,5\n").replacen('.', ",", 1))
            .collect();
        format!("{head}{rows}")
    };
    let two_rows = "Diameter [mm];;\n;100000;250000\n";
    let (shown, written) = rows(&home, &table(two_rows, &places(50.5, 17)), options);
    for part in [
        "header   row of A2 `Diameter [mm]`\n",
        "left out 2 rows below the form circle of the pinion (from 50.5 to 51): its flank covers diameter 51.",
        "left out 1 row above the tip of the pinion (at 58.5): its flank covers diameter 51.",
        " to 58.000 mm, and there is no wear to compare outside of it\n",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    assert_eq!(written.lines().count(), 28, "{written}");
    assert!(
        written.starts_with("A,pinion,100000,wear_depth,25.75,1.5,"),
        "{written}"
    );
    // most of them off it, and one that is far away
    let head = "Diameter [mm];100000;250000\n";
    let message = refused(&home, &table(head, &places(48.0, 10)), options);
    assert!(
        message.contains("neither the first column (48 to 52.5) nor the header (100000 to 250000) are places on the pinion's flank (diameter 51.")
            && message.contains("(3 of 10 are, but not 48 in A2)"),
        "{message}"
    );
    let mut wrong = places(52.0, 12);
    wrong[4] = 154.0;
    let message = refused(&home, &table(head, &wrong), options);
    assert!(
        message.contains("A6: the diameter 154 mm is off the pinion's flank (diameter 51."),
        "{message}"
    );
    // a file of one curve
    let curve: String = places(50.5, 15)
        .iter()
        .map(|d| format!("{d},1.5\n"))
        .collect();
    let curve = format!("Run: A\nPart: pinion\nCycles: 40000\n\nDiameter [mm],Depth [um]\n{curve}");
    let (shown, written) = rows(&home, &curve, "--sigma 0.1");
    assert!(
        shown.contains("left out 2 rows below the form circle of the pinion (from 50.5 to 51): "),
        "{shown}"
    );
    assert_eq!(written.lines().count(), 13, "{written}");
    let message = refused(&home, &curve.replace("53.5,", "153.5,"), "--sigma 0.1");
    assert!(
        message.contains("A12: `153.5` below `Diameter [mm]`: the diameter 153.5 mm is off the pinion's flank (diameter 51."),
        "{message}"
    );
}

#[test]
fn typeset_numbers_are_read() {
    let home = home();
    let table = "test;member;cycles;radius;depth [um]\nA;pinion;1\u{a0}000\u{a0}000;26,5;\u{2212}1,5\nA;pinion;250\u{202f}000;26,5;\u{2212}0,5\n\
                 A;pinion;100\u{2009}000;26,5;2\n";
    assert_eq!(
        rows(&home, table, "--sigma 0.1").1,
        "A,pinion,1000000,wear_depth,26.5,-1.5,0.1,\nA,pinion,250000,wear_depth,26.5,-0.5,0.1,\nA,pinion,100000,wear_depth,26.5,2,0.1,\n"
    );
    let wide = "radius;250\u{a0}000 rev;1\u{202f}000\u{202f}000 rev\n26;1;2\n";
    assert_eq!(
        rows(&home, wide, "--test A --sigma 0.1").1,
        "A,pinion,250000,wear_depth,26,1,0.1,A-pinion-250000\nA,pinion,1000000,wear_depth,26,2,0.1,A-pinion-1000000\n"
    );
}

/// The roll length by its other German name, and by those of other languages, is none other than `roll length`: 26.5 mm of a base circle
/// of 27 mm cos 20° are √(26.5² − 25.3717²) = 7.6503 mm.
#[test]
fn roll_lengths_are_known_in_other_languages() {
    let home = home();
    for name in [
        "W\u{e4}lzweg [mm]",
        "Waelzweg [mm]",
        "W\u{e4}lzl\u{e4}nge [mm]",
        "lunghezza di rotolamento [mm]",
        "longueur de roulement [mm]",
        "longitud de rodadura [mm]",
    ] {
        let table = format!("Test,Ruota,{name},cicli,usura [um]\nA,pignone,7.6503,250000,1.5\n");
        let (shown, written) = rows(&home, &table, "--sigma 0.1");
        let position = written.split(',').nth(4).unwrap_or_default();
        let radius: f64 = position.parse().unwrap_or(0.0);
        assert!((radius - 26.5).abs() < 1e-3, "{name}: {written}{shown}");
    }
}

/// Notes and statistics that people put below a table and beside its checkpoints are no measurements; a misspelt place is refused.
#[test]
fn what_sums_a_table_up_or_stands_below_it_is_passed_over() {
    let home = home();
    let table = "Radius [mm];100000;250000;Mittelwert\n26;3,1;6,2;4,65\n26,5;2,4;4,9;3,65\n27;1,2;2,5;1,85\n";
    let below = ";;;\nMittelwert;2,2;4,5;3,4\nMax;3,1;6,2;4,65\nBemerkung: Taster gewechselt nach 250000;;;\n";
    let options = "--test A --member pinion --unit um --sigma 0.1";
    let (shown, written) = rows(&home, &format!("{table}{below}"), options);
    assert_eq!(written.lines().count(), 6, "{written}");
    for part in [
        "Mittelwert",
        "row 6 stands below the table (`Mittelwert`): passed over",
        "row 7 stands below the table (`Max`): passed over",
        "row 8 stands below the table (`Bemerkung: Taster gewechselt nach 250000`): passed over",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    let message = refused(&home, &format!("{table}2l,2;1,0;2,0;1,5\n"), options);
    assert!(message.contains("A5: `2l,2`"), "{message}");
    // a checkpoint in words is no footer
    let down = "Lastwechsel;26;26,5;27\n100000;3,1;2,4;1,2\nEnde (250000);6,2;4,9;2,5\n";
    let message = refused(&home, down, options);
    assert!(message.contains("Ende (250000)"), "{message}");
}

/// Cells that say in words that there is no value are empty, columns that sum up are known with their unit, and what stands below masses is passed over as below
/// depths.
#[test]
fn words_for_no_value_are_empty_cells() {
    let home = home();
    let table =
        "Radius [mm];100000;250000;Max [um]\n26;3,1;n.b.;3,1\n26,5;-;4,9;4,9\n27;1,2;2,5;2,5\n";
    let (shown, written) = rows(
        &home,
        table,
        "--test A --member pinion --unit um --sigma 0.1",
    );
    assert_eq!(written.lines().count(), 4, "{written}{shown}");
    assert!(
        shown.contains("no value in C2 (`n.b.`), B3 (`-`): read as empty"),
        "{shown}"
    );
    let masses = "Lastwechsel;Ritzel [mg];Rad [mg]\n100000;2,1;1,2\n250000;4,4;n.b.\nMittelwert;3,2;1,2\nBemerkung: Waage neu;;\n";
    let (shown, written) = rows(&home, masses, "--test A --quantity mass_loss --sigma 0.1");
    assert_eq!(written.lines().count(), 3, "{written}{shown}");
    assert!(shown.contains("Mittelwert"), "{shown}");
    let named = "Radius [mm];Verschlei\u{df} [\u{b5}m] nach 0,1 Mio. LW;Verschlei\u{df} [\u{b5}m] nach 0,25 Mio. LW\n26;3,1;6,2\n26,5;2,4;4,9\n27;1,2;2,5\n";
    let (_, written) = rows(&home, named, "--test A --member pinion --sigma 0.1");
    assert!(
        written.contains("A,pinion,250000,wear_depth,27,2.5"),
        "{written}"
    );
}

/// Lines of a title with a number in their second cell are no header: that stands right above its values.
#[test]
fn titles_with_numbers_in_cells_of_their_own_are_no_header() {
    let home = home();
    let values = "Radius [mm];nach 100000;nach 250000\n26;3,1;6,2\n26,5;2,4;4,9\n27;1,2;2,5\n";
    for titles in [
        "Messger\u{e4}t:;Klingelnberg P26\n",
        "\u{d6}l:;ISO VG 100\n",
        "Modul [mm];2,0\nZ\u{e4}hnezahl;27\n\n",
        "Pr\u{fc}fstand 2;;gemessen auf P40\n;;\n",
    ] {
        let (shown, written) = rows(
            &home,
            &format!("{titles}{values}"),
            "--test A --member pinion --unit um --sigma 0.1",
        );
        assert_eq!(written.lines().count(), 6, "{titles}: {shown}");
        assert!(
            written.contains("A,pinion,250000,wear_depth,27,2.5"),
            "{titles}: {written}"
        );
    }
}

#[test]
fn a_title_that_names_the_test_may_name_the_member_too() {
    let home = home();
    let values =
        "Radius [mm];Lastwechsel 100 000;nach 250 000 U\n26;3,1;6,2\n26,5;2,4;4,9\n27;1,2;2,5\n";
    for titles in [
        "Pr\u{fc}fling:;Versuch A, Ritzel\n",
        "Versuch A: Ritzel\n",
        "Verschlei\u{df} Versuch A, Ritzel\n",
        "Gemessen am:;12.03.2026\nPr\u{fc}fung A;;Ritzel\n",
    ] {
        for options in ["", " --decimal comma"] {
            let (shown, written) = rows(
                &home,
                &format!("{titles}{values}"),
                &format!("--unit um --sigma 0.1{options}"),
            );
            assert!(
                written.contains("A,pinion,250000,wear_depth,27,2.5"),
                "{titles}: {shown} {written}"
            );
            assert!(written.contains("A,pinion,100000,"), "{titles}: {written}");
        }
        let other = refused(
            &home,
            &format!("{titles}{values}"),
            "--test B --unit um --sigma 0.1",
        );
        assert!(other.contains("says test A, --test says B"), "{other}");
    }
    // a word before it may make the first group another number
    let stops = values.replace("nach 250 000 U", "Stop 2 500 000");
    let other = refused(
        &home,
        &stops,
        "--test A --member pinion --unit um --sigma 0.1",
    );
    assert!(other.contains("several numbers"), "{other}");
}

/// Where every header names the one test of the table, with digits in its id, the row is still the header and no title.
#[test]
fn headers_that_all_name_one_test_are_a_header() {
    let home = home();
    let study = STUDY.replace("id = \"A\"", "id = \"V1\"");
    fs::write(home.path().join("study.toml"), study).unwrap();
    for [first, second] in [
        ["Essai V1, 80000 tours", "Essai V1, 400000 tours"],
        ["\"Essai V1, 80000 tours\"", "\"Essai V1, 400000 tours\""],
        ["Versuch V1: 80000", "Versuch V1: 400000"],
    ] {
        let table = format!("Rayon (mm);{first};{second}\n26;1,5;2,5\n27;1,2;2,2\n");
        let (_, written) = rows(&home, &table, "--member pinion --sigma 0.1");
        assert!(
            written.contains("V1,pinion,80000,wear_depth,26,1.5,")
                && written.contains("V1,pinion,400000,wear_depth,27,2.2,"),
            "{first}: {written}"
        );
    }
}

/// Whose flank a table is of: a title that names its values and one member, or the flank on which alone its places can lie. The pinion's radii are
/// 25 to 29 mm, the gear's 50 to 55.
#[test]
fn titles_and_places_say_whose_flank_a_table_is_of() {
    let home = home();
    let table = |title: &str, places: [&str; 3], header: &str| {
        let [a, b, c] = places;
        format!("{title}\n{header};80.000 LW;400.000 LW\n{a};1,5;2,5\n{b};1,2;2,2\n{c};1,1;2,1\n")
    };
    let of_gear = ["51,5", "52,5", "53,5"];
    let of_pinion = ["26", "27", "28"];
    let options = "--test A --sigma 0.1";
    for title in [
        "Verschlei\u{df} Rad [\u{b5}m]",
        "Pr\u{fc}fprotokoll Verschlei\u{df} Rad",
        "Usure roue (\u{b5}m)",
    ] {
        let (shown, written) = rows(&home, &table(title, of_gear, "Radius [mm]"), options);
        assert!(
            written.contains("A,gear,80000,wear_depth,51.5,1.5,"),
            "{written}"
        );
        let says = format!("layout   row 1, `{title}`: member gear\n");
        assert!(shown.contains(&says), "no `{says}` in:\n{shown}");
        assert!(!shown.contains("passed over"), "{shown}");
    }
    // roll angles lie on both flanks: a title that names one settles it
    let angles = table(
        "Usura pignone [um]",
        ["18", "20", "22"],
        "angolo di rotolamento [deg]",
    );
    let (_, written) = rows(&home, &angles, options);
    assert!(written.contains("A,pinion,80000,"), "{written}");
    let angles = angles.replace("Usura pignone", "Gear wear");
    let message = refused(&home, &angles, options);
    assert!(message.contains("say whose they are"), "{message}");
    // nothing says it, or says otherwise
    let (shown, written) = rows(&home, &table("", of_gear, "Radius [mm]"), options);
    assert!(written.contains("A,gear,80000,"), "{written}");
    assert!(
        shown.contains(
            "layout   these places lie on the gear's flank alone: taken for the gear's\n"
        ),
        "{shown}"
    );
    let (shown, written) = rows(
        &home,
        &table("Verschlei\u{df} Rad", of_pinion, "Radius"),
        options,
    );
    assert!(written.contains("A,pinion,80000,"), "{written}");
    assert!(
        shown.contains("taken for the pinion's, though row 1 says `Verschlei\u{df} Rad`"),
        "{shown}"
    );
    // they may be the pinion's diameters
    for unclear in [
        table("", of_gear, "Ort"),
        table("Verschlei\u{df} Ritzel", of_gear, "Radius"),
    ] {
        let message = refused(&home, &unclear, options);
        assert!(
            message.contains("the header (80.000 to 400.000)")
                && message
                    .contains("they lie on the gear's flank: if they are that, say --member gear"),
            "{message}"
        );
    }
}

/// A place tells what its mark is where it lies on a flank in one of the two readings: the gear's radii are 50 to 55 mm.
#[test]
fn a_place_on_the_flank_tells_decimals_from_thousands() {
    let home = home();
    for places in [["52,221", "53,489"], ["52.221", "53.489"]] {
        let [first, second] = places;
        let mark = if first.contains(',') { "," } else { "." };
        let values = ["1.862", "2.038"].map(|value| value.replace('.', mark));
        let [a, b] = &values;
        let wide = format!("Rayon [mm];100000\n{first};{a}\n{second};{b}\n");
        let long = format!(
            "test;member;cycles;rayon [mm];depth\nA;gear;100000;{first};{a}\nA;gear;100000;{second};{b}\n"
        );
        for (table, options) in [
            (wide, "--test A --member gear --sigma 0.1"),
            (long, "--sigma 0.1"),
        ] {
            let (_, written) = rows(&home, &table, options);
            assert!(
                written.contains("A,gear,100000,wear_depth,52.221,1.862,"),
                "{table}{written}"
            );
        }
    }
    let (_, written) = rows(
        &home,
        "radius;100000\n26.500;1.234\n27.000;2.512\n",
        "--test A --sigma 0.2",
    );
    assert!(written.contains("wear_depth,26.5,1.234,"), "{written}");
}
