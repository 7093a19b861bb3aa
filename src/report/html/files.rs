//! What the files of a result folder are.
use super::table::{Cell, Table};

/// A row for each file that a reader may want to open; the many field files count as one.
pub(super) fn table(files: &[String]) -> Table {
    let mut table = Table::new("", ["file", "what it holds"]);
    for name in files {
        if let Some(what) = meaning(name) {
            table = table.row([Cell::Link(name.clone()), Cell::text(what)]);
        }
    }
    let is_field = |name: &&String| name.ends_with(".vtu") && !name.starts_with("fields/flanks");
    let frames = files.iter().filter(is_field).count();
    if frames > 0 {
        let what =
            format!("{frames} field files: both members at one wear state and mesh position each");
        table = table.row([Cell::Code("fields/*.vtu".to_owned()), Cell::text(what)]);
    }
    let plots = files.iter().filter(|name| name.ends_with(".svg")).count();
    if plots > 0 {
        let what = format!("the {plots} pictures of this page as single files");
        table = table.row([
            Cell::Code("plots/*.svg, *.png".to_owned()),
            Cell::text(what),
        ]);
    }
    table
}

fn meaning(name: &str) -> Option<&'static str> {
    Some(match name {
        "study.toml" => "the study as it was run",
        "summary.json" => "the figures of this page for programs",
        "wear.csv" => {
            "worn depth along both flanks at every stored state: cycles, member, radius mm, path mm, depth µm"
        }
        "contact.csv" => {
            "each tooth pair at each mesh position: load share, line load N/mm, peak pressure MPa, half width mm, whether it touches with a corner"
        }
        "transmission_error.csv" => {
            "lag of the gear at each mesh position: cycles, position in base pitches, angle µrad"
        }
        "transmission_error_turn.csv" => {
            "the same over one turn of the member with more teeth, position from the first teeth's pitch point on"
        }
        "fields/wear.pvd" => "ParaView series over pinion revolutions",
        "fields/flanks.pvd" => {
            "ParaView series of the loaded flanks over the face: worn depth (warp by wear_vector), largest pressure"
        }
        "fields/loads.json" => "loads and areas that the field files must give when integrated",
        _ if name.starts_with("fields/mesh_cycle") => {
            "ParaView series over one base pitch at one wear state"
        }
        _ => return None,
    })
}
