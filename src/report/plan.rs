//! A plan for people and for tables: the terminal, the page, `plan.csv`.

use std::fmt::Write as _;
use std::path::Path;

use super::html::{Cell, Page, Section, Table};
use crate::learn::diagnose::{
    Campaign, ENOUGH, NextTest, NextTests, Plan, RankedTest, SETTLES, made_up_chi2,
};
use crate::numeric::written::{count, plain, probability, significant};

/// Rows of the table shown on the terminal.
const SHOWN: usize = 12;
/// The same where more tests than these separate more than enough.
const MORE_THAN_ENOUGH: usize = 4;
/// The table of tests, and for a campaign every effect.
pub fn summary(title: &str, plan: &Plan, study: &str, folder: &Path) -> String {
    let mut text = String::new();
    if !title.is_empty() {
        let _ = writeln!(text, "{title}\n");
    }
    let _ = writeln!(text, "{}\n", sentence(plan));
    match plan {
        Plan::NextTests(next) => {
            let _ = writeln!(text, "to separate: {}\n", separated(next, study));
            let warmth = with_temperature(next.tests.iter().map(|row| &row.test));
            heading(&mut text, warmth, "measure", ["χ² mean", "χ² least"]);
            let is_enough = |row: &&RankedTest| least(row) >= ENOUGH;
            let enough = next.tests.iter().filter(is_enough).count();
            let shown = if enough > MORE_THAN_ENOUGH {
                MORE_THAN_ENOUGH
            } else {
                SHOWN
            };
            for row in next.tests.iter().take(shown) {
                let figures = [row.expected_chi2, least(row)].map(|chi2| capped(chi2, 4));
                line(&mut text, warmth, &row.test, &row.quantity, figures);
            }
            if next.tests.len() > shown {
                let _ = writeln!(
                    text,
                    "  and {} more in plan.csv, {}",
                    next.tests.len() - shown,
                    match next.tests[shown..].iter().filter(is_enough).count() {
                        0 => "which separate less".to_owned(),
                        more => format!("{more} of which separate as well as these"),
                    }
                );
            }
            let _ = writeln!(
                text,
                "\nχ² least: of the pair hardest to tell apart; χ² mean: of all pairs, by how probable the rival is. Both count up to {ENOUGH}. From {SETTLES} on\n\
                 a test settles it: of these the cheapest stands first (fewer hours on the rig, fewer changes, less to measure), of others\n\
                 that do nearly as well (within a fifth) too. What was measured already, or nearly, is left out."
            );
            let _ = writeln!(
                text,
                "repetition of the best test made already, with all that was measured: χ² mean {}",
                capped(next.repetition_chi2, 3)
            );
        }
        Plan::Campaign(campaign) => {
            let warmth = with_temperature(campaign.tests.iter().map(|test| &test.test));
            heading(
                &mut text,
                warmth,
                "newly told apart",
                ["shown", "told apart"],
            );
            for test in &campaign.tests {
                let figures = [test.detectable, test.told_apart].map(|n| n.to_string());
                line(&mut text, warmth, &test.test, &newly(&test.newly), figures);
            }
            for (number, test) in campaign.tests.iter().enumerate() {
                let _ = writeln!(text, "  test {}: {}", number + 1, test.adds);
            }
            let _ = writeln!(
                text,
                "\n  {:<26} {:>12} {:>12}  nearest look-alike",
                "effect", "χ² shown", "χ² apart"
            );
            for effect in &campaign.effects {
                let _ = writeln!(
                    text,
                    "  {:<26} {:>12} {:>12}  {}",
                    effect.effect,
                    made_up_chi2(effect.detection_chi2, 4),
                    made_up_chi2(effect.nearest_chi2, 4),
                    effect.nearest
                );
            }
            for (what, count) in &campaign.told_apart_with {
                let _ = writeln!(text, "\nwith {what}: {count} told apart");
            }
            for name in &campaign.not_judged {
                let needs = name.needs.join(", ");
                let _ = writeln!(text, "not judged: {} needs {needs}", name.effect);
            }
        }
    }
    let _ = writeln!(
        text,
        "\npage:    {}\nfigures: {} and plan.csv",
        folder.join("report.html").display(),
        folder.join("plan.json").display()
    );
    text
}

