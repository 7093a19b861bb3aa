//! Claim: a measurement file that is not right is refused with one message that names the file, the line, the column, what was
//! found and what is allowed; a right one is read in full, in its order, with the line of every row; no text at all makes the
//! reader panic.
//!
//! Source: the file format's table of columns; the reference pair's flanks (27/53 teeth, module 2: pinion 25.5 to 29 mm, gear
//! 51.3 to 55 mm) from involute geometry; the counts of `validation/challenges` by hand: 4 tests, 5 times, 2 members, 56 radii
//! and a mass loss each. Tolerance: none.

use gearwear::gear::Member;
use gearwear::measure::{COLUMNS, Dataset, FacePlace, Known, Place, Quantity, Subject};
use gearwear::source_text::{Fault, TextError};
use gearwear::study::Study;
use proptest::prelude::*;

/// The format's own example, with two rows more.
const GOOD: &str = "\
# measured on 3 May
test,member,cycles,quantity,position,value,sigma,trace
A,pinion,250000,wear_depth,26.31,3.42,0.15,A-p-1
A,gear,250000,wear_depth,53.5,2.1,0.15,A-g-1

A,pair,250000,transmission_error,0.25,-14.2,0.5,A-te-1
A,pinion,1000000,mass_loss,,182.0,4.0,
B,pinion,0,wear_depth,28.9995,0.1,0.15,
";

const STUDY: &str = include_str!("../../validation/challenges/none_L2/study.toml");

fn known() -> Known {
    let study = Study::parse(STUDY, "study.toml").unwrap();
    let tests = study
        .tests
        .iter()
        .map(|t| (t.id.as_str(), t.conditions.cycles));
    Known::new(
        tests,
        [&study.gears.pinion, &study.gears.gear],
        study.gears.face_width,
    )
}

fn parse(text: &str) -> Result<Dataset, TextError> {
    Dataset::parse(text, "some/measurements.csv", &known())
}

/// `GOOD` with `old`, which stands in it once, replaced.
fn with(old: &str, new: &str) -> String {
    assert_eq!(GOOD.matches(old).count(), 1, "{old} must stand once");
    GOOD.replace(old, new)
}

struct Refusal {
    fault: Fault,
    column: &'static str,
    place: (usize, usize),
    found: &'static str,
    allowed: &'static str,
    says: &'static str,
}

fn refused(text: &str, expected: &Refusal) {
    let error = parse(text).expect_err("must be refused");
    let message = error.to_string();
    let diagnostic = error.diagnostic();
    assert_eq!(diagnostic.fault, expected.fault, "{message}");
    assert_eq!(diagnostic.key, expected.column, "{message}");
    assert_eq!(error.position(), Some(expected.place), "{message}");
    let (line, column) = expected.place;
    let place = format!("some/measurements.csv:{line}:{column}");
    for part in [
        place.as_str(),
        expected.found,
        expected.allowed,
        expected.says,
    ] {
        assert!(message.contains(part), "no `{part}` in:\n{message}");
    }
    assert!(diagnostic.found.contains(expected.found), "{message}");
    assert!(diagnostic.allowed.contains(expected.allowed), "{message}");
}

macro_rules! refusals {
    ($($name:ident: $text:expr => $fault:ident $column:literal at $line:literal:$at:literal, $found:literal, $allowed:literal, $says:literal;)+) => {
        $(#[test]
        fn $name() {
            refused(&$text, &Refusal {
                fault: Fault::$fault, column: $column, place: ($line, $at),
                found: $found, allowed: $allowed, says: $says,
            });
        })+
    };
}

