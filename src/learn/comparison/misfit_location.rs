//! A sentence on where the model fails worst and what that looks like, made from the cells' figures.

use std::collections::BTreeMap;

use super::lone_row::LoneRow;
use super::misfit_ranking::{carried, excess, fails};
use super::ratio::Ratio;
use super::residual_statistics::{Cell, CellKey};
use crate::learn::fitting::region::{FlankRegions, Stage, words};
use crate::measure::{Quantity, Subject};
use crate::numeric::written::{self, count};

/// How many times the cycles of its first interval a test's last has to have for a wrong rate to show as an error that grows.
const MUCH_LATER: f64 = 2.5;

/// Where the model fails worst, in plain words.
pub(in crate::learn) fn sentence(
    cells: &BTreeMap<CellKey, Cell>,
    ratios: &BTreeMap<(usize, Subject), Vec<Ratio>>,
    map: &FlankRegions,
    lone: &BTreeMap<CellKey, LoneRow>,
    chi2: Option<f64>,
) -> String {
    // what a fit is to mend comes first; a held-out test leads where it alone fails
    let held_out = !cells.values().any(|cell| fails(cell) && !is_held_out(cell));
    let failing =
        || (cells.iter()).filter(|(_, cell)| fails(cell) && is_held_out(cell) == held_out);
    let carried = carried(failing());
    let worst = failing().max_by(|(a, first), (b, second)| {
        let of_quantity = carried[&a.2].total_cmp(&carried[&b.2]);
        of_quantity.then(excess(first).total_cmp(&excess(second)))
    });
    let Some((key, cell)) = worst else {
        let chi2 = chi2.map_or_else(String::new, |chi2| {
            format!("; χ² per point of all tests together is {chi2:.2}")
        });
        return format!(
            "In no single region of a test does the model miss the measurements by more than their noise{chi2}."
        );
    };
    let share = {
        let total: f64 = cells.values().map(|cell| excess(cell).max(0.0)).sum();
        100.0 * excess(cell) / total
    };
    let others = others(key, cell, cells, map);
    let parts = [
        format!(
            "{}{}{} is {}{} in {}test {}",
            subject(key.2),
            whose(key),
            when(key, cell, map),
            // what other tests show too is no row's own
            size(cell, lone.get(key).filter(|_| others.is_empty())),
            place(key),
            if held_out { "held-out " } else { "" },
            cell.test
        ),
        format!(
            " (χ² per point {:.1}, {share:.0} % of all that exceeds the noise)",
            cell.chi2_per_point
        ),
        trend(key, cells),
        mate(key, cell, cells, lone),
        others,
    ];
    let factor = if key.2 == Quantity::WearDepth {
        ratios
            .get(&(key.0, key.1))
            .map_or_else(String::new, |own| factor(own))
    } else {
        String::new()
    };
    parts.concat() + "." + &factor
}

fn is_held_out(cell: &Cell) -> bool {
    cell.role == "holdout"
}

fn subject(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::WearDepth => "Computed wear",
        Quantity::TransmissionError => "The computed transmission error (of the gear)",
        Quantity::MassLoss => "The computed mass loss",
        Quantity::LoadShare => "The computed load share",
        Quantity::ContactPressure => "The computed pressure",
        Quantity::MeshStiffness => "The computed mesh stiffness",
        Quantity::MeanLag => "The computed mean lag",
        Quantity::SpanLoss => "The computed loss of span",
        Quantity::ChordalLoss => "The computed loss of chordal thickness",
    }
}

fn when(key: &CellKey, cell: &Cell, map: &FlankRegions) -> String {
    if map.intervals(key.0) < 2 {
        return String::new();
    }
    let stage = match map.stage(key.0, key.4) {
        Stage::Early => "early in life",
        Stage::Middle => "in mid-life",
        Stage::Late => "late in life",
    };
    let [from, to] = cell.cycles;
    if from == to {
        return format!(" {stage} ({} cycles)", count(to));
    }
    format!(" {stage} ({} to {} cycles)", count(from), count(to))
}

