//! `gearwear synthesize`: measurements of the study's own model, to plan tests and to try the other commands on.
//!
//! ```text
//! study -> copy that names measurements.csv (and has a test) -> its model at each test + noise -> result folder
//! ```

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use super::{CliError, Context, Outcome, fitting, folder};
use crate::learn::{self, Synthetic, contact_of};
use crate::measure::Dataset;
use crate::report::Staging;
use crate::report::comparison::quoted;
use crate::study::{Scatter, Study};

/// Arguments of `synthesize`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear synthesize study.toml -o made-up\n  gearwear synthesize study.toml -o made-up --noise 0.05 --seed 7\n  gearwear synthesize study+running_in.toml -o made-up && gearwear compare made-up/study.toml"
)]
pub struct SynthesizeArgs {
    /// Study file (TOML); it stays as it is
    #[arg(value_name = "STUDY")]
    study: PathBuf,
    /// Folder for study.toml and measurements.csv; a finished one is replaced, any other that is not empty is refused
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Noise relative to the largest value of each trace; 0.02 µm are added to it
    #[arg(long, value_name = "REL", default_value_t = 0.02, value_parser = noise, allow_negative_numbers = true)]
    noise: f64,
    /// Seed of the random numbers; the same seed gives the same measurements
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
}

/// File name of the study's copy.
const COPY: &str = "study.toml";
/// File name of the measurements.
const DATA: &str = "measurements.csv";
/// Id of the test of a study that has none.
const ONLY: &str = "A";

/// Checks the input and the folder, measures the model, writes.
pub(super) fn execute(args: &SynthesizeArgs, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.study)?;
    contact_of(&study)?;
    study.check_wears()?;
    let _reserved = folder::reserve(&args.output, &args.study, &study)?;
    let mut edit = study.edit();
    let folder = args.study.parent().unwrap_or(Path::new(""));
    edit.move_between(folder, &args.output)?;
    edit.measure_from(DATA);
    if study.tests.is_empty() {
        edit.add_test(ONLY);
    }
    let copy = edit.finish(&args.output.join(COPY).display().to_string())?;
    let progress = context.progress("synthesize");
    let synthetic = learn::synthesize(&copy, args.noise, args.seed, &|doing| {
        fitting::show(&progress, doing);
    })?;
    drop(progress);
    let text = measurements(&copy, &synthetic, args);
    // what cannot be read back is not written
    Dataset::parse(&text, DATA, &copy.known())?;
    let mut staging = Staging::begin(&args.output)?;
    staging.write(COPY, copy.text().as_bytes())?;
    staging.write(DATA, text.as_bytes())?;
    staging.commit()?;
    let written = [COPY, DATA].map(|name| args.output.join(name).display().to_string());
    Ok(Outcome {
        text: format!(
            "wrote {} and {}: {} made-up values of {} {}, seed {}\n{}next: gearwear compare {}\n",
            written[0],
            written[1],
            synthetic.data.observations.len(),
            copy.tests.len(),
            if copy.tests.len() == 1 {
                "test"
            } else {
                "tests"
            },
            args.seed,
            if copy.effect_model().is_empty() {
                ""
            } else {
                "the study keeps the effects that made the values: take its [[effect]] out to try gearwear diagnose on them\n"
            },
            written[0]
        ),
        json: json!({ "written": written }),
        success: true,
    })
}

/// The measurement file: what is true of it in comments, then the rows.
fn measurements(study: &Study, synthetic: &Synthetic, args: &SynthesizeArgs) -> String {
    let data = &synthetic.data;
    let mut text = String::new();
    let mut say = |line: String| {
        let _ = writeln!(text, "# {line}");
    };
    say(format!(
        "Synthetic: the study's own model as gearwear {} computes it, with noise. Nothing here was measured.",
        env!("CARGO_PKG_VERSION")
    ));
    say(format!(
        "seed {}; sigma = {} of the trace's largest value + 0.02 µm; datums: {} µm; scatter of k: {}",
        args.seed,
        args.noise,
        study.noise.datum_um,
        match study.noise.coefficient_scatter {
            Scatter::Relative(scatter) => scatter.to_string(),
            Scatter::Estimate => "none".to_owned(),
        }
    ));
    say(format!(
        "truth: contact = {}, wear.coefficient = {:e} mm2/N",
        study.contact.name(),
        study.wear.coefficient
    ));
    if study.wear.members != [1.0, 1.0] {
        let [pinion, gear] = study.wear.members.map(|of| of * study.wear.coefficient);
        say(format!(
            "truth: k of the pinion {pinion:e}, of the gear {gear:e} mm2/N"
        ));
    }
    for parameter in study.effect_model().parameters() {
        say(format!("truth: {} = {:?}", parameter.name, parameter.value));
    }
    for (test, k) in study.tests.iter().zip(&synthetic.coefficients) {
        if *k != study.wear.coefficient {
            say(format!(
                "truth: k of test {} = {k:e} mm2/N",
                test.id.escape_debug()
            ));
        }
    }
    text.push_str("test,member,cycles,quantity,position,value,sigma,trace\n");
    for o in &data.observations {
        let position = o.position.map(|p| p.to_string()).unwrap_or_default();
        let trace = o.trace.map_or("", |trace| &data.traces[trace].name);
        let _ = writeln!(
            text,
            "{},{},{},{},{position},{:.4},{:.4},{}",
            quoted(&data.tests[o.test]),
            o.member.name(),
            o.cycles,
            o.quantity.name(),
            o.value,
            o.sigma,
            quoted(trace)
        );
    }
    text
}

/// A relative noise.
fn noise(text: &str) -> Result<f64, String> {
    let value: f64 = text
        .parse()
        .map_err(|_| "a number is needed, for example 0.02")?;
    if (0.0..=1.0).contains(&value) {
        Ok(value)
    } else {
        Err("noise is a share of the largest value, 0 to 1".to_owned())
    }
}