/// What is to be separated, and where that comes from; `study` is how commands name the study file.
fn separated(next: &NextTests, study: &str) -> String {
    let leaders = next.leaders.iter().map(|leader| {
        let form = match leader.form.as_str() {
            "" => String::new(),
            form => format!(", {form}"),
        };
        match leader.probability {
            Some(p) => format!("{} ({}{form})", leader.effect, probability(p)),
            None if form.is_empty() => leader.effect.clone(),
            None => format!("{} ({})", leader.effect, leader.form),
        }
    });
    let leaders: Vec<String> = leaders.collect();
    let basis = next.basis.replace("STUDY", study);
    format!("{}: {basis}", leaders.join(", "))
}

/// The same as a page, the whole table with reasons.
pub fn page(title: &str, plan: &Plan, study: &str) -> Page {
    let sections = match plan {
        Plan::NextTests(next) => next_tests(next, study),
        Plan::Campaign(campaign) => of_campaign(campaign),
    };
    Page {
        title: if title.is_empty() {
            "Plan".to_owned()
        } else {
            format!("Plan: {title}")
        },
        conclusion: sentence(plan).to_owned(),
        sections,
        ..Page::default()
    }
}

/// `plan.csv`: every feasible test.
///
/// Columns `rank,torque,speed,misalignment,cycles,reversed,quantity,changes,expected_chi2,least_chi2,why` after measurements,
/// `chosen,torque,speed,misalignment,cycles,reversed,changes,detectable,told_apart` for a campaign: N·m, rpm, mm, revolutions. Both end with
/// `bulk_temperature`, °C, empty where the study states none, and `hours`, on the rig.
pub fn csv(plan: &Plan) -> String {
    let mut text = String::new();
    let warmth = |t: &NextTest| t.bulk_temperature.map_or(String::new(), |c| c.to_string());
    let conditions = |t: &NextTest| {
        format!(
            "{},{},{},{},{}",
            t.torque, t.speed, t.misalignment, t.cycles, t.reversed
        )
    };
    match plan {
        Plan::NextTests(next) => {
            text.push_str("rank,torque,speed,misalignment,cycles,reversed,quantity,changes,expected_chi2,least_chi2,why,bulk_temperature,hours\n");
            for (i, row) in next.tests.iter().enumerate() {
                let _ = writeln!(
                    text,
                    "{},{},{},{},{},{},\"{}\",{},{:.2}",
                    i + 1,
                    conditions(&row.test),
                    row.quantity,
                    row.changes,
                    row.expected_chi2,
                    least(row),
                    row.why.replace('"', "\"\""),
                    warmth(&row.test),
                    row.test.hours()
                );
            }
        }
        Plan::Campaign(campaign) => {
            text.push_str(
                "chosen,torque,speed,misalignment,cycles,reversed,changes,detectable,told_apart,bulk_temperature,hours\n",
            );
            for test in &campaign.alone {
                let _ = writeln!(
                    text,
                    "{},{},{},{},{},{},{:.2}",
                    test.chosen.map_or(String::new(), |c| c.to_string()),
                    conditions(&test.test),
                    test.changes,
                    test.detectable,
                    test.told_apart,
                    warmth(&test.test),
                    test.test.hours()
                );
            }
        }
    }
    text
}

fn sentence(plan: &Plan) -> &str {
    match plan {
        Plan::NextTests(next) => &next.sentence,
        Plan::Campaign(campaign) => &campaign.sentence,
    }
}

/// A figure of the table; what is enough for certain is a bound, for the mean counts no pair higher.
fn capped(chi2: f64, digits: usize) -> String {
    if chi2 >= ENOUGH {
        format!("≥ {ENOUGH}")
    } else {
        significant(chi2, digits)
    }
}

/// Whether tests are at several temperatures, so that a column of them says something.
fn with_temperature<'t>(tests: impl Iterator<Item = &'t NextTest>) -> bool {
    let mut known = tests.map(|test| test.bulk_temperature);
    let first = known.next();
    known.any(|celsius| Some(celsius) != first)
}

fn least(row: &RankedTest) -> f64 {
    let all = row.separates.iter().map(|s| s.chi2);
    all.reduce(f64::min).unwrap_or(0.0)
}

