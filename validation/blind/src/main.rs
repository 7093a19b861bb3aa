//! Wear measurements with a hidden cause, made without anything of the solver that they judge, and the judging.

mod banded;
mod bench;
mod checks;
mod climb;
mod contact;
mod detect;
mod dice;
mod draw;
mod extend;
mod files;
mod hidden;
mod involute;
mod laws;
mod layout;
mod make;
mod messy;
mod observe;
mod passage;
mod records;
mod rig;
mod ring;
mod score;
mod trace;
mod uneven;
mod wear;

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use clap::{Parser, Subcommand, ValueEnum};

use make::{Kind, Wish};
use records::Record;
use trace::Trace;

#[derive(Parser)]
#[command(about = "Blind data for wear diagnosis, and their judging")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Clone, Copy, ValueEnum)]
enum Gear {
    Paper,
    Random,
}

#[derive(Subcommand)]
enum Command {
    /// Write data sets.
    Make {
        #[arg(long)]
        seed: u64,
        #[arg(long, default_value_t = 1)]
        count: u64,
        /// First index of the seed's series.
        #[arg(long, default_value_t = 0)]
        from: u64,
        #[arg(long)]
        out: PathBuf,
        /// Default: a mix (30 % none, 15 % single, 25 % foreign, 15 % outside, 15 % pair).
        #[arg(long)]
        class: Option<Kind>,
        /// Relative noise; default: 2, 5 or 10 %.
        #[arg(long)]
        noise: Option<f64>,
        #[arg(long)]
        gear: Option<Gear>,
        /// One cause, "name" or "name:form".
        #[arg(long)]
        law: Option<String>,
        /// Tilt one trace by several sigma.
        #[arg(long)]
        outlier: bool,
        /// Part of the points that is missing.
        #[arg(long, default_value_t = 0.0)]
        missing: f64,
        /// Divide the written sigma by this.
        #[arg(long, default_value_t = 1.0)]
        understate: f64,
        /// Tilt and shift traces, dirty and misjudge points, leave out checkpoints: the twin of the clean set.
        #[arg(long)]
        messy: bool,
        /// Also look which known causes of other names could explain the data (in truth.json; some seconds more).
        #[arg(long)]
        rivals: bool,
        /// Where across the face traces are taken, for causes that act there; default: any.
        #[arg(long)]
        trace: Option<Trace>,
        /// Whether columns `face` or `tooth` say what was measured; default: in half of the sets.
        #[arg(long)]
        stated: Option<bool>,
        /// Also measure transmission error, load share and mean lag.
        #[arg(long)]
        mesh: bool,
        /// Wanted detectability; default: 3 to 50.
        #[arg(long)]
        d: Option<f64>,
    },
    /// Measure one more test of a set that is there; the whole is written anew.
    Extend {
        set: PathBuf,
        /// torque,speed,misalignment,cycles (Nm, rpm, mm); may be given several times
        #[arg(long, required = true, allow_hyphen_values = true)]
        test: Vec<extend::Test>,
        #[arg(long)]
        out: PathBuf,
    },
    /// Judge diagnosis.json files against the answers.
    Score {
        /// Folder of the data sets.
        data: Option<PathBuf>,
        /// Folder of the diagnoses.
        #[arg(long, requires = "data")]
        results: Option<PathBuf>,
        /// Folder of climbs, each with climb.json and diagnosis.json: judged instead.
        #[arg(long, requires = "data", conflicts_with = "results")]
        climbs: Option<PathBuf>,
        /// Also count records kept in these files.
        #[arg(long)]
        records: Vec<PathBuf>,
        /// Keep what is counted here, a line each set.
        #[arg(long)]
        keep: Option<PathBuf>,
        /// Also write the figures as JSON here.
        #[arg(long)]
        json: Option<PathBuf>,
    },
    /// The generator's base model against published shares, stiffness and the open data.
    Check {
        #[arg(default_value = "all")]
        what: String,
    },
    /// List the causes.
    Laws,
}

fn main() -> Result<(), Box<dyn Error>> {
    match Arguments::parse().command {
        Command::Make {
            seed,
            count,
            from,
            out,
            class,
            noise,
            gear,
            law,
            outlier,
            missing,
            understate,
            messy,
            rivals,
            trace,
            stated,
            mesh,
            d,
        } => {
            let law = law.map(|l| match l.split_once(':') {
                Some((a, b)) => (a.to_string(), Some(b.to_string())),
                None => (l, None),
            });
            let start = Instant::now();
            for index in from..from + count {
                let folder = out.join(files::name_of(seed, index));
                if folder.join("truth.json").exists() {
                    continue;
                }
                let wish = Wish {
                    seed,
                    index,
                    kind: class,
                    noise,
                    paper: gear.map(|g| matches!(g, Gear::Paper)),
                    law: law.clone(),
                    outlier,
                    missing,
                    understate,
                    messy,
                    rivals,
                    trace,
                    stated,
                    mesh,
                    d,
                };
                let set = make::make(&wish);
                files::write(&set, &folder)?;
                let causes: Vec<String> = set
                    .laws
                    .iter()
                    .map(|l| format!("{}:{}", l.name, l.form))
                    .collect();
                println!(
                    "{} {} [{}] d {:.1} each {:.1?} rivals {:?} noise {} gear {} k {:.2e} attempts {} rows {} ({:.1} s)",
                    files::name(&set),
                    set.kind.name(),
                    causes.join(" + "),
                    set.d,
                    set.d_each,
                    set.rivals
                        .iter()
                        .take(2)
                        .map(|r| format!("{} {:.2} leaves {:.1}", r.name, r.share, r.left))
                        .collect::<Vec<_>>(),
                    set.noise,
                    if set.rig.paper { "paper" } else { "random" },
                    set.k,
                    set.attempts,
                    set.rows.len(),
                    start.elapsed().as_secs_f64()
                );
            }
        }
        Command::Extend { set, test, out } => {
            let set = extend::extend(&set, &test)?;
            files::write(&set, &out.join(files::name(&set)))?;
        }
        Command::Score {
            data,
            results,
            climbs,
            records,
            keep,
            json,
        } => {
            if let Some((data, climbs)) = data.as_ref().zip(climbs) {
                print!("{}", climb::table(data, &climbs)?);
                return Ok(());
            }
            let (mut all, mut missing) = (Vec::new(), Vec::new());
            for path in &records {
                all.extend(Record::of_file(path)?);
            }
            if let Some((data, results)) = data.zip(results) {
                let (new, without) = Record::of_folders(&data, &results)?;
                all.extend(new);
                missing = without;
            }
            if let Some(path) = keep {
                records::write(&all, &path)?;
            }
            let (text, figures) = score::score(&all, &missing);
            print!("{text}");
            if let Some(path) = json {
                std::fs::write(path, serde_json::to_string_pretty(&figures)?)?;
            }
        }
        Command::Check { what } => checks::print(&what),
        Command::Laws => {
            for (name, form) in draw::KNOWN.iter().copied().flatten() {
                println!("{name}: {form}");
            }
            for name in draw::OUTSIDE {
                println!("{name}: outside the catalogue");
            }
        }
    }
    Ok(())
}
