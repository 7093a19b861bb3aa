//! What a run was made from: conditions, gears, face and teeth as stated, in tables.

use crate::gear::{Face, Hunting, Lead};
use crate::numeric::written::{count, plain, significant};
use crate::report::html::page::Section;
use crate::report::html::table::{Cell, Table};
use crate::report::text;
use crate::simulate::result::{Conditions, MadeWheel, Member, Run, WheelGeometry};

pub(super) fn inputs(run: &Run) -> Section {
    let section = Section::new("Inputs")
        .table(conditions(run))
        .table(rack(run))
        .table(wheels(run));
    let section = match across_the_face(run) {
        Some(table) => section.table(table),
        None => section,
    };
    match teeth(run) {
        Some(table) => section.table(table),
        None => section,
    }
}

fn conditions(run: &Run) -> Table {
    let c = &run.conditions;
    let effects = if c.effects.is_empty() {
        "none".to_owned()
    } else {
        c.effects.join("; ")
    };
    let test = c.test.as_ref();
    let mut rows = vec![
        (
            "conditions",
            test.map_or("[operation]".to_owned(), |id| format!("test {id}")),
        ),
        ("contact model", c.model.clone()),
        ("added effects", effects),
        (
            "torque on the pinion",
            format!("{} N·m", plain(c.torque / 1000.0)),
        ),
        ("speed of the pinion", format!("{} rpm", plain(c.speed_rpm))),
        (
            "radial misalignment",
            format!("{} mm", plain(c.misalignment)),
        ),
        ("pinion revolutions", count(c.cycles)),
        (
            "specific wear coefficient k",
            both(c.wear_coefficient, "mm²/N"),
        ),
        (
            "friction in the contact",
            in_a_cell(text::friction_in_contact(run)),
        ),
        (
            "friction for losses (no influence on loads and wear)",
            in_a_cell(text::friction_of_losses(run)),
        ),
    ];
    if let Some(words) = text::friction_of_flash(run) {
        rows.push(("friction for the flash temperature", in_a_cell(words)));
    }
    if let Some(words) = text::warmed_teeth(run) {
        rows.push(("tooth temperature", words));
    }
    rows.extend(materials(c));
    Table::of_values("", rows)
}

/// Cells set no code.
fn in_a_cell(words: String) -> String {
    words.replace('`', "")
}

