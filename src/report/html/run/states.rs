//! The stored states of a run in a table.

use crate::numeric::written::{count, significant};
use crate::report::html::page::Section;
use crate::report::html::table::{Cell, Table};
use crate::report::text;
use crate::simulate::result::{Member, Run, State};

pub(super) fn states(run: &Run) -> Section {
    let kinks = text::at_kinks(run).is_some();
    let mut head = vec![
        "pinion revolutions",
        "pinion: largest depth, µm",
        "at radius, mm",
        "mass lost, mg",
        "gear: largest depth, µm",
        "at radius, mm",
        "mass lost, mg",
    ];
    if kinks {
        head.extend([
            "peak pressure on the flanks away from kinks, MPa",
            "at a kink, MPa",
        ]);
    } else {
        head.push("peak pressure on the flanks, MPa");
    }
    head.extend([
        "at a tip corner, MPa",
        "transmission error peak to peak, µrad",
    ]);
    let mut table = Table::new("", head);
    for state in &run.states {
        table = table.row(row(state, kinks));
    }
    let section = Section::new("Stored states").paragraph(
        "Depth is normal to the loaded flank of an average tooth; mass is that of the loaded flanks of all teeth. \
         Under a sharp tip corner the pressure has no bound: its figure is the mean over 0.02 modules.",
    );
    section.table(table)
}

fn row(state: &State, kinks: bool) -> Vec<Cell> {
    let or_dash =
        |value: Option<f64>| Cell::number(value.map_or("–".to_owned(), |v| significant(v, 4)));
    let mut row = vec![Cell::number(count(state.cycles))];
    for member in Member::BOTH {
        let flank = state.profile(member);
        let deepest = flank.deepest().filter(|_| flank.max_depth() > 0.0);
        row.push(Cell::number(significant(flank.max_depth(), 4)));
        row.push(Cell::number(
            deepest.map_or("–".to_owned(), |i| significant(flank.radius[i], 5)),
        ));
        row.push(Cell::number(significant(flank.mass_loss_mg, 4)));
    }
    row.push(or_dash(text::elsewhere(state)));
    if kinks {
        row.push(or_dash(state.kink_pressure().map(|p| p.0)));
    }
    row.push(or_dash(state.corner_pressure().map(|p| p.0)));
    row.push(or_dash(state.te_peak_to_peak_urad()));
    row
}
