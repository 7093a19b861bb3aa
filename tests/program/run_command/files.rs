//! Tolerances: 1e-9 for what equilibrium fixes (solved to about 1e-15, summed over 30 nodes), exact for what is copied from one
//! file to another, 1e-6 where a figure is worked out again from tables by another quadrature than the program's own.
use std::f64::consts::PI;

use serde_json::Value;

use super::home::{FEM, Home, STUDY, number};

/// The same digits; these tests' JSON reader may be off by one in the last place.
fn assert_same(in_json: f64, in_table: f64) {
    let off = (in_json - in_table).abs();
    assert!(
        off <= f64::EPSILON * in_table.abs(),
        "{in_json}, {in_table}"
    );
}

#[test]
fn summary_holds_every_promised_key() {
    let summary = FEM.result("run").summary();
    let promised = [
        (
            "geometry",
            "working_pressure_angle contact_ratio path_of_contact base_pitch backlash_um speed_ratio",
        ),
        ("mesh", "nodes elements dof min_angle flank_spacing"),
        (
            "contact",
            "peak_pressure te_peak_to_peak_urad single_pair_stiffness corner_pressure",
        ),
        (
            "wear/pinion",
            "max_depth_um max_depth_radius worn_area_mm2 mass_loss_mg",
        ),
        (
            "wear/gear",
            "max_depth_um max_depth_radius worn_area_mm2 mass_loss_mg",
        ),
        ("wear", "balance_error"),
        (
            "cost",
            "seconds factorisations contact_solves wear_steps peak_memory_mb threads",
        ),
    ];
    for (section, keys) in promised {
        for key in keys.split(' ') {
            let value = summary.pointer(&format!("/{section}/{key}"));
            assert!(
                value.is_some_and(Value::is_number),
                "{section}/{key} is {value:?}"
            );
        }
    }
    for check in summary["checks"].as_array().unwrap() {
        assert_eq!(check["passed"], true, "{check}");
    }
    assert!(number(&summary, "/wear/balance_error") < 5e-3);
    assert_eq!(number(&summary, "/cost/threads"), 1.0);
}

/// z, m, α, a fix these by the textbook formulas of an involute pair (ISO 21771).
#[test]
fn geometry_is_that_of_the_pair() {
    let summary = FEM.result("run").summary();
    let (alpha, module) = (20f64.to_radians(), 2.0);
    let [z1, z2] = [27.0, 53.0];
    let radii = |z: f64| (0.5 * module * z * alpha.cos(), 0.5 * module * z + module);
    let approach = |z: f64| {
        let (base, tip) = radii(z);
        (tip * tip - base * base).sqrt()
    };
    let base_pitch = PI * module * alpha.cos();
    let path = approach(z1) + approach(z2) - 80.0 * alpha.sin();
    let expected = [
        ("base_pitch", base_pitch),
        ("path_of_contact", path),
        ("contact_ratio", path / base_pitch),
        ("working_pressure_angle", 20.0),
        ("speed_ratio", z2 / z1),
    ];
    for (key, value) in expected {
        let found = number(&summary, &format!("/geometry/{key}"));
        assert!(
            (found / value - 1.0).abs() < 1e-12,
            "{key}: {found}, {value}"
        );
    }
}

#[test]
fn wear_table_holds_every_state_and_adds_up_to_the_summary() {
    let result = FEM.result("run");
    let table = result.table("wear.csv");
    assert_eq!(table.header.join(","), "cycles,member,radius,path,depth");
    assert_eq!(table.distinct("cycles"), ["0", "25000", "50000"]);
    let summary = result.summary();
    let (teeth, base) = (
        [27.0, 53.0],
        [27.0, 53.0].map(|z| z * 20f64.to_radians().cos()),
    );
    for (side, member) in ["pinion", "gear"].into_iter().enumerate() {
        let of = |cycles: &str| table.only("member", member).only("cycles", cycles);
        let (new, middle, worn) = (of("0"), of("25000"), of("50000"));
        assert!(new.numbers("depth").iter().all(|h| *h == 0.0));
        let (earlier, later) = (middle.numbers("depth"), worn.numbers("depth"));
        assert!(earlier.iter().zip(&later).all(|(a, b)| 0.0 <= *a && a <= b));
        let radius = worn.numbers("radius");
        assert!(radius.windows(2).all(|r| r[0] < r[1]));
        let deepest = later.iter().copied().fold(0.0, f64::max);
        let figure = |key: &str| number(&summary, &format!("/wear/{member}/{key}"));
        assert_same(figure("max_depth_um"), deepest);
        let at = later.iter().position(|h| *h == deepest).unwrap();
        assert_same(figure("max_depth_radius"), radius[at]);
        // ∫ h ds with s = (r² − r_b²)/(2 r_b), the arc length of an involute, by the trapezoidal rule
        let arc: Vec<f64> = radius
            .iter()
            .map(|r| (r * r - base[side] * base[side]) / (2.0 * base[side]))
            .collect();
        let area: f64 = (1..arc.len())
            .map(|i| 0.5e-3 * (arc[i] - arc[i - 1]) * (later[i] + later[i - 1]))
            .sum();
        let found = figure("worn_area_mm2");
        assert!(
            (area / found - 1.0).abs() < 1e-6,
            "{member}: {area}, {found}"
        );
        let mass = found * 33.0 * teeth[side] * 7850e-9 * 1e6;
        let lost = figure("mass_loss_mg");
        assert!(
            (mass / lost - 1.0).abs() < 1e-12,
            "{member}: {mass}, {lost}"
        );
    }
}

