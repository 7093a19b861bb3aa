//! Which field file is what, and the `.pvd` series over them.
use std::fmt::Write;

use crate::report::csv::exact;
use crate::simulate::result::FieldFrame;

/// Where one frame is stored.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldFile {
    /// File name within the `fields` folder.
    pub name: String,
    /// Number of the wear state among those drawn, from 0.
    pub state: usize,
    /// Number of the mesh position within its state, from 0.
    pub step: usize,
}

/// A name for each frame: `wear_STATE_position_STEP.vtu`. Frames of equal cycles share a state number.
pub fn names(frames: &[FieldFrame]) -> Vec<FieldFile> {
    let mut files: Vec<FieldFile> = Vec::with_capacity(frames.len());
    for (index, frame) in frames.iter().enumerate() {
        let (state, step) = match files.last() {
            None => (0, 0),
            Some(last) if frames[index - 1].cycles == frame.cycles => (last.state, last.step + 1),
            Some(last) => (last.state + 1, 0),
        };
        files.push(FieldFile {
            name: format!("wear_{state:03}_position_{step:03}.vtu"),
            state,
            step,
        });
    }
    files
}

/// Members of `wear.pvd`: time is cycles; of each state the frame whose position is nearest to that of the very first frame.
pub fn wear_series(frames: &[FieldFrame], files: &[FieldFile]) -> Vec<(f64, String)> {
    let Some(start) = frames.first().map(|frame| frame.position) else {
        return Vec::new();
    };
    let mut series: Vec<(usize, usize)> = Vec::new();
    for (index, file) in files.iter().enumerate() {
        let distance = |i: usize| (frames[i].position - start).abs();
        match series.last_mut() {
            Some((state, best)) if *state == file.state => {
                if distance(index) < distance(*best) {
                    *best = index;
                }
            }
            _ => series.push((file.state, index)),
        }
    }
    series
        .into_iter()
        .map(|(_, index)| (frames[index].cycles, files[index].name.clone()))
        .collect()
}

/// One series per wear state that is drawn at several mesh positions, with its file name; time is the position in base pitches.
pub fn mesh_cycle_series(
    frames: &[FieldFrame],
    files: &[FieldFile],
) -> Vec<(String, Vec<(f64, String)>)> {
    let states = files.last().map_or(0, |file| file.state + 1);
    (0..states)
        .map(|state| {
            let members = || {
                files
                    .iter()
                    .zip(frames)
                    .filter(move |(file, _)| file.state == state)
            };
            let series: Vec<_> = members()
                .map(|(file, frame)| (frame.position, file.name.clone()))
                .collect();
            (format!("mesh_cycle_{state:03}.pvd"), series)
        })
        .filter(|(_, series)| series.len() > 1)
        .collect()
}

/// The text of a `.pvd` file over `(time, file name)`; the names are relative to its own folder.
pub fn pvd(series: &[(f64, String)]) -> Vec<u8> {
    let mut xml = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n",
    );
    for (time, name) in series {
        // Writing into a String cannot fail.
        let _ = writeln!(
            xml,
            "    <DataSet timestep=\"{}\" part=\"0\" file=\"{name}\"/>",
            exact(*time)
        );
    }
    xml.push_str("  </Collection>\n</VTKFile>\n");
    xml.into_bytes()
}
