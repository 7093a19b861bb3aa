//! Losses of mass and thickness: weighings before and after, at each stop, per interval.

use super::*;

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

/// A loss whose header names its member, of the one member that was weighed.
#[test]
fn a_loss_of_one_member_may_name_it() {
    let home = home();
    let text = "Run,Revolutions,pinion loss mg\nA,150000,3.5\nA,375000,6.4\n";
    for options in ["--sigma 1", "--sigma 1 --member pinion"] {
        let (shown, written) = rows(&home, text, options);
        assert!(
            written.starts_with("A,pinion,150000,mass_loss,,3.5,1,"),
            "{written}"
        );
        assert!(shown.contains("the columns of the pinion alone"), "{shown}");
    }
    assert!(refused(&home, text, "--sigma 1 --member gear").contains("--member says gear"));
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

/// What sums the rows of a long table up is no measurement of a test of that name.
#[test]
fn rows_that_sum_others_up_are_passed_over() {
    let home = home();
    for total in [
        "Summe",
        "Mittelwert",
        "Total",
        "Mean",
        "Somme",
        "Totale",
        "Media",
        "Moyenne",
        "Summe A",
    ] {
        let table = format!(
            "Versuch;Lastwechsel;Massenverlust Ritzel [mg];Massenverlust Rad [mg]\n\
             A;80000;9,46;15,37\nA;400000;29,38;50,88\n{total};;38,84;66,25\n"
        );
        let (shown, written) = rows(&home, &table, "--sigma 0.5");
        assert_eq!(written.lines().count(), 4, "{written}");
        let says = format!("left out row 4 sums others up (`{total}`): passed over\n");
        assert_eq!(shown.matches(&says).count(), 1, "no `{says}` in:\n{shown}");
    }
    let of_members = "Versuch;Teil;Lastwechsel;Massenverlust [mg]\nA;Ritzel;80000;9,46\nA;Rad;80000;15,37\nA;Summe;80000;24,83\n";
    let (_, written) = rows(&home, of_members, "--sigma 0.5");
    assert_eq!(written.lines().count(), 2, "{written}");
    // any other word is a test that the study lacks
    let message = refused(
        &home,
        "Versuch;Teil;Lastwechsel;Massenverlust [mg]\nSumme X;Ritzel;80000;9,46\n",
        "--sigma 0.5",
    );
    assert!(
        message.contains("the study has no test Summe X"),
        "{message}"
    );
}

/// Revolutions and losses of each stage, by people who ask for the revolutions alone or for nothing.
#[test]
fn losses_of_stages_beside_revolutions_of_stages_are_asked_for() {
    let home = home();
    let rows_of = "A;1;40000;17,23;17,61\nA;2;60000;24,76;23,61\nA;3;100000;37,88;39,92\nA;4;100000;36,94;36,57\n";
    let table = |cycles: &str| {
        format!(
            "Versuch;Stufe;{cycles};Massenverlust Ritzel [mg];Massenverlust Rad [mg]\n{rows_of}"
        )
    };
    let message = refused(&home, &table("Umdrehungen"), "--sigma 1");
    assert!(
        message.contains("or say --per-interval cycles, or --per-interval cycles,mass_loss where these too are of each stop alone"),
        "{message}"
    );
    let doubt = "mass_loss is taken as the total since the start of the test, but falls at D5; if it too is of each interval alone, say --per-interval cycles,mass_loss";
    let (shown, _) = rows(
        &home,
        &table("Umdrehungen"),
        "--sigma 1 --per-interval cycles",
    );
    assert!(shown.contains(doubt), "{shown}");
    let named = table("Umdrehungen in der Stufe");
    let message = refused(&home, &named, "--sigma 1");
    assert!(
        message.contains("if `Umdrehungen in der Stufe` hold what each interval alone gave, say --per-interval cycles"),
        "{message}"
    );
    let (shown, written) = rows(&home, &named, "--sigma 1 --per-interval cycles,mass_loss");
    assert!(!shown.contains("is taken as the total"), "{shown}");
    assert!(
        written.contains("A,pinion,300000,mass_loss,,116.81,"),
        "{written}"
    );
}

/// A title says so as well as a header, in the languages that are read.
#[test]
fn a_title_of_stages_asks_for_per_interval_and_is_obeyed_with_it() {
    let home = home();
    for title in [
        "Pertes par palier",
        "Massenverlust je Stufe [mg]",
        "Perdite per intervallo",
        "Mass loss per stage [mg]",
    ] {
        let table = format!(
            "{title}\nTest;Member;Stage;Cycles;Mass loss [mg]\nA;pinion;1;200000;12.4\nA;pinion;2;400000;18.1\n"
        );
        let message = refused(&home, &table, "--sigma 1");
        assert!(
            message.contains("say --per-interval mass_loss"),
            "{title}: {message}"
        );
        let (_, written) = rows(&home, &table, "--sigma 1 --per-interval mass_loss");
        assert!(
            written.contains("A,pinion,400000,mass_loss,,30.5,"),
            "{title}: {written}"
        );
    }
}
