//! `gearwear init`: a commented study file and example measurements to start from.

use std::borrow::Cow;
use std::fs;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::json;

use super::{CliError, Outcome};

/// Arguments of `init`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear init\n  gearwear init my-gears\n  gearwear init --example plastic-steel pom\n  gearwear init --example hidden-effect walk\n  gearwear init --json my-gears"
)]
pub struct InitArgs {
    /// Folder to write into; made if it is not there [default: the current one]
    #[arg(value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Gear set to start from
    #[arg(long, value_enum, value_name = "NAME", default_value_t = Example::Paper)]
    example: Example,
    /// Overwrite study.toml, measurements.csv and template.csv
    #[arg(long)]
    force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Example {
    /// Steel, 27/53 teeth, module 2: the pair of a published wear study
    Paper,
    /// Steel, FZG type C, 16/24 teeth, module 4.5
    FzgC,
    /// Steel pinion, POM gear, 20/40 teeth, module 1, dry
    PlasticSteel,
    /// A measured pair with an effect that the model lacks: try compare, diagnose and add on it
    HiddenEffect,
}

/// An empty measurement file that says what stands where.
const TEMPLATE: &str = include_str!("examples/template.csv");

/// What an independent program measured on a pair like the reference one, something hidden in it.
const HIDDEN: &str = include_str!("../../validation/challenges/running_in_L1/measurements.csv");
/// The same at other conditions, without noise.
const HIDDEN_SEALED: &str = include_str!("../../validation/challenges/running_in_L1/sealed.csv");

impl Example {
    fn study(self) -> &'static str {
        match self {
            Example::Paper => include_str!("examples/paper.toml"),
            Example::FzgC => include_str!("examples/fzg-c.toml"),
            Example::PlasticSteel => include_str!("examples/plastic-steel.toml"),
            Example::HiddenEffect => include_str!("examples/hidden-effect.toml"),
        }
    }

