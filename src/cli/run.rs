//! `gearwear run`: mesh, contact and wear history of one study at its operation or at a test's conditions.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use super::args::StudyAndOutput;
use super::folder;
use super::progress::Progress;
use super::{CliError, Context, Outcome};
use crate::contact::model::ContactError;
use crate::report::{self, FieldsWritten, atomic};
use crate::simulate::checkpoint::{Checkpoint, CheckpointError, Fingerprint, fingerprint};
use crate::simulate::forward::ForwardError;
use crate::simulate::members::Members;
use crate::simulate::paper_run;
use crate::simulate::result::Run;
use crate::simulate::run::{Event, FIELDS_STAGE, Observer, Plan, RunError, run};
use crate::study::{ContactKind, Operation, Study, Test};
use crate::wear::archard::WearError;
use crate::wear::integrator::StepError;

/// Arguments of `run`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear run study.toml\n  gearwear run study.toml --test A -o results/A\n  gearwear run study.toml --resume\n  gearwear run study.toml --json --quiet | jq .wear"
)]
pub struct RunArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
    /// Run at the conditions of the test with this id instead of the study's operation
    #[arg(long, value_name = "ID")]
    test: Option<String>,
    /// Continue from the checkpoint of an interrupted run; a finished run is left alone
    #[arg(long)]
    resume: bool,
}

/// Checks the input and the folder, simulates, writes.
pub(super) fn execute(args: &RunArgs, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.paths.study)?;
    let conditions = study.conditions(args.test.as_deref())?;
    let target = args
        .paths
        .output
        .clone()
        .unwrap_or_else(|| folder::default_path(&args.paths.study, "run"));
    let _reserved = folder::reserve(&target, &args.paths.study, &study)?;
    let keeper = Keeper::new(&study, args, &target)?;
    let start = if args.resume { keeper.read()? } else { None };
    if args.resume && start.is_none() && keeper.made(&target) {
        return already_finished(&target);
    }
    let again = match &args.paths.output {
        Some(target) => format!(" -o {}", target.display()),
        None => String::new(),
    };
    let of_test = args.test.as_deref().map(|id| format!(" --test {id}"));
    super::interrupt::tells(
        keeper.path.clone(),
        format!(
            "gearwear run {}{}{again} --resume goes on",
            args.paths.study.display(),
            of_test.unwrap_or_default()
        ),
    );
    let progress = context.progress("run");
    let test = args.test.as_deref();
    let result = simulate(&study, conditions, test, start, &keeper, &progress)?;
    progress.stage_at(WRITING, "tables, fields and report");
    let pair = study.gears.pair(conditions.misalignment_mm).ok();
    let inputs = keeper.inputs(&study);
    let watch = |fields: FieldsWritten| progress.show(written_by(fields), doing(fields));
    let written = report::write_run_with(&result, pair.as_ref(), &inputs, &target, &watch)?;
    drop(progress);
    keeper.discard();
    let json = report::json::summary(&result)?;
    Ok(Outcome {
        json,
        text: report::text::summary(&result, &args.paths.study, &written.folder),
        success: true,
    })
}

/// Share of a run that is done when so much of its fields is written.
fn written_by(fields: FieldsWritten) -> f64 {
    WRITING + (1.0 - WRITING) * fields.files as f64 / (fields.of + 1) as f64
}

/// What goes on while fields are written.
fn doing(fields: FieldsWritten) -> String {
    format!(
        "{:.0} MB of fields, {} of {} files, and report",
        fields.bytes as f64 / 1e6,
        fields.files,
        fields.of
    )
}

/// Share of a run's time by which its stages begin: meshes and compliance, wear, stress fields, writing. Of the reference pair with
/// four drawn positions and five states; where more is drawn the later stages take longer than that.
const WEAR: f64 = 0.12;
const FIELDS: f64 = 0.6;
const WRITING: f64 = 0.85;