fn newly(names: &[String]) -> String {
    match names.len() {
        0 => "none".to_owned(),
        1 | 2 => names.join(", "),
        more => format!("{} and {} more", names[0], more - 1),
    }
}

/// A figure of a condition: six digits at most, so that columns stay apart.
fn short(value: f64) -> String {
    plain(value).replace('\u{202f}', "")
}

/// Hours of a column: three digits, without the blank of thousands.
fn in_table(hours: f64) -> String {
    significant(hours, 3).replace('\u{202f}', "")
}

/// The header of a table of tests; with a column of temperatures where `warmth` says so.
fn heading(text: &mut String, warmth: bool, what: &str, figures: [&str; 2]) {
    let celsius = if warmth {
        format!("{:>7}", "°C")
    } else {
        String::new()
    };
    let _ = writeln!(
        text,
        "  {:>8} {:>8} {:>6}{celsius} {:>9} {:>6} {:>8}  {:<38} {:>12} {:>12}",
        "N·m", "rpm", "mm", "cycles", "hours", "reversed", what, figures[0], figures[1]
    );
}

fn line(text: &mut String, warmth: bool, test: &NextTest, what: &str, figures: [String; 2]) {
    let celsius = test.bulk_temperature.map_or(String::new(), short);
    let celsius = if warmth {
        format!("{celsius:>7}")
    } else {
        String::new()
    };
    let _ = writeln!(
        text,
        "  {:>8} {:>8} {:>6}{celsius} {:>9.2e} {:>6} {:>8}  {:<38} {:>12} {:>12}",
        short(test.torque),
        short(test.speed),
        short(test.misalignment),
        test.cycles,
        in_table(test.hours()),
        if test.reversed { "yes" } else { "" },
        what,
        figures[0],
        figures[1]
    );
}

fn conditions(test: &NextTest) -> Vec<Cell> {
    vec![
        Cell::number(plain(test.torque)),
        Cell::number(plain(test.speed)),
        Cell::number(plain(test.misalignment)),
        Cell::number(test.bulk_temperature.map_or("–".to_owned(), plain)),
        Cell::number(count(test.cycles)),
        Cell::number(significant(test.hours(), 3)),
        Cell::text(if test.reversed { "yes" } else { "" }),
    ]
}

fn next_tests(next: &NextTests, study: &str) -> Vec<Section> {
    let head = [
        "torque, N·m",
        "speed, rpm",
        "misalignment, mm",
        "temperature, °C",
        "cycles",
        "hours",
        "reversed",
        "measure",
        "χ² mean",
        "χ² least",
    ];
    let mut table = Table::new("Feasible tests, best first", head);
    for row in &next.tests {
        let mut cells = conditions(&row.test);
        cells.extend([
            Cell::text(row.quantity.clone()),
            Cell::number(capped(row.expected_chi2, 3)),
            Cell::number(capped(least(row), 3)),
        ]);
        table = table.row(cells).row([Cell::Remark(row.why.clone())]);
    }
    vec![
        Section::new("What is to be separated").paragraph(separated(next, study)),
        Section::new("Feasible tests")
            .paragraph(format!("Expected difference of χ² between the first candidate and the others after refitting, by the analytic model. Figures count up to {ENOUGH}; mean: by how probable the rivals are. From {SETTLES} on a test settles it: of these the cheapest stands first (fewer hours on the rig, fewer changes, less to measure), among other near-equals (within a fifth) too. What was measured already, or nearly, is left out."))
            .table(table),
    ]
}

