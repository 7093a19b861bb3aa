//! Members that wear by measurement and not by the study: a wear coefficient of 0.

use super::super::residual_statistics::FittedRow;
use super::rounded;
use crate::measure::{Quantity, Subject};
use crate::numeric::written;
use crate::study::Study;

/// Standard deviations from which a row shows wear, and share of a member's rows that must.
const SHOWN: f64 = 5.0;
const MOST: f64 = 0.5;

/// A line for each member whose own wear coefficient is 0 though most of its depths or masses are far above their sigma.
pub(super) fn unworn_members(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let members = [Subject::Pinion, Subject::Gear];
    let without = (members.iter().zip(study.wear.members)).filter(|(_, factor)| *factor == 0.0);
    let worn = without.filter_map(|(member, _)| {
        let of = |quantity: Quantity| {
            let own = (rows.iter().map(|(o, _)| o))
                .filter(move |o| o.member == *member && o.quantity == quantity);
            let own: Vec<_> = own.filter(|o| o.cycles > 0.0).collect();
            let shown = own.iter().filter(|o| o.value > SHOWN * o.sigma).count();
            let most = own.iter().map(|o| o.value).fold(0.0, f64::max);
            (shown as f64 > MOST * own.len() as f64).then_some((quantity, most))
        };
        let (quantity, most) =
            of(Quantity::WearDepth).or_else(|| of(Quantity::MassLoss))?;
        let name = member.name();
        Some(format!(
            "[wear.{name}] coefficient is 0, so the {name} does not wear here, but its {} goes up to {} {}: state its coefficient, or leave that table out",
            quantity.name(),
            rounded(most),
            written::unit(quantity.unit())
        ))
    });
    worn.collect()
}
