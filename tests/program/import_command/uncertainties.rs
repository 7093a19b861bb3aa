//! Standard deviations: stated, expanded, shares, left out.

use super::*;

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

/// Neither is read as it stands, and what they are is said.
#[test]
fn several_sigmas_and_intervals_are_told() {
    let home = home();
    for (header, says) in [
        ("2 sigma [um]", "two standard deviations: call it `U (k=2)`"),
        ("2s", "two standard deviations: call it `U (k=2)`"),
        ("95% CI", "a confidence interval: if it is the half width"),
    ] {
        let table =
            format!("test,member,cycles,radius,depth [um],{header}\nA,pinion,1e5,26,1.5,0.3\n");
        let (shown, written) = rows(&home, &table, "--sigma 0.2");
        assert_eq!(written, "A,pinion,100000,wear_depth,26,1.5,0.2,\n");
        let says = format!("passed over the column `{header}`: {says}");
        assert!(shown.contains(&says), "no `{says}` in:\n{shown}");
    }
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

/// A column of standard deviations beside the checkpoints is that of all values of its row, unless it is a statistic of these.
#[test]
fn a_column_of_standard_deviations_of_a_wide_table_is_read() {
    let home = home();
    let table = |header: &str| {
        format!(
            "Radius [mm];100000;250000;{header}\n26;3,1;6,2;0,15\n26,5;2,4;4,9;0,2\n27;1,2;2,5;\n"
        )
    };
    let options = "--test A --member pinion";
    let (shown, written) = rows(&home, &table("std dev"), options);
    for row in [
        "A,pinion,100000,wear_depth,26,3.1,0.15,",
        "A,pinion,250000,wear_depth,26.5,4.9,0.2,",
        "A,pinion,250000,wear_depth,27,2.5,,",
    ] {
        assert!(written.contains(row), "no `{row}` in:\n{written}");
    }
    for part in [
        "layout   `std dev`: the standard deviation of all values of its row, in µm\n",
        "sigma    as the column says; empty in 2 rows, where it is estimated\n",
    ] {
        assert!(shown.contains(part), "no `{part}` in:\n{shown}");
    }
    assert!(!shown.contains("comment column"), "{shown}");
    let (_, written) = rows(&home, &table("U (k=2) [mm]"), options);
    assert!(written.contains("26,3.1,75,"), "{written}");
    let message = refused(&home, &table("std dev"), &format!("{options} --sigma 0.1"));
    assert!(
        message.contains("the table has a column of sigma, D1: `std dev`")
            && message.contains("leave the option out"),
        "{message}"
    );
    let message = refused(&home, &table("std dev").replace("250000", "sigma"), options);
    assert!(
        message.contains("C1: `sigma` and D1: `std dev` both look like"),
        "{message}"
    );
    // beside a mean it is the scatter of the columns
    let statistics =
        "Radius [mm];100000;250000;Mean;StdDev\n26;3,1;6,2;4,65;2,19\n26,5;2,4;4,9;3,65;1,77\n";
    let (shown, written) = rows(&home, statistics, &format!("{options} --sigma 0.1"));
    assert!(written.contains("26,3.1,0.1,"), "{written}");
    assert!(shown.contains("`Mean`, `StdDev`"), "{shown}");
    // of masses it is that of both members
    let masses =
        "Lastwechsel;Ritzel;Rad;Unsicherheit [mg]\n100000;2,1;1,2;0,3\n250000;4,4;2,6;0,4\n";
    let (_, written) = rows(&home, masses, "--test A --quantity mass_loss");
    assert!(
        written.contains("A,gear,250000,mass_loss,,2.6,0.4,"),
        "{written}"
    );
}

#[test]
fn abbreviated_standard_deviations_are_read() {
    let home = home();
    for name in ["Desv. típica [µm]", "Dev. std. [µm]", "Std.-Abw. [µm]"] {
        let table = format!(
            "Ensayo;Rueda;Vueltas;Radio [mm];Desgaste [µm];{name}\nA;piñón;5000;26,1;1,17;0,12\nA;piñón;5000;26,6;0,86;0,12\n"
        );
        let (_, written) = rows(&home, &table, "");
        assert!(
            written.contains("A,pinion,5000,wear_depth,26.1,1.17,0.12,"),
            "{name}: {written}"
        );
    }
}
