//! `report.html` of one run.

mod geometry;
mod inputs;
mod mesh_and_cost;
mod states;

use self::geometry::geometry;
use self::inputs::inputs;
use self::mesh_and_cost::mesh_and_cost;
use self::states::states;
use super::files;
use super::oil_and_heat::oil_and_heat;
use super::page::{Page, Section};
use super::table::{Cell, Table};
use crate::gear::Pair;
use crate::numeric::written::{count, percent, significant};
use crate::report::drawings;
use crate::report::error::OutputError;
use crate::report::plots;
use crate::report::text;
use crate::simulate::result::{Member, Run, State};

/// The page without its list of files; with `pair` the gears are drawn.
///
/// # Errors
/// [`OutputError`] if a picture cannot be encoded.
pub fn run(run: &Run, pair: Option<&Pair>) -> Result<Page, OutputError> {
    let worn = pair.and_then(|pair| drawings::worn_teeth(run, pair));
    let (worn, tooth) = worn.map_or((Vec::new(), None), |w| (w.drawings, Some(w.data)));
    let mut sections = vec![key_figures(run)];
    sections.extend(pair.map(|pair| Section::new("The gears").drawings(drawings::of_pair(pair))));
    sections.push(wear(run).drawings(worn).drawings(drawings::around(run)));
    sections.push(contact(run).drawings(drawings::flank_maps(run)));
    sections.push(oil_and_heat(run));
    let stresses = drawings::stresses(run)?;
    sections.extend(stresses.map(|drawing| stress(run).drawings([drawing])));
    sections.extend([inputs(run), geometry(run), mesh_and_cost(run)]);
    sections.extend([checks(run), states(run)]);
    let live = plots::live_states(run).into_iter();
    Ok(Page {
        title: if run.title.is_empty() {
            "Gear wear run".to_owned()
        } else {
            run.title.clone()
        },
        kicker: text::asked_for(run),
        conclusion: text::conclusion(run),
        sections,
        states: live.map(|i| count(run.states[i].cycles)).collect(),
        tooth,
    })
}

fn key_figures(run: &Run) -> Section {
    let mut section = Section::new("Results");
    let mut say = |name: String, value: String| section.key_figures.push((name, value));
    for member in Member::BOTH {
        let flank = run.last().profile(member);
        let value = format!("{} µm", significant(flank.max_depth(), 4));
        let across = run.last().deepest_on_the_face(member);
        let of = match (across, run.last().worst_tooth(member)) {
            (Some(_), _) => ", mean over the face",
            (None, Some(_)) => ", mean tooth",
            (None, None) => "",
        };
        say(format!("largest depth, {}{of}", member.name()), value);
        if let Some((depth, _)) = across {
            let value = format!("{} µm", significant(depth, 4));
            say(
                format!("largest depth across the face, {}", member.name()),
                value,
            );
        }
        if let Some(worst) = run.last().worst_tooth(member) {
            let (depth, tooth) = (significant(worst.deepest(), 4), worst.teeth[0]);
            let value = format!("{depth} µm, tooth {tooth}");
            say(format!("worst tooth, {}", member.name()), value);
        }
        let value = format!("{} mg", significant(flank.mass_loss_mg, 4));
        say(format!("mass lost, {}", member.name()), value);
    }
    let from_to = |of: &dyn Fn(&State) -> Option<f64>, unit: &str| {
        let (first, last) = (of(run.first())?, of(run.last())?);
        let [first, last] = [first, last].map(|v| significant(v, 4));
        Some(if run.states.len() > 1 {
            format!("{first} → {last} {unit}")
        } else {
            format!("{first} {unit}")
        })
    };
    let kinks = text::at_kinks(run).is_some();
    let peak = if kinks {
        "peak pressure on the flanks away from kinks, new → worn"
    } else {
        "peak pressure on the flanks, new → worn"
    };
    for (name, value) in [
        (peak, from_to(&text::elsewhere, "MPa")),
        (
            "pressure at a kink of the flanks (depends on the mesh), new → worn",
            from_to(
                &|s| kinks.then(|| s.kink_pressure().map_or(0.0, |p| p.0)),
                "MPa",
            ),
        ),
        (
            "transmission error at the pinion, peak to peak, new → worn",
            from_to(&|s| s.te_peak_to_peak_urad(), "µrad"),
        ),
        (
            "transmission error at the pinion over one turn, new → worn",
            from_to(&State::te_over_a_turn_urad, "µrad"),
        ),
        (
            "face load factor K_Hβ, new → worn",
            from_to(
                &|s| (!s.slices.is_empty()).then(|| s.face_load_factor()),
                "",
            ),
        ),
    ] {
        if let Some(value) = value {
            say(name.to_owned(), value);
        }
    }
    let passed = run.checks.iter().filter(|check| check.passed()).count();
    if !run.checks.is_empty() {
        say(
            "checks passed".to_owned(),
            format!("{passed} of {}", run.checks.len()),
        );
    }
    say(
        "worn area: geometry against law".to_owned(),
        percent(run.balance_error, 2),
    );
    section
}

