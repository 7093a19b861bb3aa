//! What is told of values before they are written: dates in the place of numbers, repeats far apart, masses that grew, another unit than the title's.

use std::fs;
use std::io::Write as _;

use tempfile::TempDir;

use super::{home, line, refused, rows};

const WEIGHED: &str = "test;cycles;member;mass [mg]\nA;0;pinion;1000\nA;100000;pinion;990\n";

/// A cell that holds a text.
pub(super) fn text(text: &str) -> String {
    format!("<c t='inlineStr'><is><t>{text}</t></is></c>")
}

/// A workbook of one sheet; `cells` are those of rows below a header.
fn workbook(home: &TempDir, header: [&str; 4], cells: [&str; 2]) {
    let head: String = header.into_iter().map(text).collect();
    workbook_of(home, &[("w", &[&head[..], cells[0], cells[1]])]);
}

/// A workbook of sheets with the cells of each row, its parts stored unpacked.
pub(super) fn workbook_of(home: &TempDir, sheets: &[(&str, &[&str])]) {
    let ns = "xmlns='urn:s' xmlns:r='urn:r'";
    let names: String = (sheets.iter().enumerate())
        .map(|(i, (name, _))| format!("<sheet name='{name}' r:id='a{i}'/>"))
        .collect();
    let relations: String = (0..sheets.len())
        .map(|i| format!("<Relationship Id='a{i}' Target='s{i}.xml'/>"))
        .collect();
    let mut parts = vec![
        (
            "xl/workbook.xml".to_owned(),
            format!("<workbook {ns}><sheets>{names}</sheets></workbook>"),
        ),
        (
            "xl/_rels/workbook.xml.rels".to_owned(),
            format!("<Relationships>{relations}</Relationships>"),
        ),
        (
            "xl/styles.xml".to_owned(),
            "<styleSheet><numFmts><numFmt numFmtId='164' formatCode='dd/mm/yyyy'/></numFmts>\
             <cellXfs><xf numFmtId='0'/><xf numFmtId='164'/><xf numFmtId='14'/></cellXfs></styleSheet>"
                .to_owned(),
        ),
    ];
    for (i, (_, rows)) in sheets.iter().enumerate() {
        let rows: String = rows.iter().map(|row| format!("<row>{row}</row>")).collect();
        let data = format!("<worksheet><sheetData>{rows}</sheetData></worksheet>");
        parts.push((format!("xl/s{i}.xml"), data));
    }
    let mut file = Vec::new();
    let mut directory = Vec::new();
    for (name, text) in &parts {
        let at = file.len() as u32;
        let size = (text.len() as u32).to_le_bytes();
        let sizes = [[0; 4], size, size].concat();
        let name_length = (name.len() as u16).to_le_bytes();
        file.extend(
            [
                b"PK\x03\x04".as_slice(),
                &[20, 0, 0, 0, 0, 0, 0, 0, 0, 0],
                &sizes,
                &name_length,
                &[0, 0],
                name.as_bytes(),
                text.as_bytes(),
            ]
            .concat(),
        );
        directory.extend(
            [
                b"PK\x01\x02".as_slice(),
                &[20, 0, 20, 0, 0, 0, 0, 0, 0, 0, 0, 0],
                &sizes,
                &name_length,
                &[0; 12],
                &at.to_le_bytes(),
                name.as_bytes(),
            ]
            .concat(),
        );
    }
    let (at, length, count) = (
        file.len() as u32,
        directory.len() as u32,
        parts.len() as u16,
    );
    file.extend(directory);
    file.extend(
        [
            b"PK\x05\x06".as_slice(),
            &[0; 4],
            &count.to_le_bytes(),
            &count.to_le_bytes(),
            &length.to_le_bytes(),
            &at.to_le_bytes(),
            &[0, 0],
        ]
        .concat(),
    );
    let mut out = fs::File::create(home.path().join("dated.xlsx")).unwrap();
    out.write_all(&file).unwrap();
}

const DATED: &str =
    "import dated.xlsx --study study.toml --member pinion --quantity mass_loss --sigma 2";