/// Sign and size of the error; its root mean square where it has no one sign, or is that of one row.
fn size(cell: &Cell, lone: Option<&LoneRow>) -> String {
    let unit = match cell.unit.as_str() {
        "1" => "",
        unit => &format!(" {}", written::unit(unit)),
    };
    if let Some(row) = lone {
        return format!(
            "off by {}{unit} (root mean square; {})",
            short(cell.rms),
            row.in_words()
        );
    }
    if either_sign(cell) {
        return format!(
            "off by {}{unit} (root mean square, either sign)",
            short(cell.rms)
        );
    }
    let sign = if cell.bias < 0.0 { "low" } else { "high" };
    format!("{}{unit} too {sign}", short(cell.bias.abs()))
}

/// Whose a quantity without a place is.
fn whose(key: &CellKey) -> String {
    match (key.1.member(), key.3) {
        (Some(member), None) => format!(" of the {}", member.name()),
        _ => String::new(),
    }
}

fn place(key: &CellKey) -> String {
    match (key.1.member(), key.3) {
        (Some(member), Some(region)) => {
            format!(" on the {}'s {}", member.name(), words(member, region))
        }
        _ => String::new(),
    }
}

/// Whether a cell's mean is off by more than its noise.
fn clear(cell: &Cell) -> bool {
    cell.bias.abs() > 3.0 * cell.bias_sigma
}

/// Whether a cell's error has no one sign.
fn either_sign(cell: &Cell) -> bool {
    cell.bias.abs() < 0.5 * cell.rms
}

/// Whether only the last of two errors is clear, and the one before it no smaller error of its kind: one that grows would show in both.
fn stands_alone(before: &Cell, last: &Cell) -> bool {
    clear(last) && !clear(before) && before.bias * last.bias.signum() < ON_ITS_WAY * last.bias.abs()
}

/// Part of the last error of a test that one before it has at least if errors grow.
const ON_ITS_WAY: f64 = 0.2;

/// Whether the error at that place grows, falls or changes sign over the test's intervals.
fn trend(key: &CellKey, cells: &BTreeMap<CellKey, Cell>) -> String {
    let same = cells
        .iter()
        .filter(|(k, _)| (k.0, k.1, k.2, k.3) == (key.0, key.1, key.2, key.3));
    let over: Vec<&Cell> = same.map(|(_, cell)| cell).collect();
    if over.len() < 2 {
        return String::new();
    }
    let (first, last) = (over[0], over[over.len() - 1]);
    if either_sign(&cells[key]) || !(clear(first) || clear(last)) {
        return String::new();
    }
    if let [earlier @ .., before, last] = &over[..]
        && !earlier.is_empty()
        && stands_alone(before, last)
        && !earlier.iter().any(|cell| clear(cell))
    {
        return format!(
            "; before the last interval of the test the error there is within its noise ({} just before it)",
            signed(before)
        );
    }
    // of an end within its noise nobody knows the sign
    let word = if first.bias * last.bias < 0.0 {
        match (clear(first), clear(last)) {
            (true, true) => "changes its sign",
            (false, _) => "grows out of its noise",
            (_, false) => "falls into its noise",
        }
    } else if last.bias.abs() > 1.5 * first.bias.abs() {
        "grows"
    } else if last.bias.abs() < first.bias.abs() / 1.5 {
        "falls"
    } else {
        "stays alike"
    };
    // a wrong rate makes an error that grows with the cycles
    let while_wear_grew = key.2 == Quantity::WearDepth
        && word == "stays alike"
        && last.cycles[1] > MUCH_LATER * first.cycles[1];
    let why = if while_wear_grew {
        ", as a loss in the first cycles or a shifted or tilted profile would make it"
    } else {
        ""
    };
    format!(
        "; the error there {word} over the test, from {} to {}{why}",
        signed(first),
        signed(last)
    )
}

/// Part of an error that one in another test has at least if it is called the same.
const ALIKE: f64 = 0.3;

/// Sizes of the measured wear against the computed one that are worth telling: beyond them the values are not what they are taken for.
const TELLING: std::ops::Range<f64> = 0.01..100.0;

