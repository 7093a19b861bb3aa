//! Tables: `wear.csv`, `contact.csv`, `transmission_error.csv`, and `transmission_error_turn.csv`.
//!
//! Numbers are the shortest digits that read back to the same double, so a table loses nothing.
use super::error::OutputError;
use crate::simulate::result::{Member, Run};

/// `wear.csv`: every stored state, both members, in the order cycles, member, radius.
///
/// Columns `cycles,member,radius,path,depth`: pinion revolutions; radius mm; signed mm along the path of contact from the
/// pitch point; µm. Where the face has several slices there is a further column `face` (mm from mid-face), and the rows are in the order
/// cycles, member, face, radius; where teeth differ a column `tooth` (the first one of a class, from 1), in the place of the face.
pub fn wear(run: &Run) -> Result<Vec<u8>, OutputError> {
    let sliced = run.states.iter().any(|state| !state.slices.is_empty());
    let toothed = run.states.iter().any(|state| !state.teeth.is_empty());
    let header = match (sliced, toothed) {
        (true, _) => "cycles,member,radius,path,depth,face",
        (_, true) => "cycles,member,radius,path,depth,tooth",
        _ => "cycles,member,radius,path,depth",
    };
    let mut table = Table::new("wear.csv", header);
    for state in &run.states {
        for member in Member::BOTH {
            let flank = state.profile(member);
            for (what, column) in [("path", &flank.path), ("depth", &flank.depth)] {
                same_length("wear.csv", what, column.len(), flank.radius.len())?;
            }
            let side = usize::from(member == Member::Gear);
            let slices = state.slices.iter();
            let of_slices = slices.map(|slice| (Some(slice.face), slice.depth[side].as_slice()));
            let classes = state.teeth.iter().filter(|class| class.member == member);
            let of_teeth =
                classes.map(|class| (Some(class.teeth[0] as f64), class.depth.as_slice()));
            let mut traces: Vec<(Option<f64>, &[f64])> = of_slices.chain(of_teeth).collect();
            if traces.is_empty() {
                traces.push((None, &flank.depth));
            }
            for (label, depths) in traces {
                same_length("wear.csv", "depth", depths.len(), flank.radius.len())?;
                for ((radius, path), depth) in flank.radius.iter().zip(&flank.path).zip(depths) {
                    table.number("cycles", state.cycles)?;
                    table.text(member.name());
                    table.number("radius", *radius)?;
                    table.number("path", *path)?;
                    table.number("depth", *depth)?;
                    if let Some(label) = label {
                        table.number(if toothed { "tooth" } else { "face" }, label)?;
                    }
                    table.end_row();
                }
            }
        }
    }
    Ok(table.into_bytes())
}

/// The columns of `contact.csv`.
const OF_PAIRS: &str = "cycles,position,pair,path,load_share,line_load,peak_pressure,half_width,off_line_of_action,at_corner,\
     sliding_speed_m_s,film_ratio,friction_coefficient,flash_temperature_k,friction_power_w";
/// The same where the face has several slices.
const OF_SLICES: &str = "cycles,position,pair,path,load_share,line_load,peak_pressure,half_width,off_line_of_action,at_corner,\
     sliding_speed_m_s,film_ratio,friction_coefficient,flash_temperature_k,friction_power_w,face";

