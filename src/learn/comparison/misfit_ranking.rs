//! Which cells the model fails in, and the order of these.
//!
//! What counts is by how much a cell's χ² exceeds its number of points. Quantities come in the order of what all their cells carry
//! together: a flank's trace is cut into many cells and a mass is one point, which would come first wherever both are off.

use std::collections::BTreeMap;

use super::residual_statistics::{Cell, CellKey};
use crate::measure::Quantity;
use crate::numeric::chi_squared::normal_deviate;

/// How far a cell's χ² must lie above its number of points, in standard deviations, to count as a failure: by chance 3 of 100 000 cells do, and
/// measurements have some hundred of them.
const SIGNIFICANT: f64 = 4.0;

/// Whether a cell's χ² lies above its number of points by more than chance.
pub(super) fn fails(cell: &Cell) -> bool {
    normal_deviate(cell.chi2_per_point, cell.points as f64) > SIGNIFICANT
}

/// By how much the sum of the squared standardised residuals exceeds what noise alone gives.
pub(super) fn excess(cell: &Cell) -> f64 {
    (cell.chi2_per_point - 1.0) * cell.points as f64
}

/// What the cells of each quantity that fail carry together.
pub(super) fn carried<'c>(
    cells: impl Iterator<Item = (&'c CellKey, &'c Cell)>,
) -> BTreeMap<Quantity, f64> {
    let mut carried = BTreeMap::new();
    for (key, cell) in cells {
        *carried.entry(key.2).or_default() += excess(cell).max(0.0);
    }
    carried
}

/// The cells, worst first: by what all cells of their quantity carry, then by what they carry themselves.
pub(in crate::learn) fn worst_first(cells: BTreeMap<CellKey, Cell>) -> Vec<Cell> {
    let carried = carried(cells.iter());
    let mut sorted: Vec<(CellKey, Cell)> = cells.into_iter().collect();
    sorted.sort_by(|(a, first), (b, second)| {
        let of_quantity = carried[&b.2].total_cmp(&carried[&a.2]);
        of_quantity.then(excess(second).total_cmp(&excess(first)))
    });
    sorted.into_iter().map(|(_, cell)| cell).collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::gear::Region;
    use crate::measure::Subject;

    pub(in crate::learn::comparison) fn cell(
        quantity: Quantity,
        points: usize,
        chi2_per_point: f64,
    ) -> Cell {
        Cell {
            test: "A".to_owned(),
            role: "fit".to_owned(),
            member: "pinion".to_owned(),
            quantity: quantity.name().to_owned(),
            region: "all".to_owned(),
            cycles: [0.0, 1e5],
            points,
            chi2_per_point,
            bias: -1.0,
            bias_sigma: 0.1,
            rms: 1.0,
            unit: quantity.unit().to_owned(),
            bias_um: None,
            rms_um: None,
        }
    }

    /// One row 4.5 σ off is no chance among a hundred, one 3 σ off is; of twenty a mean square of 2.9 and of 2.5.
    #[test]
    fn what_chance_makes_in_a_hundred_cells_is_no_failure() {
        let fails = |points, mean| fails(&cell(Quantity::WearDepth, points, mean));
        assert!(fails(1, 4.5 * 4.5) && !fails(1, 9.0));
        assert!(fails(20, 2.9) && !fails(20, 2.5));
    }

    /// One mass 22 σ off carries 499, each of five cells of a trace 228, together 1140: the trace comes first, and its worst cell.
    #[test]
    fn a_single_mass_does_not_come_before_a_trace_that_carries_more() {
        let mut cells = BTreeMap::new();
        let mass = (0, Subject::Pinion, Quantity::MassLoss, None, 0);
        cells.insert(mass, cell(Quantity::MassLoss, 1, 500.0));
        for interval in 0..5 {
            let trace = (
                0,
                Subject::Pinion,
                Quantity::WearDepth,
                Some(Region::LowerDouble),
                interval,
            );
            let chi2 = if interval == 3 { 25.0 } else { 20.0 };
            cells.insert(trace, cell(Quantity::WearDepth, 12, chi2));
        }
        let order: Vec<(String, f64)> = worst_first(cells.clone())
            .into_iter()
            .map(|cell| (cell.quantity, cell.chi2_per_point))
            .collect();
        assert_eq!(order[0], ("wear_depth".to_owned(), 25.0));
        assert_eq!(order[5], ("mass_loss".to_owned(), 500.0));
        // two of the weaker cells carry 456
        cells.retain(|key, _| key.4 < 2);
        assert_eq!(worst_first(cells)[0].quantity, "mass_loss");
    }
}
