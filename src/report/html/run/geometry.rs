//! The geometry of the pair in tables.

use crate::numeric::written::{plain, significant};
use crate::report::html::page::Section;
use crate::report::html::table::{Cell, Table};
use crate::report::text;
use crate::simulate::result::{Geometry, Helix, Run, WheelGeometry};

pub(super) fn geometry(run: &Run) -> Section {
    let g = &run.geometry;
    let mut section = Section::new("Geometry").table(pair(run));
    if let Some(helical) = &g.helix {
        let shown = |ratio: f64| significant(ratio, 4);
        section = section.table(helix(g, helical)).paragraph(format!(
            "The total contact ratio {} is the transverse contact ratio {} plus the overlap ratio {}.",
            shown(g.total_contact_ratio()),
            shown(g.contact_ratio),
            shown(helical.overlap_ratio)
        ));
    }
    section.table(wheels(g))
}

fn mm(value: f64) -> String {
    format!("{} mm", significant(value, 6))
}

fn pair(run: &Run) -> Table {
    let g = &run.geometry;
    let names = match g.helix {
        Some(_) => [
            "transverse working pressure angle",
            "transverse contact ratio",
            "transverse path of contact",
            "transverse base pitch",
        ],
        None => [
            "working pressure angle",
            "contact ratio",
            "path of contact",
            "base pitch",
        ],
    };
    let [a, b, d, e] = g.path_limits.map(|limit| significant(limit, 5));
    Table::of_values(
        "The pair at its working centre distance",
        [
            ("centre distance", mm(g.centre_distance)),
            (
                names[0],
                format!("{}°", significant(g.working_pressure_angle_deg, 6)),
            ),
            (names[1], significant(g.contact_ratio, 6)),
            (names[2], mm(g.path_of_contact)),
            (names[3], mm(g.base_pitch)),
            (
                "A, B, D, E from the pitch point",
                format!("{a}, {b}, {d}, {e} mm"),
            ),
            ("backlash", backlash(run)),
            ("speed ratio", significant(g.speed_ratio, 6)),
        ],
    )
}

fn backlash(run: &Run) -> String {
    let words = text::jammed(run).map_or_else(String::new, |words| format!(": {words}"));
    format!("{} µm{words}", significant(run.geometry.backlash_um, 4))
}

fn helix(g: &Geometry, helix: &Helix) -> Table {
    let degrees = |value: f64| format!("{}°", significant(value, 6));
    Table::of_values(
        "The helix",
        [
            (
                "helix angle at the pinion's reference circle",
                degrees(helix.angle_deg),
            ),
            (
                "helix angle at the base circles",
                degrees(helix.base_angle_deg),
            ),
            (
                "module of the transverse section",
                mm(helix.transverse_module),
            ),
            (
                "pressure angle of the transverse section",
                degrees(helix.transverse_pressure_angle_deg),
            ),
            ("overlap ratio", significant(helix.overlap_ratio, 6)),
            (
                "total contact ratio",
                significant(g.total_contact_ratio(), 6),
            ),
        ],
    )
}

fn wheels(g: &Geometry) -> Table {
    let mut wheels = Table::new("The wheels, radii in mm", ["", "pinion", "gear"]);
    type Column = fn(&WheelGeometry) -> String;
    let rows: [(&str, Column); 9] = [
        ("teeth", |w| w.teeth.to_string()),
        ("profile shift, modules", |w| plain(w.profile_shift)),
        ("bore", |w| plain(w.bore_radius)),
        ("root", |w| plain(w.root_radius)),
        ("base", |w| plain(w.base_radius)),
        ("form (involute begins)", |w| plain(w.form_radius)),
        ("active (nominal contact begins)", |w| {
            plain(w.active_radius)
        }),
        ("working pitch", |w| plain(w.pitch_radius)),
        ("tip", |w| plain(w.tip_radius)),
    ];
    for (name, value) in rows {
        wheels = wheels.row([
            Cell::text(name),
            Cell::number(value(&g.pinion)),
            Cell::number(value(&g.gear)),
        ]);
    }
    wheels
}
