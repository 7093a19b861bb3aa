//! `gearwear init`: a commented study file and example measurements to start from.

use std::fs;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::json;

use super::{CliError, Outcome};

/// Arguments of `init`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear init\n  gearwear init my-gears\n  gearwear init --example plastic-steel pom\n  gearwear init --json my-gears"
)]
pub struct InitArgs {
    /// Folder to write into; made if it is not there [default: the current one]
    #[arg(value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Gear set to start from
    #[arg(long, value_enum, value_name = "NAME", default_value_t = Example::Paper)]
    example: Example,
    /// Overwrite study.toml and measurements.csv
    #[arg(long)]
    force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Example {
    /// Steel, 27/53 teeth, module 2: the pair of a published wear study
    Paper,
    /// Steel, FZG type C, 16/24 teeth, module 4.5
    FzgC,
    /// Steel pinion, POM gear, 20/40 teeth, module 1, dry
    PlasticSteel,
}

impl Example {
    /// The study and the measurements.
    fn files(self) -> (&'static str, &'static str) {
        match self {
            Example::Paper => (
                include_str!("examples/paper.toml"),
                include_str!("examples/paper.csv"),
            ),
            Example::FzgC => (
                include_str!("examples/fzg-c.toml"),
                include_str!("examples/fzg-c.csv"),
            ),
            Example::PlasticSteel => (
                include_str!("examples/plastic-steel.toml"),
                include_str!("examples/plastic-steel.csv"),
            ),
        }
    }
}

/// Writes the files; nothing if one is there already and `--force` is not given.
pub(super) fn execute(args: &InitArgs) -> Result<Outcome, CliError> {
    let folder = args.folder.clone().unwrap_or_default();
    if folder.exists() && !folder.is_dir() {
        return Err(CliError::NotAFolder {
            path: folder.clone(),
        });
    }
    let (study, measurements) = args.example.files();
    let files = [
        (folder.join("study.toml"), study),
        (folder.join("measurements.csv"), measurements),
    ];
    if let Some((path, _)) = files
        .iter()
        .find(|(path, _)| path.is_dir() || (path.exists() && !args.force))
    {
        return Err(CliError::Exists { path: path.clone() });
    }
    fs::create_dir_all(&folder).map_err(|source| CliError::Io {
        doing: "create",
        path: folder.clone(),
        source,
    })?;
    for (path, text) in &files {
        fs::write(path, text).map_err(|source| CliError::Io {
            doing: "write",
            path: path.clone(),
            source,
        })?;
    }
    let written: Vec<String> = files
        .iter()
        .map(|(path, _)| path.display().to_string())
        .collect();
    let text = format!(
        "wrote {}\nnext: gearwear run {}\n",
        written.join(" and "),
        written[0]
    );
    Ok(Outcome {
        json: json!({ "written": written }),
        text,
        success: true,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{KEYS, Study};

    #[test]
    fn every_example_is_a_valid_study() {
        for example in Example::value_variants() {
            let study = Study::parse(example.files().0, "study.toml")
                .unwrap_or_else(|error| panic!("{error}"));
            assert!(
                study.tests.len() >= 2 && study.measurements.is_some(),
                "{example:?}"
            );
        }
    }

    #[test]
    fn the_paper_example_shows_every_key() {
        let text = Example::Paper.files().0;
        for (table, keys) in KEYS {
            for key in keys.iter().filter(|key| !["pinion", "gear"].contains(key)) {
                assert!(text.contains(key), "{table}: {key} is not in the example");
            }
        }
    }

    #[test]
    fn example_measurements_have_the_columns_of_the_format() {
        for example in Example::value_variants() {
            let (_, measurements) = example.files();
            let mut rows = measurements.lines().filter(|line| !line.starts_with('#'));
            assert_eq!(
                rows.next(),
                Some("test,member,cycles,quantity,position,value,sigma,trace")
            );
            assert!(rows.all(|row| row.split(',').count() == 8), "{example:?}");
        }
    }
}