#[test]
fn dates_are_no_numbers() {
    let home = home();
    let test = "<c t='inlineStr'><is><t>A</t></is></c>";
    let row = |cells: &str| format!("{test}{cells}");
    let good = row("<c><v>0</v></c><c><v>1000</v></c><c s='1'><v>45380</v></c>");
    for (bad, cell) in [
        (
            "<c s='1'><v>45385</v></c><c><v>990</v></c><c s='1'><v>45385</v></c>",
            "B3",
        ),
        (
            "<c><v>100000</v></c><c s='2'><v>45385</v></c><c s='1'><v>45385</v></c>",
            "C3",
        ),
    ] {
        workbook(
            &home,
            ["test", "cycles", "mass [mg]", "date"],
            [&good, &row(bad)],
        );
        let (code, _, message) = line(&home, DATED);
        assert_eq!(code, Some(2), "{message}");
        assert!(
            message.contains(&format!("{cell}: `2024-04-03` is a date or a time")),
            "{message}"
        );
    }
    // in a column for people they may stand
    let fine = row("<c><v>100000</v></c><c><v>990</v></c><c s='1'><v>45385</v></c>");
    workbook(
        &home,
        ["test", "cycles", "mass [mg]", "date"],
        [&good, &fine],
    );
    let (code, shown, message) = line(&home, DATED);
    assert_eq!(code, Some(0), "{message}");
    assert!(
        shown.contains("A,pinion,100000,mass_loss,,10,2,"),
        "{shown}"
    );
}

/// A machine writes a number of nines where it has no value: far from all others it is none.
#[test]
fn numbers_that_stand_for_no_value_are_left_out_and_told() {
    let home = home();
    let wide = |none: &str| {
        format!(
            "Radius [mm];40000;100000\n26,512;0,885;1,027\n26,711;{none};0,99\n27,133;0,810;{none}\n"
        )
    };
    let options = "--test A --member pinion --sigma 0.1";
    for none in ["-999", "9999", "-99,99"] {
        let (shown, written) = rows(&home, &wide(none), options);
        let says = format!(
            "left out B3: `{none}`, C4: `{none}`: these look like a machine's `no value`, for no other wear_depth is above 1.027 µm"
        );
        assert!(shown.contains(&says), "no `{says}` in:\n{shown}");
        assert_eq!(written.lines().count(), 4, "{written}");
    }
    let long = "test,member,cycles,radius,depth [mm],sigma [um]\n\
                A,pinion,40000,26.5,0.0015,0.1\nA,pinion,40000,27,-9999,0.1\nA,pinion,40000,27.5,0.0012,0.1\n";
    let (shown, written) = rows(&home, long, "");
    assert!(
        shown.contains("left out E3: `-9999`: this looks like"),
        "{shown}"
    );
    assert_eq!(written.lines().count(), 2, "{written}");
    // the total after an interval that nobody measured is not known
    let losses = "test,member,cycles,mass loss [mg]\nA,gear,40000,1.5\nA,gear,60000,-999\nA,gear,90000,1.2\n";
    let message = refused(&home, losses, "--per-interval mass_loss --sigma 0.1");
    assert!(
        message.contains("without the loss of this interval"),
        "{message}"
    );
    // others may be as large, and no other number stands for nothing
    let near = wide("99,9").replace("1,027", "9,027");
    assert_eq!(rows(&home, &near, options).1.lines().count(), 6);
    let other = wide("-998");
    assert_eq!(rows(&home, &other, options).1.lines().count(), 6);
}

/// What is left out of a table that is read like the one before it is told too.
#[test]
fn cells_left_out_of_the_next_table_are_told() {
    let home = home();
    let table = |test: &str, none: &str| {
        let row = |radius: &str, depth: &str| format!("{test},gear,40000,{radius},{depth},0.1\n");
        let all = [row("52.5", "1.5"), row("53", none), row("53.5", "1.2")].concat();
        std::fs::write(
            home.path().join(format!("{test}.csv")),
            format!("test,member,cycles,radius,depth,sigma\n{all}"),
        )
        .unwrap();
    };
    table("A", "1.4");
    table("B", "-999");
    let (code, shown, error) = line(&home, "import A.csv B.csv --study study.toml");
    assert_eq!(code, Some(0), "{error}");
    assert!(shown.contains("B.csv, read alike: 2 rows"), "{shown}");
    assert!(shown.contains("left out E3: `-999`"), "{shown}");
}

#[test]
fn repeats_that_lie_far_apart_are_told() {
    let home = home();
    let far = format!("{WEIGHED}A;100000;pinion;915\n");
    let said =
        "mass_loss of the pinion in test A after 100000 cycles: 10 and 85 mg are taken as repeats";
    assert!(
        rows(&home, &far, "--quantity mass_loss --sigma 2")
            .0
            .contains(said)
    );
    assert!(
        !rows(&home, &far, "--quantity mass_loss --sigma 20")
            .0
            .contains("taken as repeats")
    );
}

