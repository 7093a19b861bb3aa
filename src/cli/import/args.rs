//! What `gearwear import` is asked: its options, their values and how these are read.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser as _};
use clap::{Args, ValueEnum};

use crate::measure::Quantity;
use crate::measure::import::Decimal;

/// Arguments of `import`.
#[derive(Debug, Args)]
#[command(
    after_help = "A wide table has a column for each checkpoint and positions in its first column, or the other way round. A long table has a row for each value and columns of tests, members, cycles, positions and values, under the usual names in English, German, Italian, French or Spanish. A file or a sheet may be of one curve, with test, member and cycles in lines above its header.\nNothing is written without -o.\n\nExamples:\n  gearwear import pinion.xlsx --study study.toml --test A --member pinion --sigma 0.2\n  gearwear import rig.xlsx --sheet gear --study study.toml --test A --member gear --sigma 0.2 -o measurements.csv --append\n  gearwear import depth.csv --study study.toml --test A --member pinion --unit mm --turn-sign --position roll-angle --sigma 0.2\n  gearwear import profiles.csv --study study.toml -o measurements.csv\n  gearwear import profiles/*.txt --study study.toml --turn-sign -o measurements.csv\n  gearwear import weighing.xlsx --study study.toml --quantity mass_loss -o measurements.csv --append\n  gearwear import weighing.csv --study study.toml --per-interval cycles,mass_loss --sigma 0.3"
)]
pub struct ImportArgs {
    /// Tables: .xlsx, or text with commas, semicolons or tabs
    #[arg(value_name = "TABLE", required = true, num_args = 1..)]
    pub(super) tables: Vec<PathBuf>,
    /// Study that the measurements belong to: its tests and gears
    #[arg(long, value_name = "STUDY")]
    pub(super) study: PathBuf,
    /// Sheet of the spreadsheet, once or several times [default: its only one]
    #[arg(long, value_name = "NAME")]
    pub(super) sheet: Vec<String>,
    /// Every sheet of the spreadsheets, one after the other
    #[arg(long, conflicts_with = "sheet")]
    pub(super) all_sheets: bool,
    /// Sheet that --all-sheets leaves out, once or several times
    #[arg(long, value_name = "NAME", requires = "all_sheets")]
    pub(super) skip_sheet: Vec<String>,
    /// Id of the test [default: what the table or the sheet's name says, or the study's only one]
    #[arg(long, value_name = "ID")]
    pub(super) test: Option<String>,
    /// What was measured on [default: what the table or the sheet's name says, the pinion otherwise, if the places cannot lie on the gear's flank]
    #[arg(long, value_enum, value_name = "MEMBER")]
    pub(super) member: Option<On>,
    /// What was measured [default: what a column of values is called, wear_depth otherwise]
    #[arg(long, value_name = "QUANTITY", value_parser = quantities())]
    pub(super) quantity: Option<Quantity>,
    /// Pinion revolutions after which a table of one curve was measured [default: what the table says]
    #[arg(long, value_name = "N")]
    pub(super) cycles: Option<f64>,
    /// How places on the flank are told [default: what the header says, a radius otherwise]
    #[arg(long, value_enum, value_name = "KIND")]
    pub(super) position: Option<PositionKind>,
    /// What the columns of a wide table are [default: what the numbers say]
    #[arg(long, value_enum, value_name = "WHAT")]
    pub(super) columns: Option<Across>,
    /// Unit of the values [default: what a header or a title says, the quantity's own otherwise]
    #[arg(long, value_name = "UNIT")]
    pub(super) unit: Option<String>,
    /// Mark of the decimals of a text [default: what the numbers say]
    #[arg(long, value_enum, value_name = "MARK")]
    pub(super) decimal: Option<Mark>,
    /// Reverse the sign: lost material is negative in the table
    #[arg(long)]
    pub(super) turn_sign: bool,
    /// What the table gives for each interval alone, not since the start of the test: the lengths of the intervals (revolutions or running times),
    /// a loss, or both with a comma between them (cycles,mass_loss). Each is added up along the rows of a test and member, the first interval on
    /// top; sigmas are combined as the root of the sum of their squares
    #[arg(long, value_enum, value_name = "WHAT", value_delimiter = ',')]
    pub(super) per_interval: Vec<PerInterval>,
    /// One standard deviation of every value, in the quantity's own unit (µm of depth); with --all-sheets of the sheets without a column of it
    /// [default: left empty, and estimated from the scatter of the values wherever the file is read]
    #[arg(long, value_name = "SIGMA", allow_negative_numbers = true, value_parser = sigma)]
    pub(super) sigma: Option<f64>,
    /// A standard deviation as a share (0.03: three percent), beside --sigma or alone, for scatter that grows with the wear
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, allow_negative_numbers = true, value_parser = share)]
    pub(super) relative_sigma: f64,
    /// Of what --relative-sigma is a share
    #[arg(long, value_enum, value_name = "OF", default_value_t = ShareOf::Value)]
    pub(super) relative_to: ShareOf,
    /// Distance from the middle of the face at which all rows were taken, mm [default: what a column `face` says]
    #[arg(long, value_name = "MM", allow_negative_numbers = true, value_parser = plain)]
    pub(super) face: Option<f64>,
    /// The instrument's zero is the same for all checkpoints: no trace of its own for each
    #[arg(long)]
    pub(super) no_traces: bool,
    /// Number of a repeated measurement at the same checkpoints: its traces have zeros of their own
    #[arg(long, value_name = "N", conflicts_with = "no_traces")]
    pub(super) repeat: Option<u32>,
    /// Measurement file to write
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Write the rows behind those of FILE
    #[arg(long, requires = "output")]
    pub(super) append: bool,
    /// Overwrite FILE
    #[arg(long, requires = "output", conflicts_with = "append")]
    pub(super) force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum On {
    Pinion,
    Gear,
    Pair,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum PositionKind {
    /// Radius, mm
    Radius,
    /// Diameter, mm
    Diameter,
    /// Roll angle from the base circle, degrees
    RollAngle,
    /// Roll length from the base circle, mm
    RollLength,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Across {
    /// Checkpoints, in pinion revolutions
    Checkpoints,
    /// Positions
    Positions,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(super) enum PerInterval {
    /// Revolutions or running times
    Cycles,
    /// Wear depths
    WearDepth,
    /// Masses lost
    MassLoss,
    /// What spans over several teeth lost
    SpanLoss,
    /// What chordal thicknesses lost
    ChordalLoss,
}

impl PerInterval {
    /// The quantity of a loss.
    pub(super) fn loss(self) -> Option<Quantity> {
        Some(match self {
            PerInterval::Cycles => return None,
            PerInterval::WearDepth => Quantity::WearDepth,
            PerInterval::MassLoss => Quantity::MassLoss,
            PerInterval::SpanLoss => Quantity::SpanLoss,
            PerInterval::ChordalLoss => Quantity::ChordalLoss,
        })
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ShareOf {
    /// Of each value
    Value,
    /// Of the largest value of its curve
    Largest,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Mark {
    /// 1.5
    Point,
    /// 1,5
    Comma,
}

impl From<Mark> for Decimal {
    fn from(mark: Mark) -> Self {
        match mark {
            Mark::Point => Decimal::Point,
            Mark::Comma => Decimal::Comma,
        }
    }
}

/// The names of all quantities.
fn quantities() -> impl clap::builder::TypedValueParser<Value = Quantity> {
    let named = |name: String| Quantity::ALL.into_iter().find(|known| known.name() == name);
    PossibleValuesParser::new(Quantity::ALL.map(Quantity::name))
        .try_map(move |name| named(name).ok_or("no quantity has this name"))
}

/// A standard deviation; a share is no such number.
fn sigma(text: &str) -> Result<f64, String> {
    if text.contains('%') {
        return Err("a share of each value goes by --relative-sigma 0.03, alone or beside --sigma in the unit of the values".to_owned());
    }
    plain(text)
}

/// A share; percent are no such number.
fn share(text: &str) -> Result<f64, String> {
    match text.trim_end().strip_suffix('%').map(str::trim_end) {
        Some(percent) => Err(match percent.parse::<f64>() {
            Ok(percent) => format!("write the share as a number: {}", percent / 100.0),
            Err(_) => "write the share as a number: 0.03 for three percent".to_owned(),
        }),
        None => plain(text),
    }
}

fn plain(text: &str) -> Result<f64, String> {
    text.parse()
        .map_err(|_| "write a number with a decimal point, without a unit: 0.2".to_owned())
}
