//! `fields/loads.json`: what a reader of the field files must find again.
use serde_json::{Value, json};

use super::series::FieldFile;
use crate::mesh::Cells;
use crate::simulate::result::{FieldFrame, Member, MemberField};

/// For each field file the counts, the areas of the meshes, and the load as the contact solution has it.
///
/// `line_load` N/mm is the integral of `contact_pressure` over either member's outline; `torque_per_width` N is the moment of
/// the pinion's `contact_force` about its centre; the forces of both members cancel. `area` mm² is that of the worn mesh.
pub fn loads<'a>(frames: impl IntoIterator<Item = (&'a FieldFile, &'a FieldFrame)>) -> Value {
    let files: Vec<Value> = frames
        .into_iter()
        .map(|(file, frame)| {
            let member = |which: Member| {
                let field = frame.member(which);
                let cells = match &field.cells {
                    Cells::T3(cells) => cells.len(),
                    Cells::T6(cells) => cells.len(),
                };
                json!({"nodes": field.worn.len(), "cells": cells, "centre": field.centre, "area": area(field),
                       "largest_wear_depth": field.wear_depth.iter().copied().fold(0.0, f64::max)})
            };
            json!({
                "file": file.name, "cycles": frame.cycles, "position": frame.position,
                "line_load": frame.line_load, "torque_per_width": frame.torque_per_width,
                "pinion": member(Member::Pinion), "gear": member(Member::Gear),
            })
        })
        .collect();
    json!({"tolerance": 1e-6, "files": files})
}

/// Area of the mesh with its curved edges, mm².
///
/// ```text
/// A = Σ over cells of ∮ (x dy − y dx) / 2
/// ```
/// exact for straight and quadratic edges: an edge a, m, b adds [4 (a × m + m × b) − a × b] / 6, a straight one a × b / 2.
fn area(field: &MemberField) -> f64 {
    let cross = |i: u32, j: u32| {
        let ([ax, ay], [bx, by]) = (field.worn[i as usize], field.worn[j as usize]);
        ax * by - ay * bx
    };
    match &field.cells {
        Cells::T3(cells) => cells
            .iter()
            .map(|&[a, b, c]| (cross(a, b) + cross(b, c) + cross(c, a)) / 2.0)
            .sum(),
        Cells::T6(cells) => {
            let edge = |a, m, b| (4.0 * (cross(a, m) + cross(m, b)) - cross(a, b)) / 6.0;
            cells
                .iter()
                .map(|&[a, b, c, ab, bc, ca]| edge(a, ab, b) + edge(b, bc, c) + edge(c, ca, a))
                .sum()
        }
    }
}