fn of_campaign(campaign: &Campaign) -> Vec<Section> {
    let head = [
        "torque, N·m",
        "speed, rpm",
        "misalignment, mm",
        "temperature, °C",
        "cycles",
        "hours",
        "reversed",
        "shown",
        "told apart",
        "newly told apart",
    ];
    let mut chosen = Table::new("Chosen tests, each with those before", head);
    for test in &campaign.tests {
        let mut cells = conditions(&test.test);
        cells.extend([
            Cell::number(test.detectable.to_string()),
            Cell::number(test.told_apart.to_string()),
            Cell::text(test.newly.join(", ")),
        ]);
        let why = format!("{}; {}", test.why, test.adds);
        chosen = chosen.row(cells).row([Cell::Remark(why)]);
    }
    let head = ["effect", "χ² shown", "χ² apart", "nearest look-alike"];
    let mut effects = Table::new("Effects at their median strength", head);
    for effect in &campaign.effects {
        effects = effects.row([
            Cell::text(effect.effect.clone()),
            Cell::number(made_up_chi2(effect.detection_chi2, 3)),
            Cell::number(made_up_chi2(effect.nearest_chi2, 3)),
            Cell::text(effect.nearest.clone()),
        ]);
    }
    vec![
        Section::new("Tests").table(chosen),
        Section::new("Effects")
            .paragraph("χ² of 6 counts as shown and as told apart. Every rival is refitted: k, k per test, datums, its parameters and strength.")
            .table(effects),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::diagnose::Separated;

    fn row(expected_chi2: f64, chi2: f64, why: &str) -> RankedTest {
        RankedTest {
            test: NextTest {
                torque: 50.0,
                speed: 2000.0,
                misalignment: 0.0,
                cycles: 1e6,
                reversed: false,
                bulk_temperature: None,
            },
            quantity: "wear_depth".to_owned(),
            changes: 1,
            expected_chi2,
            separates: vec![Separated {
                pair: ["a".to_owned(), "b".to_owned()],
                chi2,
            }],
            why: why.to_owned(),
        }
    }

    /// Mean and least are cut off alike at what is enough, so that the least never stands above the mean.
    #[test]
    fn what_is_enough_is_a_bound() {
        assert_eq!(capped(88.9, 3), "≥ 60");
        assert_eq!(capped(60.0, 3), "≥ 60");
        assert_eq!(capped(43.6, 3), "43.6");
        let plan = Plan::NextTests(NextTests {
            tests: vec![row(60.0, 99.89, "")],
            ..next()
        });
        let text = summary("", &plan, "s.toml", Path::new("out"));
        assert!(text.contains("≥ 60 ") && !text.contains("99.89"), "{text}");
        // a million revolutions at 2000 rpm
        assert!(text.contains("1.00e6   8.33 "), "{text}");
    }

    #[test]
    fn a_few_of_the_tests_that_are_more_than_enough_are_listed() {
        let text = |rows: Vec<RankedTest>| {
            let plan = Plan::NextTests(NextTests {
                tests: rows,
                ..next()
            });
            summary("", &plan, "s.toml", Path::new("out"))
        };
        let enough = text((0..9).map(|_| row(60.0, 70.0, "")).collect());
        assert_eq!(enough.matches("wear_depth").count(), 4, "{enough}");
        let more = "and 5 more in plan.csv, 5 of which separate as well as these";
        assert!(enough.contains(more), "{enough}");
        let few = text(
            (0..14)
                .map(|i| row(30.0, 30.0 - f64::from(i), ""))
                .collect(),
        );
        assert_eq!(few.matches("wear_depth").count(), 12, "{few}");
        assert!(
            few.contains("and 2 more in plan.csv, which separate less"),
            "{few}"
        );
    }

    fn next() -> NextTests {
        NextTests {
            sentence: "Next.".to_owned(),
            basis: "the leaders of STUDY".to_owned(),
            diagnosed: false,
            leaders: Vec::new(),
            noise: 0.02,
            repetition_chi2: 1.0,
            tests: Vec::new(),
        }
    }

    #[test]
    fn the_table_has_a_row_per_test_and_quotes_reasons() {
        let row = row(12.0, 9.0, "say \"so\", plainly");
        let plan = Plan::NextTests(NextTests {
            tests: vec![row],
            ..next()
        });
        let table = csv(&plan);
        assert_eq!(table.lines().count(), 2);
        assert!(table.ends_with(
            "1,50,2000,0,1000000,false,wear_depth,1,12,9,\"say \"\"so\"\", plainly\",,8.33\n"
        ));
        assert!(summary("", &plan, "s.toml", Path::new("out")).contains("wear_depth"));
        // the reason stands below its test, across the ten columns
        let page = page("", &plan, "s.toml").html().unwrap();
        let reason = "<td class=\"remark\" colspan=\"10\">say ";
        assert_eq!(page.matches(reason).count(), 1, "{page}");
    }
}
