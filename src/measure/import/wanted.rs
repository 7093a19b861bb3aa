//! What the user states of a table, and what the name of its sheet says.

use super::numbers::{pointed, rounded};
use super::place::PositionKind;
use super::{Across, Decimal, ImportError, PerInterval, Sheet, There, units};
use crate::gear::{Gear, Member};
use crate::measure::{Quantity, Subject, names};
use crate::source_text::is_misspelt;

/// Part of a running time by which it may miss the end of its test and still be that.
const SAME_TIME: f64 = 0.005;

/// What the user states of a table.
#[derive(Debug, Clone)]
pub struct Wanted<'a> {
    /// Ids of the study's tests.
    pub tests: Vec<&'a str>,
    /// Speed of the pinion, rpm, and cycles of each test.
    pub runs: Vec<[f64; 2]>,
    /// Torque on the pinion of each test, N m.
    pub torques: Vec<f64>,
    /// The gears, pinion first.
    pub gears: [&'a Gear; 2],
    /// Id of the test; the table or the sheet's name says it otherwise.
    pub test: Option<&'a str>,
    /// What was measured on; the table or the sheet's name says it otherwise.
    pub member: Option<Subject>,
    /// What was measured; the table says it otherwise.
    pub quantity: Option<Quantity>,
    /// Label of the tooth; what a column says otherwise.
    pub tooth: Option<String>,
    /// After how many pinion revolutions a curve was measured; the table says it otherwise.
    pub cycles: Option<f64>,
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
    /// One standard deviation, in the quantity's unit; left empty where neither it nor the share is known.
    pub sigma: Option<f64>,
    /// Whether a table with a column of them goes by that alone: the user's are those of other tables.
    pub sigma_of_others: bool,
    /// Another, independent one as a share.
    pub relative_sigma: f64,
    /// Of what it is a share.
    pub relative_to: ShareOf,
    /// Distance of all that was measured from the middle of the face, mm; what a column says otherwise.
    pub face: Option<f64>,
    /// Whether each checkpoint is a trace with a zero of its own.
    pub traces: bool,
    /// Number of a repeated measurement.
    pub repeat: Option<u32>,
    /// What the table gives for each interval alone, not since the start of the test.
    pub per_interval: PerInterval,
    /// The rows behind which those of the table come.
    pub there: There,
}

