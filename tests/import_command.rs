//! Claim: `import` turns tables with a column for each checkpoint or for each position, from spreadsheets and texts, into rows of a
//! measurement file, shows how before it writes and writes nothing unasked; `check` says what it understood of a study and its
//! measurements, what is wrong with them as a whole and what a comparison could conclude.
//!
//! Source: `data/tables.xlsx`, written by openpyxl 3.1; radii of roll angles and lengths by r² = r_b² + ρ², ρ = r_b φ (ISO 21771) with
//! r_b = 27 mm cos 20°, computed apart from this program (Python's math). Tolerance: the nine digits that are written.

use std::fs;
use std::path::Path;
use std::time::Duration;

use assert_cmd::Command;
use tempfile::TempDir;

mod common;
#[path = "import_command/deviations.rs"]
mod deviations;
#[path = "import_command/doubtful.rs"]
mod doubtful;
#[path = "import_command/multiples.rs"]
mod multiples;
#[path = "import_command/nothing_measured.rs"]
mod nothing_measured;

use common::{gears, line, succeed};

const STUDY: &str = concat!(
    gears!("centre_distance = 80.0\n"),
    r#"[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 2e-10
cycles = 1e6
[model]
contact = "hertz"
[numerics]
positions = 40
[[test]]
id = "A"
[[test]]
id = "B"
torque = 170.0
role = "holdout"
[measurements]
file = "m.csv"
"#
);

fn home() -> TempDir {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("study.toml"), STUDY).unwrap();
    let tables = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/tables.xlsx");
    fs::copy(tables, home.path().join("tables.xlsx")).unwrap();
    home
}

fn read(home: &TempDir, name: &str) -> String {
    fs::read_to_string(home.path().join(name)).unwrap()
}

const PINION: &str = "import tables.xlsx --sheet pinion --study study.toml --test A --unit mm --turn-sign --sigma 0.2";

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

