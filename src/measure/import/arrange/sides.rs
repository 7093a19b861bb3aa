//! Both members' columns side by side: `radius pinion | wear pinion | radius gear | wear gear`.

use super::{is_curve, put_column};
use crate::measure::import::Sheet;
use crate::measure::import::columns::{Column, What, columns};
use crate::measure::{Place, Subject, names};

/// The table of each member, with the columns of the other one emptied and a column of members; the table alone where it is not laid out so.
pub(super) fn one_by_one(sheet: &Sheet, head: usize, said: &mut Vec<String>) -> Vec<Sheet> {
    let header = &sheet.rows[head];
    let sides: Vec<Option<(Subject, String)>> = header.iter().map(|text| side(text)).collect();
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
    let both = [Subject::Pinion, Subject::Gear].map(of);
    if !both
        .iter()
        .all(|own| stands_alone(&columns(&own.rows[head]), &columns(header)))
    {
        return vec![sheet.clone()];
    }
    said.push("the columns of the pinion and of the gear side by side".to_owned());
    both.into()
}

/// Whether a member's columns make a table of their own where the whole header makes none.
fn stands_alone(own: &[Column], whole: &[Column]) -> bool {
    let value = |columns: &[Column]| {
        let mut values = columns.iter().filter(|c| c.what.own() == Some("value"));
        values.next().map(|column| column.what)
    };
    let has_test = || whole.iter().any(|column| column.what == What::Own("test"));
    // masses without tests are read as a wide table
    let of_whole = |what: What| match what {
        What::Values(quantity) => quantity.place() == Place::Whole && has_test(),
        _ => false,
    };
    value(whole).is_none() && (is_curve(own) || value(own).is_some_and(of_whole))
}

/// The member that a column of places, values or their scatter names, and its header without it.
fn side(header: &str) -> Option<(Subject, String)> {
    let member = names::one_member(header)?;
    let is_of = |word: &str| names::member(word) == Some(member);
    let words = header.split(|c: char| !c.is_alphanumeric());
    let word = words
        .into_iter()
        .find(|word| !word.is_empty() && is_of(word))?;
    let rest = header.replacen(word, "", 1);
    let rest: Vec<&str> = rest.split_whitespace().collect();
    let rest = rest.join(" ");
    let own = Column::of(0, &rest).what.own()?;
    ["position", "value", "sigma", "trace"]
        .contains(&own)
        .then_some((member, rest))
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
