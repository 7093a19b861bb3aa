//! `gearwear schema`: the JSON schema of study files, by which editors complete keys and mark mistakes.

use clap::Args;

use super::{CliError, Outcome};
use crate::study;

/// Arguments of `schema`.
#[derive(Debug, Args)]
#[command(
    after_help = "Editors with a TOML language server (Taplo, Even Better TOML) take it by a first line in the study:\n  #:schema ./study.schema.json\n\nExamples:\n  gearwear schema > study.schema.json"
)]
pub struct SchemaArgs {}

/// The schema is the result, so it is printed also with `--quiet`.
pub(super) fn execute(_: &SchemaArgs) -> Result<Outcome, CliError> {
    let schema = study::schema();
    Ok(Outcome {
        text: format!("{schema:#}\n"),
        json: schema,
        success: true,
    })
}
