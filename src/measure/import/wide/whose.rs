//! Whose flank the places of a wide table lie on: what the table or the user says of it, or else what the places tell.

use super::Result;
use super::grid::{Grid, Places};
use crate::measure::import::wanted::Wanted;
use crate::measure::import::{ImportError, Sheet};
use crate::measure::{Quantity, Subject, names};

/// A member, and what says that it is this one.
pub(super) struct Whose {
    pub(super) member: Subject,
    /// Whether anything says so; without, it is the pinion.
    pub(super) is_said: bool,
    /// What is said of a title, or of the places, that decided.
    pub(super) said: Option<String>,
    /// The title that decided.
    pub(super) title: Option<String>,
}

/// Whose places the table of a quantity has, below and beside the header in row `head`.
///
/// # Errors
/// [`ImportError`] where they lie on the other member's flank alone, and that is not plainly what is meant.
pub(super) fn of(
    sheet: &Sheet,
    head: usize,
    grid: &Grid<'_>,
    quantity: Quantity,
    wanted: &Wanted<'_>,
) -> Result<Whose> {
    let stated = wanted.stated_member(sheet, quantity)?;
    let title = of_title(sheet, head, quantity);
    if let Some(member) = stated.or_else(|| of_corner(grid.corner())) {
        let other = title.as_ref().filter(|title| title.member != member);
        return Ok(Whose {
            member,
            is_said: true,
            said: other.map(|title| title.passed_over(member)),
            title: other.map(|title| title.written.clone()),
        });
    }
    let member = title.as_ref().map_or(Subject::Pinion, |title| title.member);
    let orientation = |member: Subject| {
        let places = Places::of((quantity, member), wanted, grid.corner())?;
        grid.orientation(&places, wanted.across)
    };
    let Err(error) = orientation(member) else {
        return Ok(Whose {
            member,
            is_said: title.is_some(),
            said: title.as_ref().map(Title::obeyed),
            title: title.map(|title| title.written),
        });
    };
    let other = match member {
        Subject::Gear => Subject::Pinion,
        _ => Subject::Gear,
    };
    if orientation(other).is_err() {
        return Err(error);
    }
    let places = Places::of((quantity, other), wanted, grid.corner())?;
    // a pinion's diameters may look like the gear's radii
    let is_plain = match &title {
        Some(_) => member == Subject::Gear,
        None => places.kind.is_said_by(wanted.position, grid.corner()),
    };
    if !is_plain {
        return Err(ImportError(format!(
            "{error}. Read as {} they lie on the {}'s flank: if they are that, say --member {}",
            places.kind.name(),
            other.name(),
            other.name()
        )));
    }
    let though = title.map_or_else(String::new, |title| {
        format!(", though row {} says `{}`", title.row + 1, title.written)
    });
    Ok(Whose {
        member: other,
        is_said: true,
        said: Some(format!(
            "these places lie on the {}'s flank alone: taken for the {}'s{though}",
            other.name(),
            other.name()
        )),
        title: None,
    })
}

/// The member that the first header names.
fn of_corner(corner: &str) -> Option<Subject> {
    names::one_member(corner).filter(|named| named.member().is_some())
}

/// A row above the header that says whose wear its values are.
struct Title {
    row: usize,
    written: String,
    member: Subject,
}

impl Title {
    fn obeyed(&self) -> String {
        format!(
            "row {}, `{}`: member {}",
            self.row + 1,
            self.written,
            self.member.name()
        )
    }

    /// Where the header or the user says that it is `member`.
    fn passed_over(&self, member: Subject) -> String {
        format!(
            "taken for the {}'s as stated, though row {} says `{}`",
            member.name(),
            self.row + 1,
            self.written
        )
    }
}

/// The row that names a quantity and one member, or nothing but a member, where no other such row names the other: `Verschleiß Rad [µm]`, `Rad`.
fn of_title(sheet: &Sheet, head: usize, quantity: Quantity) -> Option<Title> {
    let rows = sheet.rows.iter().enumerate().take(head);
    let titles: Vec<Title> = rows
        .filter_map(|(row, cells)| {
            let filled = cells.iter().map(|cell| cell.trim());
            let filled: Vec<&str> = filled.filter(|cell| !cell.is_empty()).collect();
            let written = filled.join(" ");
            let member = named_in(&written, quantity)?;
            Some(Title {
                row,
                written,
                member,
            })
        })
        .collect();
    let first = titles.first()?.member;
    let is_one = titles.iter().all(|title| title.member == first);
    titles.into_iter().next().filter(|_| is_one)
}

/// The one member whose wear a title speaks of.
fn named_in(title: &str, quantity: Quantity) -> Option<Subject> {
    let words = names::words(title);
    let says = |is: &dyn Fn(&str) -> bool| words.iter().any(|word| is(word));
    let names_values = says(&|word| names::quantity(word).is_some_and(|(of, _)| of == quantity))
        || names::speaks_of_deviation(title);
    // whose revolutions are counted is another matter
    let counts = says(&|word| names::revolutions(word).is_some());
    let is_all = names::member(title.trim_matches([' ', ':'])).is_some();
    // any pair has `gear wear`, and `Rad 1` is the pinion
    let is_plain =
        says(&|word| word != "gear" && names::member(word).is_some()) && !says(&|word| word == "1");
    let member = names::one_member(title).filter(|member| member.member().is_some());
    member.filter(|_| is_all || names_values && is_plain && !counts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_say_whose_wear_they_speak_of() {
        for (title, member) in [
            ("Verschlei\u{df} Rad [\u{b5}m]", Some(Subject::Gear)),
            (
                "Pr\u{fc}fprotokoll Verschlei\u{df} Rad",
                Some(Subject::Gear),
            ),
            ("Usure roue (\u{b5}m)", Some(Subject::Gear)),
            ("Usura pignone", Some(Subject::Pinion)),
            ("Verschlei\u{df} Ritzel und Rad", None),
            ("Verschlei\u{df} nach Umdrehungen Rad", None),
            ("Corona", Some(Subject::Gear)),
            ("Gear:", Some(Subject::Gear)),
            ("Pinion and gear", None),
            ("Gear wear, run A", None),
            ("Verschlei\u{df} Rad 1", None),
            ("Zeichnung Rad 4711", None),
        ] {
            assert_eq!(named_in(title, Quantity::WearDepth), member, "{title}");
        }
    }
}