#[test]
fn masses_that_grew_are_told() {
    let home = home();
    let table = format!("{WEIGHED}A;200000;pinion;1050\nA;300000;pinion;980\n");
    let (shown, _) = rows(&home, &table, "--quantity mass_loss --sigma 2");
    assert!(
        shown.contains("1 of 3 values of mass_loss are negative (mass_loss of the pinion in test A after 200000 cycles: -50 mg)"),
        "{shown}"
    );
}

#[test]
fn teeth_that_grew_are_told() {
    let home = home();
    let table =
        "test,member,cycles,quantity,position,value,sigma\nA,pinion,1e5,chordal_loss,26.8,-15,1\n";
    let (shown, _) = rows(&home, table, "");
    assert!(
        shown.contains("1 of 1 values of chordal_loss are negative"),
        "{shown}"
    );
}

#[test]
fn a_title_with_another_unit_is_named() {
    let home = home();
    let table = "Wear depth [mm]\nradius [mm];250000\n26,5;2,345\n27;2,1\n";
    let message = refused(&home, table, "--test A --member pinion --sigma 0.1");
    assert!(
        message.contains("the title says mm; the numbers look like \u{b5}m"),
        "{message}"
    );
    assert!(!message.contains("looks like nm"), "{message}");
    // a header of a table with a row for each value says it alike
    let table = "cycles;radius [mm];wear depth [mm]\n250000;26,5;2,345\n250000;27;2,1\n";
    let message = refused(&home, table, "--test A --member pinion --sigma 0.1");
    assert!(
        message.contains("the header says mm; the numbers look like \u{b5}m"),
        "{message}"
    );
    assert!(!message.contains("looks like nm"), "{message}");
}

#[test]
fn two_exchanged_places_are_told_and_two_exchanged_rows_are_not() {
    let home = home();
    let told = |radii: [f64; 10], values: [f64; 10]| {
        let pairs = radii.iter().zip(values);
        let lines: String = pairs.map(|(r, v)| format!("{r};{v}\n")).collect();
        let table = format!("radius [mm];250000\n{lines}");
        rows(&home, &table, "--test A --member pinion --sigma 0.1").0
    };
    let radii = [26.0, 26.3, 26.6, 26.9, 27.2, 27.5, 27.7, 27.9, 28.1, 28.3];
    let values = [4.0, 3.0, 2.2, 1.6, 1.2, 1.0, 0.9, 0.9, 1.1, 1.4];
    let mut exchanged = radii;
    exchanged.swap(1, 2);
    assert!(!told(radii, values).contains("out of order"));
    let shown = told(exchanged, values);
    assert!(
        shown.contains("the places 26.6 and 26.3 are out of order"),
        "{shown}"
    );
    let mut along = values;
    along.swap(1, 2);
    assert!(!told(exchanged, along).contains("out of order"));
}

/// Roll angles of both members overlap, and so do the radii of like ones: nothing is taken for the pinion's by itself.
#[test]
fn a_curve_that_either_flank_could_have_wants_its_member() {
    let home = home();
    let table =
        "Gear inspection report;\nroll angle [deg];250000\n18;2.5\n20;2.1\n22;1.5\n24;1.2\n";
    let message = refused(&home, table, "--test A --sigma 0.1");
    assert!(
        message.contains("--member pinion or --member gear")
            && message.contains("a row above says `Gear inspection report`"),
        "{message}"
    );
    let (_, written) = rows(&home, table, "--test A --sigma 0.1 --member gear");
    assert!(
        written.starts_with("A,gear,250000,wear_depth,"),
        "{written}"
    );
}

#[test]
fn a_second_curve_is_not_put_into_a_trace() {
    let home = home();
    let table = |radii: [f64; 4]| {
        let rows = radii.iter().map(|r| format!("{r};1.5\n"));
        format!("radius [mm];250000\n{}", rows.collect::<String>())
    };
    let option = "--test A --member pinion --sigma 0.1 -o out.csv";
    let (code, _, message) = super::import(&home, &table([26.0, 26.5, 27.0, 27.5]), option);
    assert_eq!(code, Some(0), "{message}");
    let behind = format!("{option} --append");
    let (code, _, message) = super::import(&home, &table([26.1, 26.6, 27.1, 27.6]), &behind);
    assert_eq!(code, Some(2));
    assert!(
        message.contains("the trace A-pinion-250000 is there already, from 26 to 27.5"),
        "{message}"
    );
    // the other half of the flank goes on with it
    let (code, _, message) = super::import(&home, &table([27.4, 27.8, 28.1, 28.4]), &behind);
    assert_eq!(code, Some(0), "{message}");
}
