//! Floor 10: the command line. The only place that prints and that knows exit codes.
//!
//! ```text
//! arguments -> one command -> Outcome (a JSON document and a text) -> standard output, exit code
//!                          -> CliError                              -> standard error, exit code
//! ```
//!
//! A command is one file with its arguments and one function, one variant of [`args::Command`] and one arm of its
//! `execute`.

mod add;
pub mod args;
mod check;
mod climb;
mod compare;
mod completions;
mod diagnose;
mod each;
mod effects;
mod error;
mod export;
mod fitting;
mod folder;
mod import;
mod init;
mod inputs;
mod interrupt;
mod ladder;
mod materials;
mod mesh;
mod models;
mod plan;
mod progress;
mod run;
mod schema;
mod serve;
mod sweep;
mod synthesize;
mod text;
mod validate;

use std::ffi::OsString;
use std::io::{self, IsTerminal, Write};

use clap::Parser;

use crate::measure::Dataset;
pub use error::CliError;
use progress::Progress;

/// What a command that did its work hands back.
#[derive(Debug)]
pub(crate) struct Outcome {
    /// The document `--json` prints.
    pub(crate) json: serde_json::Value,
    /// What a person reads otherwise; several lines, the last one ended.
    pub(crate) text: String,
    /// Whether it went well; `false` (a validation case failed) ends with exit code 1.
    pub(crate) success: bool,
}

/// The general options, as commands see them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Context {
    quiet: bool,
}

impl Context {
    /// Says how a measurement file was read that is not written in the format's own way; silent with `--quiet`.
    pub(crate) fn tell_reading(&self, data: &Dataset) {
        if !self.quiet && !data.reading.is_empty() {
            let _ = writeln!(io::stderr(), "note: {}: {}", data.name, data.reading);
        }
    }

    /// Says something at once, on standard error; silent with `--quiet`.
    pub(crate) fn tell(&self, text: &str) {
        if !self.quiet {
            let _ = writeln!(io::stderr(), "{text}");
        }
    }

    /// A progress bar on standard error, hidden with `--quiet` and where nobody looks.
    pub(crate) fn progress(&self, what: &'static str) -> Progress {
        Progress::new(what, self.quiet)
    }
}

/// A document as `--json` prints it: as result files have it, without a minus before a zero.
fn printed(document: &serde_json::Value) -> Result<String, CliError> {
    let bytes = crate::report::json::text("standard output", document)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Runs the program with its arguments (the first is its name) and returns its exit code: 0 success, 2 unusable input
/// (nothing was written), 1 any other failure.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments = match args::Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        // Help and version are asked for; the rest is a mistake. A closed pipe is neither.
        Err(usage) => {
            let _ = usage.print();
            if let Some(near) = near_command(&usage) {
                let _ = writeln!(io::stderr(), "did you mean `gearwear {near}`?");
            }
            return if usage.use_stderr() { 2 } else { 0 };
        }
    };
    match execute(&arguments) {
        Ok(code) => code,
        Err(error) => {
            let coloured = io::stderr().is_terminal()
                && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
            let _ = writeln!(io::stderr(), "{}", error.render(coloured));
            error.exit_code()
        }
    }
}

/// Most letters by which a mistyped command may differ from the one that is meant.
const MISTYPED: usize = 2;

/// The command that an unknown one is like, where the parser of arguments names none.
fn near_command(usage: &clap::Error) -> Option<String> {
    use clap::error::{ContextKind, ContextValue};
    let Some(ContextValue::String(written)) = usage.get(ContextKind::InvalidSubcommand) else {
        return None;
    };
    if usage.get(ContextKind::SuggestedSubcommand).is_some() {
        return None;
    }
    let command = <args::Arguments as clap::CommandFactory>::command();
    let names = command.get_subcommands().map(clap::Command::get_name);
    let near = crate::source_text::nearest(written, names)?;
    (strsim::damerau_levenshtein(written, near) <= MISTYPED).then(|| near.to_owned())
}

fn execute(arguments: &args::Arguments) -> Result<u8, CliError> {
    // the program is parallel over bodies, positions and tests; inside a matrix more threads would change the last bits
    faer::set_global_parallelism(faer::Par::Seq);
    if let Some(threads) = arguments.general.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.get());
        pool.build_global().map_err(|source| CliError::Threads {
            threads: threads.get(),
            source,
        })?;
    }
    let general = &arguments.general;
    let outcome = arguments.command.execute(&Context {
        quiet: general.quiet,
    })?;
    let mut text = if general.json {
        printed(&outcome.json)?
    } else {
        outcome.text
    };
    // a script for the shell is a result, not a summary
    let result = matches!(
        arguments.command,
        args::Command::Completions(_) | args::Command::Schema(_)
    );
    if general.quiet && !general.json && !result {
        text.clear();
    }
    match io::stdout()
        .write_all(text.as_bytes())
        .and_then(|()| io::stdout().flush())
    {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(CliError::Print(error)),
        _ => Ok(if outcome.success { 0 } else { 1 }),
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::*;

    #[test]
    fn no_zero_is_printed_with_a_minus() {
        let document = serde_json::json!({"bias_um": -0.0, "rms_um": 0.5});
        let text = printed(&document).unwrap();
        assert_eq!(text, "{\n  \"bias_um\": 0.0,\n  \"rms_um\": 0.5\n}\n");
    }

    /// The threads of a process are started once: another number is a failure of the machine, not of the input.
    #[test]
    fn threads_that_cannot_be_started_are_said() {
        // starts those of this process, if no other test has
        assert!(rayon::current_num_threads() > 0);
        let arguments = args::Arguments::parse_from(["gearwear", "effects", "--threads", "3"]);
        let error = execute(&arguments).unwrap_err();
        assert!(
            matches!(error, CliError::Threads { threads: 3, .. }),
            "{error}"
        );
        assert_eq!(error.exit_code(), 1);
        assert!(
            error
                .render(false)
                .starts_with("error: cannot start 3 threads: ")
        );
    }

    /// What was understood stands before the reason, so that it is seen what the reason is about.
    #[test]
    fn what_was_understood_is_shown_before_the_reason() {
        let error = CliError::Shown {
            shown: "table    a.csv".to_owned(),
            why: "no uncertainty".to_owned(),
        };
        assert_eq!(error.exit_code(), 2);
        assert_eq!(error.render(false), "table    a.csv\nerror: no uncertainty");
    }
}
