//! The meshes and what a run took, in tables.

use crate::numeric::written::{duration, percent, significant, whole};
use crate::report::html::page::Section;
use crate::report::html::table::{Cell, Table};
use crate::simulate::result::{Cost, Member, MeshSummary, Run};

pub(super) fn mesh_and_cost(run: &Run) -> Section {
    let section = Section::new("Mesh and cost");
    let section = match &run.mesh {
        None => section.paragraph(format!("The {} model needs no mesh.", run.conditions.model)),
        Some(both) => section.table(meshes(both)),
    };
    let section = section.table(cost(&run.cost));
    if run.cost.stages.is_empty() {
        section
    } else {
        section.table(stages(&run.cost))
    }
}

fn meshes(meshes: &[MeshSummary; 2]) -> Table {
    let head = [
        "",
        "element",
        "nodes",
        "elements",
        "unknowns",
        "smallest angle, °",
        "flank spacing, µm",
    ];
    let mut table = Table::new("", head);
    for (member, mesh) in Member::BOTH.into_iter().zip(meshes) {
        table = table.row([
            Cell::text(member.name()),
            Cell::text(mesh.element.clone()),
            Cell::number(whole(mesh.nodes)),
            Cell::number(whole(mesh.elements)),
            Cell::number(whole(mesh.dof)),
            Cell::number(significant(mesh.min_angle_deg, 3)),
            Cell::number(significant(mesh.flank_spacing * 1000.0, 3)),
        ]);
    }
    table
}

fn cost(cost: &Cost) -> Table {
    let memory = cost.peak_memory_mb.map_or("not known".to_owned(), |mb| {
        format!("{} MB", significant(mb, 3))
    });
    Table::of_values(
        "",
        [
            ("time", duration(cost.seconds)),
            ("threads", whole(cost.threads)),
            ("largest memory", memory),
            ("factorisations", whole(cost.factorisations)),
            ("contact problems solved", whole(cost.contact_solves)),
            ("wear steps", whole(cost.wear_steps)),
        ],
    )
}

/// The time of each stage and its share of the whole.
fn stages(cost: &Cost) -> Table {
    let mut stages = Table::new("Time per stage", ["stage", "time", "share"]);
    let total: f64 = cost.stages.iter().map(|(_, seconds)| seconds).sum();
    for (name, seconds) in &cost.stages {
        let share = if total > 0.0 {
            percent(seconds / total, 2)
        } else {
            String::new()
        };
        stages = stages.row([
            Cell::text(name.clone()),
            Cell::number(duration(*seconds)),
            Cell::number(share),
        ]);
    }
    stages
}