#[test]
fn what_cannot_be_told_is_refused_with_its_cell() {
    let home = home();
    let table = "import table.csv --study study.toml --test A --sigma 0.2";
    for (text, command, says) in [
        ("radius;100000\n26;x\n", table, "B2: `x` is not a number"),
        (
            "radius;100 000\n26;1\n",
            table,
            "B1: several numbers (write one, without marks between thousands) in the header `100 000`",
        ),
        ("radius;100000\n;1\n", table, "A2: nothing stands here"),
        // numbers of which none tells what its mark is
        (
            "radius;100000\n26.500;1.234\n27.000;2.512\n",
            table,
            "A2: is `26.500` 26.500 or 26500? No number of the table shows which: say --decimal point or --decimal comma",
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
            "radius;250.000;500.000\n26,5;1,2;2,3\n27,5;1,1;2,2\n",
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
            "radius;250k\n26;1\n",
            table,
            "a number with a letter, a multiple or a time",
        ),
        (
            "radius;0,25 Mio\n26;1\n",
            table,
            "a number with a letter, a multiple or a time",
        ),
        ("radius;100 h\n26;1\n", table, "a multiple or a time"),
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

#[test]
fn a_check_tells_what_was_understood_and_what_could_be_concluded() {
    let home = home();
    succeed(&home, "synthesize study.toml -o data --seed 2");
    fs::copy(
        home.path().join("data/measurements.csv"),
        home.path().join("m.csv"),
    )
    .unwrap();
    let told = succeed(&home, "check study.toml");
    for part in [
        "gears:   27 and 53 teeth",
        "signs, units and zeros look right",
        "can show:    the wear coefficient k",
        "can show:    laws of time",
        "can show:    whether what was fitted holds elsewhere",
        "cannot show: laws of the load (pressure exponent, flexibility) apart from k: a second torque",
        "cannot show: how k scatters between tests: a second fit test",
        "test B: 170 N·m",
        "next:    gearwear compare study.toml",
    ] {
        assert!(told.contains(part), "no `{part}` in:\n{told}");
    }
    assert!(home.path().join("study.out/check/report.html").is_file());
    // depths with the other sign
    let turned = changed(&read(&home, "m.csv"), |cells| {
        turn(cells, "wear_depth");
    });
    fs::write(home.path().join("m.csv"), turned).unwrap();
    let told = succeed(&home, "check study.toml");
    assert!(
        told.contains("check first: wear_depth has the other sign"),
        "{told}"
    );
}

/// Rows of a measurement file, changed one by one, the header as it is.
/// Where tests are told apart by their temperature, the temperature is said with their torque and speed; elsewhere it is not.
#[test]
fn temperatures_that_differ_are_told() {
    let home = home();
    succeed(&home, "synthesize study.toml -o data --seed 2");
    fs::copy(
        home.path().join("data/measurements.csv"),
        home.path().join("m.csv"),
    )
    .unwrap();
    let page = || read(&home, "study.out/compare/report.html");
    for (second, is_told) in [("81.25", true), ("60.0", false)] {
        let warm = STUDY
            .replace("id = \"A\"", "id = \"A\"\nbulk_temperature = 60.0")
            .replace(
                "id = \"B\"",
                &format!("id = \"B\"\nbulk_temperature = {second}"),
            );
        fs::write(home.path().join("study.toml"), warm).unwrap();
        let told = succeed(&home, "check study.toml");
        succeed(&home, "compare study.toml");
        for part in ["rpm, 60 °C", "rpm, 81.3 °C"] {
            let told = told.contains(part) && page().contains(part);
            assert_eq!(told, is_told, "{part}");
        }
        assert!(is_told || !page().contains("rpm, 60 °C"));
    }
}

fn changed(text: &str, change: impl Fn(&mut Vec<String>)) -> String {
    let rows = text.lines().map(|row| {
        let mut cells: Vec<String> = row.split(',').map(str::to_owned).collect();
        if cells.len() > 6 && cells[0] != "test" {
            change(&mut cells);
        }
        cells.join(",") + "\n"
    });
    rows.collect()
}

fn number(cell: &str) -> f64 {
    cell.parse().unwrap()
}

/// Turns the sign of a row's value if it is of this quantity.
fn turn(cells: &mut [String], quantity: &str) -> bool {
    let own = cells[3] == quantity;
    if own {
        cells[5] = (-number(&cells[5])).to_string();
    }
    own
}

#[test]
fn a_check_finds_cycles_of_the_gear_rows_that_stand_twice_and_a_wrong_sigma() {
    let home = home();
    succeed(&home, "synthesize study.toml -o data --seed 2 --noise 0.05");
    let good = read(&home, "data/measurements.csv");
    let told = |text: &str| {
        fs::write(home.path().join("m.csv"), text).unwrap();
        succeed(&home, "check study.toml")
    };
    let right = told(&good);
    assert!(
        right.contains("signs, units and zeros look right") && !right.contains("warning:"),
        "{right}"
    );
    let of_gear = changed(&good, |cells| {
        if cells[1] == "gear" {
            cells[2] = (number(&cells[2]) * 27.0 / 53.0).to_string();
        }
    });
    let said = told(&of_gear);
    assert!(
        said.contains("the gear's rows stand at 27/53 of the pinion's cycles"),
        "{said}"
    );
    let depths = |row: &&str| row.contains("wear_depth");
    let again: String = good
        .lines()
        .filter(depths)
        .take(5)
        .collect::<Vec<_>>()
        .join("\n");
    let again = changed(&again, |cells| cells[6] = "0.3".to_owned());
    let said = told(&(good.clone() + &again));
    assert!(said.contains("5 rows repeat an earlier one"), "{said}");
    // each row's own depth for the largest of its curve
    let small = changed(&good, |cells| {
        if cells[3] == "wear_depth" {
            cells[6] = 0.02f64.hypot(0.05 * number(&cells[5])).to_string();
        }
    });
    let said = told(&small);
    assert!(
        said.contains("the stated sigma of the depths does not fit"),
        "{said}"
    );
    let ten_times = changed(&good, |cells| {
        if cells[3] == "wear_depth" {
            cells[6] = (10.0 * number(&cells[6])).to_string();
        }
    });
    let said = told(&ten_times);
    assert!(
        said.contains("scatter only 0.1") && said.contains("if sigma is overstated"),
        "{said}"
    );
    // a hundredth of each mass, where the balance is good to a twentieth of the largest
    let masses = changed(&good, |cells| {
        if cells[3] == "mass_loss" {
            cells[5] = (number(&cells[5]) + 8.0 * number(&cells[6])).to_string();
            cells[6] = (0.01 * number(&cells[5])).to_string();
        }
    });
    let said = told(&masses);
    assert!(
        said.contains("% of the misfit of the fit tests is that of")
            && said.contains("rows of mass_loss"),
        "{said}"
    );
}

/// Estimates of short curves scatter, and do not fit one law of all curves: nothing is said of a sigma that nobody stated.
#[test]
fn a_check_says_nothing_of_sigmas_that_are_estimated() {
    let home = home();
    succeed(&home, "synthesize study.toml -o data --seed 2 --noise 0.05");
    let mut depths = 0;
    let made = read(&home, "data/measurements.csv");
    let third = made.lines().filter(|row| {
        depths += usize::from(row.contains("wear_depth"));
        !row.contains("wear_depth") || depths % 3 == 0
    });
    let third: String = third.map(|row| format!("{row}\n")).collect();
    let unstated = changed(&third, |cells| {
        if cells[3] == "wear_depth" {
            cells[6] = String::new();
        }
    });
    fs::write(home.path().join("m.csv"), unstated).unwrap();
    let said = succeed(&home, "check study.toml");
    assert!(
        said.contains("zeros look right") && !said.contains("stated sigma"),
        "{said}"
    );
}

/// Elements would wear teeth away to follow masses that are a thousand times too large, for many minutes; a second is the rule.
#[test]
fn a_check_of_a_wrong_unit_does_not_wear_teeth_away() {
    let home = home();
    succeed(&home, "synthesize study.toml -o data --seed 2 --noise 0.05");
    let heavy = changed(&read(&home, "data/measurements.csv"), |cells| {
        if cells[3] == "mass_loss" {
            cells[5] = (1000.0 * number(&cells[5])).to_string();
        }
        // depths without a trace are looked at by elements
        cells[7] = String::new();
    });
    fs::write(home.path().join("m.csv"), heavy).unwrap();
    let by_elements = STUDY.replace("\"hertz\"", "\"fem\"");
    fs::write(home.path().join("study.toml"), by_elements).unwrap();
    let mut command = Command::cargo_bin("gearwear").unwrap();
    let check = command.current_dir(&home).args(["check", "study.toml"]);
    let output = check.timeout(Duration::from_secs(60)).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(
        said.contains("times less wear than its masses"),
        "{:?} {said}",
        output.status
    );
}

/// At z1/z2 = 1/2 a test that ends halfway may have been stopped there, unless all others were measured to their end; members that turn alike have no
/// revolutions of their own.
#[test]
fn a_check_finds_one_test_in_revolutions_of_the_gear_at_simple_ratios() {
    for (teeth, distance, found) in [("54", "81.0", true), ("27", "54.0", false)] {
        let home = home();
        let study = STUDY
            .replace(
                "teeth = 53\nbore_diameter = 40.0",
                &format!("teeth = {teeth}\nbore_diameter = 25.0"),
            )
            .replace(
                "centre_distance = 80.0",
                &format!("centre_distance = {distance}"),
            );
        fs::write(home.path().join("study.toml"), study).unwrap();
        succeed(&home, "synthesize study.toml -o data --seed 2 --noise 0.05");
        let good = read(&home, "data/measurements.csv");
        let ratio = 27.0 / number(teeth);
        let of_gear = changed(&good, |cells| {
            if cells[0] == "B" {
                cells[2] = (number(&cells[2]) * ratio).to_string();
            }
        });
        fs::write(home.path().join("m.csv"), of_gear).unwrap();
        let said = succeed(&home, "check study.toml");
        let says = said.contains(&format!(
            "the last rows of test B stand at 27/{teeth} of the cycles"
        ));
        assert_eq!(says, found, "{said}");
    }
}

/// A k in m2/N is a millionth of the right one: the fit finds it all the same, and what is doubted is the study's.
#[test]
fn a_check_of_a_study_with_k_in_another_unit_doubts_the_study() {
    let home = home();
    succeed(&home, "synthesize study.toml -o data --seed 2 --noise 0.05");
    fs::copy(
        home.path().join("data/measurements.csv"),
        home.path().join("m.csv"),
    )
    .unwrap();
    let off = STUDY.replace("coefficient = 2e-10", "coefficient = 2e-16");
    fs::write(home.path().join("off.toml"), off).unwrap();
    let said = succeed(&home, "check off.toml");
    assert!(
        said.contains("times above the wear.coefficient that the study states, 2.0e-16"),
        "{said}"
    );
    assert!(
        !said.contains("is below what gears are known to have"),
        "{said}"
    );
}

/// The analytic model knows too little of what stands over a rotation to find its sign: finite elements are asked.
#[test]
fn a_check_finds_a_transmission_error_that_runs_the_other_way() {
    let home = home();
    let by_fem = STUDY.replace("contact = \"hertz\"", "contact = \"fem\"");
    fs::write(home.path().join("study.toml"), by_fem).unwrap();
    succeed(&home, "synthesize study.toml -o data --seed 2");
    let turned = changed(&read(&home, "data/measurements.csv"), |cells| {
        if turn(cells, "transmission_error") {
            // of less weight than the depths, which k is then fitted to
            cells[6] = (8.0 * number(&cells[6])).to_string();
        }
    });
    fs::write(home.path().join("m.csv"), turned).unwrap();
    let said = succeed(&home, "check study.toml");
    assert!(
        said.contains("check first: transmission_error runs against the computed one"),
        "{said}"
    );
}

/// Without a sigma the column stays empty; a table that was taken already is known again, whatever its sigma.
#[test]
fn a_sigma_may_be_left_out_and_hides_no_second_copy() {
    let home = home();
    let table = "radius;100000\n26;1.5\n27;1\n";
    fs::write(home.path().join("table.csv"), table).unwrap();
    let import = "import table.csv --study study.toml --test A";
    let (code, _, message) = line(&home, &format!("{import} -o m.csv"));
    // two points have no neighbours to estimate it from
    assert_eq!(code, Some(2));
    assert!(message.contains("sigma"), "{message}");
    succeed(&home, &format!("{import} --sigma 0.2 -o m.csv"));
    let again = format!("{import} --sigma 0.3 --relative-sigma 0.1 -o m.csv --append");
    let (code, _, message) = line(&home, &again);
    assert_eq!(code, Some(2));
    assert!(message.contains("--repeat 2"), "{message}");
    let curve: String = (0..20)
        .map(|i| {
            let noise = if i % 3 == 0 { 0.1 } else { -0.05 };
            format!("{};{}\n", 26.0 + 0.1 * f64::from(i), 5.0 + noise)
        })
        .collect();
    let curve = format!("radius;100000\n{curve}");
    fs::write(home.path().join("table.csv"), curve).unwrap();
    let shown = succeed(&home, &format!("{import} -o empty.csv"));
    assert!(shown.contains("sigma    left empty"), "{shown}");
    assert!(read(&home, "empty.csv").contains("A,pinion,100000,wear_depth,26,5.1,,"));
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

/// Writes a table and imports it.
fn import(home: &TempDir, text: &str, options: &str) -> (Option<i32>, String, String) {
    fs::write(home.path().join("table.csv"), text).unwrap();
    line(
        home,
        &format!("import table.csv --study study.toml {options}"),
    )
}

/// As [`import`], and it has to succeed: what is shown, and the rows of the file without its header.
fn rows(home: &TempDir, text: &str, options: &str) -> (String, String) {
    let (code, shown, error) = import(home, text, &format!("{options} -o out.csv --force"));
    assert_eq!(code, Some(0), "{text}: {error}");
    let written = read(home, "out.csv");
    let (header, rows) = written.split_once('\n').unwrap();
    assert!(header.starts_with("test,member,cycles,quantity,position,value,sigma,trace"));
    (shown, rows.to_owned())
}

/// As [`import`], and it has to be refused: the message.
fn refused(home: &TempDir, text: &str, options: &str) -> String {
    let (code, _, message) = import(home, text, options);
    assert_eq!(code, Some(2), "{text} {options}: {message}");
    message
}

#[test]
fn a_long_table_is_read_by_the_names_of_its_columns() {
    let home = home();
    // Italian, in mm with decimal commas, lost material negative, no traces
    let (shown, written) = rows(
        &home,
        "PROVA;RUOTA;CICLI;RAGGIO [mm];USURA [mm];SIGMA [mm];NOTE;banco\n\
         A;pignone;100000;26,512;-0,0012;0,0001;;1\nA;pignone;100000;27,5;-0,0025;0,0001;prova;1\n\
         B;corona;100000;52,5;-0,0031;0,0001;;1\nB;corona;250000;52,5;;;;\n",
        "--turn-sign",
    );
    assert_eq!(
        written,
        "A,pinion,100000,wear_depth,26.512,1.2,0.1,A-pinion-100000\n\
         A,pinion,100000,wear_depth,27.5,2.5,0.1,A-pinion-100000\n\
         B,gear,100000,wear_depth,52.5,3.1,0.1,\n"
    );
    for part in [
        "column   `CICLI`: cycles, pinion revolutions\n",
        "column   `RAGGIO [mm]`: radius, mm\n",
        "column   `USURA [mm]`: wear_depth in mm\n",
        "passed over the column `NOTE`: a comment column\n",
        "passed over the column `banco`: not known\n",
        "in tests A, B, their sign turned\n",
        "traces   one for each test, member and checkpoint",
        "empty    1 row without a value",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    // units behind underscores, a column of traces, roll angles: r = r_b sqrt(1 + phi^2)
    let (_, written) = rows(
        &home,
        "Run,Wheel,Revs,roll angle_deg,depth_um,sd_um,profile_id\nA,small,1e5,12,1.5,0.1,p1\nA,small,1e5,24,2.5,0.1,p1\n",
        "",
    );
    assert!(
        written.starts_with("A,pinion,100000,wear_depth,25.9221924,1.5,0.1,p1\nA,pinion,100000,wear_depth,27.5076469,2.5,0.1,p1\n"),
        "{written}"
    );
    // traces that are numbered within test and member
    let (shown, written) = rows(
        &home,
        "run,wheel,revs,r_mm,depth_um,sd_um,trace\nA,small,1e5,26.5,1.5,0.1,1\nA,big,1e5,52.5,2.5,0.1,1\n",
        "",
    );
    assert!(
        written.contains(",A-pinion-1\n") && written.contains(",A-gear-1\n"),
        "{written}"
    );
    assert!(shown.contains("it numbers them within these"), "{shown}");
    // masses have no position; what the table does not say is stated
    let (_, written) = rows(
        &home,
        "cycles;peso [g];u (k=1) [mg]\n100000;0,0042;0,4\n",
        "--test B --member gear --quantity mass_loss",
    );
    assert_eq!(written, "B,gear,100000,mass_loss,,4.2,0.4,\n");
    let (_, written) = rows(
        &home,
        "test;member;revolutions of the pinion;loss_mg\nA;Ritzel;100000;4,2\nA;Rad;100000;8,4\n",
        "--sigma 0.4",
    );
    assert_eq!(
        written,
        "A,pinion,100000,mass_loss,,4.2,0.4,\nA,gear,100000,mass_loss,,8.4,0.4,\n"
    );
}

#[test]
fn a_long_table_that_is_not_understood_is_refused_with_what_was() {
    let home = home();
    let header = "test,member,cycles,radius [mm],depth [um],sigma";
    for (text, options, says) in [
        (
            "test,member,radius [mm],depth [um],oil\nA,pinion,26,1,x\n".to_owned(),
            "",
            "the header in row 1 is `test; member; radius [mm]; depth [um]; oil`; understood: `test` as test, `member` as member, `radius \
             [mm]` as position, `depth [um]` as value (wear_depth); not understood: `oil`; missing: cycles. A long table needs",
        ),
        ("cycles,radius [mm],depth [um]\n1e5,26,1\n".to_owned(), "", "missing: test, member."),
        ("test,member,cycles,depth [um]\nA,pinion,1e5,1\n".to_owned(), "", "missing: position."),
        (
            "test,member,cycles,radius,reading\nA,pinion,1e5,26,1\n".to_owned(),
            "",
            "E1: `reading` does not say what was measured: name it with --quantity",
        ),
        (
            "test,member,cycles,radius,depth [um],mass [mg]\nA,pinion,1e5,26,1,2\n".to_owned(),
            "",
            "E1: `depth [um]` and F1: `mass [mg]` both look like the column `value`",
        ),
        (format!("{header}\nA,pinion,1e5,26,x,0.1\n"), "", "E2: `x` is not a number"),
        (format!("{header}\nC,pinion,1e5,26,1,0.1\n"), "", "A2: `C` below `test`: the study has no test C; its tests: A, B. Add a [[test]] with id = \"C\""),
        (format!("{header}\nA,left,1e5,26,1,0.1\n"), "", "B2: `left` below `member`: write pinion, gear"),
        (format!("{header}\nA,gear,1e5,26,1,0.1\n"), "", "D2: `26` below `radius [mm]`: the radius 26 mm is off the gear's flank"),
        (format!("{header}\nA,pinion,1e5,52,1,0.1\n"), "", "it lies on the other member's flank"),
        (format!("{header}\nB,pinion,1e5,26,1,0.1\n"), "--test A", "--test says A; leave it out"),
        (format!("{header}\nA,pinion,1e5,26,1,0.1\n"), "--sigma 0.1", "the table has a column of sigma"),
        (format!("{header}\nA,pinion,1e5,26,1,0.1\n"), "--columns positions", "--columns is for tables with a column for each"),
        (format!("{header}\nA,pinion,1e5,26,1,0.1\n"), "--quantity mass_loss", "holds wear_depth, --quantity says mass_loss"),
        (
            format!("{header}\nA,pinion,1e5,26,1,0.1\nA,pinion,1e5,27,1,0.1\nA,pinion,1e5,26,1,0.1\n"),
            "",
            "E2 and E4 both hold the same wear_depth of the pinion in test A after 100000 pinion revolutions at 26",
        ),
        (
            "test;member;cycles;radius;depth [um];sigma\nA;pinion;100000;26,5;1.5;0,1\n".to_owned(),
            "",
            "has a decimal point, D2: `26,5` a comma",
        ),
        (
            "test,member,cycles [h],radius,depth [um]\nA,pinion,10,26.5,1.5\n".to_owned(),
            "",
            "C1: `cycles [h]`: cycles in h are not read",
        ),
        (
            "test,member,cycles,radius,depth [mm],sigma\nA,pinion,1e5,26.5,0.0015,0.1\n".to_owned(),
            "",
            "F1: `sigma`: write its unit in the header too: the values are in mm",
        ),
        (
            "test,member,cycles,mass loss [mg],U (k=7) [mg]\nA,pinion,1e5,26.5,1.5\n".to_owned(),
            "",
            "E1: `U (k=7) [mg]`: k = 7 is no coverage factor, which is 1 to 5; write `U (k=2)`",
        ),
        (
            "test,member,cycles,radius,depth [um],sigma [%]\nA,pinion,1e5,26.5,1.5,3\n".to_owned(),
            "",
            "F1: `sigma [%]`: a share of each value is no sigma",
        ),
        (
            "test,member,cycles,quantity,position,value [g],sigma [g]\nA,pinion,1e5,wear_depth,26.5,1.5,3\n".to_owned(),
            "",
            "F1: `value [g]`, with row 2 of wear_depth: unit g: units of wear_depth are um, mm",
        ),
    ] {
        let message = refused(&home, &text, options);
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
}

/// Two weighings of one member, which their headers name, are that member's loss; a multiple of cycles is named as such.
#[test]
fn weighings_of_one_member_may_name_it() {
    let home = home();
    let header = "Versuch;Lastwechsel;Masse Ritzel vorher [g];Masse Ritzel nachher [g]";
    let text = format!("{header}\nA;1E5;26,5;26,4\nA;2E5;26,4;26,2\n");
    for options in ["--sigma 1", "--sigma 1 --member pinion"] {
        let (shown, written) = rows(&home, &text, options);
        assert!(written.contains("A,pinion,200000,mass_loss,,"), "{written}");
        assert!(shown.contains("the columns of the pinion alone"), "{shown}");
    }
    for (text, options, says) in [
        (
            text.clone(),
            "--sigma 1 --member gear",
            "--member says gear",
        ),
        (
            text.replace("Lastwechsel", "Lastwechsel [1E6]"),
            "--sigma 1",
            "B1: `Lastwechsel [1E6]`: 100000 would be 1e11 revolutions: are they written in full below it?",
        ),
        (
            format!("Rad;{header}\nRitzel;A;1E5;26,5;26,4\n"),
            "--sigma 1",
            "missing: nothing, but `Masse Ritzel vorher [g]`, `Masse Ritzel nachher [g]` with the name of a member are not read here",
        ),
    ] {
        let message = refused(&home, &text, options);
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
}

#[test]
fn the_sign_of_a_measurement_file_can_be_turned() {
    let home = home();
    let text = "test,member,cycles,quantity,position,value,sigma\nA,pinion,100000,wear_depth,26,-1.5,0.1\nA,pair,100000,transmission_error,0.5,-2,0.1\n";
    let (shown, written) = rows(&home, text, "--turn-sign");
    assert_eq!(
        written,
        "A,pinion,100000,wear_depth,26,1.5,0.1,\nA,pair,100000,transmission_error,0.5,-2,0.1,\n"
    );
    assert!(shown.contains("their sign turned"), "{shown}");
}

#[test]
fn rows_are_appended_to_a_file_with_other_columns() {
    let home = home();
    fs::write(
        home.path().join("m.csv"),
        "# weighed\ntest,member,cycles,quantity,position,value,sigma,comment\nA,pinion,100000,mass_loss,,4.2,0.4,ok\n",
    )
    .unwrap();
    let depths = "test,member,cycles,radius,depth [um],sigma\nA,pinion,1e5,26,1,0.1\nA,pinion,1e5,27,2,0.1\n";
    let (code, _, message) = import(&home, depths, "-o m.csv --append");
    assert_eq!(code, Some(0), "{message}");
    assert_eq!(
        read(&home, "m.csv"),
        "# weighed\ntest,member,cycles,quantity,position,value,sigma,comment,trace\n\
         A,pinion,100000,mass_loss,,4.2,0.4,ok,\n\
         A,pinion,100000,wear_depth,26,1,0.1,,A-pinion-100000\n\
         A,pinion,100000,wear_depth,27,2,0.1,,A-pinion-100000\n"
    );
    let again = refused(&home, depths, "-o m.csv --append");
    assert!(again.contains("--repeat 2"), "{again}");
    // masses behind depths with traces
    let (code, _, message) = import(
        &home,
        "test,member,cycles,mass loss [mg],sigma\nB,pinion,1e5,4,0.4\n",
        "-o m.csv --append",
    );
    assert_eq!(code, Some(0), "{message}");
    assert!(read(&home, "m.csv").ends_with("B,pinion,100000,mass_loss,,4,0.4,,\n"));
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
fn the_name_of_a_sheet_says_test_and_member() {
    let home = home();
    // the sheets of the workbook are called pinion, gear and rows
    let options = "--study study.toml --test A --sigma 0.2";
    let (code, _, message) = line(
        &home,
        &format!("import tables.xlsx --sheet gear {options} --member pinion"),
    );
    assert_eq!(code, Some(2));
    assert!(
        message.contains(
            "the sheet's name, `gear`, says gear, --member says pinion: say --member gear"
        ),
        "{message}"
    );
    let shown = succeed(&home, &format!("import tables.xlsx --sheet gear {options}"));
    assert!(
        shown.contains("wear_depth of the gear in test A"),
        "{shown}"
    );
}

/// What was passed over silently before: the masses of both members went to one, the columns of all tests to one.
#[test]
fn columns_tell_tests_and_members_by_what_stands_in_them() {
    let home = home();
    let masses = "no.;thing;tours;perte de masse (mg)\n1;pignon;140000;1,08\n2;roue;140000;1,56\n";
    let (shown, written) = rows(&home, masses, "--test B --relative-sigma 0.1");
    assert_eq!(
        written,
        "B,pinion,140000,mass_loss,,1.08,0.108,\nB,gear,140000,mass_loss,,1.56,0.156,\n"
    );
    assert!(
        shown.contains("`thing`: member, by what stands in it"),
        "{shown}"
    );
    assert!(
        refused(&home, masses, "--test B --member gear").contains("B2: `pignon` below `thing`")
    );
    let which = "which,member,cycles,mass loss [mg]\nrun A,pinion,1e5,1\nB,pinion,1e5,2\n";
    let (shown, written) = rows(&home, which, "--sigma 0.1");
    assert_eq!(
        written,
        "A,pinion,100000,mass_loss,,1,0.1,\nB,pinion,100000,mass_loss,,2,0.1,\n"
    );
    assert!(
        shown.contains("`which`: test, by what stands in it"),
        "{shown}"
    );
    // one cell that is none
    let other = "which,member,cycles,mass loss [mg]\nA,pinion,1e5,1\nx,pinion,1e5,2\n";
    assert!(refused(&home, other, "").contains("missing: test"));
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

/// At 2000 rpm an hour has 120,000 revolutions; 8.333 h are the test's end, 1,000,000, to within what is written.
#[test]
fn running_times_are_turned_into_revolutions() {
    let home = home();
    let times =
        "Run,Part,Time (h),Radius (mm),Wear (um)\nA,pinion,1.5,26.5,1\nA,pinion,8.333,26.5,2\n";
    let (shown, written) = rows(&home, times, "--sigma 0.1");
    assert_eq!(
        written,
        "A,pinion,180000,wear_depth,26.5,1,0.1,\nA,pinion,1000000,wear_depth,26.5,2,0.1,\n"
    );
    assert!(
        shown.contains(
            "`Time (h)`: running time, turned into pinion revolutions by the speed of each test"
        ),
        "{shown}"
    );
    let minutes = "Run,Part,Laufzeit [min],Radius (mm),Wear (um)\nA,pinion,90,26.5,1\n";
    assert!(
        rows(&home, minutes, "--sigma 0.1")
            .1
            .starts_with("A,pinion,180000,")
    );
    // decimal commas; a time of whole hours is no rounded end of the test
    let commas =
        "Run;Part;Time (h);Radius (mm);Wear (um)\nA;pinion;8,000;26,5;1\nA;pinion;8,333;26,5;2\n";
    let written = rows(&home, commas, "--sigma 0.1").1;
    assert!(
        written.starts_with("A,pinion,960000,") && written.contains("\nA,pinion,1000000,"),
        "{written}"
    );
    let whole = "Run,Part,Time (h),Radius (mm),Wear (um)\nA,pinion,8,26.5,1\n";
    assert!(
        rows(&home, whole, "--sigma 0.1")
            .1
            .starts_with("A,pinion,960000,")
    );
    // beside cycles a time says nothing more
    let both = "Run,Part,Time (h),cycles,Radius (mm),Wear (um)\nA,pinion,7,1e5,26.5,1\n";
    let (shown, written) = rows(&home, both, "--sigma 0.1");
    assert!(written.starts_with("A,pinion,100000,"), "{written}");
    assert!(
        shown.contains("passed over the column `Time (h)`"),
        "{shown}"
    );
    let unknown = "Run,Part,Time,Radius (mm),Wear (um)\nA,pinion,7,26.5,1\n";
    assert!(refused(&home, unknown, "--sigma 0.1").contains("missing: cycles"));
}

#[test]
fn a_share_may_stand_alone_and_be_of_the_largest_of_a_curve() {
    let home = home();
    let table = "radius;100000\n26;2\n27;0.001\n";
    let (shown, written) = rows(
        &home,
        table,
        "--test A --relative-sigma 0.1 --relative-to largest",
    );
    assert!(
        written.contains(",26,2,0.2,") && written.contains(",27,0.001,0.2,"),
        "{written}"
    );
    assert!(
        shown.contains("sigma    10 % of the largest value of its curve"),
        "{shown}"
    );
    // hypot(0.05, 0.2)
    let options = "--test A --sigma 0.05 --relative-sigma 0.1 --relative-to largest";
    assert!(rows(&home, table, options).1.contains(",26,2,0.2062,"));
    let alone = refused(&home, table, "--test A --relative-sigma 0.1");
    assert!(
        alone.contains("B3: 0.1 of the value 0.001 would be known far better")
            && alone.contains("where little is worn, or --relative-to largest"),
        "{alone}"
    );
}

/// A file for each curve, as gear-measuring machines write it: what the lines above the header say holds for all rows.
#[test]
fn files_of_one_curve_each_are_read_together() {
    let home = home();
    let curve = |member: &str, cycles: &str, first: &str| {
        format!(
            "Profile export\nRun:\tA\nPart:\t{member}\nRevolutions of pinion:\t{cycles}\nNumber of teeth:\t27\n\n\
             Radius [mm]\tDeviation [um]\n{first}\t-2.5\n27.5\t-1.25\n"
        )
    };
    for (name, text) in [
        ("a.txt", curve("pinion", "100000", "26.5")),
        ("b.txt", curve("pinion", "250000", "26.6")),
    ] {
        fs::write(home.path().join(name), text).unwrap();
    }
    let all = "import a.txt b.txt --study study.toml --turn-sign --sigma 0.1 -o m.csv";
    let shown = succeed(&home, all);
    for part in [
        "layout   row 2, `Run`: test A\n",
        "layout   row 3, `Part`: member pinion\n",
        "layout   row 4, `Revolutions of pinion`: cycles 100000\n",
        "title    row 5 passed over: Number of teeth: 27\n",
        "table    b.txt, read alike: 2 rows, wear_depth of pinion in test A after 250000\n",
        "wrote m.csv: 4 rows\n",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    assert_eq!(
        read(&home, "m.csv"),
        "test,member,cycles,quantity,position,value,sigma,trace\n\
         A,pinion,100000,wear_depth,26.5,2.5,0.1,A-pinion-100000\n\
         A,pinion,100000,wear_depth,27.5,1.25,0.1,A-pinion-100000\n\
         A,pinion,250000,wear_depth,26.6,2.5,0.1,A-pinion-250000\n\
         A,pinion,250000,wear_depth,27.5,1.25,0.1,A-pinion-250000\n"
    );
    // the same curve twice is no second measurement
    let (code, _, message) = line(&home, "import a.txt a.txt --study study.toml --sigma 0.1");
    assert_eq!(code, Some(2));
    assert!(message.contains("the reading A,pinion,100000"), "{message}");
    // a curve that says nothing of itself
    let bare = "Radius [mm];Deviation [um]\n26.5;2.5\n27.5;1.5\n";
    let options = "--test B --member pinion --cycles 5000 --sigma 0.1";
    assert_eq!(
        rows(&home, bare, options).1,
        "B,pinion,5000,wear_depth,26.5,2.5,0.1,B-pinion-5000\nB,pinion,5000,wear_depth,27.5,1.5,0.1,B-pinion-5000\n"
    );
    // a member that the lines state is not overruled
    let pinion = curve("pinion", "100000", "26.5");
    assert!(refused(&home, &pinion, "--member gear").contains("--member says gear"));
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

/// What was lost is the difference of two weighings, never the mass that is left.
#[test]
fn two_weighings_are_a_loss() {
    let home = home();
    let table = "Test,Revolutions,Member,Mass before [g],Mass after [g]\nA,5000,pinion,812.4312,812.4055\nA,6000,gear,2955.1207,2955.1\n";
    let (shown, written) = rows(&home, table, "--sigma 1");
    assert!(
        shown.contains("layout   mass loss: `Mass before [g]` less `Mass after [g]`\n"),
        "{shown}"
    );
    assert_eq!(
        written,
        "A,pinion,5000,mass_loss,,25.7,1,\nA,gear,6000,mass_loss,,20.7,1,\n"
    );
    let german = "Versuch;Umdrehungen;Bauteil;Masse vorher [g];Masse nachher [g]\nA;5000;Ritzel;812,4312;812,4055\n";
    assert_eq!(
        rows(&home, german, "--sigma 1").1,
        "A,pinion,5000,mass_loss,,25.7,1,\n"
    );
    let one = "Test,Revolutions,Member,Mass after [g]\nA,5000,pinion,812.4055\n";
    assert!(
        refused(&home, one, "--sigma 1").contains("D1: `Mass after [g]` is a mass and no loss"),
    );
    let units = table.replace("Mass after [g]", "Mass after [mg]");
    assert!(refused(&home, &units, "--sigma 1").contains("in two units"));
    // a share of the largest of a test's masses, not of each
    let shares =
        "test,cycles,member,mass loss [mg]\nA,5000,pinion,2\nA,9000,pinion,20\nA,9000,gear,40\n";
    let of_largest = rows(&home, shares, "--relative-sigma 0.1 --relative-to largest").1;
    assert_eq!(
        of_largest,
        "A,pinion,5000,mass_loss,,2,2,\nA,pinion,9000,mass_loss,,20,2,\nA,gear,9000,mass_loss,,40,4,\n"
    );
}

/// The example's values are nobody's measurements.
#[test]
fn rows_are_not_put_behind_the_example_of_init() {
    let home = tempfile::tempdir().unwrap();
    succeed(&home, "init new");
    let table = "test,cycles,member,mass loss [mg]\nA,5000,pinion,2\n";
    fs::write(home.path().join("table.csv"), table).unwrap();
    let import = "import table.csv --study new/study.toml --sigma 1 -o new/measurements.csv";
    let file = home.path().join("new/measurements.csv");
    let windows = fs::read_to_string(&file).unwrap().replace("\n", "\r\n");
    fs::write(&file, windows).unwrap();
    for how in ["", " --append"] {
        let (code, _, message) = line(&home, &format!("{import}{how}"));
        assert_eq!(code, Some(2));
        assert!(
            message.contains("made-up measurements") && message.contains("--force"),
            "{message}"
        );
    }
    succeed(&home, &format!("{import} --force"));
    assert_eq!(read(&home, "new/measurements.csv").lines().count(), 2);
}

#[test]
fn all_sheets_are_read_one_after_the_other() {
    let home = home();
    let (code, _, message) = line(&home, "import tables.xlsx --study study.toml --sigma 0.1");
    assert_eq!(code, Some(2));
    assert!(message.contains("--all-sheets"), "{message}");
    let (code, _, message) = line(
        &home,
        "import tables.xlsx --all-sheets --study study.toml --test B --sigma 0.1",
    );
    // which of them cannot be read is said
    assert_eq!(code, Some(2), "{message}");
    assert!(
        message.contains("tables.xlsx, sheet rows: A2: `A` below `test`: --test says B"),
        "{message}"
    );
}

/// What an option says of the sheets without a column of sigma is no second word on those with one.
#[test]
fn a_stated_sigma_is_of_the_sheets_without_a_column_of_it() {
    let home = home();
    let all = "import tables.xlsx --all-sheets --study study.toml --test A --sigma 0.3 -o m.csv";
    let shown = succeed(&home, all);
    for part in [
        "sigma    0.3 µm for each\n",
        "sigma    as the column says (what the options say is of the sheets without one)\n",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    let written = read(&home, "m.csv");
    for row in [
        "A,gear,100000,wear_depth,52,1.5,0.3,A-gear-100000\n",
        "A,pinion,100000,wear_depth,26.5,2.5,0.1,p1\n",
        "A,gear,100000,mass_loss,,55,1.5,\n",
    ] {
        assert!(written.contains(row), "no `{row}` in:\n{written}");
    }
    let one = "import tables.xlsx --sheet rows --study study.toml --sigma 0.3";
    let (code, _, message) = line(&home, one);
    assert_eq!(code, Some(2));
    assert!(
        message.contains("the table has a column of sigma"),
        "{message}"
    );
}

/// What a table says twice has to agree, and what it says of cycles has to be plain.
#[test]
fn lines_above_a_header_are_obeyed_or_refused() {
    let home = home();
    let curve = |lines: &str| format!("{lines}\nRadius [mm];Depth [um]\n26.5;2.5\n27.5;1.5\n");
    let all = "Run;A\nPart;pinion\nRevolutions;40000";
    assert!(
        rows(&home, &curve(all), "--sigma 0.1")
            .1
            .starts_with("A,pinion,40000,")
    );
    // 20000 of the gear are 20000 53/27 of the pinion
    let of_gear = curve("Run: A\nPart: gear\nRevolutions: 20000 gear").replace("26.5", "52.5");
    assert!(
        rows(&home, &of_gear.replace("27.5", "53"), "--sigma 0.1")
            .1
            .starts_with("A,gear,39259.2593,")
    );
    for (lines, options, says) in [
        ("Run: A\nRevolutions: 40k", "", "a multiple or a time"),
        (
            "Run: A\nRevolutions: 40,000",
            "",
            "marked between thousands",
        ),
        ("Run: A\nRevolutions;40000;x1000", "", "several numbers"),
        (
            "Run: A\nRun: B\nRevolutions: 4000",
            "",
            "row 2: `Run` says test B, row 1 says A",
        ),
        (
            "Run: A\nRevolutions: 4000\nCycles: 3000",
            "",
            "row 2 says 4000",
        ),
        ("Run: C\nRevolutions: 4000", "", "the study has no test C"),
        ("Run: B\nRevolutions: 4000", "--test A", "--test says A"),
        (
            "Run: A\nPart: pinion\nRevolutions: 4000",
            "--member gear",
            "--member says gear",
        ),
        (
            "Run: A\nRevolutions: 4000",
            "--cycles 5000",
            "--cycles is for a table that does not say",
        ),
    ] {
        let message = refused(&home, &curve(lines), &format!("{options} --sigma 0.1"));
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
    let long = "Run: B\ntest,cycles,member,mass loss [mg]\nA,5000,pinion,2\n";
    assert!(refused(&home, long, "--sigma 1").contains("A3 says A: take the wrong one out"));
    // above a wide table too
    let wide = "Run;B\nPart;gear\nradius;5000;6000\n52.5;1.5;2.5\n53;1;2\n";
    assert!(
        rows(&home, wide, "--sigma 0.1")
            .1
            .starts_with("B,gear,5000,wear_depth,52.5,")
    );
    assert!(refused(&home, wide, "--test A --sigma 0.1").contains("--test says A"));
    assert!(refused(&home, wide, "--cycles 5 --sigma 0.1").contains("--cycles is for"));
    // masses after one count of cycles, and those of both members below a test
    let masses = "test;member;mass loss [mg]\nA;pinion;12\n";
    assert_eq!(
        rows(&home, masses, "--cycles 5000 --sigma 1").1,
        "A,pinion,5000,mass_loss,,12,1,\n"
    );
    let both = "Test;A\n\nrevolutions;pinion loss mg;gear loss mg\n5000;12;30\n";
    assert_eq!(
        rows(&home, both, "--sigma 1").1,
        "A,pinion,5000,mass_loss,,12,1,\nA,gear,5000,mass_loss,,30,1,\n"
    );
}

/// Weighings of both members, other marks, and tables that have a loss beside them.
#[test]
fn weighings_are_read_with_the_marks_and_the_columns_of_their_table() {
    let home = home();
    let sides = "Versuch;Umdrehungen;Masse Ritzel vor [g];Masse Ritzel nach [g];Masse Rad vor [g];Masse Rad nach [g]\n\
                 A;5000;812,4312;812,4055;2955,1207;2955,1\n";
    assert_eq!(
        rows(&home, sides, "--sigma 1").1,
        "A,pinion,5000,mass_loss,,25.7,1,\nA,gear,5000,mass_loss,,20.7,1,\n"
    );
    let points =
        "test;cycles;member;mass before [g];mass after [g]\nA;5000;pinion;812.4312;812.4055\n";
    assert!(
        refused(&home, points, "--sigma 1 --decimal comma")
            .contains("is no number with --decimal comma")
    );
    let unclear = "test;cycles;member;mass before [g];mass after [g]\nA;5000;pinion;2.955;2.950\n";
    assert!(
        refused(&home, unclear, "--sigma 1").contains("say --decimal point or --decimal comma")
    );
    assert_eq!(
        rows(&home, unclear, "--sigma 1 --decimal point").1,
        "A,pinion,5000,mass_loss,,5,1,\n"
    );
    let sigma = "test;cycles;member;mass before [g];mass after [g];Unsicherheit [mg]\nA;5000;pinion;812,4312;812,4055;0,5\n";
    assert_eq!(
        rows(&home, sigma, "").1,
        "A,pinion,5000,mass_loss,,25.7,0.5,\n"
    );
    for beside in [
        "test,cycles,member,mass before [g],mass loss [mg]\nA,5000,pinion,812.4312,25.7\n",
        "test,cycles,member,mass before [g],mass after [g],mass loss [mg]\nA,5000,pinion,812.4312,812.4055,25.7\n",
    ] {
        let (shown, written) = rows(&home, beside, "--sigma 1");
        assert_eq!(written, "A,pinion,5000,mass_loss,,25.7,1,\n");
        assert!(
            shown.contains("the column `mass before [g]`: a weighing"),
            "{shown}"
        );
    }
    // a deviation is a depth only where nothing else is
    let both = "test,cycles,member,radius,depth,deviation\nA,5000,pinion,26.5,2,9\n";
    assert!(
        rows(&home, both, "--sigma 1")
            .1
            .contains("wear_depth,26.5,2,1,")
    );
    // a table read with the other sign is not said to be read alike
    let table = "test,cycles,member,radius,depth\nA,5000,pinion,26.5,2\n";
    fs::write(home.path().join("a.csv"), table).unwrap();
    let turned = format!(
        "negative = material lost\n{}",
        table.replace("5000", "6000")
    );
    fs::write(home.path().join("b.csv"), turned).unwrap();
    let shown = succeed(&home, "import a.csv b.csv --study study.toml --sigma 1");
    assert!(
        !shown.contains("read alike") && shown.contains("their sign turned"),
        "{shown}"
    );
}

/// A table is the same one where a face was written beside its rows since, and another one at another face.
#[test]
fn a_table_is_not_taken_twice_at_a_face_and_without() {
    let home = home();
    let table = |face: &str, value: &str| {
        let (name, face) = match face {
            "" => ("", String::new()),
            face => (",face", format!(",{face}")),
        };
        format!(
            "test,member,cycles,radius,depth [um],sigma{name}\nA,pinion,1e5,26,1.5,0.1{face}\nA,pinion,1e5,27,{value},0.1{face}\n"
        )
    };
    for (first, second, says) in [
        (
            "8.07",
            "8.070",
            "is there already: was this table taken before?",
        ),
        (
            "8.07",
            "",
            "is there already at face 8.07: was this table taken before?",
        ),
        (
            "",
            "8.07",
            "is there already without a face: was this table taken before?",
        ),
    ] {
        rows(&home, &table(first, "1.25"), "");
        let before = read(&home, "out.csv");
        let message = refused(&home, &table(second, "1.25"), "-o out.csv --append");
        assert!(message.contains(says), "no `{says}` in: {message}");
        assert_eq!(read(&home, "out.csv"), before);
    }
    // another place, and one value of two that is the same by chance
    rows(&home, &table("8.07", "1.25"), "");
    for (face, value) in [("-8.07", "1.25"), ("", "1.75")] {
        let (code, _, message) = import(&home, &table(face, value), "-o out.csv --append");
        assert_eq!(code, Some(0), "{message}");
    }
    assert_eq!(read(&home, "out.csv").lines().count(), 7);
}

/// A weighing sheet with a column for each member: at 2000 rpm half an hour has 60,000 revolutions.
#[test]
fn columns_named_after_members_hold_what_the_user_says() {
    let home = home();
    let sheet = "Run,Hours,Pinion (g),Wheel (g)\nA,0.5,0.00019,0.01151\nA,1.5,0.04491,\nB,0.5,0.0744,0.0819\n";
    let (shown, written) = rows(&home, sheet, "--quantity mass_loss --sigma 0.7");
    assert_eq!(
        written,
        "A,pinion,60000,mass_loss,,0.19,0.7,\nA,pinion,180000,mass_loss,,44.91,0.7,\nB,pinion,60000,mass_loss,,74.4,0.7,\n\
         A,gear,60000,mass_loss,,11.51,0.7,\nB,gear,60000,mass_loss,,81.9,0.7,\n"
    );
    for part in [
        "layout   the columns of the pinion and of the gear side by side\n",
        "running time, turned into pinion revolutions",
        "mass_loss in g\n",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    // revolutions in place of hours, one member alone, no unit
    let one = "Run,Revolutions,Pinion (mg)\nA,5000,12\n";
    assert_eq!(
        rows(&home, one, "--quantity mass_loss --sigma 1").1,
        "A,pinion,5000,mass_loss,,12,1,\n"
    );
    let bare = "Run,Revolutions,Pinion,Wheel\nA,5000,12,30\n";
    assert_eq!(
        rows(&home, bare, "--quantity mass_loss --sigma 1").1,
        "A,pinion,5000,mass_loss,,12,1,\nA,gear,5000,mass_loss,,30,1,\n"
    );
    // the masses that are left, or what was lost?
    for options in ["--sigma 1", "--test A --sigma 1"] {
        let message = refused(&home, sheet, options);
        for part in [
            "C1: `Pinion (g)` and D1: `Wheel (g)`: the columns of the members are in g, so they hold masses",
            "--quantity mass_loss",
            "two weighings are understood as well",
        ] {
            assert!(message.contains(part), "no `{part}` in: {message}");
        }
    }
    // as the message says
    let weighings = "Run,Hours,mass pinion before [g],mass pinion after [g],mass wheel before [g],mass wheel after [g]\n\
                     A,0.5,812.4312,812.4055,2955.1207,2955.1\n";
    assert_eq!(
        rows(&home, weighings, "--sigma 1").1,
        "A,pinion,60000,mass_loss,,25.7,1,\nA,gear,60000,mass_loss,,20.7,1,\n"
    );
    let depths = sheet.replace("(g)", "(um)");
    assert!(
        refused(&home, &depths, "--quantity mass_loss --sigma 1")
            .contains("unit um: units of mass_loss are mg, g")
    );
}

#[test]
fn a_test_that_the_study_lacks_is_to_be_added() {
    let home = home();
    let study = STUDY.replace("id = \"B\"", "id = \"wet-17\"");
    fs::write(home.path().join("study.toml"), study).unwrap();
    let of = |id: &str| format!("test,member,cycles,mass loss [mg]\n{id},pinion,1e5,4\n");
    for (id, meant) in [
        ("D", None),
        ("wet-18", None),
        ("a", Some("A")),
        ("WET 17", Some("wet-17")),
        ("wte-17", Some("wet-17")),
    ] {
        let message = refused(&home, &of(id), "--sigma 1");
        let says = format!(
            "the study has no test {id}; its tests: A, wet-17. Add a [[test]] with id = \"{id}\" to the study"
        );
        assert!(message.contains(&says), "no `{says}` in: {message}");
        match meant {
            Some(meant) => assert!(
                message.contains(&format!("or is `{meant}` meant?")),
                "{message}"
            ),
            None => assert!(!message.contains("meant?"), "{message}"),
        }
    }
    let wide = "radius;100000\n26;1\n";
    let message = refused(&home, wide, "--test D --sigma 1");
    assert!(
        message.contains("Add a [[test]] with id = \"D\""),
        "{message}"
    );
    let headers = "radius;A 100000;D 100000\n26;1;2\n";
    let message = refused(&home, headers, "--sigma 1");
    assert!(
        message.contains("the header `D 100000` names no test of the study, others do")
            && message.contains("Add a [[test]]"),
        "{message}"
    );
    let nothing = "test,member,cycles,mass loss [mg]\n,pinion,1e5,4\n";
    assert!(refused(&home, nothing, "--sigma 1").contains("every row says of which test it is"));
}

#[test]
fn an_expanded_uncertainty_is_divided_by_its_k() {
    let home = home();
    let table = |header: &str| {
        format!("test,member,cycles,radius,depth [um],{header}\nA,pinion,1e5,26,1.5,0.3\n")
    };
    for (header, sigma, words) in [
        (
            "u(k=2)",
            "0.15",
            "an expanded uncertainty, sigma is it over k = 2",
        ),
        (
            "U (k=2)",
            "0.15",
            "an expanded uncertainty, sigma is it over k = 2",
        ),
        (
            "U (k = 2) [nm]",
            "0.00015",
            "an expanded uncertainty in nm, sigma is it over k = 2",
        ),
        (
            "U [um] (k=3)",
            "0.1",
            "an expanded uncertainty in µm, sigma is it over k = 3",
        ),
        (
            "expanded uncertainty (k = 1.5)",
            "0.2",
            "sigma is it over k = 1.5",
        ),
        ("u (k=1) [um]", "0.3", "sigma in µm"),
    ] {
        let (shown, written) = rows(&home, &table(header), "");
        assert_eq!(
            written,
            format!("A,pinion,100000,wear_depth,26,1.5,{sigma},\n"),
            "{header}"
        );
        let said = format!("column   `{header}`: {words}");
        assert!(
            shown.contains(&said) || shown.contains(words),
            "no `{said}` in:\n{shown}"
        );
    }
    // how many standard deviations it is does not stand there
    let (shown, written) = rows(&home, &table("U95"), "--sigma 0.2");
    assert_eq!(written, "A,pinion,100000,wear_depth,26,1.5,0.2,\n");
    assert!(
        shown.contains("passed over the column `U95`: an expanded uncertainty that does not say its k: call it `U (k=2)`"),
        "{shown}"
    );
    for k in ["0.5", "6"] {
        let header = format!("U (k={k})");
        assert!(refused(&home, &table(&header), "").contains("is no coverage factor"));
    }
}

#[test]
fn cycles_may_be_called_n_and_members_be_numbered() {
    let home = home();
    for name in ["N_pinion", "n pinion", "N"] {
        let table = format!(
            "run,wheel,{name},quantity,r,value,u(k=2)\nA,1,5.3e4,depth,26,1.5,0.2\nA,2,5.3e4,mass loss,,4,0.8\n"
        );
        let (shown, written) = rows(&home, &table, "");
        assert_eq!(
            written, "A,pinion,53000,wear_depth,26,1.5,0.1,\nA,gear,53000,mass_loss,,4,0.4,\n",
            "{name}"
        );
        assert!(
            shown.contains("column   `wheel`: member, 1 the pinion and 2 the gear\n"),
            "{shown}"
        );
    }
    // a speed, a number of the row or of a gear, one of a part beside a column of members
    let speed = "run,part,n [rpm],cycles,mass loss [mg]\nA,1,2000,5000,4\n";
    assert_eq!(
        rows(&home, speed, "--sigma 1").1,
        "A,pinion,5000,mass_loss,,4,1,\n"
    );
    let row = "n,run,part,mass loss [mg]\n1,A,pinion,4\n";
    assert!(refused(&home, row, "--sigma 1").contains("missing: cycles"));
    let gear = "run,N. ruota,member,mass loss [mg]\nA,7,pinion,4\n";
    assert!(refused(&home, gear, "--sigma 1").contains("missing: cycles"));
    let words = "run,part,what,cycles,mass loss [mg]\nA,1,gear,5000,4\nA,2,gear,6000,5\n";
    assert!(
        refused(&home, words, "--sigma 1").contains("B2: `1` below `part`: write pinion, gear")
    );
    let third = "run,part,cycles,mass loss [mg]\nA,1,5000,4\nA,3,6000,5\n";
    assert!(refused(&home, third, "--sigma 1").contains("`1` below `part`"));
    assert!(
        refused(&home, speed, "--sigma 1 --member gear")
            .contains("--member says gear; leave it out")
    );
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

/// The face of the study is 33 mm wide.
#[test]
fn a_face_may_be_stated_for_a_whole_table() {
    let home = home();
    let wide = "radius;100000\n26;1.5\n27;1\n";
    let options = "--test A --sigma 0.1 --face -8.07";
    let (shown, written) = rows(&home, wide, options);
    assert_eq!(
        written,
        "A,pinion,100000,wear_depth,26,1.5,0.1,A-pinion-100000-face-8.07,-8.07\n\
         A,pinion,100000,wear_depth,27,1,0.1,A-pinion-100000-face-8.07,-8.07\n"
    );
    assert!(
        shown.contains("face     -8.07 mm from the middle of the face\n"),
        "{shown}"
    );
    // the same table again, and another profile of the same checkpoint
    let again = refused(&home, wide, &format!("{options} -o out.csv --append"));
    assert!(again.contains("is there already"), "{again}");
    let (code, _, message) = import(
        &home,
        wide,
        "--test A --sigma 0.1 --face 16.5 -o out.csv --append",
    );
    assert_eq!(code, Some(0), "{message}");
    // masses beside depths are of no place
    let long = "test,member,cycles,quantity,position,value,sigma\nA,pinion,1e5,wear_depth,26,1.5,0.1\nA,pinion,1e5,mass_loss,,4,0.4\n";
    assert_eq!(
        rows(&home, long, "--face 4").1,
        "A,pinion,100000,wear_depth,26,1.5,0.1,,4\nA,pinion,100000,mass_loss,,4,0.4,,\n"
    );
    let column = "test,member,cycles,radius,depth [um],sigma,face\nA,pinion,1e5,26,1.5,0.1,8\n";
    let masses = "test,member,cycles,mass loss [mg]\nA,pinion,1e5,4\n";
    for (table, options, says) in [
        (
            column,
            "--face 8",
            "--face: the table has a column of places across the face, G1: `face`",
        ),
        (
            wide,
            "--test A --sigma 0.1 --face 16.6",
            "--face 16.6: the face of the study is 33 mm wide, so a place on it is -16.5 to 16.5 mm from its middle",
        ),
        (
            masses,
            "--sigma 1 --face 8",
            "mass_loss is of the whole face: leave it out",
        ),
        (
            wide,
            "--test A --face 8mm",
            "write a number with a decimal point",
        ),
    ] {
        let message = refused(&home, table, options);
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
}

#[test]
fn a_sigma_in_another_unit_than_its_own_is_said_to_be_wrong() {
    let home = home();
    let table = |count: usize| {
        let rows: String = (0..count)
            .map(|i| format!("{};{}\n", 26.0 + 0.1 * i as f64, 1.0 + 0.04 * i as f64))
            .collect();
        format!("radius;100000\n{rows}")
    };
    let message = refused(&home, &table(11), "--test A --sigma 70");
    assert!(
        message.contains(
            "--sigma 70: this is 50 times the largest wear_depth of the table, 1.4 µm; --sigma takes one standard deviation in µm"
        ) && !message.contains("looks like"),
        "{message}"
    );
    // a few values may be lost in their noise
    rows(&home, &table(3), "--test A --sigma 70");
}

/// Weighed before and after each interval, a part loses what all intervals took.
#[test]
fn weighings_at_each_stop_are_added_up() {
    let home = home();
    let head = "test,member,cycles,mass before [g],mass after [g]\n";
    // the gear is weighed against its new mass each time; rows need not stand in the order of time
    let rows_of = "A,pinion,250000,412.2671,412.2357\nA,pinion,100000,412.3000,412.2671\nA,pinion,500000,412.2358,412.2029\n\
                   A,gear,100000,1630.1,1630.09\nA,gear,250000,1630.1,1630.07\n";
    let (shown, written) = rows(&home, &format!("{head}{rows_of}"), "--sigma 1");
    assert_eq!(
        written,
        "A,pinion,250000,mass_loss,,64.3,1,\nA,pinion,100000,mass_loss,,32.9,1,\nA,pinion,500000,mass_loss,,97.1,1,\n\
         A,gear,100000,mass_loss,,10,1,\nA,gear,250000,mass_loss,,30,1,\n"
    );
    for part in [
        "layout   mass loss: each `mass before [g]` is `mass after [g]` of the stop before it, so the losses are added up from the first",
        "layout   mass loss: `mass before [g]` less `mass after [g]`\n",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    // another part, an interval that is left out, and a change of how it was weighed
    for (third, says) in [
        (
            "A,pinion,500000,412.2300,412.2029",
            "row 4: `mass before [g]` is 412.23, in row 2 it is 412.3 and `mass after [g]` in row 3 is 412.2357",
        ),
        (
            "A,pinion,500000,412.3000,412.2029",
            "row 4: `mass before [g]` is 412.3,",
        ),
    ] {
        let table = format!(
            "{head}A,pinion,100000,412.3000,412.2671\nA,pinion,250000,412.2671,412.2357\n{third}\n"
        );
        let message = refused(&home, &table, "--sigma 1");
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
}

#[test]
fn a_deviation_before_and_one_after_are_a_depth() {
    let home = home();
    let table = "test,member,cycles,radius_mm,deviation before [um],deviation after [um]\n\
                 A,pinion,100000,26,3.635,0.553\nA,pinion,100000,27,-2.5,-2.75\nA,pinion,100000,28,1,\n";
    let depths = "A,pinion,100000,wear_depth,26,3.082,0.1,A-pinion-100000\nA,pinion,100000,wear_depth,27,0.25,0.1,A-pinion-100000\n";
    for options in ["--sigma 0.1", "--sigma 0.1 --turn-sign"] {
        let (shown, written) = rows(&home, table, options);
        assert_eq!(written, depths, "{options}");
        assert!(
            shown.contains(
                "layout   wear depth: `deviation before [um]` less `deviation after [um]`"
            ),
            "{shown}"
        );
    }
    let sides = "test,cycles,radius pinion [mm],Deviation pinion before [um],Deviation pinion after [um],radius gear [mm],\
                 Deviation gear before [um],Deviation gear after [um]\nA,100000,26,3,1,52,2,1\n";
    assert_eq!(
        rows(&home, sides, "--sigma 0.1").1,
        "A,pinion,100000,wear_depth,26,2,0.1,\nA,gear,100000,wear_depth,52,1,0.1,\n"
    );
    let otherwise = format!("positive = material lost\n{table}");
    assert!(refused(&home, &otherwise, "--sigma 0.1").contains("lost material is positive"));
    let units = table.replace("after [um]", "after [mm]");
    assert!(refused(&home, &units, "--sigma 0.1").contains("in two units"));
}

#[test]
fn two_flanks_are_no_one_curve() {
    let home = home();
    let table = |second: &str| {
        format!(
            "test,member,flank,cycles,radius,depth\nA,pinion,left,1e5,26,1\nA,pinion,{second},1e5,27,2\n"
        )
    };
    let message = refused(&home, &table("right"), "--sigma 0.1");
    assert!(
        message.contains("C3: `flank` says `right`, C2 says `left`, both of the pinion in test A: wear is that of the loaded flank, so keep the rows of"),
        "{message}"
    );
    let (shown, written) = rows(&home, &table("Left"), "--sigma 0.1");
    assert_eq!(written.lines().count(), 2, "{written}");
    assert!(
        shown.contains("passed over the column `flank`: one flank"),
        "{shown}"
    );
    // in files of one curve each, long or wide
    for body in [
        "radius [mm],depth [um]\n26,1\n27,2\n",
        "radius [mm],40000,50000\n26,1,2\n27,2,3\n",
    ] {
        for flank in ["left", "right"] {
            let cycles = if body.contains("depth") {
                "Cycles: 40000\n"
            } else {
                ""
            };
            let text = format!("Test: A\nPart: pinion\n{cycles}Flank: {flank}\n\n{body}");
            fs::write(home.path().join(format!("{flank}.csv")), text).unwrap();
        }
        let (code, _, message) = line(
            &home,
            "import left.csv right.csv --study study.toml --sigma 0.1",
        );
        assert_eq!(code, Some(2));
        assert!(
            message.contains("right.csv is of the flank `right`, left.csv of the flank `left`, both of the pinion in test A"),
            "{message}"
        );
        succeed(&home, "import left.csv --study study.toml --sigma 0.1");
    }
}

#[test]
fn teeth_do_not_share_a_trace() {
    let home = home();
    for (tooth, first) in [("1", "1"), ("8", "2")] {
        let text = format!(
            "Test: A\nPart: pinion\nCycles: 40000\nTooth: {tooth}\nOperator of tooth {tooth}\n\nradius [mm],depth [um]\n26,{first}\n27,2.5\n"
        );
        fs::write(home.path().join(format!("t{tooth}.txt")), text).unwrap();
    }
    let shown = succeed(
        &home,
        "import t1.txt t8.txt --study study.toml --sigma 0.1 -o m.csv",
    );
    assert_eq!(
        read(&home, "m.csv"),
        "test,member,cycles,quantity,position,value,sigma,trace,tooth\n\
         A,pinion,40000,wear_depth,26,1,0.1,A-pinion-40000-tooth1,1\nA,pinion,40000,wear_depth,27,2.5,0.1,A-pinion-40000-tooth1,1\n\
         A,pinion,40000,wear_depth,26,2,0.1,A-pinion-40000-tooth8,8\nA,pinion,40000,wear_depth,27,2.5,0.1,A-pinion-40000-tooth8,8\n"
    );
    for part in [
        "layout   row 4, `Tooth`: tooth 1\n",
        "after 40000, tooth 8\n",
        // what is passed over in each file, not in the first alone
        "title    row 5 passed over: Operator of tooth 1\n",
        "title    row 5 passed over: Operator of tooth 8\n",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    let wide = "Test: A\nTooth: 8\nradius [mm],40000\n26,1\n";
    assert_eq!(
        rows(&home, wide, "--member pinion --sigma 0.1").1,
        "A,pinion,40000,wear_depth,26,1,0.1,A-pinion-40000-tooth8,8\n"
    );
}

/// Hours become revolutions by the speed of the study's test, 2000 rpm, so no other one may stand beside them.
#[test]
fn a_speed_beside_running_times_is_that_of_the_test() {
    let home = home();
    let column = |header: &str, speed: &str| {
        format!(
            "test,member,hours,{header},radius,depth\nA,pinion,1.5,{speed},26,1\nA,pinion,1.5,{speed},27,2\n"
        )
    };
    let lines = |speed: &str| {
        format!(
            "Test: A\nPart: pinion\n{speed}\nRun time [h]: 1.5\n\nradius [mm],depth [um]\n26,1\n27,2\n"
        )
    };
    for (table, says) in [
        (
            column("speed [rpm]", "1500"),
            "D2: `1500` below `speed [rpm]` is another speed than that of test A in the study, 2000 rpm",
        ),
        (
            lines("Speed: 1500 rpm"),
            "row 3: `Speed: 1500 rpm` is another speed than that of test A in the study, 2000 rpm",
        ),
        (lines("Drehzahl [1/min]: 1500"), "2000 rpm"),
        (lines("n = 1500 1/min"), "2000 rpm"),
        (lines("Speed: 1500rpm"), "2000 rpm"),
        (column("speed_rpm", "1500"), "2000 rpm"),
        (column("n_rpm", "1500"), "2000 rpm"),
        // 2000 of 27 teeth are 1018.9 of 53
        (lines("Gear speed: 2000 rpm"), "1019 rpm"),
    ] {
        let message = refused(&home, &table, "--sigma 0.1");
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
    for table in [
        column("speed [rpm]", "2000"),
        column("Drehzahl", "1998"),
        column("rpm", "2000 rpm"),
        lines("Speed: 2000 rpm"),
        lines("Speed: 2.000 rpm"),
        lines("Gear speed: 1019 rpm"),
    ] {
        let (shown, written) = rows(&home, &table, "--sigma 0.1");
        assert!(written.starts_with("A,pinion,180000,"), "{table}{written}");
        assert!(!shown.contains("passed over"), "{shown}");
    }
    // beside revolutions it is passed over
    let cycles = column("speed [rpm]", "1500").replace("hours", "cycles");
    let (shown, _) = rows(&home, &cycles.replace("1.5,", "40000,"), "--sigma 0.1");
    assert!(
        shown.contains("passed over the column `speed [rpm]`"),
        "{shown}"
    );
}

#[test]
fn a_capital_u_without_a_k_is_no_sigma() {
    let home = home();
    for header in [
        "U [um]",
        "U",
        "U (95%) [um]",
        "U [um] (95 %)",
        "u (95 %)",
        "uncertainty 95 % [um]",
    ] {
        let table =
            format!("test,member,cycles,radius,depth [um],{header}\nA,pinion,1e5,26,1.5,0.3\n");
        let (shown, written) = rows(&home, &table, "--sigma 0.2");
        assert_eq!(
            written, "A,pinion,100000,wear_depth,26,1.5,0.2,\n",
            "{header}"
        );
        let says = format!(
            "passed over the column `{header}`: an expanded uncertainty that does not say its k"
        );
        assert!(shown.contains(&says), "no `{says}` in:\n{shown}");
    }
    let small = "test,member,cycles,radius,depth [um],u [um]\nA,pinion,1e5,26,1.5,0.3\n";
    assert!(rows(&home, small, "").1.contains(",1.5,0.3,"));
    let both = "test,member,cycles,radius,depth [um],U (k=2; 95 %) [um]\nA,pinion,1e5,26,1.5,0.3\n";
    assert!(rows(&home, both, "").1.contains(",1.5,0.15,"));
}

#[test]
fn what_counts_no_revolutions_is_no_checkpoint() {
    let home = home();
    let options = "--test A --member pinion --sigma 0.1";
    for header in [
        "70 hrs",
        "2 wk",
        "25 %",
        "2000 rpm",
        "100 T",
        "20 °C",
        "50 Nm",
        "5 mm",
        "1 tooth",
        "100000 left",
        "70 [hrs]",
    ] {
        let message = refused(
            &home,
            &format!("radius [mm],{header}\n26,300\n27,200\n"),
            options,
        );
        assert!(
            message.contains(&format!("B1: the header `{header}` has `"))
                && message.contains("a checkpoint is a number of revolutions"),
            "{header}: {message}"
        );
    }
    let stages = refused(
        &home,
        "radius [mm],stage 1,stage 2\n26,3,4\n27,2,3\n",
        options,
    );
    assert!(
        stages.contains("B1: the header `stage 1` counts stages or measurements"),
        "{stages}"
    );
    for header in [
        "100000 load cycles",
        "100000 U",
        "100000 [um]",
        "100000 cycles, um",
        "wear after 100000 rev",
    ] {
        let table = format!("radius [mm];{header}\n26;3\n27;2\n");
        assert!(
            rows(&home, &table, options)
                .1
                .starts_with("A,pinion,100000,"),
            "{header}"
        );
    }
    // a degree is no word before the name of a test
    let study = STUDY.replace("id = \"B\"", "id = \"C\"");
    fs::write(home.path().join("study.toml"), study).unwrap();
    let message = refused(
        &home,
        "radius [mm],20 °C,40 °C\n26,3,2\n",
        "--test A --sigma 0.1",
    );
    assert!(message.contains("`°C` behind its number"), "{message}");
    // masses
    let masses = "member,70 hrs\npinion,3\n";
    let message = refused(&home, masses, "--test A --quantity mass_loss --sigma 1");
    assert!(message.contains("`hrs` behind its number"), "{message}");
    for (text, word) in [
        (
            "Wear depth in um after running hours\nradius [mm],0.83,2.08\n26,3,4\n",
            "hours",
        ),
        (
            "Verschleiß [µm] nach Stunden\nradius [mm],0.83,2.08\n26,3,4\n",
            "Stunden",
        ),
        (
            "Cycles x 1e6\nradius [mm],0.1,0.25\n26,3,4\n",
            "a power of ten",
        ),
        ("hours,26,27\n2,3,4\n4,5,6\n", "hours"),
    ] {
        let message = refused(&home, text, options);
        let says = format!("row 1: `{}", text.split([',', '\n']).next().unwrap());
        assert!(
            message.contains(&says) && message.contains(&format!("speaks of `{word}`")),
            "{message}"
        );
    }
    let long = "Wear depth, cycles in millions\ncycles,radius [mm],wear depth [um]\n0.1,26,3\n";
    let message = refused(&home, long, options);
    assert!(
        message.contains("row 1: `Wear depth cycles in millions` speaks of multiples"),
        "{message}"
    );
    let fact = "Operating hours of the rig: 1234\nradius [mm],100000\n26,3\n";
    assert!(
        rows(&home, fact, options)
            .0
            .contains("title    row 1 passed over")
    );
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

#[test]
fn a_mass_that_may_be_left_is_no_loss() {
    let home = home();
    for header in [
        "mass [g]",
        "weight [g]",
        "Masse [mg]",
        "mass pinion [g],mass gear [g]",
    ] {
        let two = header.contains(',');
        let table = match two {
            true => format!("test,cycles,{header}\nA,100000,412.2671,1630.0669\n"),
            false => format!("test,member,cycles,{header}\nA,pinion,100000,412.2671\n"),
        };
        let message = refused(&home, &table, "--sigma 1");
        assert!(
            message.contains(
                "may be the mass that is left: say --quantity mass_loss if it is what was lost"
            ),
            "{header}: {message}"
        );
    }
    let small = "test,member,cycles,mass [g]\nA,pinion,100000,0.0042\n";
    assert_eq!(
        rows(&home, small, "--quantity mass_loss --sigma 1").1,
        "A,pinion,100000,mass_loss,,4.2,1,\n"
    );
}

/// 509 434 revolutions of 53 teeth are 1 000 000.07 of 27: the end of the test, rounded.
#[test]
fn rounded_revolutions_of_the_gear_may_be_the_end_of_the_test() {
    let home = home();
    for text in [
        "Test: A\nPart: gear\nRevolutions of gear: 509434\n\nradius [mm],depth [um]\n52,1\n",
        "test,member,gear revolutions,radius [mm],depth [um]\nA,gear,509434,52,1\n",
        "Test: A\nPart: gear\nradius [mm],509434 gear rev\n52,1\n",
    ] {
        let written = rows(&home, text, "--sigma 0.1").1;
        assert!(
            written.starts_with("A,gear,1000000,wear_depth,52,"),
            "{text}{written}"
        );
    }
    let later = "test,member,gear revolutions,radius [mm],depth [um]\nA,gear,509435,52,1\n";
    assert!(refused(&home, later, "--sigma 0.1").contains("ends before these cycles"));
}

#[test]
fn a_running_time_above_the_header_has_its_unit_where_it_may_stand() {
    let home = home();
    let curve = |line: &str, separator: &str| {
        format!(
            "Test: A\nPart: pinion\n{line}\n\nradius [mm]{separator}depth [um]\n26{separator}1\n27{separator}2\n"
        )
    };
    for (line, separator) in [
        ("Run time: 8.333 h", ","),
        ("Run time [h]: 8.333", ","),
        ("Run time [h]: 8.333 h", ","),
        ("Run time: 500 min", ","),
        ("Run time (h);8,333", ";"),
        ("Laufzeit;8,333;Std.", ";"),
        ("Temps de marche [h]: 8.333", ","),
        ("Running hours: 8.333", ","),
    ] {
        let (shown, written) = rows(&home, &curve(line, separator), "--sigma 0.1");
        assert!(
            written.starts_with("A,pinion,1000000,"),
            "{line}: {written}"
        );
        assert!(shown.contains("layout   row 3, `"), "{shown}");
    }
    for line in ["Run time: 8.333", "Run time: 8 h 20 min", "Run time: long"] {
        let message = refused(&home, &curve(line, ","), "--sigma 0.1");
        assert!(
            message.contains("row 3: `Run time` says `")
                && message.contains("one number with a unit of h, min, s or d"),
            "{line}: {message}"
        );
    }
    let far = refused(&home, &curve("Run time: 70 h", ","), "--sigma 0.1");
    assert!(
        far.contains("found `8400000`")
            && far.contains("the cycles are those of `Run time [h]`: running time"),
        "{far}"
    );
    // beside cycles it says nothing more, and a time of day is none
    for line in [
        "Run time: 70 h\nCycles: 40000",
        "Time: 12:30\nCycles: 40000",
    ] {
        let (_, written) = rows(&home, &curve(line, ","), "--sigma 0.1");
        assert!(written.starts_with("A,pinion,40000,"), "{written}");
    }
}

#[test]
fn checkpoints_within_a_thousandth_are_one() {
    let home = home();
    let table = "test,member,cycles,radius,depth\nA,pinion,99997,26,1\nA,pinion,99997,27,2\nA,gear,100000,52,1\nA,gear,100000,53,2\n\
                 A,gear,100101,52,3\nA,gear,100101,53,4\n";
    let (shown, written) = rows(&home, table, "--sigma 0.1");
    assert!(
        written.starts_with("A,pinion,100000,wear_depth,26,1,0.1,A-pinion-100000\n")
            && written.contains("A,gear,100101,wear_depth,52,"),
        "{written}"
    );
    assert!(
        shown
            .contains("layout   test A: 99997 read as the checkpoint 100000, within 0.1 % of it\n"),
        "{shown}"
    );
    // what has no place may be a record of many times
    let record = "test,member,cycles,mass loss [mg]\nA,pinion,99997,1\nA,pinion,100000,2\n";
    assert!(
        rows(&home, record, "--sigma 0.1")
            .1
            .starts_with("A,pinion,99997,")
    );
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

/// The same part weighed after each stop: the hours of its intervals are no times of the test. At 2000 rpm an hour has 120,000 revolutions.
#[test]
fn times_of_single_intervals_are_refused() {
    let home = home();
    let table = |hours: [&str; 3]| {
        format!(
            "run;stop;run time [h];mass before [g];mass after [g]\nA;1;{};14,7174;14,7168\nA;2;{};14,7168;14,7159\nA;3;{};14,7159;14,7144\n",
            hours[0], hours[1], hours[2]
        )
    };
    let options = "--member pinion --sigma 0.2";
    for (hours, says) in [
        (
            ["1,00", "1,00", "1,00"],
            "row 3: `1,00` below `run time [h]` is not more than the `1,00` of row 2, although its weighing goes on where that one ended: running times since the start of the test are wanted, not those of each stop. Add them up: 1,00; 2,00; 3,00, or say --per-interval cycles",
        ),
        (
            ["2", "1", "3"],
            "row 3: `1` below `run time [h]` is not more than the `2` of row 2",
        ),
    ] {
        let message = refused(&home, &table(hours), options);
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
    // revolutions as well, and without a column of stops
    let revolutions = table(["1e5", "1e5", "1e5"])
        .replace("run time [h]", "cycles")
        .replace("stop;", "lab;");
    let message = refused(&home, &revolutions, options);
    assert!(
        message.contains("revolutions since the start of the test are wanted"),
        "{message}"
    );
    // rising ones may be totals or not: this is said
    let (shown, written) = rows(&home, &table(["1", "2,5", "5"]), options);
    assert_eq!(
        written,
        "A,pinion,120000,mass_loss,,0.6,0.2,\nA,pinion,300000,mass_loss,,1.5,0.2,\nA,pinion,600000,mass_loss,,3,0.2,\n"
    );
    assert!(
        shown.contains(
            "layout   `run time [h]` is taken as the total since the start of the test at each stop"
        ),
        "{shown}"
    );
    // stops of other values
    let depths = |hours: [&str; 2]| {
        format!(
            "test;member;stage;time [h];radius;depth [um]\nA;pinion;1;{};26;1,5\nA;pinion;1;{};27;1,2\nA;pinion;2;{};26;2,5\nA;pinion;2;{};27;2,2\n",
            hours[0], hours[0], hours[1], hours[1]
        )
    };
    let message = refused(&home, &depths(["2", "2"]), "--sigma 0.1");
    assert!(
        message.contains("row 4: `2` below `time [h]` is not more than the `2` of row 2, although `stage` 2 comes after 1")
            && message.contains("Add them up: 2; 4"),
        "{message}"
    );
    rows(&home, &depths(["2", "4"]), "--sigma 0.1");
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

/// A column of tests makes a long table, understood or not: no row of its data is a header, and --test is no way out.
#[test]
fn a_long_table_that_lacks_something_is_told_what() {
    let home = home();
    for (table, says) in [
        (
            "run;hours;mass after [g]\nP1;10,00;14,7168\nP1;20,00;14,7159\n",
            &[
                "looks like a table with a row for each value",
                "understood: `run` as test, `hours` as cycles (a running time), `mass after [g]` as the mass after the test",
                "missing: member, value",
                "`mass before [g]` is the other one",
            ][..],
        ),
        (
            "run;stop;interval [h];mass before [g];mass after [g]\nA;1;1,00;14,7174;14,7168\nA;2;1,00;14,7168;14,7159\n",
            &[
                "not understood: `stop`, `interval [h]`",
                "missing: member, cycles",
                "If `interval [h]` is the running time since the start of the test, call it `time [h]`; if it is that of each interval alone, say --per-interval cycles",
            ],
        ),
        (
            "Test;Time [h];Teeth spanned;Span [mm]\nA;1,00;4;21,42\nA;2,00;4;21,41\n",
            &[
                "`Teeth spanned` as position",
                "not understood: `Span [mm]`",
                "missing: member, value",
            ],
        ),
        (
            "Versuch;Ritzel vorher [g];Ritzel nachher [g]\nA;7,41;7,40\n",
            &[
                "`Ritzel vorher [g]` as the mass before the test, `Ritzel nachher [g]` as the mass after the test; not understood: nothing; missing: cycles.",
            ],
        ),
        (
            "Pr\u{fc}fling;Ritzel vorher [g];Ritzel nachher [g]\nA;7,41;7,40\nB;7,41;7,40\n",
            &[
                "`Pr\u{fc}fling` as test, `Ritzel vorher [g]` as the mass before the test",
                "missing: cycles.",
            ],
        ),
        (
            "Stufe;Ritzel vorher [g];Ritzel nachher [g]\nS1;7,41;7,40\nS2;7,41;7,40\n",
            &["not understood: `Stufe`; missing: test, cycles."],
        ),
        (
            // as it stands in the table, not as it is arranged
            "run;stop;run time [h];mass before [g];mass after [g]\nA;1;1,00;14,7174;14,7168\n",
            &[
                "the header in row 1 is `run; stop; run time [h]; mass before [g]; mass after [g]`",
                "missing: member.",
            ],
        ),
        (
            "Versuch;Stunden;Dicke neu;Dicke alt\nA;1,00;7,41;7,40\n",
            &["not understood: `Dicke neu`, `Dicke alt`"],
        ),
    ] {
        let message = refused(&home, table, "--sigma 1");
        for part in says {
            assert!(message.contains(part), "no `{part}` in: {message}");
        }
        assert!(
            !message.contains("--test with") && !message.contains("the header `"),
            "{message}"
        );
    }
    // a member and a time of weighing are enough of a name in a unit of mass
    let sides = "Versuch;Laufzeit [h];Ritzel vorher [g];Ritzel nachher [g];Rad vorher [g];Rad nachher [g]\n\
                 A;1,00;7,4100;7,4098;9,1200;9,1195\n";
    assert_eq!(
        rows(&home, sides, "--sigma 1").1,
        "A,pinion,120000,mass_loss,,0.2,1,\nA,gear,120000,mass_loss,,0.5,1,\n"
    );
}

/// What a span or a chord lost is the difference of two measurements.
#[test]
fn a_span_new_and_a_span_worn_are_a_loss() {
    let home = home();
    let table = "Test;Member;Time [h];Teeth spanned;Span new [mm];Span worn [mm]\nA;pinion;1,00;4;21,4212;21,4191\nA;pinion;2,00;4;21,4212;21,4171\n\
                 A;gear;1,00;6;33,9010;33,9000\n";
    let (shown, written) = rows(&home, table, "--sigma 1");
    assert_eq!(
        written,
        "A,pinion,120000,span_loss,4,2.1,1,\nA,pinion,240000,span_loss,4,4.1,1,\nA,gear,120000,span_loss,6,1,1,\n"
    );
    assert!(
        shown.contains("layout   span loss: `Span new [mm]` less `Span worn [mm]`\n")
            && shown.contains("column   `Teeth spanned`: teeth spanned\n"),
        "{shown}"
    );
    for header in [
        "Versuch;Bauteil;Laufzeit [h];Messz\u{e4}hnezahl;Zahnweite vorher [mm];Zahnweite nachher [mm]",
        "run;part;time [h];k;base tangent length before [mm];base tangent length after [mm]",
        "run;part;time [h];k;Wk new [mm];Wk worn [mm]",
    ] {
        let (_, data) = table.split_once('\n').unwrap();
        assert_eq!(
            rows(&home, &format!("{header}\n{data}"), "--sigma 1").1,
            written,
            "{header}"
        );
    }
    // each measurement goes on where the one before ended
    let stops = "test;member;cycles;k;span before [mm];span after [mm]\nA;gear;100000;6;33,9010;33,9000\nA;gear;200000;6;33,9000;33,8980\n";
    assert_eq!(
        rows(&home, stops, "--sigma 1").1,
        "A,gear,100000,span_loss,6,1,1,\nA,gear,200000,span_loss,6,3,1,\n"
    );
    let chords = "test;member;cycles;Measuring circle;Diameter [mm];chordal thickness new [mm];chordal thickness worn [mm]\n\
                  A;pinion;100000;x;54;3,1400;3,1380\n";
    assert_eq!(
        rows(&home, chords, "--sigma 1").1,
        "A,pinion,100000,chordal_loss,27,2,1,\n"
    );
    for (from, to, says) in [
        (
            "Span new [mm]",
            "Span nominal [mm]",
            "F1: `Span worn [mm]`: a span is no loss: the table needs one column `span new [mm]` and one column `span worn [mm]`",
        ),
        ("Span worn [mm]", "Span worn [um]", "in two units"),
    ] {
        let message = refused(&home, &table.replace(from, to), "--sigma 1");
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
    let bare = table.replace(" [mm]", "");
    assert!(
        refused(&home, &bare, "--sigma 1")
            .contains("write the unit into the header of both columns"),
    );
}

/// A log of the mass at each stop: what was lost is its difference to that at the start.
#[test]
fn masses_at_each_stop_are_taken_from_the_first() {
    let home = home();
    let table = "run;run time [h];mass [g]\nA;0;14,7174\nA;1,0;14,7168\nA;2,5;14,7159\nB;0,0;15,0000\nB;1,0;14,9990\n";
    let options = "--member pinion --quantity mass_loss --sigma 0.1";
    let (shown, written) = rows(&home, table, options);
    assert_eq!(
        written,
        "A,pinion,120000,mass_loss,,0.6,0.1,\nA,pinion,300000,mass_loss,,1.5,0.1,\nB,pinion,120000,mass_loss,,1,0.1,\n"
    );
    assert!(
        shown.contains("layout   mass loss: `mass [g]` at 0 less each `mass [g]` of the same test and member; the rows at 0 are not written"),
        "{shown}"
    );
    let message = refused(&home, &table.replace("B;0,0;", "B;0,5;"), options);
    assert!(
        message.contains("C5: no mass of the pinion in test B stands at 0 h or 0 cycles"),
        "{message}"
    );
    let later = table.replace("A;0;", "A;0,5;").replace("B;0,0;", "B;0,5;");
    let message = refused(&home, &later, options);
    assert!(
        message.contains("C2: 14717.4 mg of loss is the mass itself: the values of the pinion in test A do not grow with time")
            && message.contains("add the row of the new part, at 0"),
        "{message}"
    );
    // losses from nothing on are losses
    let losses = "run;run time [h];mass [g]\nA;0;0\nA;1,0;0,0006\nA;2,5;0,0015\n";
    assert_eq!(
        rows(&home, losses, options).1,
        "A,pinion,0,mass_loss,,0,0.1,\nA,pinion,120000,mass_loss,,0.6,0.1,\nA,pinion,300000,mass_loss,,1.5,0.1,\n"
    );
    // both members, in a table of a row for each value and in a wide one
    let sides = "Run,Hours,Pinion (g),Wheel (g)\nA,0,14.7174,30.5\nA,1,14.7168,30.499\n";
    let both = "A,pinion,120000,mass_loss,,0.6,0.1,\nA,gear,120000,mass_loss,,1,0.1,\n";
    assert_eq!(
        rows(&home, sides, "--quantity mass_loss --sigma 0.1").1,
        both
    );
    let wide = "revolutions;pinion [g];gear [g]\n0;14,7174;30,5\n120000;14,7168;30,499\n";
    let options = "--test A --quantity mass_loss --sigma 0.1";
    let (shown, written) = rows(&home, wide, options);
    assert_eq!(written, both);
    assert!(
        shown.contains("layout   mass loss: the mass at 0 less"),
        "{shown}"
    );
    let message = refused(&home, &wide.replace("\n0;", "\n60000;"), options);
    assert!(
        message.contains("14717.4 mg of loss is the mass itself"),
        "{message}"
    );
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

/// The rows that are made of a table stand in no file that the user has.
#[test]
fn a_table_without_uncertainties_is_shown_before_it_is_refused() {
    let home = home();
    let table = "test;member;cycles;mass loss [mg];Bemerkung\nA;pinion;100000;4;trocken\nA;pinion;200000;8;\n";
    let message = refused(&home, table, "");
    let (shown, why) = message.split_once("\nerror: ").unwrap();
    for part in [
        "table    table.csv\n",
        "column   `mass loss [mg]`: mass_loss in mg\n",
        "passed over the column `Bemerkung`: a comment column\n",
        "sigma    none: nothing states it\n",
        "  A,pinion,100000,mass_loss,,4,,\n",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    for part in [
        "table.csv: the table has no uncertainty of its mass_loss",
        "State one standard deviation with --sigma, in mg, or a share of each value with --relative-sigma",
        "may be left out",
    ] {
        assert!(why.contains(part), "no `{part}` in: {why}");
    }
    assert!(
        !message.contains("-->") && !why.contains("the rows of"),
        "{message}"
    );
    rows(&home, table, "--sigma 0.1");
}

/// Claim: durations and losses of single intervals are added up, sigmas as √Σσ². By hand: at 2000 rpm an hour has 120,000 revolutions, 2 h, 2 h and
/// 1.5 h end after 240,000, 480,000 and 660,000; 3, 2.5 and 2 mg are 3, 5.5 and 7.5 mg, each known to 0.3 mg: 0.3, 0.3 √2 = 0.4243, 0.3 √3 = 0.5196.
#[test]
fn durations_and_losses_of_intervals_are_added_up() {
    let home = home();
    let both = "--per-interval cycles,mass_loss";
    let weighed = "run;wheel;interval;duration of interval [h];loss in interval [mg]\nA;small;1;2;3\nA;big;1;2;1\nA;small;2;2;2,5\nA;big;2;2;1\n\
                   A;small;3;1,5;2\nA;big;3;1,5;1\n";
    let of_pinion = "A,pinion,240000,mass_loss,,3,0.3,\n|A,pinion,480000,mass_loss,,5.5,0.4243,\n|A,pinion,660000,mass_loss,,7.5,0.5196,\n";
    let (shown, written) = rows(&home, weighed, &format!("{both} --sigma 0.3"));
    for row in of_pinion.split('|') {
        assert!(written.contains(row), "no `{row}` in {written}");
    }
    assert!(written.contains("A,gear,660000,mass_loss,,3,0.5196,\n"));
    for part in [
        "layout   `duration of interval [h]`: read as `time [h]` of each interval\n",
        "layout   `loss in interval [mg]`: read as `loss [mg]` of each interval\n",
        "`time [h]` is that of each interval alone: added up to totals since the start of the test; the intervals are those of the numbers in `interval`",
        "mass_loss: the losses of the intervals of each test and member are added up to totals since the start; their sigmas are combined as the root of the sum of their squares",
        "sigma    0.3 mg for each interval alone\n",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    // without numbers the rows are in order; a column of sigmas; one of the two only
    let plain = "time [h];loss [mg];u [mg]\n2;3;0,3\n2;2,5;0,4\n1,5;2;0,5\n";
    let options = "--test A --member pinion";
    let (_, written) = rows(&home, plain, &format!("{both} {options}"));
    assert!(
        written.contains("A,pinion,480000,mass_loss,,5.5,0.5,\n")
            && written.contains("A,pinion,660000,mass_loss,,7.5,0.7071,\n"),
        "{written}"
    );
    let (_, written) = rows(&home, plain, &format!("--per-interval cycles {options}"));
    assert!(written.contains("A,pinion,660000,mass_loss,,2,0.5,\n"));
    let totals = "cycles;loss [mg]\n100000;3\n250000;2,5\n";
    let (_, written) = rows(
        &home,
        totals,
        &format!("--per-interval mass_loss {options} --sigma 0.3"),
    );
    assert!(written.contains("A,pinion,250000,mass_loss,,5.5,0.4243,\n"));
    // the parts of a member, side by side, in revolutions of the gear; the new part's row of nothing
    let sides = "run,interval,gear revolutions in interval,pinion loss in interval [mg],gear loss in interval [mg]\nA,0,0,0,0\nA,1,27000,3,1\nA,2,54000,2,1\n";
    let (_, written) = rows(&home, sides, &format!("{both} --sigma 0.3"));
    assert!(
        written.contains("A,pinion,159000,mass_loss,,5,")
            && written.contains("A,gear,53000,mass_loss,,1,"),
        "{written}"
    );
    // weighings go from stop to stop as before, only their times are of each
    let masses = "run;run time [h];mass before [g];mass after [g]\nA;2;14,7174;14,7168\nA;1;14,7168;14,7159\nA;2;14,7159;14,7144\n";
    let (_, written) = rows(
        &home,
        masses,
        "--per-interval cycles --member pinion --sigma 0.2",
    );
    assert_eq!(
        written,
        "A,pinion,240000,mass_loss,,0.6,0.2,\nA,pinion,360000,mass_loss,,1.5,0.2,\nA,pinion,600000,mass_loss,,3,0.2,\n"
    );
    // curves: each place by itself, and wide tables, whose checkpoints are totals
    let curves = "test,member,interval,cycles,radius,depth [um]\nA,pinion,1,1e5,26,1\nA,pinion,1,1e5,27,2\nA,pinion,2,1e5,26,0.5\nA,pinion,2,1e5,27,0.25\n";
    let (_, written) = rows(
        &home,
        curves,
        "--per-interval cycles,wear_depth --sigma 0.1",
    );
    assert!(
        written.contains("A,pinion,200000,wear_depth,27,2.25,0.1414,A-pinion-200000\n"),
        "{written}"
    );
    let wide = "radius [mm],100000,250000\n26,1,0.5\n27,2,0.25\n";
    let (shown, written) = rows(
        &home,
        wide,
        &format!("--per-interval wear_depth {options} --sigma 0.1"),
    );
    assert!(
        written.contains("A,pinion,250000,wear_depth,27,2.25,0.1414,"),
        "{written}"
    );
    assert!(shown.contains("layout   wear_depth: the losses of the intervals"));
}

#[test]
fn intervals_that_cannot_be_added_up_are_refused_with_their_row() {
    let home = home();
    let options = "--test A --member pinion --sigma 0.3";
    let numbered = |rows: &str| format!("interval;time [h];loss [mg]\n{rows}");
    let both = "cycles,mass_loss";
    for (what, table, says) in [
        (
            both,
            numbered("1;2;3\n2;2;2\n2;2;2\n"),
            "table.csv: row 4: interval 2 stands in row 3 already: take one out",
        ),
        (
            both,
            numbered("2;2;3\n1;2;2\n"),
            "table.csv: row 3: interval 1 stands below interval 2 of row 2",
        ),
        (
            both,
            numbered("1;2;3\n3;2;2\n"),
            "row 3: interval 3 below `interval`, and interval 2 is not there",
        ),
        (
            both,
            numbered("1;2;3\nsum;4;5\n"),
            "A3: `sum` below `interval`: write the number of the interval there",
        ),
        (
            both,
            numbered("1;2;3\n2;-2;2\n"),
            "B3: `-2` below `time [h]`: an interval has no negative length",
        ),
        (
            both,
            numbered("1;2;3\n2;2;\n3;2;1\n"),
            "C3: nothing stands here below `loss [mg]`: without the loss of this interval the total of row 4 is not known",
        ),
        (
            both,
            "time [h];loss [mg]\n2;3\n;2\n2;1\n".to_owned(),
            "A3: nothing stands here below `time [h]`",
        ),
        (
            both,
            numbered("1;2;3\n"),
            "the table holds no second interval of anything",
        ),
        (
            "mass_loss",
            "cycles;loss [mg]\n100000;3\n100000;2\n".to_owned(),
            "B2 and B3 both hold the loss of the pinion in test A until 100000 pinion revolutions",
        ),
        (
            "mass_loss",
            "cycles;loss [mg]\n200000;3\n100000;2\n".to_owned(),
            "B2 and B3 are not in the order of the intervals",
        ),
        (
            "wear_depth",
            "cycles;radius;depth\n100000;26;1\n100000;27;1\n200000;26;1\n200000;26.5;2\n"
                .to_owned(),
            "C5: the total of the pinion in test A at 26.5 is not known: its loss in the interval until 100000 pinion revolutions is missing",
        ),
        (
            "cycles",
            "cycles;radius;depth\n100000;26;1\n100000;27;1\n100000;26;1\n".to_owned(),
            "add a column `interval` that numbers them",
        ),
        (
            "cycles",
            "radius [mm];100000;200000\n26;1;2\n27;1;2\n".to_owned(),
            "--per-interval cycles is for tables with a row for each value",
        ),
        (
            "wear_depth",
            numbered("1;2;3\n2;4;2\n"),
            "--per-interval wear_depth: the table holds no wear_depth",
        ),
        (
            "mass_loss",
            "cycles;mass before [g];mass after [g]\n1e5;9.5;9.4\n2e5;9.4;9.2\n".to_owned(),
            "--per-interval mass_loss: the table has measurements of the new and of the worn part",
        ),
    ] {
        let message = refused(&home, &table, &format!("--per-interval {what} {options}"));
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
    // names of intervals are a hint where nobody asked
    let message = refused(
        &home,
        "duration of interval [h];loss in interval [mg]\n2;3\n2;2\n",
        options,
    );
    let says = "if `duration of interval [h]` and `loss in interval [mg]` hold what each interval alone gave, say --per-interval cycles,mass_loss";
    assert!(message.contains(says), "{message}");
    // the lengths of one interval are the same for both members
    let two = "wheel,interval,cycles,loss [mg]\npinion,1,1e5,3\ngear,1,2e5,1\n";
    let message = refused(&home, two, "--per-interval cycles --test A --sigma 0.3");
    assert!(
        message.contains("row 3: interval 1 lasts `2e5`, in row 2 it lasts `1e5`"),
        "{message}"
    );
}

/// Claim: curves that come behind others of nearly the same cycles are of their checkpoint, from another table as from an earlier file.
#[test]
fn rows_behind_others_take_their_checkpoints() {
    let home = home();
    fs::write(
        home.path().join("m.csv"),
        "test,member,cycles,quantity,position,value,sigma\nA,pinion,100000,wear_depth,26,1,0.1\nA,pinion,250000,wear_depth,26,2,0.1\n\
         A,pinion,300000,mass_loss,,2,0.1\nB,pinion,500000,wear_depth,26,2,0.1\n",
    )
    .unwrap();
    let table = "test,member,cycles,radius,depth\nA,gear,100004,52,1\nA,gear,100004,53,2\nA,gear,249990,52,2\nA,gear,299990,52,3\nA,gear,500001,52,3\n";
    let (code, shown, message) = import(&home, table, "--sigma 0.1 -o m.csv --append");
    assert_eq!(code, Some(0), "{message}");
    assert!(
        shown.contains(
            "joined   test A: 100004, 249990 read as the checkpoints 100000, 250000 of the rows that are there, within 0.1 % of them\n"
        ),
        "{shown}"
    );
    let written = read(&home, "m.csv");
    assert!(
        written.contains("A,gear,100000,wear_depth,53,2,0.1,A-gear-100000\n")
            && written.contains("A,gear,250000,wear_depth,52,2,0.1,\n"),
        "{written}"
    );
    // a mass has no curve, and test B is another one
    assert!(written.contains("A,gear,299990,") && written.contains("A,gear,500001,"));
    // the same table again is the same
    let again = refused(&home, table, "--sigma 0.1 -o m.csv --append");
    assert!(again.contains("is there already"), "{again}");
    // several tables, of which the second is read like the first; wide ones too
    for (name, member, cycles, at) in [
        ("a.csv", "pinion", "400000", 26),
        ("b.csv", "gear", "399995", 52),
    ] {
        let text = format!(
            "Run: A\nPart: {member}\nCycles: {cycles}\nradius,depth\n{at},3\n{},4\n",
            at + 1
        );
        fs::write(home.path().join(name), text).unwrap();
    }
    let shown = succeed(
        &home,
        "import a.csv b.csv --study study.toml --sigma 0.1 -o n.csv",
    );
    assert!(
        shown.contains("joined   test A: 399995 read as the checkpoint 400000 of the rows that are there, within 0.1 % of it\n"),
        "{shown}"
    );
    assert!(read(&home, "n.csv").contains("A,gear,400000,wear_depth,53,4,0.1,A-gear-400000\n"));
    let wide = "radius,399990,400000,500000\n52,3,4,5\n53,3.1,4.1,5.1\n";
    let (code, shown, message) = import(
        &home,
        wide,
        "--test A --member gear --sigma 0.1 -o n.csv --append",
    );
    assert_eq!(code, Some(0), "{message}");
    // two columns of one table are not made one
    assert!(!shown.contains("joined"), "{shown}");
    let wide = "radius,400010\n52,5\n53,5.1\n";
    let options = "--test A --member gear --sigma 0.1 --repeat 2 -o n.csv --append";
    let (_, shown, _) = import(&home, wide, options);
    assert!(shown.contains("joined   test A: 400010 read as"), "{shown}");
    assert!(read(&home, "n.csv").contains("A,gear,400000,wear_depth,52,5,0.1,A-gear-400000-r2\n"));
}

/// Claim: rows of a member that lie apart from its own and among the other member's get a warning. The gears are nearly of one size, so the flanks
/// (z 39 and 41, module 2: form to tip circle about 37.5 to 41 and 39.5 to 43 mm) reach over each other.
#[test]
fn members_that_may_be_swapped_are_warned_of() {
    let home = home();
    let alike = STUDY.replace("teeth = 27", "teeth = 39");
    assert_ne!(alike, STUDY);
    fs::write(
        home.path().join("study.toml"),
        alike.replace("teeth = 53", "teeth = 41"),
    )
    .unwrap();
    let rows =
        |member: &str, [a, b]: [f64; 2]| format!("{member},100000,{a},1\n{member},100000,{b},2\n");
    let table = |rows: &str| format!("member,cycles,radius,depth\n{rows}");
    let options = "--test A --sigma 0.1 -o m.csv";
    let there = [rows("pinion", [38.2, 39.8]), rows("gear", [40.2, 42.5])].concat();
    let (code, shown, message) = import(&home, &table(&there), options);
    assert_eq!(code, Some(0), "{message}");
    assert!(!shown.contains("warning"), "{shown}");
    let appended = |rows: &str| {
        let rows = rows.replace(",100000,", ",200000,");
        let (code, shown, message) = import(&home, &table(&rows), &format!("{options} --append"));
        assert_eq!(code, Some(0), "{message}");
        shown
    };
    // its own place, and a place that neither has
    for good in [rows("pinion", [39.0, 40.5]), rows("gear", [42.6, 42.8])] {
        let shown = appended(&good);
        assert!(!shown.contains("warning"), "{shown}");
    }
    fs::remove_file(home.path().join("m.csv")).unwrap();
    import(&home, &table(&there), options);
    let shown = appended(&rows("pinion", [40.4, 40.8]));
    let says = "warning  the radii of the pinion, 40.4 to 40.8 mm, lie apart from those of its rows that are there, 38.2 to 39.8 mm, and among the gear's, 40.2 to 42.5 mm: are the members swapped?";
    assert_eq!(shown.matches("warning").count(), 1, "{shown}");
    assert!(shown.contains(says), "{shown}");
}