refusals! {
    empty_file: "" => MissingKey "" at 1:1, "nothing", "a first line with the columns test, member", "the file is empty";
    comments_only: "# a\n# b\n"
        => MissingKey "" at 1:1, "comments only", "a first line with the columns", "no header line";
    header_only: "test,member,cycles,quantity,position,value,sigma\n"
        => MissingKey "" at 1:49, "no row after the header", "one row per measured value", "holds no measurement";
    no_header: "A,pinion,250000,wear_depth,26.31,3.42,0.15,A-p-1\n"
        => UnknownKey "A" at 1:1, "`A`", "test, member, cycles", "first line that is no comment names the columns";
    another_name_of_a_column: with("sigma,trace", "sd,trace")
        => UnknownKey "sd" at 2:44, "`sd`", "value, sigma", "the nearest column is `sigma`";
    misspelt_column: with("quantity", "quantitiy")
        => UnknownKey "quantitiy" at 2:20, "`quantitiy`", "quantity, position", "the nearest column is `quantity`";
    abbreviated_column: with("quantity", "qty")
        => UnknownKey "qty" at 2:20, "`qty`", "quantity, position", "the nearest column is `quantity`";
    nameless_column: with("sigma,trace", "sigma,,trace")
        => UnknownKey "" at 2:50, "nothing", "optional trace, face, tooth", "a comma too many";
    something_below_no_name: with("sigma,trace", "sigma,trace,,").replace("A-p-1", "A-p-1,,7")
        => Inconsistent "" at 3:51, "`7`", "nothing", "a column without a name";
    missing_column: with(",sigma,", ",")
        => MissingKey "sigma" at 2:1, "this header", "value, sigma", "no column `sigma`";
    missing_position: "test,member,cycles,quantity,value,sigma\n"
        => MissingKey "position" at 1:1, "this header", "position", "empty in rows of mass_loss";
    duplicate_column: with("value,sigma", "value,value")
        => Syntax "value" at 2:44, "`value`", "each column once", "stands twice";
    bars: GOOD.replace(',', "|")
        => UnknownKey "test|member|cycles|quantity|position|value|sigma|trace" at 2:1, "`test|member", "test, member", "commas, semicolons or tabs";
    points_and_commas: GOOD.replace(',', ";").replace("2.1;", "2,1;")
        => Inconsistent "" at 4:31, "`2,1`", "one of the two in all numbers", "marks between thousands";
    thousands: GOOD.replace(',', ";").replace("A;pinion;250000", "A;pinion;250.000")
        => BadValue "cycles" at 3:10, "`250.000`", "without marks between thousands", "is that 250000, or 250.000 with decimals?";
    thousands_beside_commas: GOOD.replacen("A,pinion,250000", "A,pinion,250.000", 1)
        => BadValue "cycles" at 3:10, "`250.000`", "without marks between thousands", "250000 or 2.5e5";
    another_unit_in_the_header: with("position,value", "position [m],value")
        => Inconsistent "position" at 3:28, "`26.31`", "position of wear_depth in mm", "the header says position in m";
    one_unit_for_two: with("value,sigma", "value (µm),sigma")
        => Inconsistent "value" at 6:39, "`-14.2`", "value of transmission_error in µrad", "if rows of several quantities stand below it";
    short_row: with("182.0,4.0,", "182.0,4.0")
        => Syntax "" at 7:1, "7 fields", "8 fields", "empty fields at the end need their commas";
    decimal_comma: with("3.42", "3,42")
        => Syntax "" at 3:1, "9 fields", "8 fields", "decimals are written with a point";
    quoted_decimal_comma: with("3.42", "\"3,42\"")
        => WrongType "value" at 3:34, "`3,42`", "a number, µm", "decimals are written with a point";
    open_quote: with("A,gear", "\"A,gear")
        => Syntax "" at 4:1, "a line break in quotes", "a row on each line", "never closed";
    open_quote_in_the_last_column: with("53.5,2.1,0.15,A-g-1", "53.5,2.1,0.15,\"A-g-1")
        => Syntax "" at 4:1, "a line break in quotes", "a row on each line", "never closed";
    unknown_test: with("B,pinion", "E,pinion")
        => BadValue "test" at 8:1, "`E`", "A, B, C, D", "add a [[test]] with id = \"E\" to the study";
    missing_test: with("B,pinion", ",pinion")
        => BadValue "test" at 8:1, "nothing", "A, B, C, D", "no such test";
    test_in_small_letters: with("B,pinion", "b,pinion")
        => BadValue "test" at 8:1, "`b`", "A, B, C, D", "the nearest is `B`";
    unknown_member: with("A,gear", "A,wheel")
        => BadValue "member" at 4:3, "`wheel`", "pinion, gear, pair", "there is no member `wheel`";
    unknown_quantity: with("mass_loss", "massloss")
        => BadValue "quantity" at 7:18, "`massloss`", "mass_loss, load_share", "the nearest is `mass_loss`";
    wear_of_the_pair: with("A,gear", "A,pair")
        => Inconsistent "member" at 4:3, "`pair`", "pinion, gear", "wear_depth is no quantity of the pair";
    error_of_one_member: with("A,pair", "A,gear")
        => Inconsistent "member" at 6:3, "`gear`", "pair", "transmission_error is no quantity of the gear";
    cycles_as_text: with("A,gear,250000", "A,gear,many")
        => WrongType "cycles" at 4:8, "`many`", "0 to 1000000", "cycles is not a number";
    negative_cycles: with("A,gear,250000", "A,gear,-1")
        => BadValue "cycles" at 4:8, "`-1`", "0 to 1000000", "cycles are negative";
    too_many_cycles: with("B,pinion,0", "B,pinion,800001")
        => BadValue "cycles" at 8:10, "`800001`", "0 to 800000", "the test B ends before";
    position_missing: with("26.31", "")
        => MissingKey "position" at 3:28, "nothing", "a radius on the pinion's flank", "position is missing";
    position_not_wanted: with("mass_loss,,", "mass_loss,27.0,")
        => Inconsistent "position" at 7:28, "`27.0`", "nothing", "has no position";
    radius_below_the_form_circle: with("26.31", "25.0")
        => BadValue "position" at 3:28, "`25.0`", "29.000 mm", "off the pinion's flank";
    radius_above_the_tip: with("28.9995", "29.001")
        => BadValue "position" at 8:23, "`29.001`", "29.000 mm", "look whether it has the right sign, is that of this member";
    diameter: with("26.31", "52.62")
        => BadValue "position" at 3:28, "`52.62`", "29.000 mm", "looks like a diameter";
    metres: with("26.31", "0.02631")
        => BadValue "position" at 3:28, "`0.02631`", "29.000 mm", "looks like metres";
    radius_of_the_mate: with("A,pinion,250000,wear_depth,26.31", "A,pinion,250000,wear_depth,54.9")
        => BadValue "position" at 3:28, "`54.9`", "29.000 mm", "lies on the gear's flank";
    rotation_outside_the_pitch: with("0.25,-14.2", "1.25,-14.2")
        => BadValue "position" at 6:34, "`1.25`", "0 to 1", "outside the base pitch";
    nan: with("3.42", "NaN")
        => BadValue "value" at 3:34, "`NaN`", "a number, µm", "not a finite number";
    infinite: with("3.42", "-inf")
        => BadValue "value" at 3:34, "`-inf`", "a number, µm", "not a finite number";
    beyond_doubles: with("3.42", "1e400")
        => BadValue "value" at 3:34, "`1e400`", "a number, µm", "not a finite number";
    value_with_unit: with("3.42", "3.42 um")
        => WrongType "value" at 3:34, "`3.42 um`", "a number, µm", "value is not a number";
    value_missing: with("3.42", "")
        => MissingKey "value" at 3:34, "nothing", "a number, µm", "value is missing";
    sigma_zero: with("182.0,4.0", "182.0,0.0")
        => BadValue "sigma" at 7:35, "`0.0`", "at least 1e-9, mg", "sigma is not above 0";
    sigma_negative: with("182.0,4.0", "182.0,-4.0")
        => BadValue "sigma" at 7:35, "`-4.0`", "at least 1e-9, mg", "sigma is not above 0";
    sigma_nan: with("182.0,4.0", "182.0,nan")
        => BadValue "sigma" at 7:35, "`nan`", "at least 1e-9, mg", "not a finite number";
    sigma_missing: with("182.0,4.0", "182.0,")
        => MissingKey "sigma" at 7:35, "nothing", "at least 1e-9, mg", "sigma is missing";
    nanometres: with("3.42", "3420")
        => BadValue "value" at 3:34, "`3420`", "at most 1000 µm", "looks like nm";
    millimetres: GOOD.replace("3.42,0.15", "0.00342,0.00015").replace("2.1,0.15", "0.0021,0.00015").replace("0.1,0.15", "0.0001,0.00015")
        => BadValue "value" at 3:34, "`0.00342`, the largest", "wear_depth in µm", "looks like mm";
    millimetres_beside_sigmas_in_micrometres: (0..8).fold("test,member,cycles,quantity,position,value,sigma\n".to_owned(), |text, i| format!("{text}A,pinion,250000,wear_depth,26.{i},0.00{i}42,0.15\n"))
        => BadValue "value" at 9:33, "`0.00742`, the largest, with a sigma of 0.15", "wear_depth and sigma in µm", "looks like mm beside sigmas in µm";
    radians: with("-14.2,0.5", "-14.2e-6,5e-7")
        => BadValue "value" at 6:39, "`-14.2e-6`, the largest", "in µrad", "looks like rad";
    percent: with("wear_depth,26.31,3.42,0.15,A-p-1", "load_share,26.31,63,1,")
        => BadValue "value" at 3:34, "`63`", "at most 2", "looks like percent";
    pascals: with("wear_depth,26.31,3.42,0.15,A-p-1", "contact_pressure,26.31,8e8,1e7,")
        => BadValue "value" at 3:40, "`8e8`", "at most 30000 MPa", "looks like Pa";
    trace_of_two_quantities: with("A-te-1", "A-p-1")
        => Inconsistent "trace" at 6:49, "`A-p-1`", "one quantity in a trace", "a trace of wear_depth (from line 3)";
    face_off_the_gear: "test,member,cycles,quantity,position,value,sigma,face\nA,gear,0,wear_depth,54,1,0.1,17\n"
        => BadValue "face" at 2:30, "`17`", "-16.5 to 16.5", "off the face width";
    windows_lines: with("3.42", "x").replace('\n', "\r\n")
        => WrongType "value" at 3:34, "`x`", "a number, µm", "value is not a number";
    byte_order_mark: format!("\u{feff}{}", with("test,member", "test,mumber"))
        => UnknownKey "mumber" at 2:6, "`mumber`", "member", "the nearest column is `member`";
    letters_of_two_bytes: with("A-p-1", "Zähne-1").replace("3.42", "\u{b5}")
        => WrongType "value" at 3:34, "`µ`", "a number, µm", "value is not a number";
}

