//! Film ratio, flash temperature, friction losses and root stress of a run against closed forms and an independent program.

use super::home::{Folder, Home, STUDY};

/// The coarse study with all that film and heat need, quadratic elements.
fn study() -> String {
    let oil = "viscosity = 0.015\npressure_viscosity = 18.0\nroughness = 0.5\nfriction_coefficient = 0.06\n\
               [thermal]\nbulk_temperature = 60.0\nconductivity = 46.0\nspecific_heat = 470.0\n";
    STUDY
        .replace("friction_coefficient = 0.06\n", oil)
        .replace("order = 1\n", "order = 2\n")
}

/// A run of this study.
fn run(study: &str) -> (Home, Folder) {
    let home = Home::with(&[]);
    home.write("study.toml", study);
    home.succeed("run study.toml -o out");
    let result = home.result("out");
    (home, result)
}

#[test]
fn film_and_heat_along_the_path_are_those_of_their_formulas() {
    let (_home, result) = run(&study());
    let table = result.table("contact.csv").only("cycles", "0");
    // none where nothing is loaded
    let table = table.only_where("line_load", |load| load > 0.0);
    let column = |name: &str| table.numbers(name);
    let path = column("path");
    let share = column("load_share");
    let near = |at: f64| {
        let far = |i: &usize| (path[*i] - at).abs();
        (0..path.len())
            .filter(|i| share[*i] > 0.99)
            .min_by(|a, b| far(a).total_cmp(&far(b)))
            .unwrap()
    };
    // single contact below the pitch point: the load is that of the torque
    let i = near(-0.5);
    let (base, angle) = (27.0 * 20f64.to_radians().cos(), 20f64.to_radians());
    let load = 1e5 / base / 33.0;
    let tangent = [27.0, 53.0].map(|radius: f64| radius * angle.sin());
    let rho = [tangent[0] + path[i], tangent[1] - path[i]];
    let relative = rho[0] * rho[1] / (rho[0] + rho[1]);
    let omega = 2000.0 / 60.0 * std::f64::consts::TAU;
    let rolling = [omega * rho[0], omega * 27.0 / 53.0 * rho[1]];
    let modulus = 2.1e5 / (2.0 * (1.0 - 0.09));

    // Dowson and Higginson (1966): h = 2.65 R G^0.54 U^0.7 W^-0.13 with E' = 2 E*
    let prime = 2.0 * modulus;
    let speed = 0.5 * (rolling[0] + rolling[1]);
    let groups = [
        18e-3 * prime,
        0.015e-6 * speed / (prime * relative),
        load / (prime * relative),
    ];
    let film = 2.65 * relative * groups[0].powf(0.54) * groups[1].powf(0.7) * groups[2].powf(-0.13);
    let found = table.texts("film_ratio")[i].parse::<f64>().unwrap();
    assert!(
        (found / (1e3 * film / 0.5) - 1.0).abs() < 1e-3,
        "{found} {film}"
    );

    // Blok (1937), the half width that of Hertz's ellipse with this load and the solved peak pressure
    let half = 2.0 * load / (std::f64::consts::PI * column("peak_pressure")[i]);
    let heat = (46.0f64 * 7850.0 * 470.0).sqrt() * 1e-3;
    let roots = (rolling[0].sqrt() - rolling[1].sqrt()).abs();
    let rise = 1.11 * 0.06 * load * roots / (heat * (2.0 * half).sqrt());
    let found = table.texts("flash_temperature_k")[i]
        .parse::<f64>()
        .unwrap();
    assert!((found / rise - 1.0).abs() < 1e-3, "{found} {rise}");

    let page = result.text("report.html");
    for name in ["film_ratio", "flash_temperature", "friction_power"] {
        assert!(
            result.0.join(format!("plots/{name}.svg")).is_file(),
            "{name}"
        );
        assert!(page.contains(name));
    }
}