fn wear(run: &Run) -> Section {
    let single = match run.geometry.helix {
        None => "B and D the ends of single contact",
        Some(_) => "B and D the ends of single contact in any one transverse section",
    };
    Section::new("Wear")
        .with_slider()
        .plots(plots::wear_of_run(run))
        .note(format!(
            "A and E are the ends of the nominal path of contact, {single}, C is the pitch point; \
         negative distances lie in the pinion's dedendum. Lines join neighbouring points only.",
        ))
}

fn contact(run: &Run) -> Section {
    let mut section = Section::new("Contact over the mesh cycle").with_slider().plots(plots::contact_of_run(run)).note(
        "Load shares and pressures of every tooth pair as it passes along the path of contact; crosses: pairs that touch with a \
         tip corner, whose pressure is the mean over 0.02 modules.",
    );
    if text::at_kinks(run).is_some() {
        section = section.note(
            "Where a linear tip relief begins, or a flank bends otherwise by a finite angle, the pressure of new flanks has no bound: what it comes to there \
             depends on the mesh, until wear has rounded the kink off.",
        );
    }
    match text::across_helical_gears(run) {
        Some(said) => section.note(format!("Note: {said}.")),
        None => section,
    }
}

fn stress(run: &Run) -> Section {
    let section = Section::new("Mesh and stress");
    let roots = Member::BOTH
        .into_iter()
        .zip(run.root_stress.iter().flatten());
    let section = roots.fold(section, |mut section, (member, root)| {
        section.key_figures.push((
            format!(
                "largest tensile stress in the {}'s fillet, at radius {} mm, tooth loaded {} mm from the pitch point",
                member.name(),
                significant(root.radius, 4),
                significant(root.path, 3)
            ),
            format!("{} MPa", significant(root.stress, 4)),
        ));
        section
    });
    section.note(format!(
        "Deformed as computed, not magnified. Along the flanks elements are too small to be told apart but in the close-ups, which show \
         the contact that carries most and have a scale of their own. As files: `plots/stress_*.svg` and `.png`. The {} stored \
         fields hold displacement, stress tensor, contact pressure and worn depth for ParaView.",
        run.fields.len()
    ))
}

fn checks(run: &Run) -> Section {
    let mut table = Table::new("", ["check", "found", "allowed", "verdict"]);
    for check in &run.checks {
        let unit = if check.unit == "-" {
            String::new()
        } else {
            format!(" {}", check.unit)
        };
        let verdict = if check.passed() {
            Cell::Badge("pass", "pass".into())
        } else {
            Cell::Badge("fail", "fail".into())
        };
        table = table.row([
            Cell::text(check.name.clone()),
            Cell::number(format!("{}{unit}", significant(check.value, 3))),
            Cell::number(format!("{}{unit}", significant(check.limit, 3))),
            verdict,
        ]);
    }
    let balance = format!(
        "Balance of the worn area: the area missing from the flanks and the area the wear law removed differ by {}.",
        percent(run.balance_error, 2)
    );
    let section = Section::new("Checks").paragraph(balance);
    if table.rows.is_empty() {
        section
    } else {
        section.table(table)
    }
}

/// The files of the result folder, the last section of the page.
pub fn files_of_run(run: &Run, names: &[String]) -> Section {
    let section = Section::new("Files").table(files::table(names));
    if run.fields.is_empty() {
        return section;
    }
    section.note(
        "To look at the fields, load `fields/open_in_paraview.py` in ParaView (File, Load State), which sets range, camera and colours; or open \
         `fields/wear.pvd`, press Apply and choose an array to colour by \
         (`von_mises`, `contact_pressure`, `wear_depth`). The time slider runs over pinion revolutions; \
         `fields/mesh_cycle_NNN.pvd` runs over one base pitch instead. The filter Warp By Vector makes deflection \
         visible (`displacement`, scale factor 10 to 50) or wear (`wear_vector`, 50 to 200). Quadratic triangles are drawn \
         smoothly after raising Nonlinear Subdivision Level. Units are mm, N and MPa; `wear_depth` is in µm.",
    )
}
