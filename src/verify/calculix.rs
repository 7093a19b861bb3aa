//! X1: single mesh positions solved again by CalculiX, from the deck that `gearwear export` writes.
//!
//! CalculiX gets the same meshes and torque and finds contact, pressure and the pinion's turn by its own code: penalty contact
//! between element faces, no line of action, no contact grid. Only the nodes are ours. Where the program `ccx` is not
//! installed the cases are skipped.

use std::path::Path;
use std::process::{Command, Stdio};
use std::{env, fs, io};

use crate::simulate::deck::deck;
use crate::simulate::forward::Conditions;
use crate::simulate::numerics::Numerics;
use crate::simulate::one_position::OnePosition;
use crate::verify::contact_and_wear::Effort;
use crate::verify::gear_pairs::GearCase;
use crate::verify::{CaseError, Measured};

/// Id of the cases.
pub const ID: &str = "X1";

/// Whence the targets come.
pub const SOURCE: &str =
    "independent program: CalculiX, face-to-face penalty contact on the same meshes";

/// Why the tolerances are what they are.
pub const REASON: &str = "2 % for the pinion's turn, 5 % for the peak pressure: penalty contact overlaps by 1 % of the flattened depth, and the \
     peak is CalculiX' largest integration point";

/// Why the cases are skipped where they are.
pub const ABSENT: &str = "CalculiX (the program ccx) is not installed";

/// Mesh positions, base pitches from the pitch point: one tooth pair at the pitch point, and two pairs that share the load.
const POSITIONS: [f64; 2] = [0.0, 0.5];

/// Flank edges per Hertz half width: the default of a study.
const FINENESS: f64 = 5.0;

/// What CalculiX found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// Turn of the pinion's bore, rad.
    pub turn: f64,
    /// Largest contact pressure of any integration point, MPa.
    pub peak_pressure: f64,
}

/// Why CalculiX gave no answer.
#[derive(Debug, thiserror::Error)]
pub enum CalculixError {
    /// The program is not there.
    #[error("{ABSENT}")]
    Absent,
    /// A file could not be written or read, or the program not be started.
    #[error("cannot {doing}: {source}")]
    Io {
        /// What was tried.
        doing: &'static str,
        /// The system's answer.
        source: io::Error,
    },
    /// It ended without a solution.
    #[error("CalculiX ended without a solution: {last}")]
    NoSolution {
        /// The last words it printed.
        last: String,
    },
}

/// Turn and peak pressure of REF and FZG-C at two positions each; an empty list where CalculiX is absent.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved, by us or by CalculiX.
pub fn all(effort: Effort) -> Result<Vec<Measured>, CaseError> {
    let mut out = Vec::new();
    if !installed() {
        return Ok(out);
    }
    let positions = match effort {
        Effort::Quick => &POSITIONS[..1],
        Effort::Full => &POSITIONS,
    };
    for case in [GearCase::reference()?, GearCase::fzg_c()?] {
        out.extend(resolved(&case, positions)?);
    }
    Ok(out)
}

/// One pair at each of `positions`.
fn resolved(case: &GearCase, positions: &[f64]) -> Result<Vec<Measured>, CaseError> {
    let numerics = Numerics {
        elements_per_half_width: FINENESS,
        ..Numerics::default()
    };
    let set = &case.set;
    let members = set
        .members(&numerics, &[case.torque], &[0.0])
        .map_err(CaseError::gears)?;
    let conditions = Conditions {
        torque: case.torque,
        speed: 1.0,
        misalignment: 0.0,
        cycles: 0.0,
        coefficient: [0.0; 2],
    };
    let mut out = Vec::new();
    for &position in positions {
        let ours = OnePosition::solve(set, &members, &conditions, &numerics, position)
            .map_err(CaseError::gears)?;
        let text = deck(case.name, set, &members, &ours).map_err(CaseError::gears)?;
        let theirs = solve(&text).map_err(CaseError::gears)?;
        let at = format!("{} at {position} base pitches", case.name);
        out.push(Measured::relative(
            ID,
            format!("{at}: turn of the pinion, µrad"),
            1e6 * ours.contact.approach,
            1e6 * theirs.turn,
            0.02,
        ));
        out.push(Measured::relative(
            ID,
            format!("{at}: peak pressure, MPa"),
            ours.peak().0,
            theirs.peak_pressure,
            0.05,
        ));
    }
    Ok(out)
}

