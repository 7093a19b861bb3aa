//! Layouts of wide tables beyond a column for each checkpoint: several tables side by side, values with their standard deviations, statistics.

use super::*;

#[test]
fn tables_side_by_side_are_read_one_after_the_other() {
    let home = home();
    let table = "Run A\nRitzel;;;;Rad\nradius [mm];100000;250000;;radius [mm];100000;250000\n\
                 26;3.1;6.2;;52.5;1.1;2.2\n27;1.2;2.5;;53.5;0.4;0.9\n28;1.4;2.7\n";
    let (shown, written) = rows(&home, table, "--sigma 0.1");
    assert!(
        shown.contains("table.csv, columns A to C\n")
            && shown.contains("columns E to G, counted from A"),
        "{shown}"
    );
    assert_eq!(written.lines().count(), 10, "{written}");
    assert!(
        written.contains("A,pinion,250000,wear_depth,28,2.7,0.1,")
            && written.contains("A,gear,100000,wear_depth,52.5,1.1,0.1,"),
        "{written}"
    );
    let tests = "Pinion\nRun A;;;Run B\nradius [mm];100000;;radius [mm];250000\n26;3.1;;26;6.2\n27;1.2;;27;2.5\n";
    let (_, written) = rows(&home, tests, "--sigma 0.1");
    assert!(
        written.contains("A,pinion,100000,wear_depth,27,1.2,")
            && written.contains("B,pinion,250000,wear_depth,26,6.2,"),
        "{written}"
    );
}

#[test]
fn standard_deviations_stand_behind_a_sign_or_beside_each_value() {
    let home = home();
    let options = "--member pinion --test A";
    let wide = "depth [um]\nradius [mm];100000;250000\n26;3,1 \u{b1} 0,2;6,2 \u{b1} 0,3\n27;1,2 \u{b1} 0,2;2,5\n28;1,3;2,6\n";
    let (shown, written) = rows(&home, wide, options);
    assert!(
        shown.contains("B3: `3,1 \u{b1} 0,2`, behind the sign: one standard deviation, in \u{b5}m"),
        "{shown}"
    );
    assert!(
        written.contains("A,pinion,250000,wear_depth,26,6.2,0.3,")
            && written.contains("A,pinion,250000,wear_depth,27,2.5,,"),
        "{written}"
    );
    let beside = "depth [mm]\nradius [mm];100000;\u{b1};250000;\u{b1}\n26;0.0031;0.0002;0.0062;0.0003\n27;0.0012;0.0002;0.0025;0.0003\n";
    let (_, written) = rows(&home, beside, options);
    assert!(
        written.contains("A,pinion,250000,wear_depth,26,6.2,0.3,"),
        "{written}"
    );
    // two standard deviations, in a unit of their own
    let expanded = beside
        .replace('\u{b1}', "U (k=2) [um]")
        .replace("0.0003", "0.6");
    let (shown, written) = rows(&home, &expanded, options);
    assert!(
        shown.contains("over k = 2") && written.contains(",26,6.2,0.3,"),
        "{shown}{written}"
    );
    let message = refused(&home, beside, &format!("{options} --sigma 0.1"));
    assert!(message.contains("C2: `\u{b1}`"), "{message}");
    let long = "cycles;radius [mm];depth [um]\n100000;26;3,1 +/- 0,2\n100000;27;1,2 +/- 0,2\n";
    let (_, written) = rows(&home, long, options);
    assert!(
        written.contains("A,pinion,100000,wear_depth,26,3.1,0.2,"),
        "{written}"
    );
}

#[test]
fn of_a_mean_and_extremes_the_mean_is_read() {
    let home = home();
    let options = "--member pinion --test A --sigma 0.1";
    let table = "radius [mm];100000 min;100000 max;100000 Mittel\n26;3;5;4\n27;1;3;2\n";
    let (shown, written) = rows(&home, table, options);
    assert!(shown.contains("the means are read"), "{shown}");
    assert!(
        written.starts_with("A,pinion,100000,wear_depth,26,4,0.1,"),
        "{written}"
    );
    assert_eq!(written.lines().count(), 2, "{written}");
    let message = refused(&home, &table.replace("Mittel", "median"), options);
    assert!(message.contains("not one mean"), "{message}");
}

#[test]
fn depths_in_millimetres_without_a_unit_say_which_option_reads_them() {
    let home = home();
    let row = |n: u32| {
        let depth = 0.004 + 0.0001 * f64::from(n % 3);
        format!(
            "{:.1};{depth:.4};{:.4}\n",
            26.0 + 0.1 * f64::from(n),
            2.0 * depth
        )
    };
    let table = format!(
        "radius [mm];100000;250000\n{}",
        (0..20).map(row).collect::<String>()
    );
    let message = refused(&home, &table, "--member pinion --test A");
    assert!(
        message.contains("this looks like mm") && message.contains("say it with --unit"),
        "{message}"
    );
}

#[test]
fn a_title_tells_what_was_measured_over_a_rotation() {
    let home = home();
    let table = "Errore di trasmissione [urad]\nRotazione [passi base];100000;250000\n0;105,7;161,9\n0,25;-10,2;-22,1\n0,5;-60,1;-70,3\n";
    let (_, written) = rows(&home, table, "--test A --sigma 0.5");
    assert!(
        written.contains("A,pair,250000,transmission_error,0.25,-22.1,0.5,"),
        "{written}"
    );
    let untitled = table.split_once('\n').unwrap().1;
    let message = refused(&home, untitled, "--test A --sigma 0.5");
    assert!(message.contains("--quantity"), "{message}");
}
