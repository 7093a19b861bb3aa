//! Reads gmsh meshes, ASCII, versions 2.2 and 4.1.
//!
//! Physical curves named `bore` and `flank_1`, `flank_2`, ... (any whole numbers) mark the node sets; triangles with 3 nodes
//! (gmsh type 2) or 6 (type 9), not mixed. Other elements and groups are passed over.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::str::FromStr;

use super::user::RawMesh;
use super::{Cells, Mesh, MeshError};
use crate::gear::Gear;
use crate::numeric::Vec2;

/// Reads a mesh of `gear` from the text of a .msh file. `path` only names it in errors.
///
/// # Errors
/// [`MeshError::File`] with the line, what is wrong and what is allowed.
pub fn read_msh(path: &Path, text: &str, gear: &Gear) -> Result<Mesh, MeshError> {
    Reader::new(text)
        .read()
        .and_then(|raw| raw.check(gear))
        .map_err(|problem| MeshError::File {
            path: path.to_owned(),
            problem,
        })
}

struct Reader<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    line: usize,
    names: BTreeMap<(i64, i64), String>,
    /// Physical groups of each geometric curve (4.1).
    curve_groups: HashMap<i64, Vec<i64>>,
    number: HashMap<u64, u32>,
    points: Vec<Vec2>,
    triangles: Vec<Vec<u32>>,
    /// Nodes of line elements, by physical group.
    lines_of: BTreeMap<i64, Vec<u32>>,
}

