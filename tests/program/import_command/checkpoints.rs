//! What a checkpoint is: revolutions of either member, running times, multiples of a thousand.

use super::*;

/// The first cell may name the rows and the columns of a table. At 2000 rpm an hour has 120,000 revolutions.
#[test]
fn a_first_cell_that_names_rows_and_columns_tells_running_times() {
    let home = home();
    let options = "--test A --member pinion --unit um --sigma 0.1 --no-traces";
    let expected = "A,pinion,180000,wear_depth,26.5,1.1,0.1,\nA,pinion,180000,wear_depth,28,2.1,0.1,\n\
                    A,pinion,960000,wear_depth,26.5,1.2,0.1,\nA,pinion,960000,wear_depth,28,2.2,0.1,\n";
    for table in [
        "Zeit [h] / Radius [mm];26,5;28,0\n1,5;1,1;2,1\n8,0;1,2;2,2\n",
        "Laufzeit [min] \\ Radius [mm];26,5;28,0\n90;1,1;2,1\n480;1,2;2,2\n",
        "Rayon [mm] / Temps [h];1,5;8,0\n26,5;1,1;1,2\n28,0;2,1;2,2\n",
    ] {
        let (shown, written) = rows(&home, table, options);
        assert_eq!(written, expected, "{table}\n{shown}");
        assert!(shown.contains("running times, turned into"), "{shown}");
    }
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
    for header in [
        "Ore [h]",
        "Ore",
        "Stunden [h]",
        "Heures de marche (h)",
        "Horas de funcionamiento [h]",
        "Heures",
    ] {
        let hours = format!("Prova,Ruota,{header},Raggio [mm],Usura [um]\nA,pignone,1.5,26.5,1\n");
        assert!(
            rows(&home, &hours, "--sigma 0.1")
                .1
                .starts_with("A,pinion,180000,"),
            "{header}"
        );
    }
    // both of a compound's words
    let of_gear =
        "Versuch;Rad;Radumdrehungen;Radius [mm];Verschlei\u{df} [\u{b5}m]\nA;Ritzel;27000;26,5;1\n";
    let plain = of_gear.replace("Radumdrehungen", "Umdrehungen Rad");
    assert_eq!(
        rows(&home, of_gear, "--sigma 0.1").1,
        rows(&home, &plain, "--sigma 0.1").1
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

/// Test A runs with 100 N m on the pinion of 27 teeth, B with 170: a table with another torque is of another test, or the study is wrong.
#[test]
fn a_torque_of_a_table_is_that_of_the_test() {
    let home = home();
    let table = |header: &str, torque: &str| {
        format!(
            "test;member;cycles;{header};radius;depth\nA;pinion;40000;{torque};26;1\nA;pinion;40000;{torque};27;2\n"
        )
    };
    for (header, torque, says) in [
        (
            "Drehmoment [Nm]",
            "600",
            "D2: `600` below `Drehmoment [Nm]` is another torque than that of test A in the study, 100 N m: correct",
        ),
        ("torque [N m]", "102", "100 N m"),
        ("Moment [Nm]", "100000", "100 N m"),
        // 100 N m of 27 teeth are 196.3 of 53, and 50.94 are those of 100 on the gear
        ("Drehmoment Rad [Nm]", "100", "N m on the gear"),
        ("torque pinion [Nm]", "196,3", "is it the other member's?"),
        (
            "torque [Nm]",
            "50,94",
            "does the study state the gear's torque?",
        ),
    ] {
        let message = refused(&home, &table(header, torque), "--sigma 0.1");
        assert!(message.contains(says), "no `{says}` in: {message}");
    }
    for (header, torque) in [
        ("Drehmoment [Nm]", "100"),
        ("torque [N m]", "99,2"),
        ("torque [Nmm]", "100000"),
        ("torque [Nm]", "100 Nm"),
        ("torque [Nm]", ""),
        ("gear torque [Nm]", "196"),
    ] {
        let (shown, written) = rows(&home, &table(header, torque), "--sigma 0.1");
        assert!(written.starts_with("A,pinion,40000,"), "{written}");
        let said = format!("passed over the column `{header}`: a torque, which is the study's\n");
        assert!(shown.contains(&said), "{shown}");
    }
    let (shown, _) = rows(&home, &table("Drehmoment [Nm]", "196,3"), "--sigma 0.1");
    assert!(
        shown.contains("`Drehmoment [Nm]`: the gear's torque, which is that of the test times"),
        "{shown}"
    );
    // each row is held against its own test
    let both =
        table("torque [Nm]", "100").replacen("A;pinion;40000;100;27", "B;pinion;40000;170;27", 1);
    assert!(
        rows(&home, &both, "--sigma 0.1")
            .1
            .contains("B,pinion,40000,")
    );
}

#[test]
fn what_counts_no_revolutions_is_no_checkpoint() {
    let home = home();
    let options = "--test A --member pinion --sigma 0.1";
    for header in [
        "2 wk",
        "25 %",
        "2000 rpm",
        "100 T",
        "20 °C",
        "50 Nm",
        "5 mm",
        "1 tooth",
        "100000 left",
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
        stages.contains("B1: the header `stage 1` counts stages, teeth or measurements"),
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

/// A title may say the test, the member and the count in one line, a date beside them.
#[test]
fn a_title_says_after_how_many_revolutions_a_curve_was_measured() {
    let home = home();
    let table = |title: &str, radius: f64| {
        format!(
            "{title}\nradius [mm];depth [um]\n{radius};1\n{};2\n",
            radius + 0.5
        )
    };
    for (title, radius, start) in [
        (
            "Essai A, 100000 tours pignon, 12/03/2025",
            26.0,
            "A,pinion,100000,wear_depth,26,",
        ),
        (
            "Run A; pinion; after 250 000 revolutions",
            26.0,
            "A,pinion,250000,wear_depth,26,",
        ),
        (
            "Run A, 509434 gear rev",
            52.0,
            "A,gear,1000000,wear_depth,52,",
        ),
    ] {
        let (shown, written) = rows(&home, &table(title, radius), "--sigma 0.1");
        assert!(written.starts_with(start), "{title}: {shown}{written}");
    }
    // hours, torques and multiples are no counts
    for title in [
        "Run A, 3 h, pinion",
        "Run A, 100 N m, pinion",
        "Run A, 0.8 Mio. rev, pinion",
    ] {
        refused(&home, &table(title, 26.0), "--sigma 0.1");
    }
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

/// Beside revolutions a column of speeds is passed over, and said to be the study's only where it is: 2000 rpm of 27 teeth are 1019 of 53.
#[test]
fn a_speed_beside_revolutions_is_compared_with_that_of_the_test() {
    let home = home();
    for (header, speed, says) in [
        ("speed [rpm]", "2000", "a speed, which is the study's"),
        (
            "speed [rpm]",
            "1019",
            "the gear's speed, which is that of the test over the ratio",
        ),
        (
            "Drehzahl Rad [1/min]",
            "1019",
            "the gear's speed, which is that of the test over the ratio",
        ),
        (
            "speed [rpm]",
            "1500",
            "a speed, which is not the study's: D2: `1500` below `speed [rpm]` is another one than that of test A, 2000 rpm",
        ),
        (
            "gear speed [rpm]",
            "2000",
            "a speed, which is not the study's: D2: `2000` below `gear speed [rpm]` is another one than that of test A, 1019 rpm",
        ),
        (
            "speed [rpm]",
            "high",
            "a speed, which could not be compared with the study's",
        ),
    ] {
        let table =
            format!("test,member,cycles,{header},radius,depth\nA,pinion,40000,{speed},26,1\n");
        let (shown, _) = rows(&home, &table, "--sigma 0.1");
        let says = format!("passed over the column `{header}`: {says}");
        assert!(shown.contains(&says), "no `{says}` in:\n{shown}");
    }
    // running times become revolutions beside the gear's speed too
    let table = "test,member,hours,speed [rpm],radius,depth\nA,pinion,1.5,1019,26,1\n";
    let (shown, written) = rows(&home, table, "--sigma 0.1");
    assert!(written.starts_with("A,pinion,180000,"), "{written}");
    assert!(shown.contains("`speed [rpm]`: the gear's speed"), "{shown}");
}
