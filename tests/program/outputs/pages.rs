//! Claim: pages stand on their own, carry the figures of the data, and say first what matters; plots are drawn to scale.
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use gearwear::report::html::{self, Case, Verdict};
use gearwear::report::plots::{Plot, Style};
use gearwear::report::{text, write_validation};
use gearwear::simulate::result::FaceSlice;
use serde_json::Value;

use super::{read, synthetic, written};

/// Every address in a page: values of href, src and url(...).
fn addresses(page: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for (opening, end) in [
        ("href=\"", '"'),
        ("src=\"", '"'),
        ("url(", ')'),
        ("@import", ';'),
    ] {
        found.extend(
            page.split(opening)
                .skip(1)
                .map(|rest| rest.split(end).next().unwrap_or_default().to_owned()),
        );
    }
    found
}

#[test]
fn the_report_is_self_contained_and_complete() {
    let (dir, run) = written();
    let page = read(&dir, "report.html");
    for address in addresses(&page) {
        let inside = address.starts_with('#')
            || address.starts_with("data:image/png;base64,")
            || dir.path().join("study.out/run").join(&address).is_file();
        assert!(inside, "{address}");
    }
    let without_namespace = page
        .replace("http://www.w3.org/2000/svg", "")
        .replace("/*! https://github.com/leeoniya/uPlot (v1.6.32) */", "");
    assert!(
        !without_namespace.contains("http")
            && !page.contains("<script src")
            && !page.contains("<link")
    );
    // the scripts ask no one for anything
    for word in [
        "fetch(",
        "XMLHttpRequest",
        "WebSocket",
        "import(",
        "sendBeacon",
    ] {
        assert!(!page.contains(word), "{word}");
    }
    assert!(
        page.contains("Made-up pair &lt;27/53&gt; &amp; &quot;quotes&quot;")
            && !page.contains("<27/53>")
    );
    // wear of both flanks, growth; pressure, share, lag, two of sliding, tip corners; film, losses; stresses
    assert_eq!(page.matches("<figure ").count(), 12);
    for heading in [
        "Results",
        "Wear",
        "Contact over the mesh cycle",
        "Mesh and stress",
        "Inputs",
        "Geometry",
        "Mesh and cost",
        "Checks",
        "Stored states",
        "Files",
    ] {
        assert!(page.contains(&format!("\">{heading}</h2>")), "{heading}");
    }
    assert!(page.contains("prefers-color-scheme: dark") && page.contains("@media print"));
    // The conclusion carries the figures: the depth that the profile holds, to three digits.
    let deepest = run.last().pinion.max_depth();
    let conclusion = page
        .split("class=\"conclusion\">")
        .nth(1)
        .unwrap()
        .split("</p>")
        .next()
        .unwrap();
    assert!(
        conclusion.contains(&format!("{deepest:.2} µm")),
        "{conclusion}"
    );
    let page = page.split("<script").next().unwrap();
    let page = &format!("{page}</body></html>");
    for tag in [
        "table", "tr", "td", "section", "figure", "svg", "p", "div", "text",
    ] {
        let opened =
            page.matches(&format!("<{tag}>")).count() + page.matches(&format!("<{tag} ")).count();
        assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "{tag}");
    }
    // A failed check is said at the top.
    let mut failed = run;
    failed.checks[0].value = 1.0;
    let page = html::run(&failed, None).unwrap().html().unwrap();
    let conclusion = page
        .split("class=\"conclusion\">")
        .nth(1)
        .unwrap()
        .split("</p>")
        .next()
        .unwrap();
    assert!(conclusion.contains("1 check") && page.contains("badge fail"));
}

