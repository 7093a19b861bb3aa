//! The page of a run lists all that the study states of the gears, under the names of the section that it holds for, and which friction was used.
use super::home::{Home, STUDY};

/// The page of a coarse analytic run of [`STUDY`] with `more` after the pinion's and gear's numbers of teeth, and further tables.
fn page(members: &str, more: &str) -> String {
    let home = Home::with(&[("contact", "\"hertz\""), ("cycles", "1")]);
    let study = std::fs::read_to_string(home.path("study.toml")).unwrap();
    assert_eq!(STUDY.matches("\nteeth = ").count(), 2);
    let study = study
        .replace("\nteeth = ", &format!("\n{members}teeth = "))
        .replace("centre_distance = 80.0\n", "");
    home.write("study.toml", &(study + more));
    home.succeed("run study.toml -o run");
    home.result("run").text("report.html")
}

/// The cells of the table row whose first cell begins so, after the heading.
fn row(page: &str, heading: &str, name: &str) -> Vec<String> {
    let section = page.split(&format!(">{heading}</h2>")).nth(1).unwrap();
    let section = section.split("<h2").next().unwrap();
    let rows = section.split("<tr>").map(|row| {
        let cells = row
            .split("</t")
            .map(|cell| cell.rsplit('>').next().unwrap().trim().to_owned());
        cells.filter(|cell| !cell.is_empty()).collect::<Vec<_>>()
    });
    let mut found = rows.filter(|row| row.first().is_some_and(|cell| cell.starts_with(name)));
    found.next().unwrap_or_else(|| panic!("{name}: {section}"))
}

#[test]
fn inputs_of_helical_gears_are_named_by_their_section() {
    let members =
        "tip_relief_amount = 20.0\ntip_relief_length = 1.25\nthickness_reduction = 0.04\n";
    let page = page(
        members,
        "[face]\nslices = 11\nhelix_angle = 12.0\n[face.pinion]\nlead_slope = 5.0\ncrowning = 3.0\n\
         [face.gear]\nend_relief_amount = 6.0\nend_relief_length = 4.5\n\
         [teeth.gear]\neccentricity = 10.0\neccentricity_phase = 30.0\n",
    );
    for (name, cells) in [
        ("normal module", &["2 mm"][..]),
        ("normal pressure angle", &["20°"]),
        ("helix angle", &["12°"]),
        ("transverse module", &["2.04468 mm"]),
        ("addendum", &["1 modules"]),
        ("dedendum", &["1.25 modules"]),
        ("fillet radius", &["0.38 modules"]),
        ("thickness reduction", &["0.04", "0.04"]),
        ("linear tip relief", &["20", "20"]),
        ("its length along the path", &["1.25", "1.25"]),
        ("lead slope", &["5", "0"]),
        ("crowning", &["3", "0"]),
        ("end relief", &["0", "6"]),
        ("eccentricity, µm", &["0", "10"]),
        ("its phase", &["0", "30"]),
        (
            "friction in the contact",
            &["none: contact forces are normal to the flanks"],
        ),
        (
            "friction for losses",
            &["coefficient 0.06 (lubricant.friction_coefficient)"],
        ),
    ] {
        assert_eq!(row(&page, "Inputs", name)[1..], *cells, "{name}");
    }
    assert!(page.contains("Across the face: 11 slices"));
    // lines of contact run across the face: at no time does one pair carry alone
    assert!(page.contains("B and D the ends of single contact in any one transverse section"));
    assert!(!page.contains("a single pair carries"));
    // ε_γ = ε_α + ε_β; ε_β = b sin β/(π m_n) = 33 sin 12°/(2π) = 1.092
    for part in [
        "The total contact ratio 2.737 is the transverse contact ratio 1.645 plus the overlap ratio 1.092.",
        ">transverse contact ratio<",
        ">transverse base pitch<",
    ] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn spur_gears_have_one_section() {
    let page = page("", "");
    assert_eq!(row(&page, "Inputs", "module")[1], "2 mm");
    assert_eq!(row(&page, "Inputs", "centre distance")[1], "80 mm");
    for word in [
        "normal module",
        "transverse",
        "Across the face",
        "eccentricity",
        "total contact ratio",
    ] {
        assert!(!page.contains(word), "{word}");
    }
}