impl<'a> Reader<'a> {
    fn new(text: &'a str) -> Reader<'a> {
        Reader {
            lines: text.lines().enumerate(),
            line: 0,
            names: BTreeMap::new(),
            curve_groups: HashMap::new(),
            number: HashMap::new(),
            points: Vec::new(),
            triangles: Vec::new(),
            lines_of: BTreeMap::new(),
        }
    }

    fn read(mut self) -> Result<RawMesh, String> {
        let mut version = 0.0;
        while let Some(line) = self.next_line() {
            match line {
                "$MeshFormat" => {
                    let f = self.numbers::<f64>(3)?;
                    version = f[0];
                    if f[1] != 0.0 || (version != 2.2 && version != 4.1) {
                        return Err(self.at(&format!(
                            "format {version}, type {}; allowed 2.2 or 4.1, ASCII (type 0)",
                            f[1]
                        )));
                    }
                }
                "$PhysicalNames" => self.physical_names()?,
                "$Entities" => self.entities()?,
                "$Nodes" if version == 2.2 => {
                    let n = self.numbers::<usize>(1)?[0];
                    self.nodes_2(n)?;
                }
                "$Nodes" if version == 4.1 => self.nodes_4()?,
                "$Elements" if version == 2.2 => self.elements_2()?,
                "$Elements" if version == 4.1 => self.elements_4()?,
                "$Nodes" | "$Elements" => return Err(self.at("section before $MeshFormat")),
                _ => {}
            }
        }
        self.finish()
    }

    fn finish(self) -> Result<RawMesh, String> {
        let size = self.triangles.first().map_or(3, Vec::len);
        if self.triangles.iter().any(|t| t.len() != size) {
            return Err("triangles of 3 and of 6 nodes are mixed; one kind is allowed".into());
        }
        let flat: Vec<u32> = self.triangles.concat();
        let cells = if size == 6 {
            Cells::T6(flat.as_chunks().0.to_vec())
        } else {
            Cells::T3(flat.as_chunks().0.to_vec())
        };
        let (mut bore, mut flanks) = (Vec::new(), Vec::new());
        for (group, nodes) in self.lines_of {
            let Some(name) = self.names.get(&(1, group)) else {
                continue;
            };
            if name == "bore" {
                bore = nodes;
            } else if let Some(k) = name.strip_prefix("flank_") {
                let k = k.parse().map_err(|_| {
                    format!("physical curve `{name}`: allowed flank_ and a whole number")
                })?;
                flanks.push((k, nodes));
            }
        }
        Ok(RawMesh {
            points: self.points,
            cells,
            bore,
            flanks,
        })
    }

    fn physical_names(&mut self) -> Result<(), String> {
        for _ in 0..self.numbers::<usize>(1)?[0] {
            let line = self.next_line().ok_or("file ends in $PhysicalNames")?;
            let mut words = line.splitn(3, ' ');
            let mut number = || words.next().and_then(|w| w.parse::<i64>().ok());
            let (Some(dim), Some(tag)) = (number(), number()) else {
                return Err(self.at("dimension, tag and name wanted"));
            };
            let name = words.next().unwrap_or_default().trim().trim_matches('"');
            self.names.insert((dim, tag), name.to_owned());
        }
        Ok(())
    }

    fn entities(&mut self) -> Result<(), String> {
        let counts = self.numbers::<usize>(4)?;
        for _ in 0..counts[0] {
            self.next_line().ok_or("file ends in $Entities")?;
        }
        for _ in 0..counts[1] {
            // tag, bounding box (6), number of groups, groups, ...
            let v = self.numbers::<f64>(8)?;
            let groups = v
                .iter()
                .skip(8)
                .take(v[7] as usize)
                .map(|g| g.abs() as i64)
                .collect();
            self.curve_groups.insert(v[0] as i64, groups);
        }
        Ok(())
    }

    fn nodes_2(&mut self, count: usize) -> Result<(), String> {
        for _ in 0..count {
            let v = self.numbers::<f64>(4)?;
            self.add_node(v[0] as u64, &v[1..4])?;
        }
        Ok(())
    }

    fn nodes_4(&mut self) -> Result<(), String> {
        for _ in 0..self.numbers::<usize>(4)?[0] {
            let count = self.numbers::<usize>(4)?[3];
            let mut tags = Vec::new();
            for _ in 0..count {
                tags.push(self.numbers::<u64>(1)?[0]);
            }
            for tag in tags {
                let v = self.numbers::<f64>(3)?;
                self.add_node(tag, &v)?;
            }
        }
        Ok(())
    }

    fn elements_2(&mut self) -> Result<(), String> {
        for _ in 0..self.numbers::<usize>(1)?[0] {
            let v = self.numbers::<i64>(3)?;
            let tags = v[2].max(0) as usize;
            let group = v.get(3).copied().filter(|_| tags > 0);
            let nodes = v.get(3 + tags..).unwrap_or_default().to_vec();
            self.add_element(v[1], &nodes, group.as_slice())?;
        }
        Ok(())
    }

    fn elements_4(&mut self) -> Result<(), String> {
        for _ in 0..self.numbers::<usize>(4)?[0] {
            let block = self.numbers::<i64>(4)?;
            let groups = if block[0] == 1 {
                self.curve_groups.get(&block[1]).cloned()
            } else {
                None
            };
            let groups = groups.unwrap_or_default();
            for _ in 0..block[3] {
                let v = self.numbers::<i64>(2)?;
                self.add_element(block[2], &v[1..], &groups)?;
            }
        }
        Ok(())
    }

    fn add_node(&mut self, tag: u64, xyz: &[f64]) -> Result<(), String> {
        if xyz[2].abs() > 1e-9 {
            return Err(self.at(&format!(
                "node {tag} has z = {}; the mesh must lie in the plane z = 0",
                xyz[2]
            )));
        }
        if self.number.insert(tag, self.points.len() as u32).is_some() {
            return Err(self.at(&format!("node {tag} stands twice")));
        }
        self.points.push(Vec2::new(xyz[0], xyz[1]));
        Ok(())
    }

    fn add_element(&mut self, kind: i64, tags: &[i64], groups: &[i64]) -> Result<(), String> {
        let count = match kind {
            1 => 2,
            8 | 2 => 3,
            9 => 6,
            15 => return Ok(()),
            _ => {
                return Err(self.at(&format!(
                    "element type {kind}; allowed lines (1, 8), triangles (2, 9), points (15)"
                )));
            }
        };
        if tags.len() != count {
            return Err(self.at(&format!(
                "{} nodes for an element of type {kind}, which has {count}",
                tags.len()
            )));
        }
        let nodes: Option<Vec<u32>> = tags
            .iter()
            .map(|t| self.number.get(&(*t as u64)).copied())
            .collect();
        let nodes =
            nodes.ok_or_else(|| self.at("an element names a node that is not in $Nodes"))?;
        if kind == 2 || kind == 9 {
            self.triangles.push(nodes);
        } else {
            for group in groups {
                self.lines_of.entry(*group).or_default().extend(&nodes);
            }
        }
        Ok(())
    }

    fn next_line(&mut self) -> Option<&'a str> {
        let (i, text) = self.lines.next()?;
        self.line = i + 1;
        Some(text.trim())
    }

    /// The next line's numbers, at least `least` of them.
    fn numbers<T: FromStr>(&mut self, least: usize) -> Result<Vec<T>, String> {
        let line = self.next_line().ok_or("the file ends too early")?;
        let numbers: Option<Vec<T>> = line.split_whitespace().map(|w| w.parse().ok()).collect();
        match numbers {
            Some(v) if v.len() >= least => Ok(v),
            _ => Err(self.at(&format!("at least {least} numbers wanted, found `{line}`"))),
        }
    }

    fn at(&self, what: &str) -> String {
        format!("line {}: {what}", self.line)
    }
}