/// The size of the measured wear against the computed one over the test, where that explains the misfit.
fn factor(ratios: &[Ratio]) -> String {
    let extreme = |r: &&Ratio| (r.measured_over_computed.abs().ln().abs() * 1e6) as i64;
    let Some(first) = ratios.iter().filter(|r| r.matters()).max_by_key(extreme) else {
        return String::new();
    };
    if !TELLING.contains(&first.measured_over_computed) {
        return String::new();
    }
    let told = |r: &Ratio| {
        let times = r.measured_over_computed;
        format!(
            "{times:.2} times the computed at {} cycles",
            count(r.cycles)
        )
    };
    let mut text = format!(
        " With the zero of each trace left open the {}'s measured wear in test {} is {} (that factor alone would remove {:.0} % of the misfit there)",
        first.member,
        first.test,
        told(first),
        100.0 * first.explains().min(1.0)
    );
    let far = |r: &&Ratio| ((r.cycles / first.cycles).ln().abs() * 1e6) as i64;
    if let Some(second) = ratios
        .iter()
        .max_by_key(far)
        .filter(|r| r.cycles != first.cycles && TELLING.contains(&r.measured_over_computed))
    {
        text += &format!(", and {}", told(second));
    }
    text + "."
}

/// What the mate shows where it meets that region.
fn mate(
    key: &CellKey,
    cell: &Cell,
    cells: &BTreeMap<CellKey, Cell>,
    lone: &BTreeMap<CellKey, LoneRow>,
) -> String {
    let Some(member) = key.1.member() else {
        return String::new();
    };
    let other = Subject::from(member.other());
    let there = (key.0, other, key.2, key.3, key.4);
    let Some(found) = cells.get(&there) else {
        return String::new();
    };
    let name = other.name();
    if fails(found) && (either_sign(found) || either_sign(cell)) {
        format!(
            "; the {name} there is {} too",
            size(found, lone.get(&there))
        )
    } else if !clear(found) || either_sign(cell) {
        format!("; the {name} there is not clearly off ({})", signed(found))
    } else if found.bias * cell.bias > 0.0 {
        format!("; the {name} there shares it ({})", signed(found))
    } else {
        format!(
            "; the {name} there is off the other way ({})",
            signed(found)
        )
    }
}

/// The tests that show the same sign, or an error of either sign too, at the same place and stage of life.
fn others(
    key: &CellKey,
    cell: &Cell,
    cells: &BTreeMap<CellKey, Cell>,
    map: &FlankRegions,
) -> String {
    let stage = |k: &CellKey| map.stage(k.0, k.4);
    let mut like = Vec::new();
    for (k, found) in cells {
        let same_place =
            (k.1, k.2, k.3, stage(k)) == (key.1, key.2, key.3, stage(key)) && k.0 != key.0;
        let is_alike = found.bias.abs() > ALIKE * cell.bias.abs();
        let same_sign = found.bias * cell.bias > 0.0 && clear(found) && is_alike;
        let alike = if either_sign(cell) {
            fails(found) && either_sign(found) && found.rms > ALIKE * cell.rms
        } else {
            same_sign
        };
        if same_place && alike && !like.contains(&found.test.as_str()) {
            like.push(found.test.as_str());
        }
    }
    match like.as_slice() {
        [] => String::new(),
        [one] => format!("; test {one} shows the same"),
        [all @ .., last] => format!("; tests {} and {last} show the same", all.join(", ")),
    }
}

fn signed(cell: &Cell) -> String {
    let sign = if cell.bias < 0.0 { "−" } else { "+" };
    let unit = written::unit(&cell.unit);
    format!("{sign}{} {unit}", short(cell.bias.abs()))
}

