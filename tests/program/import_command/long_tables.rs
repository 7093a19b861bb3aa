//! Tables with a row for each value, under the names that people give.

use super::*;

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
        written.contains(",A-pinion-100000-1\n") && written.contains(",A-gear-100000-1\n"),
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

/// All checkpoints had one zero where a column numbers the profiles of each.
#[test]
fn a_name_at_several_checkpoints_is_a_trace_at_each() {
    let home = home();
    let table = |name: &str| {
        format!(
            "Versuch;Rad;Lastspiele;Kurve;Radius [mm];Verschlei\u{df} [\u{b5}m];sigma\n\
             A;Ritzel;40000;{name};26,512;1,75;0,1\nA;Ritzel;40000;{name};27,5;1,55;0,1\n\
             A;Ritzel;100000;{name};26,512;2,75;0,1\nA;Ritzel;100000;{name};27,5;2,55;0,1\n"
        )
    };
    for (name, why) in [
        ("1", "before the name: it numbers them within these"),
        (
            "links",
            "before the name: the same name stands at several checkpoints",
        ),
    ] {
        let (shown, written) = rows(&home, &table(name), "");
        for cycles in ["40000", "100000"] {
            let trace = format!(",A-pinion-{cycles}-{name}\n");
            assert_eq!(written.matches(&trace).count(), 2, "{written}");
        }
        let said = format!("traces   as the column says, with test, member and checkpoint {why}");
        assert!(shown.contains(&said), "{shown}");
    }
    // a number says nothing in one test either: the next table has it too
    let one = |test: &str| {
        format!(
            "test,member,cycles,profile,radius,depth,sigma\n{test},gear,40000,1,52.5,1.75,0.1\n{test},gear,40000,1,53.5,1.5,0.1\n"
        )
    };
    assert!(rows(&home, &one("A"), "").1.contains(",A-gear-40000-1\n"));
    let (code, _, error) = import(&home, &one("B"), "-o out.csv --append");
    assert_eq!(code, Some(0), "{error}");
    assert!(read(&home, "out.csv").contains(",B-gear-40000-1\n"));
    // so has one with the same name, but the rest of the same curve goes on with it
    let named = |test: &str| one(test).replace("0,1,5", "0,left,5");
    assert!(rows(&home, &named("A"), "").1.contains(",left\n"));
    let rest = named("A").replace("52.5", "54.5").replace("53.5", "55");
    for (table, trace) in [(rest, ",left\n"), (named("B"), ",B-gear-40000-left\n")] {
        let (code, _, error) = import(&home, &table, "-o out.csv --append");
        assert_eq!(code, Some(0), "{error}");
        assert!(read(&home, "out.csv").ends_with(trace), "{trace}");
    }
    // names of one checkpoint each stay, and teeth have traces of their own
    let named = one("A").replace("0,1,5", "0,p1,5");
    assert!(rows(&home, &named, "").1.contains(",p1\n"));
    let teeth = "test,member,cycles,profile,tooth,radius,depth,sigma\nA,gear,40000,1,3,52.5,1.75,0.1\nA,gear,40000,1,8,52.5,1.5,0.1\n";
    let (_, written) = rows(&home, teeth, "");
    assert!(written.contains(",A-gear-40000-tooth8-1,8\n"), "{written}");
    // a record of one mass over its test is one series
    let masses =
        "test,member,cycles,trace,mass loss [mg]\nA,gear,40000,1,1.75\nA,gear,90000,1,3.5\n";
    let (_, written) = rows(&home, masses, "--sigma 0.4");
    assert_eq!(written.matches(",A-gear-1\n").count(), 2, "{written}");
}

