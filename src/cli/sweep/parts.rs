//! Parts of a sweep for other machines, and the whole from its parts.
//!
//! ```text
//! --shard i/n          every n-th point                        one job of an array
//! --emit FILE          a line for each point or for some        -> --point LINE or -    one task of a task farm
//! --merge DIR...       the files that parts have left           -> the sweep, to the byte as one machine makes it
//! ```

use std::collections::BTreeSet;
use std::io::{self, Read};
use std::num::NonZeroUsize;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::kept::{self, Found};
use super::points::{Point, Result};
use super::{CliError, Design};
use crate::simulate::checkpoint::fingerprint;

/// One of `of` parts, from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shard {
    number: usize,
    of: usize,
}

/// Reads `i/n`.
pub(super) fn shard(text: &str) -> std::result::Result<Shard, String> {
    let wrong = || "write i/n: part i of n, i from 1 to n".to_owned();
    let (number, of) = text.split_once('/').ok_or_else(wrong)?;
    let read = |text: &str| text.trim().parse::<usize>().map_err(|_| wrong());
    let (number, of) = (read(number)?, read(of)?);
    if !(1..=of).contains(&number) {
        return Err(wrong());
    }
    Ok(Shard { number, of })
}

impl Shard {
    /// Whether a point (from 0) is one of the part's.
    pub(super) fn holds(self, point: usize) -> bool {
        point % self.of == self.number - 1
    }
}

/// A line of `--emit`: some points of a design.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Item {
    /// Numbers from 0.
    points: Vec<usize>,
    /// Which design they are numbered in.
    design: String,
}

/// What a design and its points are told by: other keys, values or inputs have another.
fn identity(points: &[Point]) -> String {
    let parts: Vec<String> = points
        .iter()
        .map(|point| format!("{} {}", point.key, point.values.join(" ")))
        .collect();
    let parts: Vec<&[u8]> = parts.iter().map(String::as_bytes).collect();
    let hash = fingerprint(&parts);
    hash[..8].iter().map(|b| format!("{b:02x}")).collect()
}

/// The lines for all points, `each` in a line.
pub(super) fn lines(points: &[Point], each: NonZeroUsize) -> (String, usize) {
    let design = identity(points);
    let numbers: Vec<usize> = (0..points.len()).collect();
    let items = numbers.chunks(each.get()).map(|chunk| Item {
        points: chunk.to_vec(),
        design: design.clone(),
    });
    let lines: Vec<String> = items
        .map(|item| serde_json::json!(item).to_string())
        .collect();
    (lines.join("\n") + "\n", lines.len())
}

/// The variable in which HyperQueue hands a line of `--each-line` to its task.
const ENTRY: &str = "HQ_ENTRY";

/// The points that a line names; `-` stands for the one in the environment, or on standard input.
///
/// # Errors
/// [`CliError::Unusable`] for a line that is none, or one of another design.
pub(super) fn named(
    line: &str,
    points: &[Point],
) -> std::result::Result<BTreeSet<usize>, CliError> {
    let text = if line == "-" {
        entry()?
    } else {
        line.to_owned()
    };
    let fault = |why: String| CliError::Unusable(format!("--point {}: {why}", text.trim()));
    let item: Item = serde_json::from_str(&text)
        .map_err(|error| fault(format!("no line of --emit: {error}")))?;
    if item.design != identity(points) {
        return Err(fault(
            "the line belongs to another sweep; give the study, keys, values and seed that --emit was given".to_owned(),
        ));
    }
    match item.points.iter().find(|point| **point >= points.len()) {
        Some(point) => Err(fault(format!(
            "there is no point {point}, the last is {}",
            points.len() - 1
        ))),
        None => Ok(item.points.into_iter().collect()),
    }
}

fn entry() -> std::result::Result<String, CliError> {
    if let Ok(text) = std::env::var(ENTRY) {
        return Ok(text);
    }
    let mut text = String::new();
    io::stdin().read_to_string(&mut text).map_err(|error| {
        CliError::Unusable(format!("--point -: cannot read standard input: {error}"))
    })?;
    Ok(text)
}

/// Most points that are listed.
const MOST_LISTED: usize = 20;

/// The results of all points from the files that parts have left, and how many of these belong to other points.
///
/// # Errors
/// [`CliError::Missing`] if a point is not there; [`CliError::Unusable`] if two parts hold different figures of the same one.
pub(super) fn merged(
    design: &Design,
    points: &[Point],
    folders: &[PathBuf],
) -> std::result::Result<(Vec<Result>, usize), CliError> {
    let mut left = kept::left_in(folders)?;
    let told = |point: usize| {
        let each = design.keys.iter().zip(&points[point].values);
        let values: Vec<String> = each.map(|(key, value)| format!("{key}={value}")).collect();
        format!("point {} ({})", point + 1, values.join(" "))
    };
    let mut results = Vec::with_capacity(points.len());
    let (mut missing, mut unlike) = (Vec::new(), Vec::new());
    let mut used = BTreeSet::new();
    for (number, point) in points.iter().enumerate() {
        if let Err(why) = &point.study {
            results.push(Err(why.clone()));
            continue;
        }
        used.insert(point.key.clone());
        let found = left.get(&point.key).map_or(&[][..], Vec::as_slice);
        // a point that failed in one part and came to figures in another is done
        let figures: Vec<&(Found, PathBuf)> = found.iter().filter(|(f, _)| f.is_ok()).collect();
        match (&figures[..], found) {
            ([one], _) => results.push(one.0.clone()),
            ([], []) => missing.push(told(number)),
            ([], [first, ..]) => results.push(first.0.clone()),
            (several, _) => {
                let folders: Vec<String> = several
                    .iter()
                    .map(|(_, folder)| folder.display().to_string())
                    .collect();
                unlike.push(format!("{} in {}", told(number), folders.join(" and ")));
            }
        }
    }
    let listed = |all: &[String]| {
        let mut text: String = all
            .iter()
            .take(MOST_LISTED)
            .map(|one| format!("\n  {one}"))
            .collect();
        if all.len() > MOST_LISTED {
            text += &format!("\n  and {} more", all.len() - MOST_LISTED);
        }
        text
    };
    if !unlike.is_empty() {
        return Err(CliError::Unusable(format!(
            "parts hold different figures of the same points; were they made by different versions of the program?{}",
            listed(&unlike)
        )));
    }
    if !missing.is_empty() {
        return Err(CliError::Missing(format!(
            "{} of {} points are missing{}\nrun the parts again that have not ended (what they have done is kept), then merge; nothing was written",
            missing.len(),
            points.len(),
            listed(&missing)
        )));
    }
    left.retain(|key, _| !used.contains(key));
    Ok((results, left.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_share_the_points() {
        for of in [1, 7, 100] {
            let parts: Vec<Shard> = (1..=of)
                .map(|i| shard(&format!("{i}/{of}")).unwrap())
                .collect();
            for point in 0..250 {
                assert_eq!(parts.iter().filter(|part| part.holds(point)).count(), 1);
            }
        }
        for wrong in ["0/3", "4/3", "1", "a/b", "1/0", "-1/3"] {
            assert!(shard(wrong).is_err(), "{wrong}");
        }
    }
}
