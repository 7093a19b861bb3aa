//! Several tables, sheets and files, and rows behind those that are there.

use super::doubtful::{text, workbook_of};
use super::*;

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
        "layout   row 5, `Number of teeth: 27`: as in the study\n",
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
    let (code, _, message) = line(
        &home,
        "import a.txt a.txt --study study.toml --turn-sign --sigma 0.1",
    );
    assert_eq!(code, Some(2));
    assert!(message.contains("the reading A,pinion,100000"), "{message}");
    // a curve that says nothing of itself
    let bare = "Radius [mm];Deviation [um]\n26.5;2.5\n27.5;1.5\n";
    let options = "--test B --member pinion --cycles 5000 --sigma 0.1 --quantity wear_depth";
    assert_eq!(
        rows(&home, bare, options).1,
        "B,pinion,5000,wear_depth,26.5,2.5,0.1,B-pinion-5000\nB,pinion,5000,wear_depth,27.5,1.5,0.1,B-pinion-5000\n"
    );
    // a member that the lines state is not overruled
    let pinion = curve("pinion", "100000", "26.5");
    assert!(refused(&home, &pinion, "--member gear").contains("--member says gear"));
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
        message.contains(
            "tables.xlsx, sheet pinion: row 1: `Flank wear, pinion, test A` says test A, --test says B"
        ),
        "{message}"
    );
    // and which of the others cannot be read either
    assert!(
        message.contains("Nothing is written; of the others, rows cannot be read either"),
        "{message}"
    );
}

/// Of a cover nothing is read, and it is said; a row of units stands below the header.
#[test]
fn covers_are_passed_over_and_units_below_a_header_are_read() {
    let home = home();
    let row = |cells: [&str; 3]| cells.map(text).concat();
    let (cover, seal) = (row(["Report 2025/17", "", ""]), row(["Pages", "4", ""]));
    let head = row(["Radius", "40000", "100000"]);
    let units = row(["mm", "mm", "mm"]);
    let dates = row(["measured on", "2025-03-01", "2025-03-04"]);
    let values = "<c><v>26.5</v></c><c><v>0.0025</v></c><c><v>0.006</v></c>";
    let sheets: [(&str, &[&str]); 2] = [
        ("Cover", &[&cover, &seal]),
        ("A pinion", &[&head, &units, values]),
    ];
    workbook_of(&home, &sheets);
    let import = "import dated.xlsx --all-sheets --study study.toml --sigma 0.1";
    let shown = succeed(&home, &format!("{import} -o out.csv"));
    assert!(
        shown.contains("sheet Cover passed over: none of its rows holds two numbers"),
        "{shown}"
    );
    assert!(shown.contains("row 2 holds the columns' units"), "{shown}");
    let written = read(&home, "out.csv");
    assert!(
        written.contains("A,pinion,40000,wear_depth,26.5,2.5,0.1,"),
        "{written}"
    );
    let head = row(["Radius [mm]", "40000 [mm]", "100000 [mm]"]);
    workbook_of(&home, &[("A pinion", &[&head, &dates, values])]);
    let shown = succeed(&home, &format!("{import} -o out.csv --force"));
    assert!(shown.contains("row 2 holds dates: passed over"), "{shown}");
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

#[test]
fn some_sheets_are_taken_or_left_out_by_name() {
    let home = home();
    let options = "--study study.toml --test A --unit mm --turn-sign --sigma 0.2";
    let shown = succeed(
        &home,
        &format!("import tables.xlsx --all-sheets --skip-sheet rows --skip-sheet gear {options}"),
    );
    assert!(
        shown.contains("sheet rows passed over: as asked") && shown.contains("sheet pinion\n"),
        "{shown}"
    );
    let two = "import tables.xlsx --sheet pinion --sheet pinion --study study.toml --test A --unit mm --turn-sign --sigma 0.2";
    let (code, _, message) = line(&home, two);
    // the same twice is no second table
    assert_eq!(code, Some(2), "{message}");
    let (code, _, message) = line(
        &home,
        &format!("import tables.xlsx --all-sheets --skip-sheet lid {options}"),
    );
    assert_eq!(code, Some(2));
    assert!(
        message.contains("has no sheet lid; its sheets: pinion"),
        "{message}"
    );
}
