//! A sheet as one kind of table or the other.

use serde_json::json;

use crate::measure::import::{self, Entry, Long, Sheet, Titles, UnitFrom, Wanted, Wide};
use crate::numeric::written;

/// Either kind of table, as it was understood.
pub(super) enum Understood {
    Long(Long),
    Wide(Wide),
}

impl Understood {
    /// A sheet as either kind of table.
    pub(super) fn of(sheet: &Sheet, wanted: &Wanted<'_>) -> Result<Self, import::ImportError> {
        let (sheet, without) = import::without_words(sheet, &wanted.tests);
        let mut understood = match import::long(&sheet, wanted)? {
            Some(long) => Understood::Long(long),
            None => Understood::Wide(import::wide(&sheet, wanted)?),
        };
        understood.left_out_mut().extend(without);
        Ok(understood)
    }

    fn left_out_mut(&mut self) -> &mut Vec<String> {
        match self {
            Understood::Long(long) => &mut long.left_out,
            Understood::Wide(wide) => &mut wide.left_out,
        }
    }

    pub(super) fn entries(&self) -> &[Entry] {
        match self {
            Understood::Long(long) => &long.entries,
            Understood::Wide(wide) => &wide.entries,
        }
    }

    /// What is said of checkpoints that are those of rows that are there already.
    pub(super) fn joined(&self) -> &[String] {
        match self {
            Understood::Long(long) => &long.joined,
            Understood::Wide(wide) => &wide.joined,
        }
    }

    /// The cells, rows or columns that are left out, in words.
    pub(super) fn left_out(&self) -> &[String] {
        match self {
            Understood::Long(long) => &long.left_out,
            Understood::Wide(wide) => &wide.left_out,
        }
    }

    pub(super) fn titles(&self) -> &Titles {
        match self {
            Understood::Long(long) => &long.titles,
            Understood::Wide(wide) => &wide.titles,
        }
    }

    pub(super) fn flank(&self) -> Option<&str> {
        match self {
            Understood::Long(long) => long.flank.as_deref(),
            Understood::Wide(wide) => wide.flank.as_deref(),
        }
    }

    /// What was read as what, by which a table is like another.
    pub(super) fn columns(&self) -> Vec<(String, String)> {
        let (mut columns, turned) = match self {
            Understood::Long(long) => (long.columns.clone(), long.turned),
            Understood::Wide(wide) => (vec![wide.corner.clone()], wide.turned),
        };
        columns.push(("sign".to_owned(), turned.to_string()));
        columns
    }

    /// How the numbers were read, for messages about the rows.
    pub(super) fn reading(&self) -> Vec<String> {
        let wide = match self {
            Understood::Wide(wide) => wide,
            Understood::Long(long) => {
                let times = long
                    .columns
                    .iter()
                    .filter(|(_, what)| what.starts_with("running time"));
                return times
                    .map(|(written, what)| format!("the cycles are those of `{written}`: {what}"))
                    .collect();
            }
        };
        let mut said = Vec::new();
        if wide.of_gear {
            said.push("the headers count revolutions of the gear; these are the pinion's, by the numbers of teeth".to_owned());
        }
        let (unit, from) = &wide.unit;
        if *unit != wide.quantity.unit() {
            let by = match from {
                UnitFrom::Header => "the header says so",
                UnitFrom::Title => "the title says so",
                _ => "--unit",
            };
            said.push(format!(
                "the values were read in {} ({by})",
                written::unit(unit)
            ));
        }
        said
    }

    /// What is said of values of another size where nothing states their unit; none where something does.
    pub(super) fn unit_unstated(&self) -> Option<String> {
        let (_, from) = match self {
            Understood::Wide(wide) => &wide.unit,
            Understood::Long(long) => long.unit.as_ref()?,
        };
        (*from == UnitFrom::Quantity).then(|| {
            "nothing in the table states the unit of its values: say it with --unit".to_owned()
        })
    }

    /// What is said of values that are too large for the unit that a title or a header states; none where it is another one's matter.
    pub(super) fn unit_otherwise(&self) -> Option<String> {
        const SMALLER: [(&str, &str); 3] = [("mm", "um"), ("g", "mg"), ("kg", "g")];
        let (unit, from) = match self {
            Understood::Wide(wide) => &wide.unit,
            Understood::Long(long) => long.unit.as_ref()?,
        };
        let what = match from {
            UnitFrom::Header => "header",
            UnitFrom::Title => "title",
            _ => return None,
        };
        let (_, smaller) = SMALLER.iter().find(|(own, _)| own == unit)?;
        Some(format!(
            "the {what} says {unit}; the numbers look like {}",
            written::unit(smaller)
        ))
    }

    /// The document of `--json`, without what was written.
    pub(super) fn document(&self) -> serde_json::Value {
        let titles = |titles: &import::Titles| {
            let rows = titles.passed_over.iter().map(|(_, text)| text.clone());
            rows.collect::<Vec<String>>()
        };
        match self {
            Understood::Long(long) => json!({
                "columns": long.columns,
                "passed_over": long.passed_over,
                "titles_passed_over": titles(&long.titles),
                "checkpoints_joined": long.joined,
                "left_out": long.left_out,
                "sign_turned": long.turned,
                "empty": long.empty,
                "rows": long.entries.len(),
            }),
            Understood::Wide(wide) => json!({
                "columns": match (wide.across, wide.position) {
                    (import::Across::Checkpoints, _) => "checkpoints",
                    (import::Across::Positions, Some(_)) => "positions",
                    (import::Across::Positions, None) => "members",
                },
                "position": wide.position.map(|(kind, _)| kind.name()),
                "checkpoints": wide.checkpoints,
                "from_to": wide.position.map(|(_, from_to)| from_to),
                "passed_over": wide.passed_over,
                "titles_passed_over": titles(&wide.titles),
                "checkpoints_joined": wide.joined,
                "left_out": wide.left_out,
                "sign_turned": wide.turned,
                "empty": wide.empty,
                "rows": wide.entries.len(),
            }),
        }
    }
}