/// Of what a relative standard deviation is a share.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShareOf {
    /// Of each value.
    Value,
    /// Of the largest value of its curve.
    Largest,
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

    /// Revolutions of the pinion while the gear makes so many in a test: the end of the test if they are it to within the rounding of a
    /// revolution of the gear.
    pub(super) fn pinion_revolutions(&self, test: &str, of_gear: f64) -> f64 {
        let ratio = self.ratio();
        let revolutions = rounded(of_gear * ratio);
        match self.run(test) {
            Some([_, end]) if (revolutions - end).abs() <= 0.5 * ratio => end,
            _ => revolutions,
        }
    }

    /// Revolutions of the pinion in one of the gear.
    pub(super) fn ratio(&self) -> f64 {
        let [pinion, gear] = self.gears.map(|gear| f64::from(gear.spec.teeth));
        gear / pinion
    }

    /// Speed of the pinion, rpm, and cycles of a test.
    pub(super) fn run(&self, test: &str) -> Option<[f64; 2]> {
        let n = self.tests.iter().position(|id| *id == test)?;
        Some(self.runs[n])
    }

    /// Cycles of a test.
    pub(super) fn end(&self, test: &str) -> Option<f64> {
        self.run(test).map(|[_, end]| end)
    }

    /// Torque on the pinion of a test, N m.
    pub(super) fn torque(&self, test: &str) -> Option<f64> {
        let n = self.tests.iter().position(|id| *id == test)?;
        self.torques.get(n).copied()
    }

    /// Revolutions of the pinion in a running time of a test: so many times `hours`, as `written`. The end of the test if that is within the
    /// rounding of what is written.
    pub(super) fn revolutions_after(
        &self,
        test: &str,
        written: &str,
        time: f64,
        hours: f64,
    ) -> f64 {
        let decimals = pointed(written)
            .rsplit_once('.')
            .map_or(0, |(_, digits)| digits.len());
        // a whole number of hours may be meant to the minute
        let rounding = (0.5 * 10f64.powi(-(decimals as i32))).min(SAME_TIME * time);
        self.revolutions_in(test, hours * time, hours * rounding)
    }

    /// Revolutions of the pinion in so many hours of a test, known to within `rounding` hours: the end of the test if that is within.
    fn revolutions_in(&self, test: &str, hours: f64, rounding: f64) -> f64 {
        let Some([rpm, end]) = self.run(test) else {
            return hours;
        };
        let revolutions = 60.0 * rpm * hours;
        if (revolutions - end).abs() <= 60.0 * rpm * rounding {
            end
        } else {
            revolutions.round()
        }
    }

    /// Whether the user states a standard deviation.
    pub(super) fn states_sigma(&self) -> bool {
        self.sigma.is_some() || self.relative_sigma > 0.0
    }

    /// The one test that a table without a column of tests belongs to, and what says so beside the user.
    pub(super) fn one_test(&self, sheet: &Sheet) -> Result<(String, Option<&'static str>)> {
        let named = self.test_named(&sheet.name);
        match (self.test, named, self.tests.as_slice()) {
            (Some(id), _, tests) if !tests.contains(&id) => Err(self.no_test(id)),
            (Some(id), Some(other), _) if id != other => Err(ImportError(format!(
                "the sheet's name, `{}`, says test {other}, --test says {id}: say --test {other}, or rename the sheet",
                sheet.name
            ))),
            (Some(id), _, _) => Ok((id.to_owned(), None)),
            (None, Some(id), _) => Ok((id.to_owned(), Some("by the sheet's name"))),
            (None, None, [one]) => Ok(((*one).to_owned(), None)),
            (None, None, tests) => Err(ImportError(format!(
                "name the test with --test; the study's tests: {}. If the study lacks it, add a [[test]] to the study",
                tests.join(", ")
            ))),
        }
    }

    /// The study has no such test.
    pub(super) fn no_test(&self, id: &str) -> ImportError {
        let meant = match self.tests.iter().find(|other| may_mean(id, other)) {
            Some(other) => format!("; or is `{other}` meant?"),
            None => String::new(),
        };
        ImportError(format!(
            "the study has no test {id}; its tests: {}. Add a [[test]] with id = \"{id}\" to the study{meant}",
            self.tests.join(", ")
        ))
    }

    /// The test that a cell names: its id, or that behind a word for tests (`run A`).
    pub(super) fn test_of(&self, cell: &str) -> Option<&str> {
        let own = |text: &str| self.tests.iter().copied().find(|id| *id == text);
        own(cell).or_else(|| {
            let (word, id) = cell.split_once(|c: char| c.is_whitespace() || "_.:-".contains(c))?;
            (names::column(word) == Some("test")).then(|| own(id.trim()))?
        })
    }

    /// The test whose id stands in a column's header, and the header without it. An id that is a number has to follow a word for tests: `run 1, 5000`.
    pub(super) fn test_in_header(&self, header: &str) -> Option<(&str, String)> {
        let id = self.test_named(header)?;
        let is_number = id.parse::<f64>().is_ok();
        let place = places(id, header).find(|&at| {
            let before = names::words(&header[..at]);
            !is_number
                || before
                    .last()
                    .is_some_and(|word| names::column(word) == Some("test"))
        })?;
        let rest = [&header[..place], &header[place + id.len()..]].concat();
        Some((id, rest.trim().to_owned()))
    }

    /// The one test of which a title speaks: its id behind a word for tests, `wear, run A`, or an id that no other word is, `pinion V3`.
    pub(super) fn test_in_title(&self, title: &str) -> Option<&str> {
        let id = self.test_named(title)?;
        let follows_a_word_for_tests = |at: usize| {
            let before = names::words(&title[..at]);
            let last = before.last();
            last.is_some_and(|word| names::column(word) == Some("test"))
        };
        let has = |of: fn(char) -> bool| id.chars().any(of);
        let is_no_word = has(char::is_alphabetic) && has(char::is_numeric);
        (is_no_word || places(id, title).any(follows_a_word_for_tests)).then_some(id)
    }

    /// The one test whose id stands in a sheet's name or a header.
    pub(super) fn test_named(&self, sheet: &str) -> Option<&str> {
        let stands_in = |id: &str, text: &str| places(id, text).next().is_some();
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

/// Fewest letters of which one may be a slip.
const SLIP: usize = 4;

/// Whether an id may be another one misspelt: with the same digits, and but for case and signs the same or long enough for a slip.
fn may_mean(id: &str, other: &str) -> bool {
    let digits = |text: &str| -> String { text.chars().filter(char::is_ascii_digit).collect() };
    let is_slip = other.chars().count() >= SLIP && is_misspelt(id, other);
    digits(id) == digits(other) && (names::folded(id) == names::folded(other) || is_slip)
}

/// Where an id stands in a text as a word of its own.
fn places(id: &str, text: &str) -> impl Iterator<Item = usize> {
    // `20 °C` names no test C
    let outside = |c: Option<char>| {
        c.is_none_or(|c| !c.is_alphanumeric() && !['\u{b0}', '\u{ba}'].contains(&c))
    };
    let found = text
        .match_indices(id)
        .map(|(at, found)| (at, at + found.len()));
    let found = found.filter(move |&(from, to)| {
        outside(text[..from].chars().next_back()) && outside(text[to..].chars().next())
    });
    found
        .map(|(from, _)| from)
        .collect::<Vec<usize>>()
        .into_iter()
}