/// A positive number with two significant digits.
fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let digits = (1 - x.log10().floor() as i32).clamp(0, 9) as usize;
    format!("{x:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::super::misfit_ranking::tests::cell;
    use super::*;
    use crate::gear::Region;

    #[test]
    fn no_sentence_is_made_of_a_factor_that_no_wear_has() {
        let ratio = |measured_over_computed: f64| Ratio {
            test: "A".to_owned(),
            role: "fit".to_owned(),
            member: "pinion".to_owned(),
            cycles: 1e5,
            measured_over_computed,
            sigma: 1e-3,
            points: 50,
            chi2_per_point: 400.0,
            chi2_scaled: 1.0,
        };
        assert!(factor(&[ratio(1.61)]).contains("1.61 times the computed"));
        assert_eq!(factor(&[ratio(-1.1e5)]), "");
        assert_eq!(factor(&[ratio(2e3)]), "");
    }

    /// Test S is held out and further off than A: A leads, and S where A is within its noise.
    #[test]
    fn a_held_out_test_leads_where_it_alone_fails() {
        let held_out = |chi2| Cell {
            test: "S".to_owned(),
            role: "holdout".to_owned(),
            ..cell(Quantity::MassLoss, 9, chi2)
        };
        let key = |test| (test, Subject::Pinion, Quantity::MassLoss, None, 0);
        let map = FlankRegions::of_ends(vec![vec![1e5], vec![1e5]]);
        let told = |of_a: f64| {
            let cells = BTreeMap::from([
                (key(0), cell(Quantity::MassLoss, 9, of_a)),
                (key(1), held_out(40.0)),
            ]);
            sentence(&cells, &BTreeMap::new(), &map, &BTreeMap::new(), None)
        };
        assert!(
            told(20.0).contains("too low in test A (χ² per point 20.0"),
            "{}",
            told(20.0)
        );
        assert!(
            told(1.0).contains("too low in held-out test S"),
            "{}",
            told(1.0)
        );
    }

    /// A transmission error is measured on the pair; that of the gear is computed, so that too low is a gear that lags too much.
    #[test]
    fn a_transmission_error_is_the_gear_s() {
        let quantity = Quantity::TransmissionError;
        let key = (0, Subject::Pair, quantity, None, 0);
        let cells = BTreeMap::from([(key, cell(quantity, 40, 9.0))]);
        let map = FlankRegions::of_ends(vec![vec![1e5]]);
        let told = sentence(&cells, &BTreeMap::new(), &map, &BTreeMap::new(), None);
        let begins = "The computed transmission error (of the gear) is 1.0 µrad too low in test A (χ² per point 9.0";
        assert!(told.starts_with(begins), "{told}");
    }

    /// −0.13 µm at first and +0.15 µm at last, where the worst cell lies at an end.
    #[test]
    fn an_error_that_changes_its_sign_does_not_stay_alike() {
        let key = |interval| {
            let place = Some(Region::LowerDouble);
            (0, Subject::Pinion, Quantity::WearDepth, place, interval)
        };
        let after = |ends: [f64; 2], sigmas: [f64; 2], times: f64| {
            let of = |i: usize| Cell {
                cycles: [0.0, if i == 0 { 1e5 } else { times * 1e5 }],
                bias: ends[i],
                bias_sigma: sigmas[i],
                rms: ends[i].abs(),
                ..cell(Quantity::WearDepth, 12, 20.0)
            };
            let cells = BTreeMap::from([(key(0), of(0)), (key(1), of(1))]);
            trend(&key(1), &cells)
        };
        let told = |ends, sigmas| after(ends, sigmas, 1.0);
        let changes = told([-0.13, 0.15], [0.01; 2]);
        assert!(
            changes.contains("changes its sign over the test, from −0.13 µm to +0.15 µm"),
            "{changes}"
        );
        let alike = told([0.13, 0.15], [0.01; 2]);
        assert!(
            alike.contains("stays alike") && !alike.contains("profile"),
            "{alike}"
        );
        // while wear grew to eight times
        let alike = after([0.13, 0.15], [0.01; 2], 8.0);
        assert!(
            alike.ends_with("a shifted or tilted profile would make it"),
            "{alike}"
        );
        // four within their noise, and one
        let weighings = |errors: [f64; 4]| {
            let of = |(i, bias): (usize, f64)| {
                let cell = Cell {
                    bias,
                    bias_sigma: 4.8,
                    rms: bias.abs(),
                    ..cell(Quantity::MassLoss, 1, 20.0)
                };
                ((0, Subject::Pinion, Quantity::MassLoss, None, i), cell)
            };
            let cells: BTreeMap<CellKey, Cell> = errors.into_iter().enumerate().map(of).collect();
            trend(&(0, Subject::Pinion, Quantity::MassLoss, None, 3), &cells)
        };
        let alone = weighings([0.4, 2.2, -11.4, 23.6]);
        assert!(
            alone.contains(
                "before the last interval of the test the error there is within its noise (−11"
            ),
            "{alone}"
        );
        let growing = weighings([0.4, 5.2, 11.4, 23.6]);
        assert!(growing.contains("grows over the test"), "{growing}");
        // one end within its noise
        assert!(told([-0.13, 0.15], [0.06, 0.01]).contains("grows out of its noise"));
        assert!(told([-0.15, 0.13], [0.01, 0.06]).contains("falls into its noise"));
    }
}