#[test]
fn losses_are_those_of_the_loss_factor_and_root_stress_that_of_another_program() {
    // with the stated friction alone: what viscosity and roughness say would vary along the path
    let (_home, result) = run(&STUDY.replace("order = 1\n", "order = 2\n"));
    let summary = result.summary();
    let power = summary["contact"]["friction_power_w"].as_f64().unwrap();
    // Ohlendorf (1958): loss over power = μ π (u + 1)/(z1 u) (1 − ε + ε1² + ε2²), for loads shared evenly
    let ratio = 53.0 / 27.0;
    let path = &summary["geometry"]["path_limits"];
    let pitch = summary["geometry"]["base_pitch"].as_f64().unwrap();
    let [recess, approach] = [3, 0].map(|i: usize| path[i].as_f64().unwrap().abs() / pitch);
    let factor = std::f64::consts::PI * (ratio + 1.0) / (27.0 * ratio)
        * (1.0 - approach - recess + approach.powi(2) + recess.powi(2));
    let driving = 100.0 * 2000.0 / 60.0 * std::f64::consts::TAU;
    let expected = 0.06 * factor * driving;
    // elastic sharing takes load off the ends of the path, where sliding is fastest, and tips touch beyond them: some percent each
    assert!((power / expected - 1.0).abs() < 0.06, "{power} {expected}");
    assert!(summary["contact"]["least_film_ratio"].is_null());

    // where one pair carries all load: case E4's independent program at B, C and D, straight lines between
    let known = [
        ("pinion", [(-1.0932, 133.8), (0.0, 141.5), (0.6949, 148.8)]),
        ("gear", [(-1.0932, 141.6), (0.0, 129.3), (0.6949, 122.8)]),
    ];
    for (member, known) in known {
        let found = &summary["root_stress"][member];
        let [stress, path] = ["stress_mpa", "path_mm"].map(|key| found[key].as_f64().unwrap());
        let line = known.windows(2).find(|ends| path <= ends[1].0).unwrap();
        let part = (path - line[0].0) / (line[1].0 - line[0].0);
        let expected = line[0].1 + part * (line[1].1 - line[0].1);
        assert!((0.0..=1.0).contains(&part), "{member} at {path}");
        assert!(
            (stress / expected - 1.0).abs() < 0.03,
            "{member}: {stress}, {expected}"
        );
    }
}

/// The gears of GEARpie's report "MAO": 30 and 30 teeth, module 2, 15 mm, POM on POM, 10 N m at 1000 rpm, friction 0.28, 23 °C: flank 243.5 °C,
/// root 75.6 °C. Tolerance 0.2 % of the rise: its losses are integrated.
#[test]
fn teeth_that_friction_warms_are_shown_with_their_temperature() {
    let mut text = include_str!("../../../src/cli/examples/plastic-steel.toml").to_owned();
    for (old, new) in [
        ("module = 1.0 ", "module = 2.0 "),
        ("teeth = 20", "teeth = 30"),
        ("teeth = 40", "teeth = 30"),
        ("centre_distance = 30.0", "centre_distance = 60.0"),
        ("face_width = 8.0", "face_width = 15.0"),
        ("youngs_modulus = 2.1e5", "youngs_modulus = 3000"),
        ("friction_coefficient = 0.2", "friction_coefficient = 0.28"),
        ("torque = 0.5", "torque = 10.0"),
        ("contact = \"fem\"", "contact = \"hertz\""),
        (
            "bulk_temperature = 40.0 ",
            "tooth_temperature = \"vdi2736\"\nambient_temperature = 23.0 ",
        ),
    ] {
        assert!(text.contains(old), "{old}");
        text = text.replacen(old, new, 1);
    }
    let home = Home::with(&[]);
    home.write("study.toml", &text);
    let said = home.succeed("run study.toml -o out").out;
    let temperatures = home.result("out").summary()["conditions"]["tooth_temperature_c"].clone();
    let [flank, root] = ["flank", "root"].map(|key| temperatures[key].as_f64().unwrap());
    assert!(((flank - 23.0) / 220.5 - 1.0).abs() < 2e-3, "{flank}");
    assert!(((root - 23.0) / 52.6 - 1.0).abs() < 2e-3, "{root}");
    let words = format!("flank {flank:.1} °C, root {root:.1} °C (VDI 2736");
    assert!(said.contains(&words), "{words}\n{said}");
    assert!(home.result("out").text("report.html").contains(&words));
}
