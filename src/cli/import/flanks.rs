//! The flanks of several tables: a model wears the loaded one.

use std::collections::BTreeMap;

use super::understood::Understood;
use crate::cli::CliError;
use crate::measure::Subject;

/// The flank of each member in each test with the table that says it.
#[derive(Debug, Default)]
pub(super) struct Flanks(BTreeMap<(String, Subject), (String, String)>);

impl Flanks {
    /// Refuses a table of the other flank of a member in a test.
    pub(super) fn agree(&mut self, table: &str, understood: &Understood) -> Result<(), CliError> {
        let Some(flank) = understood.flank() else {
            return Ok(());
        };
        for entry in understood.entries() {
            let of = (entry.test.clone(), entry.member);
            let said = || (flank.to_owned(), table.to_owned());
            let (first, elsewhere) = self.0.entry(of).or_insert_with(said);
            if first.to_lowercase() != flank.to_lowercase() {
                return Err(CliError::Unusable(format!(
                    "{table} is of the flank `{flank}`, {elsewhere} of the flank `{first}`, both of the {} in test {}: wear is that of the loaded \
                     flank, so import the tables of that one only",
                    entry.member.name(),
                    entry.test
                )));
            }
        }
        Ok(())
    }
}