#[test]
fn contact_table_is_in_equilibrium() {
    let result = FEM.result("run");
    let table = result.table("contact.csv");
    assert_eq!(
        table.header[..8].join(","),
        "cycles,position,pair,path,load_share,line_load,peak_pressure,half_width"
    );
    assert_eq!(table.distinct("cycles"), ["0", "25000", "50000"]);
    assert_eq!(table.distinct("position").len(), 30);
    let base_pitch = number(&result.summary(), "/geometry/base_pitch");
    // torque per width over base radius, N/mm; the levers of single pressures differ from the base radius off the line of action
    let load = new_load();
    for cycles in ["0", "25000", "50000"] {
        for position in table.distinct("position") {
            let rows = table.only("cycles", cycles).only("position", position);
            let sum: f64 = rows.numbers("load_share").iter().sum();
            assert!(
                (sum - 1.0).abs() < 1e-9,
                "{cycles}, {position}: shares {sum}"
            );
            let forces: f64 = rows.numbers("line_load").iter().sum();
            assert!(
                (forces / load - 1.0).abs() < 1e-2,
                "{cycles}, {position}: {forces} N/mm"
            );
            let nominal: Vec<f64> = rows
                .numbers("pair")
                .iter()
                .map(|j| (position.parse::<f64>().unwrap() + j) * base_pitch)
                .collect();
            for (path, nominal) in rows.numbers("path").iter().zip(nominal) {
                assert!((path - nominal).abs() < 1e-9);
            }
        }
    }
    for column in ["load_share", "line_load", "peak_pressure", "half_width"] {
        assert!(table.numbers(column).iter().all(|v| *v >= 0.0), "{column}");
    }
}

/// Normal load per width of 100 N m on 33 mm, N/mm.
fn new_load() -> f64 {
    100e3 / (27.0 * 20f64.to_radians().cos() * 33.0)
}

#[test]
fn flanks_and_tip_corners_are_told_apart() {
    let result = FEM.result("run");
    let (summary, table) = (result.summary(), result.table("contact.csv"));
    let new = table.only("cycles", "0");
    let largest = |corner: &str| {
        let rows = new.only("at_corner", corner);
        rows.numbers("peak_pressure")
            .into_iter()
            .fold(0.0, f64::max)
    };
    assert_same(number(&summary, "/contact/peak_pressure"), largest("0"));
    assert_same(number(&summary, "/contact/corner_pressure"), largest("1"));
    // deflected teeth meet a little outside the path of contact: corners touch there, and nowhere in the middle
    let limits = &summary["geometry"]["path_limits"];
    let (start, end) = (limits[0].as_f64().unwrap(), limits[3].as_f64().unwrap());
    for (path, off) in new
        .numbers("path")
        .into_iter()
        .zip(new.texts("off_line_of_action"))
    {
        assert_eq!(off == "1", path < start || path > end, "{path}");
    }
    let corners = new.only("at_corner", "1").only("off_line_of_action", "0");
    for path in corners.numbers("path") {
        assert!((path - start).min(end - path) < 0.25, "a corner at {path}");
    }
    // as a mean over 0.02 modules still above Hertz's pressure of a single pair at the pitch point, sqrt(F E*/(π R)) with the curvature radii of both flanks
    // there; the grid's own peaks on the flanks, two linear edges per half width, are too high by half to compare with
    let sine = 20f64.to_radians().sin();
    let radius = 1.0 / (1.0 / (27.0 * sine) + 1.0 / (53.0 * sine));
    let modulus = 2.1e5 / (2.0 * (1.0 - 0.09));
    let hertz = (new_load() * modulus / (PI * radius)).sqrt();
    assert!(
        largest("1") > hertz,
        "{} MPa, Hertz {hertz} MPa",
        largest("1")
    );
}