/// `contact.csv`: every pair of every mesh position of every stored state.
///
/// Columns `cycles,position,pair,path,load_share,line_load,peak_pressure,half_width,off_line_of_action,at_corner`: position is
/// the pinion rotation from the pitch point in base pitches; mm; -; N/mm; MPa; mm; 1 where the pair touches outside the nominal
/// line of action; 1 where the end of a flank (a tip corner) is loaded, so that the mesh decides the peak pressure. Then
/// `sliding_speed_m_s,film_ratio,friction_coefficient,flash_temperature_k,friction_power_w`, empty where they do not follow from the study.
/// Where the face has several slices there is a further column `face`: the middle of the slice that `peak_pressure` is of, mm from mid-face, empty without load.
pub fn contact(run: &Run) -> Result<Vec<u8>, OutputError> {
    let sliced = run.states.iter().any(|state| !state.slices.is_empty());
    let mut table = Table::new("contact.csv", if sliced { OF_SLICES } else { OF_PAIRS });
    for state in &run.states {
        for position in &state.cycle {
            for pair in &position.pairs {
                table.number("cycles", state.cycles)?;
                table.number("position", position.position)?;
                table.text(&pair.pair.to_string());
                table.number("path", pair.path)?;
                table.number("load_share", pair.load_share)?;
                table.number("line_load", pair.line_load)?;
                table.number("peak_pressure", pair.peak_pressure)?;
                table.number("half_width", pair.half_width)?;
                for flag in [pair.off_line_of_action, pair.at_corner] {
                    table.text(if flag { "1" } else { "0" });
                }
                let sliding = &pair.sliding;
                table.number("sliding_speed_m_s", sliding.speed)?;
                for (name, value) in [
                    ("film_ratio", sliding.film_ratio),
                    ("friction_coefficient", sliding.friction),
                    ("flash_temperature_k", sliding.flash_temperature),
                    ("friction_power_w", sliding.power),
                ] {
                    table.number_or_nothing(name, value)?;
                }
                if sliced {
                    table.number_or_nothing("face", pair.face)?;
                }
                table.end_row();
            }
        }
    }
    Ok(table.into_bytes())
}

/// `transmission_error.csv`: lag of the gear seen at the pinion under load, µrad, worn material included.
///
/// Columns `cycles,position,angle`.
pub fn transmission_error(run: &Run) -> Result<Vec<u8>, OutputError> {
    let mut table = Table::new("transmission_error.csv", "cycles,position,angle");
    for state in &run.states {
        for position in &state.cycle {
            table.number("cycles", state.cycles)?;
            table.number("position", position.position)?;
            table.number("angle", position.angle_urad)?;
            table.end_row();
        }
    }
    Ok(table.into_bytes())
}

/// `transmission_error_turn.csv`: the same over one turn of the member with more teeth, where teeth differ or a member runs out;
/// else none.
///
/// Columns `cycles,position,angle`; the position counts base pitches since the first teeth met in the pitch point.
pub fn transmission_error_turn(run: &Run) -> Result<Option<Vec<u8>>, OutputError> {
    if run.states.iter().all(|state| state.turn.is_empty()) {
        return Ok(None);
    }
    let mut table = Table::new("transmission_error_turn.csv", "cycles,position,angle");
    for state in &run.states {
        for [position, angle] in &state.turn {
            table.number("cycles", state.cycles)?;
            table.number("position", *position)?;
            table.number("angle", *angle)?;
            table.end_row();
        }
    }
    Ok(Some(table.into_bytes()))
}

/// Shortest digits that read back to the same double; very large and very small ones with an exponent.
pub(super) fn exact(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if (1e-5..1e16).contains(&size) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

pub(super) fn finite(file: &str, what: &str, value: f64) -> Result<f64, OutputError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(OutputError::NotFinite {
            file: file.to_owned(),
            what: what.to_owned(),
            value,
        })
    }
}

pub(super) fn same_length(
    file: &str,
    what: &str,
    found: usize,
    expected: usize,
) -> Result<(), OutputError> {
    if found == expected {
        Ok(())
    } else {
        Err(OutputError::Length {
            file: file.to_owned(),
            what: what.to_owned(),
            found,
            expected,
        })
    }
}

/// A table being built; rows end explicitly, commas come by themselves.
pub(super) struct Table {
    file: &'static str,
    text: String,
    row_begins: bool,
}

impl Table {
    pub(super) fn new(file: &'static str, header: &str) -> Self {
        Table {
            file,
            text: format!("{header}\n"),
            row_begins: true,
        }
    }

    pub(super) fn text(&mut self, cell: &str) {
        if !self.row_begins {
            self.text.push(',');
        }
        self.text.push_str(cell);
        self.row_begins = false;
    }

    pub(super) fn number(&mut self, what: &str, value: f64) -> Result<(), OutputError> {
        let cell = exact(finite(self.file, what, value)?);
        self.text(&cell);
        Ok(())
    }

    /// A number, or an empty cell where there is none.
    pub(super) fn number_or_nothing(
        &mut self,
        what: &str,
        value: Option<f64>,
    ) -> Result<(), OutputError> {
        match value {
            Some(value) => self.number(what, value)?,
            None => self.text(""),
        }
        Ok(())
    }

    pub(super) fn end_row(&mut self) {
        self.text.push('\n');
        self.row_begins = true;
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.text.into_bytes()
    }
}