#[test]
fn plots_draw_the_numbers() {
    // A straight line stays one: three points on it, to two units of rounding each (an eighth of a pixel).
    let plot = Plot::new("line", "A <line>", "x, mm", "y, µm").starting_at_zero();
    let svg = plot
        .curve(
            "here",
            Style::Kind(0),
            vec![(0.0, 0.0), (1.0, 10.0), (3.0, 30.0)],
        )
        .svg()
        .unwrap();
    let line = svg
        .split("<polyline")
        .filter(|part| part.contains("#0072B2"))
        .find_map(|part| {
            let points = part.split("points=\"").nth(1)?.split('"').next()?;
            let points: Vec<(f64, f64)> = points
                .split_whitespace()
                .map(|p| {
                    p.split_once(',')
                        .map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()))
                        .unwrap()
                })
                .collect();
            (points.len() == 3).then_some(points)
        });
    let line = line.unwrap_or_else(|| panic!("no curve in {svg}"));
    let [(x0, y0), (x1, y1), (x2, y2)] = [line[0], line[1], line[2]];
    assert!(
        ((x2 - x0) - 3.0 * (x1 - x0)).abs() <= 4.0 && ((y2 - y0) - 3.0 * (y1 - y0)).abs() <= 4.0,
        "{line:?}"
    );
    assert!(x2 > x0 + 3200.0 && y2 < y0 - 1600.0, "{line:?}");
    for text in ["x, mm", "y, µm", "here", "A &lt;line&gt;", "role=\"img\""] {
        assert!(svg.contains(text), "{text}");
    }
    // Same data, same bytes.
    let run = synthetic::run();
    let draw = || {
        gearwear::report::plots::of_run(&run)
            .iter()
            .map(|plot| plot.svg().unwrap())
            .collect::<Vec<_>>()
    };
    assert_eq!(draw(), draw());
    // Nothing to draw and constant data do no harm.
    let flat = Plot::new("flat", "", "", "").curve(
        "c",
        Style::Points(1),
        vec![(1.0, 5.0), (f64::NAN, 1.0)],
    );
    assert!(flat.svg().is_ok() && Plot::new("none", "", "", "").svg().is_ok());
}

#[test]
fn validation_is_written_for_people_and_programs() {
    let case = |id: &str, group: &str, verdict: Verdict| Case {
        id: id.to_owned(),
        group: group.to_owned(),
        family: id.to_owned(),
        question: format!("Is {id} right?"),
        quantity: "peak pressure, MPa".to_owned(),
        target: Some(3585.37),
        source: "NAFEMS, \"Cylinder\" | roller".to_owned(),
        value: (verdict != Verdict::Skipped).then_some(3590.0),
        error: (verdict != Verdict::Skipped).then_some(0.0013),
        tolerance: Some(0.02),
        measure: "relative".to_owned(),
        verdict,
        reason: String::new(),
        seconds: 1.0,
        note: if verdict == Verdict::Pass {
            String::new()
        } else {
            format!("see {id}")
        },
    };
    let cases = [
        case("B3", "Contact", Verdict::Pass),
        case("C1", "Geometry", Verdict::Fail),
        case("B4", "Contact", Verdict::Skipped),
        case("P9", "Paper", Verdict::ContradictsTheory),
    ];
    let dir = tempfile::tempdir().unwrap();
    let done = write_validation(&cases, &dir.path().join("validate")).unwrap();
    let json: Value =
        serde_json::from_slice(&fs::read(done.folder.join("validation.json")).unwrap()).unwrap();
    let verdicts: Vec<_> = json["cases"]
        .as_array()
        .unwrap()
        .iter()
        .map(|case| case["verdict"].clone())
        .collect();
    assert_eq!(verdicts, ["pass", "fail", "skipped", "contradicts_theory"]);
    for key in [
        "id",
        "target",
        "source",
        "value",
        "error",
        "tolerance",
        "verdict",
    ] {
        assert!(json["cases"][0].get(key).is_some(), "{key}");
    }
    let markdown = fs::read_to_string(done.folder.join("RESULTS.md")).unwrap();
    assert!(markdown.contains("1 of 4 cases pass, 1 fail"), "{markdown}");
    let row = markdown.lines().find(|line| line.contains("cases/B3.md"));
    let row = row.expect("no line for B3");
    assert!(
        row.contains("\\| roller") && row.contains("**pass**") && row.contains("Is B3 right?"),
        "{row}"
    );
    assert!(row.contains("0.13 % of 2.0 %"), "{row}");
    let unmet: Vec<&str> = (markdown.lines())
        .skip_while(|line| !line.contains("Not met"))
        .take_while(|line| !line.contains("## Contact"))
        .collect();
    for (id, word) in [
        ("C1", "fail"),
        ("B4", "skipped"),
        ("P9", "contradicts theory"),
    ] {
        let told = |line: &&str| line.contains(&format!("`{id}`")) && line.contains(word);
        assert!(unmet.iter().any(told), "{id}: {unmet:?}");
    }
    assert!(!unmet.iter().any(|line| line.contains("`B3`")), "{unmet:?}");
    let family = fs::read_to_string(done.folder.join("cases/C1.md")).unwrap();
    assert!(
        family.contains("gearwear validate C1") && family.contains("see C1"),
        "{family}"
    );
    let page = fs::read_to_string(done.folder.join("report.html")).unwrap();
    assert!(
        page.contains("badge pass") && page.contains("badge fail") && page.contains("badge theory")
    );
}