#[test]
fn a_message_looks_like_a_compilers() {
    let message = parse(&with("3.42", "x")).unwrap_err().to_string();
    let expected = "\
error: value is not a number
 --> some/measurements.csv:3:34
  |
3 | A,pinion,250000,wear_depth,26.31,x,0.15,A-p-1
  |                                  ^ found `x`, allowed: a number, µm";
    assert_eq!(message.trim_end(), expected);
}

#[test]
fn a_good_file_is_read_as_it_stands() {
    let data = parse(GOOD).unwrap_or_else(|error| panic!("{error}"));
    let lines: Vec<usize> = data.observations.iter().map(|o| o.line).collect();
    assert_eq!(lines, [3, 4, 6, 7, 8]);
    let traces: Vec<(&str, Quantity, usize)> = data
        .traces
        .iter()
        .map(|t| (t.name.as_str(), t.quantity, t.line))
        .collect();
    assert_eq!(
        traces,
        [
            ("A-p-1", Quantity::WearDepth, 3),
            ("A-g-1", Quantity::WearDepth, 4),
            ("A-te-1", Quantity::TransmissionError, 6)
        ]
    );
    let first = &data.observations[0];
    assert_eq!(
        (first.test, first.member, first.cycles),
        (0, Subject::Pinion, 250_000.0)
    );
    assert_eq!(
        (first.position, first.value, first.sigma),
        (Some(26.31), 3.42, 0.15)
    );
    assert_eq!(
        (first.trace, first.face, &first.tooth),
        (Some(0), None, &None)
    );
    assert_eq!(data.place(first), "some/measurements.csv:3");
    let mass = &data.observations[3];
    assert_eq!(
        (mass.quantity, mass.position, mass.trace),
        (Quantity::MassLoss, None, None)
    );
    let last = &data.observations[4];
    assert_eq!(data.tests[last.test], "B");
    assert_eq!(last.member.member(), Some(Member::Pinion));
}

