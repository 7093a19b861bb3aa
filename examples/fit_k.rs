//! Fits the wear coefficient k to measurements and says how wrong the model then still is.
//!
//! `cargo run --release --example fit_k [STUDY.toml]` (default: made-up measurements of a pair whose k is known). The study names its
//! measurements and, in `[fit] free`, what may be adjusted; here nothing but k.

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use gearwear::learn::{ModelVersion, compare};
use gearwear::study::Study;

#[expect(clippy::print_stdout, reason = "an example shows what it found")]
fn main() -> Result<(), Box<dyn Error>> {
    let default = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/validation/challenges/none_L2/study.toml"
    );
    let path = std::env::args_os()
        .nth(1)
        .map_or(PathBuf::from(default), PathBuf::from);
    // With the analytic contact model, to be quick; without this `replace` the fit is made by finite elements.
    let text = fs::read_to_string(&path)?.replace("contact = \"fem\"", "contact = \"hertz\"");
    let study = Study::parse(&text, &path.display().to_string())?;
    let data = study.dataset()?;

    // What the study itself says: its effects, its free parameters.
    let version = ModelVersion::of(&study);
    let found = compare(&study, &data, &version, &|_| ())?.comparison;

    for parameter in &found.parameters {
        println!(
            "{} = {:.3e} ± {:.1e} {}",
            parameter.name, parameter.value, parameter.sigma, parameter.unit
        );
    }
    println!(
        "chi² per point {:.2}  (1: nothing left but noise)",
        found.chi2_per_point
    );
    for test in &found.tests {
        println!(
            "  test {:4} {:8} {:5} points, chi² {:6.2}, k {:.3e} mm²/N",
            test.test, test.role, test.points, test.chi2_per_point, test.coefficient
        );
    }
    println!("{}", found.worst);
    Ok(())
}
