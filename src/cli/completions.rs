//! `gearwear completions`: the script that completes commands and options in a shell.

use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};
use serde_json::json;

use super::args::Arguments;
use super::{CliError, Outcome};

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

/// The script is the result, so it is printed also with `--quiet`.
pub(super) fn execute(args: &CompletionsArgs) -> Result<Outcome, CliError> {
    let mut script = Vec::new();
    generate(
        args.shell,
        &mut Arguments::command(),
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