/// Whether the program `ccx` can be started.
pub fn installed() -> bool {
    let mut version = Command::new("ccx");
    version
        .arg("-v")
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    version.status().is_ok()
}

/// Lets CalculiX solve a deck, in a folder that is removed afterwards.
///
/// # Errors
/// [`CalculixError`].
pub fn solve(deck: &str) -> Result<Answer, CalculixError> {
    if !installed() {
        return Err(CalculixError::Absent);
    }
    let folder = env::temp_dir().join(format!("gearwear-ccx-{}", std::process::id()));
    let failed = |doing| move |source| CalculixError::Io { doing, source };
    fs::create_dir_all(&folder).map_err(failed("make a folder for CalculiX"))?;
    let answer = solve_in(&folder, deck);
    // a folder that stays behind in the system's place for such does no harm
    let _ = fs::remove_dir_all(&folder);
    answer
}

fn solve_in(folder: &Path, deck: &str) -> Result<Answer, CalculixError> {
    let failed = |doing| move |source| CalculixError::Io { doing, source };
    fs::write(folder.join("deck.inp"), deck).map_err(failed("write the deck"))?;
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let output = Command::new("ccx")
        .arg("deck")
        .current_dir(folder)
        .env("OMP_NUM_THREADS", threads.to_string())
        .output()
        .map_err(failed("start CalculiX"))?;
    let answer = fs::read_to_string(folder.join("deck.dat"))
        .ok()
        .and_then(|printed| read(&printed));
    answer
        .filter(|_| output.status.success())
        .ok_or_else(|| CalculixError::NoSolution {
            last: last_words(&String::from_utf8_lossy(&output.stdout)),
        })
}

/// Turn and largest pressure of the last increment in CalculiX' list of printed values.
pub fn read(printed: &str) -> Option<Answer> {
    let block = |heading: &str| {
        let at = printed.rfind(heading)?;
        let lines = printed[at..].lines().skip(1);
        let cells = |line: &str| -> Option<Vec<f64>> {
            line.split_whitespace().map(|c| c.parse().ok()).collect()
        };
        let rows = lines
            .skip_while(|line| line.trim().is_empty())
            .map_while(move |line| cells(line).filter(|c| !c.is_empty()));
        Some(rows.collect::<Vec<Vec<f64>>>())
    };
    let turn = *block("displacements (vx,vy,vz)")?.first()?.get(1)?;
    let pressures = block("contact stress (")?;
    let peak_pressure = pressures
        .iter()
        .filter_map(|row| row.get(2).copied())
        .fold(0.0, f64::max);
    Some(Answer {
        turn,
        peak_pressure,
    })
}

fn last_words(output: &str) -> String {
    let mut lines: Vec<&str> = output
        .lines()
        .rev()
        .map(str::trim)
        .filter(|line| line.chars().any(char::is_alphabetic))
        .take(3)
        .collect();
    lines.reverse();
    lines.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_increment_counts() {
        let printed = "\n displacements (vx,vy,vz) for set TURN and time  0.5000000E+00\n\n         7  1.0E-04  0.0E+00  0.0E+00\n\n \
             contact stress (slave element+face,press,tang1,tang2) for all contact elements and time 0.5E+00\n\n  13  4  9.9E+02  0.0E+00  0.0E+00\n\n \
             displacements (vx,vy,vz) for set TURN and time  0.1000000E+01\n\n         7  3.466073E-04  0.0E+00  0.0E+00\n\n \
             contact stress (slave element+face,press,tang1,tang2) for all contact elements and time 0.1E+01\n\n  13  4  7.1E+01  0.0E+00  0.0E+00\n  13  4  8.1E+02  0.0E+00  0.0E+00\n";
        assert_eq!(
            read(printed),
            Some(Answer {
                turn: 3.466073e-4,
                peak_pressure: 810.0
            })
        );
        assert_eq!(read("nothing of it"), None);
    }
}
