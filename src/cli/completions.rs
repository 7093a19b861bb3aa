//! `gearwear completions`: the script that completes commands and options in a shell.

use clap::builder::PossibleValuesParser;
use clap::{Args, Command, CommandFactory};
use clap_complete::{Shell, generate};
use serde_json::json;

use super::args::Arguments;
use super::{CliError, Outcome};
use crate::effects::CATALOGUE;
use crate::material::WEAR_PAIRS;

/// Arguments of `completions`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear completions bash > ~/.local/share/bash-completion/completions/gearwear\n  gearwear completions zsh > \"${fpath[1]}/_gearwear\"\n  gearwear completions fish > ~/.config/fish/completions/gearwear.fish"
)]
pub struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// The command with the catalogue's effects where one is named: a script offers them, the commands themselves have better words for an
/// unknown one.
fn with_effects(command: Command) -> Command {
    let offers = |command: Command| {
        command.mut_arg("effect", |argument| {
            argument.value_parser(PossibleValuesParser::new(
                CATALOGUE.iter().map(|card| card.name),
            ))
        })
    };
    command
        .mut_subcommand("materials", |command: Command| {
            command.mut_arg("pair", |argument| {
                argument.value_parser(PossibleValuesParser::new(
                    WEAR_PAIRS.iter().map(|pair| pair.name),
                ))
            })
        })
        .mut_subcommand("effects", offers)
        .mut_subcommand("add", offers)
}

/// The script is the result, so it is printed also with `--quiet`.
pub(super) fn execute(args: &CompletionsArgs) -> Result<Outcome, CliError> {
    let mut script = Vec::new();
    generate(
        args.shell,
        &mut with_effects(Arguments::command()),
        "gearwear",
        &mut script,
    );
    let text = String::from_utf8_lossy(&script).into_owned();
    Ok(Outcome {
        json: json!({"shell": args.shell.to_string(), "script": text}),
        text,
        success: true,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The script for fish has no values of arguments without a name: `clap_complete` writes none.
    #[test]
    fn effects_are_offered() {
        for shell in [Shell::Bash, Shell::Zsh] {
            let told =
                execute(&CompletionsArgs { shell }).unwrap_or_else(|error| panic!("{error}"));
            for card in CATALOGUE {
                assert!(told.text.contains(card.name), "{shell}: {}", card.name);
            }
        }
    }
}