fn simulate(
    study: &Study,
    conditions: &Operation,
    test: Option<&str>,
    start: Option<Checkpoint>,
    keeper: &Keeper,
    progress: &Progress,
) -> Result<Run, CliError> {
    let set = study.gear_set_at(conditions);
    let acting = study.acting(conditions);
    let effects: Vec<String> = study.effects().iter().map(ToString::to_string).collect();
    let plan = Plan {
        acting: acting.as_ref(),
        surroundings: study.surroundings(conditions),
        effects: &effects,
        title: &study.title,
        test,
        set: &set,
        conditions: conditions.simulated(&study.wear_at(conditions)),
        numerics: study.resolution(),
        kind: match study.contact {
            ContactKind::Fem => crate::simulate::forward::ContactKind::Fem,
            ContactKind::Hertz | ContactKind::Paper => crate::simulate::forward::ContactKind::Hertz,
        },
        stored_states: study.numerics.stored_states,
        drawn_positions: study.numerics.fields,
        root_stress: true,
    };
    if study.contact == ContactKind::Paper {
        return Ok(paper_run::run(&plan)?);
    }
    let own = own_members(study, &plan)?;
    let mut watcher = Watcher { keeper, progress };
    let refused = |error| {
        if matches!(error, RunError::WornAway(_)) {
            // the same again, whatever was kept
            keeper.discard();
        }
        refused(study, &torque_key(study, test), error)
    };
    run(&plan, own.as_ref(), start, &mut watcher).map_err(refused)
}

/// The key that states the torque of `test`, or of the study's operation.
fn torque_key(study: &Study, test: Option<&str>) -> String {
    let own = |t: &Test| t.conditions.torque_nmm != study.operation.torque_nmm;
    let place = study
        .tests
        .iter()
        .position(|t| Some(t.id.as_str()) == test && own(t));
    place.map_or("operation.torque".to_owned(), |i| {
        format!("test[{i}].torque")
    })
}

/// Errors of a run that are unusable input: a user's own mesh that lacks the fine flank of a tooth which can touch, and a
/// torque so small that its contact cannot be resolved, or so large that the new gears give way too far.
fn refused(study: &Study, torque: &str, error: RunError) -> CliError {
    let torque = |allowed: &str, hint: &str| {
        CliError::Study(study.refuse(torque, &error.to_string(), allowed, hint))
    };
    if let RunError::Forward(ForwardError::TooFine { .. }) = &error {
        return torque(
            "a torque whose contact the flanks' elements can resolve",
            "numerics.elements_per_half_width sets how finely",
        );
    }
    if let Some(ContactError::TooSoft { .. } | ContactError::OutOfReach { .. }) = of_contact(&error)
    {
        return torque(
            "a torque under which the gears deform little",
            "stiffer gears also help: a larger youngs_modulus or face_width, a wider bore",
        );
    }
    if let RunError::Forward(ForwardError::Contact(ContactError::NoFlank { side, .. })) = &error
        && let (member, Some(path)) = study.own_meshes()[*side]
    {
        let message = format!("{}: {error}", path.display());
        return super::mesh::refusal(study, member, &message);
    }
    error.into()
}

/// The contact problem that stopped a run before any wear.
fn of_contact(error: &RunError) -> Option<&ContactError> {
    match error {
        RunError::Forward(ForwardError::Contact(error)) => Some(error),
        RunError::Forward(ForwardError::Step(StepError::System {
            source: WearError::Contact(error),
            ..
        })) => Some(error),
        _ => None,
    }
}

/// The members on the user's own meshes, if the study names any.
pub(super) fn own_members(study: &Study, plan: &Plan) -> Result<Option<Members>, CliError> {
    let named = study.own_meshes();
    if named.iter().all(|(_, path)| path.is_none()) {
        return Ok(None);
    }
    let torque = [plan.conditions.torque];
    let misalignment = [plan.conditions.misalignment];
    let mut meshes = [None, None];
    for (slot, (member, path)) in meshes.iter_mut().zip(named) {
        if let Some(path) = path {
            *slot = Some(super::mesh::read_own(study, member, path)?);
        }
    }
    Ok(Some(plan.set.members_on(
        &plan.numerics,
        &torque,
        &misalignment,
        meshes,
    )?))
}

/// File of a result folder that tells which input it was made from.
const FINGERPRINT: &str = "input.sha256";

/// Keeps the checkpoint of one run, and knows its input.
struct Keeper {
    path: PathBuf,
    identity: Fingerprint,
    hex: String,
}

