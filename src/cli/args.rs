//! The arguments of the program: general options and one variant per command.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use super::{
    CliError, Context, Outcome, add, check, climb, compare, completions, diagnose, effects, export,
    import, init, ladder, materials, mesh, models, plan, run, schema, serve, sweep, synthesize,
    validate,
};

/// Finite-element contact and wear of spur and helical gears.
#[derive(Debug, Parser)]
#[command(
    name = "gearwear",
    version,
    about,
    long_about = "Finite-element contact and wear of spur and helical gears, from one study file (TOML).\n\n\
        Exit codes: 0 success, 2 unusable input (nothing is written), 1 any other failure.",
    after_help = "Examples:\n  gearwear init my-gears\n  gearwear run my-gears/study.toml\n  gearwear run my-gears/study.toml --test A -o results/A\n  gearwear validate",
    max_term_width = 100
)]
pub struct Arguments {
    /// Options of every command.
    #[command(flatten)]
    pub general: General,
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// Options of every command.
#[derive(Debug, Args)]
pub struct General {
    /// Show no progress and no summary; errors are still shown
    #[arg(short, long, global = true)]
    pub quiet: bool,
    /// Print one JSON document on standard output instead of a summary
    #[arg(long, global = true)]
    pub json: bool,
    /// Number of threads [default: all cores]; results do not depend on it
    #[arg(long, value_name = "N", global = true)]
    pub threads: Option<NonZeroUsize>,
}

/// The study file of a command and where its results go.
#[derive(Debug, Args)]
pub struct StudyAndOutput {
    /// Study file (TOML)
    #[arg(value_name = "STUDY")]
    pub study: PathBuf,
    /// Result folder; a finished one is replaced, any other that is not empty is refused [default: STUDYSTEM.out/COMMAND beside the study]
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Write a commented study file and example measurements to start from
    Init(init::InitArgs),
    /// Mesh, contact and wear history at the study's operation or a test's conditions: fields, tables, plots, report
    Run(run::RunArgs),
    /// Read the study and its measurements, say what was understood and what a comparison could conclude
    Check(check::CheckArgs),
    /// Turn a table with a column for each checkpoint or radius (.xlsx or text) into a measurement file
    Import(import::ImportArgs),
    /// Run the study over a grid of values: one table, one picture
    Sweep(sweep::SweepArgs),
    /// Compare the finite-element, Hertz and published models, and say which assumption makes each difference
    Models(models::ModelsArgs),
    /// Mesh both members, report the quality and write the meshes
    Mesh(mesh::MeshArgs),
    /// Write one mesh position as an input deck, for another finite-element program to solve again
    Export(export::ExportArgs),
    /// Fit what is free to the measurements and show how wrong the model is, and where
    Compare(compare::CompareArgs),
    /// Find the physical effect that the model lacks: ranks the catalogue, says how sure that is and what to measure next
    Diagnose(diagnose::DiagnoseArgs),
    /// Say what to measure next: tests that separate what the measurements leave, or a first campaign without any
    Plan(plan::PlanArgs),
    /// Add a physical effect to a study, its parameters and the wear coefficient fitted to the measurements unless set
    Add(add::AddArgs),
    /// Add one missing effect after the other, each only if it pays, until nothing more does
    Climb(climb::ClimbArgs),
    /// Put versions of a model side by side: the error of each on fitted and on held-out tests
    Ladder(ladder::LadderArgs),
    /// Answer samplers and other programs over HTTP (UM-Bridge): measured rows, likelihood, posterior, with exact gradients
    Serve(serve::ServeArgs),
    /// Make up measurements of the study's own model, with noise, to plan and to try
    Synthesize(synthesize::SynthesizeArgs),
    /// List the catalogue of physical effects, or tell all about one: formula, parameters, source, signature
    Effects(effects::EffectsArgs),
    /// List published wear coefficients of material pairs, or tell all about one: value, scatter, conditions, source
    Materials(materials::MaterialsArgs),
    /// Run the verification and validation cases; exit code 1 if one fails
    Validate(validate::ValidateArgs),
    /// Print the script that completes commands and options in a shell
    Completions(completions::CompletionsArgs),
    /// Print the JSON schema of study files, by which editors complete keys and mark mistakes
    Schema(schema::SchemaArgs),
}

impl Command {
    /// Does what the command is for.
    pub(super) fn execute(&self, context: &Context) -> Result<Outcome, CliError> {
        match self {
            Command::Init(args) => init::execute(args),
            Command::Run(args) => run::execute(args, context),
            Command::Models(args) => models::execute(args, context),
            Command::Mesh(args) => mesh::execute(args, context),
            Command::Export(args) => export::execute(args, context),
            Command::Check(args) => check::execute(args, context),
            Command::Import(args) => import::execute(args, context),
            Command::Serve(args) => serve::execute(args, context),
            Command::Sweep(args) => sweep::execute(args, context),
            Command::Compare(args) => compare::execute(args, context),
            Command::Diagnose(args) => diagnose::execute(args, context),
            Command::Plan(args) => plan::execute(args, context),
            Command::Add(args) => add::execute(args, context),
            Command::Climb(args) => climb::execute(args, context),
            Command::Ladder(args) => ladder::execute(args, context),
            Command::Synthesize(args) => synthesize::execute(args, context),
            Command::Effects(args) => effects::execute(args),
            Command::Materials(args) => materials::execute(args),
            Command::Validate(args) => validate::execute(args, context),
            Command::Completions(args) => completions::execute(args),
            Command::Schema(args) => schema::execute(args),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn every_command_shows_an_example() {
        Arguments::command().debug_assert();
        for command in Arguments::command().get_subcommands() {
            let help = command
                .get_after_help()
                .map(ToString::to_string)
                .unwrap_or_default();
            assert!(
                help.contains(&format!("gearwear {}", command.get_name())),
                "{}: {help}",
                command.get_name()
            );
        }
    }
}
