//! What is said of the rows that stand apart from their neighbours.

use super::Outlier;
use crate::measure::Dataset;

impl Dataset {
    /// How many rows stand apart from their neighbours, and where they are listed, in a sentence; None where none does.
    pub fn outliers_counted(&self) -> Option<String> {
        let rows = self.rows_apart()?;
        Some(format!("{rows}; gearwear check lists them"))
    }

    /// How many rows stand apart from their neighbours, and how they count.
    fn rows_apart(&self) -> Option<String> {
        let first = self.outliers.first()?;
        let rows = match self.outliers.len() {
            1 => "1 row stands".to_owned(),
            n => format!("{n} rows stand"),
        };
        let counted = if self.observations[first.row].sigma > first.stated_sigma {
            match self.outliers.len() {
                1 => "counted with a sigma as large as it stands apart",
                _ => "counted with a sigma as large as they stand apart",
            }
        } else if self.outliers.len() == 1 {
            "counted as it is: correct it, or state [noise] outliers = \"robust\""
        } else {
            "counted as they are: correct them, or state [noise] outliers = \"robust\""
        };
        Some(format!(
            "{rows} apart from the neighbours along the trace, {counted}"
        ))
    }

    /// All rows that stand apart from their neighbours, in a sentence; None where none does.
    pub fn outliers_in_words(&self) -> Option<String> {
        let rows = self.rows_apart()?;
        let one = |outlier: &Outlier| {
            let o = &self.observations[outlier.row];
            let (value, expected) = (o.value, outlier.expected);
            let unit = o.quantity.shown_unit();
            let place = self.place(o);
            match outlier.meant {
                Some(meant) => format!(
                    "{place} ({value:.4} {unit} where the other profiles lead one to expect {expected:.4}: {meant:.4} with a slipped decimal point?)"
                ),
                None => format!(
                    "{place} ({value:.4} {unit} where {expected:.4} is expected by them, {:.0} times their scatter)",
                    outlier.apart
                ),
            }
        };
        let all: Vec<String> = self.outliers.iter().map(one).collect();
        Some(format!("{rows}: {}", all.join(", ")))
    }
}