    fn measurements(self) -> Cow<'static, str> {
        match self {
            Example::Paper => include_str!("examples/paper.csv").into(),
            Example::FzgC => include_str!("examples/fzg-c.csv").into(),
            Example::PlasticSteel => include_str!("examples/plastic-steel.csv").into(),
            Example::HiddenEffect => {
                let sealed = HIDDEN_SEALED.split_inclusive('\n');
                let rows = sealed.skip_while(|line| !line.starts_with("S,"));
                let note = "# the held-out test S: values without noise, sigma as if they had the others'\n";
                [HIDDEN, note]
                    .into_iter()
                    .chain(rows)
                    .collect::<String>()
                    .into()
            }
        }
    }

    /// Whether a measurement file holds what one of the examples does.
    pub(super) fn holds(text: &str) -> bool {
        Self::value_variants()
            .iter()
            .any(|example| text.lines().eq(example.measurements().lines()))
    }

    /// The command to go on with.
    fn next(self) -> &'static str {
        match self {
            Example::HiddenEffect => "compare",
            _ => "run",
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
    let files = [
        (folder.join("study.toml"), args.example.study().into()),
        (folder.join("measurements.csv"), args.example.measurements()),
        (folder.join("template.csv"), TEMPLATE.into()),
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
        fs::write(path, text.as_bytes()).map_err(|source| CliError::Io {
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
        "wrote {}, {} (made-up values to try with: put your own in their place) and {}, an empty measurement file that says what stands where\nnext: gearwear {} {}\n",
        written[0],
        written[1],
        written[2],
        args.example.next(),
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
    use crate::study::{KEY_DOCS, KEYS, Study, Without};

    use crate::effects::CATALOGUE;
    use crate::measure::Dataset;
    use crate::study::Role;

    fn study(example: Example) -> Study {
        Study::parse(example.study(), "study.toml").unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn every_example_is_a_valid_study_with_valid_measurements() {
        for example in Example::value_variants() {
            let study = study(*example);
            assert!(
                study.tests.len() >= 2 && study.measurements.is_some(),
                "{example:?}"
            );
            let data = example.measurements();
            Dataset::parse(&data, "measurements.csv", &study.known())
                .unwrap_or_else(|error| panic!("{error}"));
        }
    }

    #[test]
    fn the_paper_example_shows_every_key() {
        let text = Example::Paper.study();
        for (table, keys) in KEYS {
            for key in keys.iter().filter(|key| !["pinion", "gear"].contains(key)) {
                assert!(text.contains(key), "{table}: {key} is not in the example");
            }
        }
    }

    /// The template is a measurement file of every quantity once its examples are no comments.
    #[test]
    fn the_template_shows_every_quantity() {
        let study = study(Example::Paper);
        let filled = TEMPLATE.replace("\n# A,", "\nA,");
        let data = Dataset::parse(&filled, "template.csv", &study.known());
        let data = data.unwrap_or_else(|error| panic!("{error}"));
        for quantity in crate::measure::Quantity::ALL {
            assert!(
                data.observations.iter().any(|o| o.quantity == quantity),
                "{quantity:?}"
            );
            assert!(
                TEMPLATE.contains(&format!("{:<22}", quantity.name())),
                "{quantity:?}"
            );
        }
        for (column, _) in crate::measure::COLUMNS {
            assert!(
                TEMPLATE.contains(&format!("# {column}"))
                    || TEMPLATE.contains(&format!(", {column}")),
                "{column}"
            );
        }
    }

    /// What an example calls a default is the default.
    #[test]
    fn defaults_in_examples_are_the_defaults() {
        for example in Example::value_variants() {
            let text = example.study();
            let mut stated = 0;
            for (key, line) in text
                .lines()
                .filter_map(|l| Some((l.split_once(" =")?.0, l)))
            {
                let Some((_, default)) = line.split_once("; default ") else {
                    continue;
                };
                let key = key.trim_start_matches("# ");
                let doc = KEY_DOCS.iter().find(|doc| doc.key == key).unwrap();
                assert_eq!(
                    doc.without,
                    Without::Default(default),
                    "{example:?}: {line}"
                );
                stated += 1;
            }
            assert!(stated >= 6 || !text.contains("[numerics]"), "{example:?}");
        }
    }

    #[test]
    fn example_measurements_have_the_columns_of_the_format() {
        for example in Example::value_variants() {
            let measurements = example.measurements();
            let mut rows = measurements.lines().filter(|line| !line.starts_with('#'));
            assert_eq!(
                rows.next(),
                Some("test,member,cycles,quantity,position,value,sigma,trace")
            );
            assert!(rows.all(|row| row.split(',').count() == 8), "{example:?}");
        }
    }

    /// The hidden effect is the independent data's study and sealed test, and does not name what it hides.
    #[test]
    fn the_hidden_effect_stays_hidden() {
        let text = Example::HiddenEffect.study();
        let hidden = study(Example::HiddenEffect);
        let original = Study::parse(
            concat!(
                include_str!("../../validation/challenges/running_in_L1/study.toml"),
                "\n",
                include_str!("../../validation/challenges/running_in_L1/sealed.toml")
            ),
            "study.toml",
        )
        .unwrap();
        assert_eq!(
            (
                &hidden.gears,
                &hidden.materials,
                &hidden.tests,
                &hidden.wear
            ),
            (
                &original.gears,
                &original.materials,
                &original.tests,
                &original.wear
            )
        );
        assert_eq!(
            (hidden.lubricant, hidden.thermal),
            (original.lubricant, original.thermal)
        );
        assert_eq!(
            hidden.tests.last().map(|test| test.role),
            Some(Role::Holdout)
        );
        let both = format!("{text}{}", Example::HiddenEffect.measurements());
        for card in CATALOGUE {
            assert!(!both.contains(card.name), "{}", card.name);
        }
        let data = Example::HiddenEffect.measurements();
        let data = Dataset::parse(&data, "m.csv", &hidden.known()).unwrap();
        let held = data.observations.iter().filter(|row| row.test == 4).count();
        assert_eq!((data.observations.len(), held), (2280 + 570, 570));
    }
}