fn materials(c: &Conditions) -> [(&'static str, String); 3] {
    [
        ("Young's modulus", both(c.youngs_modulus, "MPa")),
        ("Poisson's ratio", both(c.poisson_ratio, "")),
        ("density", both(c.density, "kg/m³")),
    ]
}

/// One figure, or those of pinion and gear.
fn both([pinion, gear]: [f64; 2], unit: &str) -> String {
    let with_unit = |value: f64| format!("{} {unit}", plain(value)).trim_end().to_owned();
    if pinion == gear {
        with_unit(pinion)
    } else {
        format!("{} pinion, {} gear", with_unit(pinion), with_unit(gear))
    }
}

/// What both members have in common.
fn rack(run: &Run) -> Table {
    let (g, made) = (&run.geometry, &run.made);
    let mm = |value: f64| format!("{} mm", plain(value));
    let modules = |value: f64| format!("{} modules", plain(value));
    let (module, angle) = match g.helix {
        Some(_) => ("normal module", "normal pressure angle"),
        None => ("module", "pressure angle"),
    };
    let mut rows = vec![
        (module, mm(g.module)),
        (angle, format!("{}°", plain(g.pressure_angle_deg))),
    ];
    if let Some(helix) = &g.helix {
        let degrees = |value: f64| format!("{}°", significant(value, 6));
        rows.extend([
            (
                "helix angle at the pinion's reference circle",
                format!("{}°", plain(helix.angle_deg)),
            ),
            (
                "transverse module (from these)",
                format!("{} mm", significant(helix.transverse_module, 6)),
            ),
            (
                "transverse pressure angle (from these)",
                degrees(helix.transverse_pressure_angle_deg),
            ),
        ]);
    }
    rows.extend([
        ("face width", mm(run.conditions.face_width)),
        (
            "centre distance without misalignment",
            mm(made.centre_distance),
        ),
        ("addendum of the basic rack", modules(made.addendum)),
        ("dedendum of the basic rack", modules(made.dedendum)),
        (
            "fillet radius of the basic rack",
            modules(made.fillet_radius),
        ),
    ]);
    let caption = match g.helix {
        Some(_) => "The gears; modules and the basic rack are those of the normal section",
        None => "The gears",
    };
    Table::of_values(caption, rows)
}

/// What each member has of its own.
fn wheels(run: &Run) -> Table {
    let g = &run.geometry;
    let both = [
        (&g.pinion, run.made.wheels[0]),
        (&g.gear, run.made.wheels[1]),
    ];
    type Column = fn(&WheelGeometry, &MadeWheel) -> String;
    let rows: [(&str, Column); 8] = [
        ("teeth", |g, _| g.teeth.to_string()),
        ("profile shift, modules", |g, _| plain(g.profile_shift)),
        ("thickness reduction, mm", |_, m| {
            plain(m.thickness_reduction)
        }),
        ("bore diameter, mm", |g, _| plain(2.0 * g.bore_radius)),
        ("linear tip relief, µm", |_, m| plain(m.tip_relief_um)),
        ("its length along the path of contact, mm", |_, m| {
            plain(m.tip_relief_length)
        }),
        ("tip rounding, mm", |_, m| plain(m.tip_rounding)),
        ("measured profile", |_, m| given(m.measured_profile)),
    ];
    let caption = match g.helix {
        Some(_) => "The members; shift and thickness reduction are those of the normal section",
        None => "The members",
    };
    let mut table = Table::new(caption, ["", "pinion", "gear"]);
    for (name, value) in rows {
        let [pinion, gear] = both.map(|(wheel, made)| Cell::number(value(wheel, &made)));
        table = table.row([Cell::text(name), pinion, gear]);
    }
    table
}

fn given(is_given: bool) -> String {
    if is_given { "given" } else { "none" }.to_owned()
}

/// Slices and leads; none where one section stands for the face.
fn across_the_face(run: &Run) -> Option<Table> {
    let slices = run.last().slices.len();
    if slices == 0 {
        return None;
    }
    let face: &Face = &run.made.face;
    let coupling = if text::slices_are_tied(run) {
        "tied by the teeth"
    } else {
        "turn together, not tied besides"
    };
    let caption = format!("Across the face: {slices} slices, {coupling}");
    type Figure = fn(&Lead) -> String;
    let rows: [(&str, Figure); 5] = [
        ("lead slope over the face, µm", |lead| {
            plain(1e3 * lead.slope)
        }),
        ("crowning at both ends, µm", |lead| {
            plain(1e3 * lead.crowning)
        }),
        ("end relief, µm", |lead| plain(1e3 * lead.end_relief)),
        ("its length, mm", |lead| plain(lead.end_relief_length)),
        ("measured lead", |lead| given(!lead.measured.is_empty())),
    ];
    let mut table = Table::new(&caption, ["", "pinion", "gear"]);
    for (name, value) in rows {
        let [pinion, gear] = face.lead.each_ref().map(|lead| Cell::number(value(lead)));
        table = table.row([Cell::text(name), pinion, gear]);
    }
    Some(table)
}

/// Pitch deviations and eccentricities; none where all teeth stand in their places.
fn teeth(run: &Run) -> Option<Table> {
    let teeth = &run.made.teeth;
    if teeth.are_alike() && !teeth.run_out() {
        return None;
    }
    let mut table = Table::new("Where the teeth stand", ["", "pinion", "gear"]);
    let pitch = teeth.back.each_ref().map(|back| {
        let (low, high) = (back.iter()).fold((0.0, 0.0), |(low, high): (f64, f64), b| {
            (low.min(*b), high.max(*b))
        });
        match back.is_empty() {
            true => "none".to_owned(),
            false => format!("{} to {}", plain(1e3 * low), plain(1e3 * high)),
        }
    });
    let [amount, phase] = [0, 1].map(|i| teeth.eccentricity.map(|axis| axis[i]));
    let classes = Member::BOTH.map(|member| {
        let own = run
            .last()
            .teeth
            .iter()
            .filter(|class| class.member == member);
        own.count().max(1).to_string()
    });
    for (name, [pinion, gear]) in [
        ("pitch deviations, µm", pitch),
        ("eccentricity, µm", amount.map(|mm| plain(1e3 * mm))),
        ("its phase, °", phase.map(|rad| plain(rad.to_degrees()))),
        ("classes of teeth", classes),
    ] {
        table = table.row([Cell::text(name), Cell::number(pinion), Cell::number(gear)]);
    }
    let hunting = match teeth.hunting {
        Hunting::Average => "the mean of its mates",
        Hunting::Full => "each of its mates in turn",
    };
    Some(table.row([
        Cell::text("a tooth meets"),
        Cell::text(hunting),
        Cell::text(hunting),
    ]))
}