#[test]
fn line_ends_marks_blanks_quotes_and_column_order_change_nothing() {
    let plain = parse(GOOD).unwrap();
    let windows = format!("\u{feff}{}", GOOD.replace('\n', "\r\n"));
    assert_eq!(parse(&windows).unwrap(), plain);
    assert_eq!(parse(&GOOD.replace('\n', "\r")).unwrap(), plain);
    assert_eq!(parse(&GOOD.replace(',', " , ")).unwrap(), plain);
    assert_eq!(
        parse(&GOOD.replace("wear_depth", "\"wear_depth\"")).unwrap(),
        plain
    );
    assert_eq!(parse(GOOD.trim_end()).unwrap(), plain);
    assert_eq!(parse(&format!("{GOOD}# the end")).unwrap(), plain);
    let columns = "sigma,value,position,quantity,cycles,member,test,tooth,face";
    let other = parse(&format!(
        "{columns}\n0.15,3.42,26.31,wear_depth,250000,pinion,A,\"7, left\",-2.5\n"
    ));
    let other = other.unwrap_or_else(|error| panic!("{error}"));
    let (a, b) = (&other.observations[0], &plain.observations[0]);
    assert_eq!(
        (a.value, a.sigma, a.position),
        (b.value, b.sigma, b.position)
    );
    assert_eq!(
        (a.face, a.tooth.as_deref()),
        (Some(FacePlace::At(-2.5)), Some("7, left"))
    );
}

