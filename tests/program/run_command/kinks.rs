//! Where a linear tip relief begins the pressure of new flanks has no bound: what the mesh makes of it is told apart from the rest.
//!
//! Tolerances: 5 % between two meshes (3 and 7 edges per Hertz half width) for what converges, more than 15 % for what does not.
use super::home::{Home, STUDY, number};

/// The gears of [`STUDY`] with 30 µm off the last 1.5 mm of both members' tips, by finite elements so fine or analytically.
fn relieved(values: &[(&str, &str)]) -> Home {
    let home = Home::with(values);
    let study = std::fs::read_to_string(home.path("study.toml")).unwrap();
    let relief = "tip_relief_amount = 30.0\ntip_relief_length = 1.5\nteeth = ";
    assert_eq!(STUDY.matches("teeth = ").count(), 2);
    home.write("study.toml", &study.replace("teeth = ", relief));
    home
}

/// New flanks; positions so near to each other that the kink lies under the middle of a contact in some.
const NEW: [(&str, &str); 5] = [
    ("cycles", "1"),
    ("fields", "0"),
    ("order", "2"),
    ("elements_per_half_width", "4"),
    ("positions", "60"),
];

#[test]
fn the_peak_at_the_start_of_a_relief_is_told_apart() {
    let home = relieved(&NEW);
    let answer = home.succeed("run study.toml -o run");
    let summary = home.result("run").summary();
    let [peak, elsewhere] = ["peak_pressure", "peak_pressure_elsewhere"]
        .map(|key| number(&summary, &format!("/contact/{key}")));
    assert_eq!(summary["contact"]["peak_pressure_over_kink"], true);
    assert!(peak > 1.5 * elsewhere, "{peak} {elsewhere}");
    // the teeth are as hard as the same without relief in the middle of the path, where one pair bears
    let place = number(&summary, "/contact/peak_pressure_elsewhere_path");
    assert!(place.abs() < 3.3, "{place}");
    let page = home.result("run").text("report.html");
    for text in [&answer.out, &page] {
        assert!(text.contains("depends on the mesh"), "{text}");
        assert!(text.contains("where a linear tip relief begins"));
    }
    let line = |name: &str| {
        answer
            .out
            .lines()
            .find(|line| line.starts_with(name))
            .unwrap_or_default()
    };
    let said = line("  peak pressure")
        .split_whitespace()
        .nth(2)
        .map(str::parse);
    let said: f64 = said.unwrap().unwrap();
    assert!((said / elsewhere - 1.0).abs() < 1e-3, "{said} {elsewhere}");
    assert!(
        line("    at a kink").contains("depends on the mesh"),
        "{}",
        answer.out
    );
    // the elastic limit is not for what no tooth bears for long
    assert!(
        !answer.out.contains("more than such teeth carry"),
        "{}",
        answer.out
    );
}

#[test]
fn elsewhere_the_mesh_does_not_matter() {
    let of = |edges: &str| {
        let mut values = NEW;
        values[3].1 = edges;
        let home = relieved(&values);
        home.succeed("run study.toml -o run");
        let summary = home.result("run").summary();
        ["peak_pressure", "peak_pressure_elsewhere"]
            .map(|key| number(&summary, &format!("/contact/{key}")))
    };
    let (coarse, fine) = (of("3"), of("7"));
    assert!(fine[0] > 1.15 * coarse[0], "{coarse:?} {fine:?}");
    assert!(
        (fine[1] / coarse[1] - 1.0).abs() < 0.05,
        "{coarse:?} {fine:?}"
    );
}

/// Without relief, and where contacts are ellipses, nothing is marked.
#[test]
fn without_a_kink_nothing_is_marked() {
    let ellipses = [NEW[0], NEW[1], ("contact", "\"hertz\"")];
    for home in [Home::with(&NEW), relieved(&ellipses)] {
        let answer = home.succeed("run study.toml -o run");
        let contact = &home.result("run").summary()["contact"];
        assert_eq!(contact["peak_pressure_over_kink"], false);
        assert_eq!(contact["peak_pressure"], contact["peak_pressure_elsewhere"]);
        assert!(!answer.out.contains("kink"), "{}", answer.out);
    }
}
