//! Both members' columns side by side: `radius pinion | wear pinion | radius gear | wear gear`.

use super::{is_curve, put_column};
use crate::measure::import::columns::half_understood::has_pair;
use crate::measure::import::columns::{Column, What, columns, with_sides};
use crate::measure::import::{Sheet, Wanted};
use crate::measure::{Place, Subject, names};

/// The table of each member, with the columns of the other one emptied and a column of members; none where not both have columns of their own.
pub(super) fn apart(sheet: &Sheet, head: usize) -> Option<Vec<Sheet>> {
    let header = &sheet.rows[head];
    let sides: Vec<Option<(Subject, String)>> = header.iter().map(|text| side(text)).collect();
    let members = [Subject::Pinion, Subject::Gear];
    let has_side = |member: &Subject| sides.iter().flatten().any(|side| side.0 == *member);
    if !members.iter().all(has_side) {
        return None;
    }
    let of = |member: Subject| {
        let mut own = sheet.clone();
        for (at, side) in sides.iter().enumerate() {
            match side {
                Some((of, name)) if *of == member => own.rows[head][at].clone_from(name),
                Some(_) => {
                    let below = own.rows.iter_mut().skip(head);
                    below
                        .filter_map(|row| row.get_mut(at))
                        .for_each(String::clear);
                }
                None => {}
            }
        }
        put_column(&mut own, head, "member", member.name());
        own
    };
    Some(members.map(of).into())
}

/// The table in which one member alone has columns, of two measurements or of what makes a table without its name only, without its name in them and
/// with a column of members; as it is where there is one already. Also what was made of it, in words.
pub(super) fn of_one(sheet: &Sheet, head: usize, wanted: &Wanted<'_>) -> (Sheet, Vec<String>) {
    let as_it_is = || (sheet.clone(), Vec::new());
    let header = &sheet.rows[head];
    let sides: Vec<Option<(Subject, String)>> = header.iter().map(|text| side(text)).collect();
    let mut members = sides.iter().flatten().map(|side| side.0);
    let Some(member) = members.next() else {
        return as_it_is();
    };
    let is_alone = member != Subject::Pair && members.all(|other| other == member);
    if !is_alone || super::has(&columns(header), "member") {
        return as_it_is();
    }
    let mut own = sheet.clone();
    for (cell, side) in own.rows[head].iter_mut().zip(&sides) {
        if let Some((_, name)) = side {
            cell.clone_from(name);
        }
    }
    if !has_pair(&with_sides(header)) && !is_table(&own, sheet, head) {
        return as_it_is();
    }
    if wanted.member != Some(member) {
        put_column(&mut own, head, "member", member.name());
    }
    (
        own,
        vec![format!("the columns of the {} alone", member.name())],
    )
}

/// Whether a member's columns make a table of their own where the whole header makes none.
pub(super) fn is_table(own: &Sheet, whole: &Sheet, head: usize) -> bool {
    let value = |columns: &[Column]| {
        let mut values = columns.iter().filter(|c| c.what.own() == Some("value"));
        values.next().map(|column| column.what)
    };
    let of_whole =
        |what: What| matches!(what, What::Values(quantity) if quantity.place() == Place::Whole);
    let columns_of = |sheet: &Sheet| columns(&sheet.rows[head]);
    let own = columns_of(own);
    value(&columns_of(whole)).is_none() && (is_curve(&own) || value(&own).is_some_and(of_whole))
}

/// The member that a column of places, values or their scatter names, and its header without it.
pub(in crate::measure::import) fn side(header: &str) -> Option<(Subject, String)> {
    let member = names::one_member(header)?;
    let is_of = |word: &str| names::member(word) == Some(member);
    let words = header.split(|c: char| !c.is_alphanumeric());
    let word = words
        .into_iter()
        .find(|word| !word.is_empty() && is_of(word))?;
    let rest = header.replacen(word, "", 1);
    let rest: Vec<&str> = rest.split_whitespace().collect();
    let rest = rest.join(" ");
    let column = columns(std::slice::from_ref(&rest)).pop()?;
    let is_side = match column.what {
        What::Weighing(_) | What::Profile(_) | What::Span(_) | What::Chord(_) | What::Values(_) => {
            true
        }
        What::Own(own) => ["position", "value", "sigma", "trace"].contains(&own),
        _ => false,
    };
    is_side.then_some((member, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_of_one_side() {
        let of = |text| side(text).map(|(member, rest)| (member.name(), rest));
        assert_eq!(
            of("Radius pinion [mm]"),
            Some(("pinion", "Radius [mm]".to_owned()))
        );
        assert_eq!(of("gear loss mg"), Some(("gear", "loss mg".to_owned())));
        assert_eq!(
            of("Masse Ritzel nach [g]"),
            Some(("pinion", "Masse nach [g]".to_owned()))
        );
        assert_eq!(
            of("Verschlei\u{df} Rad [\u{b5}m]").map(|o| o.0),
            Some("gear")
        );
        for other in [
            "gear",
            "gear [mg]",
            "revolutions of the pinion",
            "Radius [mm]",
        ] {
            assert_eq!(of(other), None, "{other}");
        }
    }
}