/// `GOOD` as a spreadsheet of central Europe writes it.
fn european() -> String {
    GOOD.replace(',', ";").replace('.', ",")
}

#[test]
fn the_forms_that_spreadsheets_write_are_read_and_told() {
    let plain = parse(GOOD).unwrap();
    assert_eq!(plain.reading, "");
    let read = |text: &str| {
        let data = parse(text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(data.observations, plain.observations, "{text}");
        data.reading
    };
    let semicolons = "semicolons between columns, decimal commas";
    assert_eq!(read(&european()), semicolons);
    let thousands = european().replace("A;pinion;250000", "A;pinion;250.000");
    assert_eq!(read(&thousands), semicolons);
    assert_eq!(
        read(&GOOD.replace(',', ";")),
        "semicolons between columns, decimal points"
    );
    assert_eq!(
        read(&european().replace(';', "\t")),
        "tabs between columns, decimal commas"
    );
    let header = "test,member,cycles,quantity,position,value,sigma,trace\n";
    let upper = with(
        header,
        "Test,MEMBER,Cycles [rev],Quantity,Position [mm],VALUE,Sigma,Trace\n",
    );
    let upper = upper
        .replace(",pinion,", ",Pinion,")
        .replace("wear_depth", "Wear_depth");
    // a rotation has no millimetres
    let upper = upper.replace(
        "A,pair,250000,transmission_error,0.25,-14.2,0.5,A-te-1\n",
        "\n",
    );
    let data = parse(&upper).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((data.observations.len(), data.reading.as_str()), (4, ""));
    // what stands in line 1 is not a comment: all lines are one further down
    let stated = parse(&format!("sep=;\n{}", european())).unwrap();
    assert_eq!(stated.observations[0].line, 4);
    assert_eq!(stated.observations[0].value, 3.42);
    assert_eq!(stated.reading, semicolons);
    let wider: String = european()
        .lines()
        .map(|line| match line {
            line if line.starts_with('#') || line.is_empty() => format!("{line}\n"),
            line if line.starts_with("test") => format!("{line};Comment;;\n"),
            line => format!("{line};seen by eye;;\n"),
        })
        .collect();
    assert_eq!(
        read(&format!("{wider};;;;;;;;;;\n;;;;;;;;;;\n")),
        format!("{semicolons}; passed over: the column `Comment`, 2 empty columns, 2 empty rows")
    );
}

#[test]
fn a_study_without_tests_allows_no_row() {
    let known = Known {
        tests: Vec::new(),
        ..known()
    };
    let message = Dataset::parse(GOOD, "m.csv", &known)
        .unwrap_err()
        .to_string();
    assert!(message.contains("the study has no [[test]]"), "{message}");
}

#[test]
fn depths_of_zero_alone_are_in_no_wrong_unit() {
    let text = "test,member,cycles,quantity,position,value,sigma\nA,gear,0,wear_depth,54,0,1e-4\n";
    assert_eq!(parse(text).unwrap().observations.len(), 1);
}

#[test]
fn every_quantity_says_its_unit_and_place() {
    for quantity in Quantity::ALL {
        assert!(!quantity.unit().is_empty() && !quantity.subjects().is_empty());
        let whole = quantity.place() == Place::Whole;
        let placeless = [Quantity::MassLoss, Quantity::MeanLag].contains(&quantity);
        assert_eq!(whole, placeless);
    }
    assert_eq!(COLUMNS.iter().filter(|c| c.1).count(), 7);
}

#[test]
fn spans_go_over_so_many_teeth_that_the_anvils_touch_flanks() {
    let row = |teeth: &str| format!("{}A,gear,250000,span_loss,{teeth},2.1,1.0,\n", GOOD);
    let known = known();
    let [_, gear] = &known.spanned;
    for teeth in gear {
        assert!(parse(&row(&teeth.to_string())).is_ok(), "{teeth}");
    }
    let beyond = gear.last().unwrap() + 1;
    for teeth in ["1", "5.5", "", &beyond.to_string()] {
        let error = parse(&row(teeth)).unwrap_err().to_string();
        let first = gear[0].to_string();
        assert!(error.contains(&format!("flanks: {first}")), "{error}");
    }
    let pair = GOOD.to_owned() + "A,pair,250000,span_loss,6,2.1,1.0,\n";
    assert!(
        parse(&pair)
            .unwrap_err()
            .to_string()
            .contains("span_loss is no quantity of the pair")
    );
}

#[test]
fn the_challenges_are_read_in_full() {
    // data of noise level 1 has no datum, so no traces
    for (text, traces) in [
        (
            include_str!("../../validation/challenges/none_L2/measurements.csv"),
            40,
        ),
        (
            include_str!("../../validation/challenges/running_in_L1/measurements.csv"),
            0,
        ),
    ] {
        let data = parse(text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(data.observations.len(), 4 * 5 * 2 * (56 + 1));
        let masses = data
            .observations
            .iter()
            .filter(|o| o.quantity == Quantity::MassLoss);
        assert_eq!(masses.count(), 40);
        assert_eq!(data.traces.len(), traces, "one per depth profile");
        let lines: Vec<usize> = data.observations.iter().map(|o| o.line).collect();
        assert!(
            lines.iter().copied().eq(2..2282),
            "one row a line, in order"
        );
    }
}

#[test]
fn files_that_cannot_be_read_are_refused_with_their_name() {
    let folder = tempfile::tempdir().unwrap();
    let good = folder.path().join("good.csv");
    std::fs::write(&good, GOOD).unwrap();
    assert_eq!(
        Dataset::load(&good, &known()).unwrap().observations.len(),
        5
    );
    let missing = Dataset::load(&folder.path().join("god.csv"), &known()).unwrap_err();
    assert_eq!(missing.diagnostic().fault, Fault::Unreadable);
    for part in [
        "god.csv",
        "no such file",
        "measurement files here: good.csv",
    ] {
        assert!(missing.to_string().contains(part), "{missing}");
    }
    let latin = folder.path().join("latin.csv");
    std::fs::write(&latin, b"# ok\n# Zahnr\xe4der\n").unwrap();
    let error = Dataset::load(&latin, &known()).unwrap_err();
    assert_eq!(error.diagnostic().fault, Fault::NotUtf8);
    assert_eq!(error.position(), Some((2, 8)));
    for part in [
        "latin.csv:2:8",
        "found the byte 0xE4",
        "save the file as UTF-8",
        "gearwear import",
    ] {
        assert!(error.to_string().contains(part), "{error}");
    }
    let wide = folder.path().join("wide.csv");
    std::fs::write(&wide, b"\xff\xfet\0e\0").unwrap();
    let error = Dataset::load(&wide, &known()).unwrap_err();
    assert!(error.to_string().contains("looks like UTF-16"), "{error}");
}

#[test]
fn every_truncation_gives_rows_or_a_message() {
    for end in (0..=GOOD.len()).filter(|at| GOOD.is_char_boundary(*at)) {
        check(&GOOD[..end]).unwrap();
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, rng_seed: proptest::test_runner::RngSeed::Fixed(21), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_files_never_panic(edits in prop::collection::vec((any::<prop::sample::Index>(), "[ -~äµ\u{0}\n\r\t\",#]{0,3}", 0..6usize), 1..6)) {
        let mut text: Vec<char> = GOOD.chars().collect();
        for (at, insert, remove) in edits {
            let at = at.index(text.len());
            let end = (at + remove).min(text.len());
            text.splice(at..end, insert.chars());
        }
        check(&text.into_iter().collect::<String>())?;
    }

    #[test]
    fn swapped_cells_never_panic(
        row in 1..6usize, column in 0..8usize,
        value in prop::sample::select(vec!["", "0", "-1", "1e308", "-1e308", "1e-308", "nan", "-inf", "\"", "\"\"", "\"a\nb\"", "pair", "µ", "#", "\r"]),
    ) {
        let mut lines: Vec<String> = GOOD.lines().filter(|l| !l.is_empty()).map(str::to_owned).collect();
        let mut cells: Vec<&str> = lines[row].split(',').collect();
        cells[column] = value;
        lines[row] = cells.join(",");
        check(&lines.join("\n"))?;
    }

    #[test]
    fn arbitrary_text_never_panics(text in "\\PC{0,200}|[,\"\n\r#a-z0-9.]{0,200}") {
        check(&text)?;
    }
}

/// Either rows that are all right, or a message with its parts.
fn check(text: &str) -> Result<(), TestCaseError> {
    match parse(text) {
        Ok(data) => {
            prop_assert!(!data.observations.is_empty());
            for o in &data.observations {
                prop_assert!(o.value.is_finite() && o.sigma > 0.0 && o.sigma.is_finite());
                prop_assert!(o.test < data.tests.len());
                prop_assert!(
                    o.trace
                        .is_none_or(|t| data.traces[t].quantity == o.quantity)
                );
            }
        }
        Err(error) => {
            let message = error.to_string();
            prop_assert!(message.starts_with("error: "), "{message}");
            prop_assert!(message.contains("--> some/measurements.csv:"), "{message}");
            let diagnostic = error.diagnostic();
            prop_assert!(
                !diagnostic.found.is_empty() && !diagnostic.allowed.is_empty(),
                "{message}"
            );
        }
    }
    Ok(())
}

/// Standard normal numbers: splitmix64 (Steele, Lea and Flood 2014) and Box and Muller's transform.
fn normal(state: &mut u64) -> f64 {
    let mut uniform = || {
        *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = *state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    let (u, v) = (1.0 - uniform(), uniform());
    (-2.0 * u.ln()).sqrt() * (2.0 * std::f64::consts::PI * v).cos()
}

/// Traces of noise of a known size on a smooth curve: its σ is found within the error of such an estimate, and that is said.
#[test]
fn a_sigma_that_is_not_stated_is_estimated_from_the_neighbours() {
    let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
    let truth = 0.17;
    let mut random = 5;
    for trace in 1..=6 {
        for point in 0..60 {
            let radius = 25.7 + 0.05 * f64::from(point);
            let wear = 5.0 + 2.0 * (1.7 * radius).sin() + truth * normal(&mut random);
            text += &format!("A,pinion,{trace}00000,wear_depth,{radius},{wear},,A-p-{trace}\n");
        }
    }
    let data = parse(&text).unwrap();
    for o in &data.observations {
        assert!((o.sigma / truth - 1.0).abs() < 0.25, "{}", o.sigma);
    }
    let mean = data.observations.iter().map(|o| o.sigma).sum::<f64>() / 360.0;
    assert!((mean / truth - 1.0).abs() < 0.12, "{mean}");
    assert!(
        data.reading.contains("sigma of 360 rows estimated"),
        "{}",
        data.reading
    );
}

/// Traces of 22 points with a noise of 0.05 µm and 2 % of the largest: what chance makes of each by itself (a factor of 2 between them) is taken
/// out by what all have in common.
#[test]
fn an_estimated_sigma_follows_the_law_of_all_traces() {
    let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
    let sigma = |trace: i32| 0.05 + 0.02 * f64::from(trace);
    let mut random = 11;
    for trace in 1..=20 {
        for point in 0..22 {
            let radius = 25.7 + 0.13 * f64::from(point);
            let shape = 0.8 + 0.2 * (1.7 * radius).sin();
            let wear = f64::from(trace) * shape + sigma(trace) * normal(&mut random);
            text += &format!("A,pinion,{trace}0000,wear_depth,{radius},{wear},,A-p-{trace}\n");
        }
    }
    let data = parse(&text).unwrap();
    for trace in 1..=20 {
        let estimated = data.observations[22 * (trace as usize - 1)].sigma;
        let off = estimated / sigma(trace);
        assert!((0.8..1.25).contains(&off), "trace {trace}: {off}");
    }
}

/// Four weighings of both members in two tests, none with a sigma: their scatter about a smooth growth, of all together. Over 200 sets of noise the
/// logarithm of sigma is that of the truth times √(8/6), the standard deviation of Student's t of eight degrees of freedom, to a tenth. One weighing alone
/// tells nothing.
#[test]
fn masses_without_a_sigma_tell_it_by_their_scatter() {
    let mut random = 3;
    let truth = 2.0;
    let mut logs = Vec::new();
    for _ in 0..200 {
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        for (test, member) in [
            ("A", "pinion"),
            ("A", "gear"),
            ("B", "pinion"),
            ("B", "gear"),
        ] {
            for step in 1..=4 {
                let mass = f64::from(40 * step - 2 * step * step) + truth * normal(&mut random);
                text += &format!("{test},{member},{step}0000,mass_loss,,{mass},\n");
            }
        }
        let data = parse(&text).unwrap();
        logs.push((data.observations[0].sigma / truth).ln());
        assert!(
            data.reading
                .contains("16 from the scatter of a few times of a test"),
            "{}",
            data.reading
        );
    }
    let mean = logs.iter().sum::<f64>() / logs.len() as f64;
    assert!((mean - 0.5 * (8.0f64 / 6.0).ln()).abs() < 0.1, "{mean}");
    let spread = logs.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / logs.len() as f64;
    assert!(spread.sqrt() < 0.4, "{spread}");
    let alone = "test,member,cycles,quantity,position,value,sigma\nA,pinion,10000,mass_loss,,40,\n";
    assert!(
        parse(alone)
            .unwrap_err()
            .to_string()
            .contains("sigma is missing")
    );
}

/// A curve that is computed, or filtered, is not known a hundred times as well as the others; one that scatters less in proportion is.
#[test]
fn a_far_smoother_curve_gets_the_sigma_of_the_others() {
    let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
    let mut random = 6;
    for trace in 1..=6 {
        // the last one without noise, the last but one with a third
        let noise = [0.15, 0.15, 0.15, 0.15, 0.05, 0.0][trace - 1];
        for point in 0..60 {
            let radius = 25.7 + 0.05 * f64::from(point);
            let wear = 5.0 + 2.0 * (1.7 * radius).sin() + noise * normal(&mut random);
            text += &format!("A,pinion,{trace}00000,wear_depth,{radius},{wear},,A-p-{trace}\n");
        }
    }
    let data = parse(&text).unwrap();
    let of = |trace: usize| data.observations[60 * (trace - 1)].sigma;
    assert!((of(5) / 0.05 - 1.0).abs() < 0.35, "{}", of(5));
    assert!((of(6) / 0.15 - 1.0).abs() < 0.35, "{}", of(6));
    assert!(
        data.reading.contains("60 from the scatter of other curves"),
        "{}",
        data.reading
    );
}

#[test]
fn a_sigma_that_is_not_stated_is_that_of_repeats_or_of_other_rows() {
    let rows = |values: &[(f64, &str)]| {
        let row =
            |(value, sigma): &(f64, &str)| format!("A,pinion,500000,mass_loss,,{value},{sigma}\n");
        let rows: String = values.iter().map(row).collect();
        parse(&format!(
            "test,member,cycles,quantity,position,value,sigma\n{rows}"
        ))
    };
    // of 10, 12, 13 and 9: standard deviation √(10/3)
    let repeated = rows(&[(10.0, ""), (12.0, ""), (13.0, ""), (9.0, "")]).unwrap();
    let expected = (10.0_f64 / 3.0).sqrt();
    assert!((repeated.observations[0].sigma - expected).abs() < 1e-12);
    let beside = rows(&[(10.0, "0.4"), (12.0, "")]).unwrap();
    assert_eq!(beside.observations[1].sigma, 0.4);
}