#[test]
fn transmission_error_is_a_positive_lag() {
    let result = FEM.result("run");
    let table = result.table("transmission_error.csv");
    assert_eq!(table.header.join(","), "cycles,position,angle");
    assert_eq!(table.len(), 3 * 30);
    assert!(table.numbers("angle").iter().all(|a| *a > 0.0));
    let new = table.only("cycles", "0").numbers("angle");
    let span = |of: &[f64]| {
        of.iter().copied().fold(f64::MIN, f64::max) - of.iter().copied().fold(f64::MAX, f64::min)
    };
    let found = number(&result.summary(), "/contact/te_peak_to_peak_urad");
    assert!((found - span(&new)).abs() < 1e-9);
    // worn flanks let the gear lag by the depth at the contact over the base radius: at most the sum of both depths
    let worn = table.only("cycles", "50000").numbers("angle");
    let depth = number(&result.summary(), "/wear/pinion/max_depth_um")
        + number(&result.summary(), "/wear/gear/max_depth_um");
    let most = 1e3 * depth / (27.0 * 20f64.to_radians().cos());
    let more: f64 = (0..30).map(|q| worn[q] - new[q]).sum::<f64>() / 30.0;
    assert!(more > 0.0 && more < most, "{more} µrad, at most {most}");
}

#[test]
fn report_is_one_file_and_names_only_files_that_exist() {
    let result = FEM.result("run");
    let page = result.text("report.html");
    for outside in ["<script src", "<link", "@import", "url("] {
        assert!(!page.contains(outside), "{outside}");
    }
    for image in page.split(" src=\"").skip(1) {
        assert!(image.starts_with("data:image/png;base64,"));
    }
    for (at, _) in page.match_indices("http") {
        let address = page[at..].split(['"', ' ']).next().unwrap();
        let known = [
            "http://www.w3.org/2000/svg",
            "https://github.com/leeoniya/uPlot",
        ];
        assert!(known.contains(&address), "{address}");
    }
    // ten plots, the pair twice, two worn teeth
    assert_eq!(page.matches("<svg").count(), 14, "every picture of a run");
    let links: Vec<&str> = page
        .split("href=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap())
        .filter(|link| !link.starts_with('#'))
        .collect();
    assert!(links.contains(&"wear.csv") && links.contains(&"study.toml"));
    for link in links {
        assert!(result.0.join(link).is_file(), "{link}");
    }
}

/// Each stored position has its picture; in the close-up (right panel of 560 pixels) both teeth are seen, and stress is highest in
/// the middle: viridis' green grows with the stress.
#[test]
fn stresses_are_pictures_with_a_close_up_of_the_contact() {
    let files = FEM.result("run").files();
    let named = |end: &str| -> Vec<&str> {
        let of = |name: &&String| name.starts_with("plots/stress_") && name.ends_with(end);
        files.keys().filter(of).map(String::as_str).collect()
    };
    assert_eq!(
        named(".svg"),
        ["plots/stress_1.svg", "plots/stress_new.svg"]
    );
    for name in named(".png") {
        let decoder = png::Decoder::new(std::io::Cursor::new(&files[name]));
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        let step = info.color_type.samples();
        let (width, corner, side) = (info.width as usize, [912, 44], 560);
        let greens = |margin: usize| -> Vec<f64> {
            let inside = margin..side - margin;
            (inside
                .clone()
                .flat_map(|row| inside.clone().map(move |column| [row, column])))
            .map(|[row, column]| step * ((corner[1] + row) * width + corner[0] + column))
            .filter(|at| bytes[*at..at + 3] != [255; 3])
            .map(|at| f64::from(bytes[at + 1]))
            .collect()
        };
        let (all, middle) = (greens(4), greens(side / 2 - 40));
        assert!(all.len() > side * side / 2, "{name}: {}", all.len());
        assert!(middle.len() > 80 * 80 * 9 / 10, "{name}: {}", middle.len());
        let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
        assert!(mean(&middle) > 1.3 * mean(&all), "{name}");
    }
}

#[test]
fn the_terminal_gets_the_figures_and_json_the_summary() {
    let home = super::home::Home::with(&[("contact", "\"hertz\"")]);
    let answer = home.succeed("run study.toml");
    for part in [
        "pinion wear",
        "peak pressure",
        "report.html",
        "Next: gearwear models ",
        "study.toml shows what",
    ] {
        assert!(answer.out.contains(part), "{part}: {}", answer.out);
    }
    assert!(home.path("study.out/run/summary.json").is_file());
    let answer = home.succeed("run study.toml --json --quiet");
    let mut printed: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(answer.err, "");
    let mut written = home.result("study.out/run").summary();
    for document in [&mut printed, &mut written] {
        document.as_object_mut().unwrap().remove("cost");
    }
    assert_eq!(printed, written);
}

/// Linear elements are said to be rough, quadratic ones not.
#[test]
fn linear_elements_come_with_a_note() {
    for (order, said) in [("order = 1", true), ("order = 2", false)] {
        let home = Home::with(&[]);
        home.write("study.toml", &STUDY.replace("order = 1", order));
        let answer = home.succeed("run study.toml -o out");
        assert_eq!(
            answer.out.contains("note: linear elements"),
            said,
            "{}",
            answer.out
        );
        // two edges were asked for: the pressures are rough for that too
        assert!(
            answer
                .out
                .contains("note: 2.0 flank edges on Hertz's half width are few"),
            "{}",
            answer.out
        );
    }
}