#[test]
fn the_terminal_summary_tells_figures_files_and_next_step() {
    let (dir, run) = written();
    let said = text::summary(
        &run,
        Path::new("my/study.toml"),
        &dir.path().join("study.out/run"),
    );
    let deepest = format!("{:.3} µm", run.last().pinion.max_depth());
    for part in [
        deepest.as_str(),
        "report.html",
        "ParaView",
        "Next: gearwear models my/study.toml shows",
        "100 N·m",
        "50\u{202f}000 pinion revolutions",
    ] {
        assert!(said.contains(part), "{part} not in\n{said}");
    }
    assert!(said.lines().count() < 20 && said.lines().all(|line| line.chars().count() < 160));
}

#[test]
fn many_cases_of_a_kind_are_one_line_that_shows_the_worst_and_hides_no_failure() {
    let case = |number: usize, error: f64| Case {
        id: format!("B1.{number}"),
        group: "Contact".to_owned(),
        family: "B1".to_owned(),
        question: "Is it carried?".to_owned(),
        quantity: format!("mesh {number}: deviation of p"),
        target: Some(0.0),
        source: "exact: uniform pressure".to_owned(),
        value: Some(error),
        error: Some(error),
        tolerance: Some(1e-8),
        measure: "absolute".to_owned(),
        verdict: if error <= 1e-8 {
            Verdict::Pass
        } else {
            Verdict::Fail
        },
        reason: "rounding".to_owned(),
        seconds: 1.0,
        note: String::new(),
    };
    let mut cases: Vec<Case> = (1..=20).map(|n| case(n, 1e-15 * n as f64)).collect();
    cases[6].error = Some(3e-9);
    cases.push(case(21, 2e-8));
    let dir = tempfile::tempdir().unwrap();
    let done = write_validation(&cases, &dir.path().join("validate")).unwrap();
    let page = fs::read_to_string(done.folder.join("cases/B1.md")).unwrap();
    let rows: Vec<&str> = page.lines().filter(|l| l.contains("`B1.")).collect();
    assert_eq!(rows.len(), 2, "{page}");
    assert!(
        rows[0].contains("20 cases") && rows[0].contains("mesh 7") && rows[0].contains("3.0·10⁻⁹"),
        "{}",
        rows[0]
    );
    assert!(
        rows[1].contains("`B1.21`") && rows[1].contains("**fail**"),
        "{}",
        rows[1]
    );
    let summary = fs::read_to_string(done.folder.join("RESULTS.md")).unwrap();
    let row = summary.lines().find(|l| l.contains("cases/B1.md")).unwrap();
    assert!(row.contains("**fail**") && row.contains("| 21 |"), "{row}");
}

/// Of slices the flanks are means over the face: text and page say so, and how deep the worst slice is worn.
#[test]
fn depths_of_slices_are_means_and_the_deepest_slice_is_named() {
    let mut run = synthetic::run();
    for state in &mut run.states {
        let profiles = [&state.pinion, &state.gear];
        let slice = |face: f64, factor: f64| FaceSlice {
            face,
            load: factor,
            peak_pressure: 900.0,
            peak_pressure_elsewhere: 700.0,
            depth: profiles.map(|p| p.depth.iter().map(|d| factor * d).collect()),
            pressure: profiles.map(|p| vec![900.0; p.depth.len()]),
        };
        state.slices = vec![slice(-11.0, 1.6), slice(0.0, 1.0), slice(11.0, 0.4)];
    }
    let deepest = 1.6 * run.last().pinion.max_depth();
    let said = text::summary(&run, Path::new("s.toml"), Path::new("out"));
    // whose transmission error it is, and the pressure away from kinks of each slice
    assert!(said.contains("µrad p-p worn (at the pinion)"), "{said}");
    let document = gearwear::report::json::summary(&run).unwrap();
    let slice = &document["face"]["last"]["slices"][0];
    assert_eq!(
        [&slice["peak_pressure"], &slice["peak_pressure_elsewhere"]],
        [900.0, 700.0]
    );
    let across = format!("up to {deepest:.3} µm at −11 mm from mid-face");
    assert!(said.contains(&across), "{across} not in\n{said}");
    // `models` refuses slices
    assert!(!said.contains("gearwear models"), "{said}");
    let page = html::run(&run, None).unwrap();
    assert!(page.conclusion.contains(&across) && page.conclusion.contains("means over the face"));
}