/// Two repeats shared one zero where their column was passed over.
#[test]
fn a_column_that_numbers_repeats_tells_them_apart() {
    let home = home();
    let table = |header: &str, [one, two]: [&str; 2]| {
        format!(
            "Versuch;Rad;Lastspiele;{header};Radius [mm];Verschlei\u{df} [\u{b5}m];sigma\n\
             A;Ritzel;40000;{one};26,512;1,75;0,1\nA;Ritzel;40000;{one};27,5;1,55;0,1\n\
             A;Ritzel;40000;{two};26,512;1,75;0,1\nA;Ritzel;40000;{two};27,5;1,65;0,1\n"
        )
    };
    for header in [
        "Messung",
        "Repeat",
        "Wdh.",
        "Messung Nr.",
        "replicate",
        "Run",
    ] {
        let (shown, written) = rows(&home, &table(header, ["1", "2"]), "");
        for repeat in ["r1", "r2"] {
            let trace = format!(",A-pinion-40000-{repeat}\n");
            assert_eq!(written.matches(&trace).count(), 2, "{header}: {written}");
        }
        let said = format!("column   `{header}`: the number of a repeat, as by --repeat");
        assert!(shown.contains(&said), "{shown}");
    }
    // beside a column of traces, and as the one number of a table
    let curves = table("Messung;Kurve", ["1;1", "2;1"]);
    let (_, written) = rows(&home, &curves, "");
    assert!(written.contains(",A-pinion-40000-1-r2\n"), "{written}");
    let third = table("Messung", ["3", "3"]).replace(
        "1,75;0,1\nA;Ritzel;40000;3;27,5;1,65",
        "1,76;0,1\nA;Ritzel;40000;3;27,5;1,65",
    );
    assert!(rows(&home, &third, "").1.contains(",A-pinion-40000-r3\n"));
    assert!(
        refused(&home, &table("Messung", ["1", "2"]), "--repeat 2")
            .contains("the table has a column of repeats, D1: `Messung`")
    );
    // numbers of points, orders, and anything else
    let counts = "test;member;cycles;Messung;radius;depth;sigma\nA;pinion;40000;1;26,512;1,75;0,1\nA;pinion;40000;2;27,5;1,55;0,1\n";
    for other in [
        counts.to_owned(),
        counts
            .replace("40000;1;", "40000;4711;")
            .replace("40000;2;", "40000;4711;"),
        counts
            .replace("40000;1;", "40000;0,5;")
            .replace("40000;2;", "40000;0,5;"),
        counts
            .replace("40000;1;", "40000;alt;")
            .replace("40000;2;", "40000;alt;"),
        // checkpoints
        format!(
            "{counts}{}",
            "A;pinion;90000;3;26,512;2,75;0,1\nA;pinion;90000;4;27,5;2,55;0,1\n"
        ),
    ] {
        let (shown, written) = rows(&home, &other, "");
        assert!(written.contains(",A-pinion-40000\n"), "{written}");
        assert!(
            shown.contains("passed over the column `Messung`: not known"),
            "{shown}"
        );
    }
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
    // one weighing alone says nothing of the loss beside it; from two it was taken
    for (beside, passed_over) in [
        (
            "test,cycles,member,mass before [g],mass loss [mg]\nA,5000,pinion,812.4312,25.7\n",
            "the column `mass before [g]`: a weighing",
        ),
        (
            "test,cycles,member,mass before [g],mass after [g],mass loss [mg]\nA,5000,pinion,812.4312,812.4055,25.7\n",
            "`mass loss [mg]` passed over: it is what lies between",
        ),
    ] {
        let (shown, written) = rows(&home, beside, "--sigma 1");
        assert_eq!(written, "A,pinion,5000,mass_loss,,25.7,1,\n");
        assert!(shown.contains(passed_over), "{shown}");
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

/// Units may stand in a row of their own below the header of a long table too.
#[test]
fn a_row_of_units_stands_below_the_header_of_a_long_table() {
    let home = home();
    let table = "Run;Part;Cycles;Diameter;Depth\n;;-;mm;mm\nA;pinion;80000;52.0;0.0015\nA;gear;80000;104.5;0.0025\n";
    let (shown, written) = rows(&home, table, "--sigma 0.1");
    assert_eq!(
        written,
        "A,pinion,80000,wear_depth,26,1.5,0.1,\nA,gear,80000,wear_depth,52.25,2.5,0.1,\n"
    );
    assert!(
        shown.contains("layout   row 2 holds the columns' units\n"),
        "{shown}"
    );
    let other = table.replace("Depth", "Depth [um]");
    let message = refused(&home, &other, "--sigma 0.1");
    assert!(
        message.contains("`Depth [um]` is in um, and `mm` stands below it"),
        "{message}"
    );
}

/// Of merged cells a spreadsheet stores the first alone.
#[test]
fn merged_cells_of_tests_and_members_hold_for_the_rows_below() {
    let home = home();
    let table = "Versuch;Rad;Lastwechsel;Radius [mm];Verschlei\u{df} [um]\n\
                 A;Ritzel;80000;26;1,5\n;;80000;27;1,2\n;Rad;80000;52;1,1\n;;80000;53;0,9\n\
                 B;Ritzel;80000;26;2,5\n;;80000;27;2,2\n";
    let (shown, written) = rows(&home, table, "--sigma 0.1");
    let lines: Vec<&str> = written.lines().collect();
    assert_eq!(lines.len(), 6, "{written}");
    for (row, begins) in [
        (1, "A,pinion,80000,wear_depth,27,1.2,"),
        (3, "A,gear,80000,wear_depth,53,0.9,"),
        (5, "B,pinion,80000,wear_depth,27,2.2,"),
    ] {
        assert!(
            lines[row].starts_with(begins),
            "no `{begins}` in:\n{written}"
        );
    }
    for part in [
        "layout   `Versuch`: empty cells hold the value above them\n",
        "layout   `Rad`: empty cells hold the value above them\n",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    // a cell that is empty among rows that state theirs each, or with nothing above it, is a gap
    let gap = "test;member;cycles;radius;depth\nA;pinion;1e5;26;1\nA;pinion;1e5;27;2\n;pinion;1e5;28;3\nB;pinion;1e5;26;4\n";
    let message = refused(&home, gap, "--sigma 0.1");
    assert!(
        message.contains("A4: nothing stands here below `test`"),
        "{message}"
    );
    let first = "test;member;cycles;radius;depth\n;pinion;1e5;26;1\nA;pinion;1e5;27;2\n";
    let message = refused(&home, first, "--sigma 0.1");
    assert!(
        message.contains("A2: nothing stands here below `test`"),
        "{message}"
    );
}

/// What lies below the limit of detection has no value: the message says what to do with it.
#[test]
fn a_value_below_the_limit_of_detection_is_to_be_left_empty() {
    let home = home();
    let long = "Prova;Ruota;Cicli;Raggio [mm];Usura [um]\nA;pignone;80000;26,5;1,29\nA;pignone;80000;27,5;<0,2\n";
    let wide = "Raggio [mm];80000\n26,5;1,29\n27,5;\u{2264} 0,2\n";
    for (table, options, cell) in [
        (long, "--sigma 0.1", "E3: `<0,2`"),
        (
            wide,
            "--test A --member pinion --sigma 0.1",
            "B3: `\u{2264} 0,2`",
        ),
    ] {
        let message = refused(&home, table, options);
        assert!(
            message.contains(cell)
                && message.contains("is a limit of detection, not a value: leave the cell empty"),
            "{message}"
        );
    }
}

/// A row for each member with a column for each checkpoint is neither a wide nor a long table.
#[test]
fn checkpoints_stand_in_columns_beside_tests_and_members() {
    let home = home();
    let table =
        "Versuch;Rad;5000 LW;20000 LW\nA;Ritzel;12,3;44,1\nA;Rad;6,3;20,5\nB;Ritzel;10,1;\n";
    for (text, options) in [
        (format!("Massenverlust [mg]\n{table}"), "--sigma 0.3"),
        (table.to_owned(), "--sigma 0.3 --quantity mass_loss"),
    ] {
        let (_, written) = rows(&home, &text, options);
        let expected = [
            "A,pinion,5000,mass_loss,,12.3,0.3",
            "A,pinion,20000,mass_loss,,44.1,0.3",
            "A,gear,5000,mass_loss,,6.3,0.3",
            "A,gear,20000,mass_loss,,20.5,0.3",
            "B,pinion,5000,mass_loss,,10.1,0.3",
        ];
        for row in expected {
            assert!(written.contains(row), "no `{row}` in: {written}");
        }
        assert_eq!(written.lines().count(), 5, "{written}");
    }
}
