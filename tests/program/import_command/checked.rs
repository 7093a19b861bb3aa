//! What `check` says of tables that were imported, and of measurements that cannot be meant so.

use super::*;

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
        said.contains("% of the misfit beyond noise of the fit tests is that of")
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
        said.contains("times less wear than their masses"),
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

/// A formula that is 0 leaves nothing that a sign, a unit or a zero could be told by.
#[test]
fn a_check_of_a_study_without_wear_says_so() {
    let home = home();
    fs::write(
        home.path().join("m.csv"),
        "test,member,cycles,quantity,position,value,sigma\nA,pinion,500000,wear_depth,26,5,0.1\nA,pinion,500000,wear_depth,27,2,0.1\n\
         A,pinion,500000,wear_depth,28,4,0.1\nA,pinion,1000000,mass_loss,,40,1\n",
    )
    .unwrap();
    let with = |factor: &str| {
        let formula = format!(
            "[[effect]]\nkind = \"formula\"\nname = \"none\"\nwear_factor = \"{factor}\"\n"
        );
        fs::write(home.path().join("study.toml"), STUDY.to_owned() + &formula).unwrap();
        succeed(&home, "check study.toml")
    };
    let told = with("0");
    assert!(
        told.contains("check first: no wear comes of this study at any measured row")
            && !told.contains("look right"),
        "{told}"
    );
    assert!(!with("1").contains("no wear comes"));
}
