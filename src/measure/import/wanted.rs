//! What the user states of a table, and what the name of its sheet says.

use super::numbers::rounded;
use super::place::PositionKind;
use super::{Across, Decimal, ImportError, Sheet, units};
use crate::gear::{Gear, Member};
use crate::measure::{Quantity, Subject, names};

/// What the user states of a table.
#[derive(Debug, Clone)]
pub struct Wanted<'a> {
    /// Ids of the study's tests.
    pub tests: Vec<&'a str>,
    /// The gears, pinion first.
    pub gears: [&'a Gear; 2],
    /// Id of the test; the table or the sheet's name says it otherwise.
    pub test: Option<&'a str>,
    /// What was measured on; the table or the sheet's name says it otherwise.
    pub member: Option<Subject>,
    /// What was measured; the table says it otherwise.
    pub quantity: Option<Quantity>,
    /// How places are told; the header says it otherwise.
    pub position: Option<PositionKind>,
    /// What the columns are; the numbers say it otherwise.
    pub across: Option<Across>,
    /// Unit of the values; what the headers say otherwise, or the quantity's own.
    pub unit: Option<&'a str>,
    /// Whether lost material is negative in the table.
    pub turn_sign: bool,
    /// How decimals are written; the numbers say it otherwise.
    pub decimal: Option<Decimal>,
    /// One standard deviation, in the quantity's unit; left empty where it is not known.
    pub sigma: Option<f64>,
    /// Another, independent one as a share of the value.
    pub relative_sigma: f64,
    /// Whether each checkpoint is a trace with a zero of its own.
    pub traces: bool,
    /// Number of a repeated measurement.
    pub repeat: Option<u32>,
}

/// What states the unit of values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitFrom {
    /// A header.
    Header,
    /// A row above the header.
    Title,
    /// The user.
    User,
    /// Nothing: it is the quantity's own.
    Quantity,
}

type Result<T> = std::result::Result<T, ImportError>;

impl Wanted<'_> {
    /// The gear of a member.
    pub(super) fn gear_of(&self, member: Subject) -> Option<&Gear> {
        let [pinion, gear] = self.gears;
        member.member().map(|member| match member {
            Member::Pinion => pinion,
            Member::Gear => gear,
        })
    }

    /// Revolutions of the pinion while the gear makes so many.
    pub(super) fn pinion_revolutions(&self, of_gear: f64) -> f64 {
        let [pinion, gear] = self.gears.map(|gear| f64::from(gear.spec.teeth));
        rounded(of_gear * gear / pinion)
    }

    /// The one test that a table without a column of tests belongs to, and whether the sheet's name says so.
    pub(super) fn one_test(&self, sheet: &Sheet) -> Result<(String, bool)> {
        let named = self.test_named(&sheet.name);
        match (self.test, named, self.tests.as_slice()) {
            (Some(id), _, tests) if !tests.contains(&id) => Err(self.no_test(id)),
            (Some(id), Some(other), _) if id != other => Err(ImportError(format!(
                "the sheet's name, `{}`, says test {other}, --test says {id}: say --test {other}, or rename the sheet",
                sheet.name
            ))),
            (Some(id), _, _) => Ok((id.to_owned(), false)),
            (None, Some(id), _) => Ok((id.to_owned(), true)),
            (None, None, [one]) => Ok(((*one).to_owned(), false)),
            (None, None, tests) => Err(ImportError(format!(
                "name the test with --test; its tests: {}",
                tests.join(", ")
            ))),
        }
    }

    /// The study has no such test.
    pub(super) fn no_test(&self, id: &str) -> ImportError {
        ImportError(format!(
            "the study has no test {id}; its tests: {}",
            self.tests.join(", ")
        ))
    }

    /// The one test whose id stands in a sheet's name.
    fn test_named(&self, sheet: &str) -> Option<&str> {
        let stands_in = |id: &str, text: &str| {
            text.match_indices(id).any(|(at, _)| {
                let outside = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric());
                outside(text[..at].chars().next_back())
                    && outside(text[at + id.len()..].chars().next())
            })
        };
        let named = self.tests.iter().copied().filter(|id| stands_in(id, sheet));
        let named: Vec<&str> = named.collect();
        // `A` in the name of `A-2`
        let whole = |id: &&&str| {
            !named
                .iter()
                .any(|other| other != *id && stands_in(id, other))
        };
        match named.iter().filter(whole).collect::<Vec<_>>()[..] {
            [one] => Some(one),
            _ => None,
        }
    }

    /// The member that the user or the sheet's name states of a quantity.
    pub(super) fn stated_member(
        &self,
        sheet: &Sheet,
        quantity: Quantity,
    ) -> Result<Option<Subject>> {
        let subjects = quantity.subjects();
        if let [only] = subjects {
            return Ok(Some(*only));
        }
        let named = names::one_member(&sheet.name).filter(|member| subjects.contains(member));
        match (self.member, named) {
            (Some(member), _) if !subjects.contains(&member) => Err(ImportError(format!(
                "{} is measured on one member: --member pinion or --member gear",
                quantity.name()
            ))),
            (Some(member), Some(other)) if member != other => Err(ImportError(format!(
                "the sheet's name, `{}`, says {}, --member says {}: say --member {}, or rename the sheet",
                sheet.name,
                other.name(),
                member.name(),
                other.name()
            ))),
            (member, named) => Ok(member.or(named)),
        }
    }

    /// The unit of a quantity's values, and what states it.
    pub(super) fn unit_of_values(
        &self,
        quantity: Quantity,
        header: Option<&str>,
        title: Option<&str>,
    ) -> Result<(String, UnitFrom)> {
        let stated = [
            (header, UnitFrom::Header, "the header says"),
            (title, UnitFrom::Title, "the title says"),
            (self.unit, UnitFrom::User, "--unit says"),
        ];
        let mut stated = stated
            .into_iter()
            .filter_map(|(unit, from, words)| Some((unit?, from, words)));
        let Some((unit, from, words)) = stated.next() else {
            return Ok((quantity.unit().to_owned(), UnitFrom::Quantity));
        };
        let factor = units::factor(unit, quantity)?;
        for (other, _, other_words) in stated {
            if units::factor(other, quantity) != Ok(factor) {
                return Err(ImportError(format!(
                    "{words} {unit}, {other_words} {other}: take the wrong one out"
                )));
            }
        }
        Ok((unit.to_owned(), from))
    }
}
