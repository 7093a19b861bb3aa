//! The flanks of a member as its condensed compliance holds them.

use std::ops::Range;

use crate::contact::strips::Strips;
use crate::fem::Compliance;

/// The flank of one tooth among the interface unknowns of its member.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothFlank {
    /// Tooth number in the member frame.
    pub tooth: i32,
    /// Index of its first held node among the interface nodes.
    pub first: usize,
    /// Arc coordinates of its nodes, mm.
    pub arc: Vec<f64>,
    /// Nodes that the compliance holds: the part that can touch.
    pub held: Range<usize>,
    /// 2 for quadratic edges, 1 for linear.
    pub order: usize,
}

/// Condensed compliance of one member's candidate flanks.
#[derive(Debug, Clone)]
pub struct ElasticFlanks {
    /// Displacements of the interface nodes per unit nodal loads, member frame.
    pub compliance: Compliance,
    /// The flanks, by interface node.
    pub flanks: Vec<ToothFlank>,
}

impl ElasticFlanks {
    pub(super) fn flank(&self, tooth: i32) -> Option<&ToothFlank> {
        self.flanks.iter().find(|f| f.tooth == tooth)
    }

    /// Whether the compliance holds all that can touch of the member `side` (0 pinion, 1 gear).
    pub fn cover(&self, strips: &Strips, side: usize) -> bool {
        strips.parts(side).all(|(tooth, [low, high])| {
            self.flank(tooth).is_some_and(|flank| {
                let held = &flank.arc[flank.held.clone()];
                let [Some(first), Some(last)] = [held.first(), held.last()] else {
                    return false;
                };
                (flank.held.start == 0 || *first <= low)
                    && (flank.held.end == flank.arc.len() || *last >= high)
            })
        })
    }
}