impl Keeper {
    /// All that the results depend on counts: the study's text, the test, the user's own meshes and measured profiles.
    fn new(study: &Study, args: &RunArgs, target: &Path) -> Result<Self, CliError> {
        let test = args.test.as_deref().unwrap_or("");
        let mut parts = vec![study.text().as_bytes().to_vec(), test.as_bytes().to_vec()];
        for (member, path) in study.own_meshes() {
            let mesh = path.map_or(Ok(Vec::new()), |path| {
                fs::read(path).map_err(|error| {
                    let message = format!("cannot read {}: {error}", path.display());
                    super::mesh::refusal(study, member, &message)
                })
            })?;
            parts.push(mesh);
        }
        for gear in [&study.gears.pinion, &study.gears.gear] {
            if !gear.profile.is_empty() {
                parts.push(format!("{:?}", gear.profile).into_bytes());
            }
        }
        if study.leads.iter().any(Option::is_some) {
            parts.push(format!("{:?}", study.face).into_bytes());
        }
        let parts: Vec<&[u8]> = parts.iter().map(Vec::as_slice).collect();
        let identity = fingerprint(&parts);
        Ok(Self {
            path: folder::checkpoint_path(target),
            identity,
            hex: identity.iter().map(|b| format!("{b:02x}")).collect(),
        })
    }

    /// Files that say what a result was made from.
    fn inputs<'a>(&'a self, study: &'a Study) -> [(&'static str, &'a [u8]); 2] {
        [
            ("study.toml", study.text().as_bytes()),
            (FINGERPRINT, self.hex.as_bytes()),
        ]
    }

    /// Whether the finished result in `folder` was made from the same input.
    fn made(&self, folder: &Path) -> bool {
        atomic::is_result(folder)
            && fs::read_to_string(folder.join(FINGERPRINT)).is_ok_and(|found| found == self.hex)
    }

    fn read(&self) -> Result<Option<Checkpoint>, CliError> {
        let bytes = match fs::read(&self.path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(source) => {
                return Err(CliError::Io {
                    doing: "read",
                    path: self.path.clone(),
                    source,
                });
            }
        };
        match Checkpoint::from_bytes(&bytes, &self.identity) {
            Ok(checkpoint) => Ok(Some(checkpoint)),
            // writes are atomic, so a damaged file is another version's or was tampered with: no ground to go on from
            Err(CheckpointError::Damaged) => Ok(None),
            Err(source) => Err(CliError::Checkpoint {
                path: self.path.clone(),
                source,
            }),
        }
    }

    fn discard(&self) {
        // the result is in place; a checkpoint that cannot be removed does no harm, --resume would end in the same result
        let _ = atomic::remove_file(&self.path);
    }
}

struct Watcher<'a> {
    keeper: &'a Keeper,
    progress: &'a Progress,
}

impl Observer for Watcher<'_> {
    fn event(&mut self, event: Event) -> bool {
        match event {
            Event::Stage(name) if name == FIELDS_STAGE => self.progress.stage_at(FIELDS, name),
            Event::Stage(name) => self.progress.stage(name),
            Event::Step { fraction, report } => {
                let [pinion, gear] = report.max_depth.map(|h| 1e3 * h);
                let doing = format!(
                    "{:.0} cycles, pinion {pinion:.2} µm, gear {gear:.2} µm, worn area law/geometry {:.1e}",
                    report.stand.n,
                    report.balance.error()
                );
                self.progress.show(WEAR + (FIELDS - WEAR) * fraction, doing);
            }
        }
        true
    }

    fn keep(&mut self, checkpoint: &Checkpoint) -> Result<(), String> {
        atomic::write_file(
            &self.keeper.path,
            &checkpoint.to_bytes(&self.keeper.identity),
        )
        .map_err(|e| e.to_string())
    }
}

fn already_finished(folder: &Path) -> Result<Outcome, CliError> {
    let path = folder.join("summary.json");
    let unreadable = |source| CliError::Io {
        doing: "read",
        path: path.clone(),
        source,
    };
    let text = fs::read_to_string(&path).map_err(unreadable)?;
    let json = serde_json::from_str(&text).map_err(|error| unreadable(error.into()))?;
    Ok(Outcome {
        json,
        text: format!("finished already: {}\n", folder.display()),
        success: true,
    })
}
