//! Elastic contact of all slices of the face: each at a position of one mesh cycle, one approach between them.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use nalgebra::DVector;

use super::FemContact;
use crate::contact::alteration::{Alteration, set_back};
use crate::contact::cycle::Position;
use crate::contact::model::{ContactError, PositionContact, SlicedContact};
use crate::contact::slices::{Flanks, Slices};
use crate::contact::tangent::{AlterationChange, Change, ContactTangent, LinearSlices};
use crate::contact::unilateral::{
    JointLinearised, JointProblem, JointSolution, Section, SliceSensitivity, TiedSection, Ties,
    UnilateralError, solve_joint, solve_tied,
};

/// Where slices are at one turn.
struct Stand<'a> {
    /// Positions of the different sections among those of the slices.
    different: Vec<usize>,
    /// These sections.
    sections: Vec<Section<'a>>,
    /// Number of each slice's among them.
    number: Vec<usize>,
    /// Section position of each slice.
    at: Vec<usize>,
}

/// The groups of a section's unknowns that slices are tied by: tooth pairs.
struct TiedPairs {
    groups: Vec<Range<usize>>,
    length: Vec<f64>,
}

impl TiedPairs {
    fn of(position: &Position) -> Self {
        let pairs = position.pairs.iter();
        Self {
            groups: (pairs.clone())
                .map(|pair| pair.offset..pair.offset + pair.xi.len())
                .collect(),
            length: pairs.flat_map(|pair| &pair.length).copied().collect(),
        }
    }

    fn section(&self) -> TiedSection<'_> {
        TiedSection {
            groups: &self.groups,
            length: &self.length,
        }
    }
}

impl FemContact<'_> {
    fn joint<'b>(&'b self, stand: &'b Stand<'b>, gaps: &'b [Vec<f64>]) -> JointProblem<'b> {
        JointProblem {
            sections: &stand.sections,
            at: &stand.number,
            gaps,
            weights: &self.slices().weight,
            load: self.torque,
            symmetric: self.compliance.symmetric,
        }
    }

    /// Where the slices are at the turn `turn`.
    fn stand(&self, turn: usize) -> Stand<'_> {
        let at = self.slices().all_at(turn, self.cycle.positions.len());
        let mut different: Vec<usize> = Vec::new();
        let number = at.iter().map(|q| {
            let known = different.iter().position(|other| other == q);
            known.unwrap_or_else(|| {
                different.push(*q);
                different.len() - 1
            })
        });
        let number = number.collect();
        let section = |&q: &usize| Section {
            w: &self.compliance.positions[q].weighted,
            arm: &self.cycle.positions[q].arm,
            lever: &self.compliance.positions[q].lever,
        };
        Stand {
            sections: different.iter().map(section).collect(),
            different,
            number,
            at,
        }
    }

    /// Weighted gaps of slices at the section positions `at`.
    fn gaps(&self, at: &[usize], flanks: &Flanks<'_>) -> Vec<Vec<f64>> {
        let slices = self.slices();
        let of_slice = |(i, &q): (usize, &usize)| {
            let position = &self.cycle.positions[q];
            let mut gap = position.gap.clone();
            position.open_each(flanks.of(i), &mut gap);
            if let Some(opened) = self.opened {
                for (gap, opened) in gap.iter_mut().zip(&opened[q]) {
                    *gap += opened;
                }
            }
            for (pair, back) in position.pairs.iter().zip(flanks.back_of(i)) {
                set_back(&mut gap, pair, slices.offset[i] + back);
            }
            gap
        };
        at.iter().enumerate().map(of_slice).collect()
    }

    fn solve_gaps(
        &self,
        turn: usize,
        gaps: &[Vec<f64>],
        flanks: &Flanks<'_>,
        start: &[Vec<usize>],
    ) -> Result<Vec<PositionContact>, ContactError> {
        let failed = |source| ContactError::Unilateral {
            theta: self.cycle.positions[turn].theta,
            source,
        };
        let stand = self.stand(turn);
        let problem = self.joint(&stand, gaps);
        let (solution, gaps) = match self.ties {
            Some(ties) => {
                let pairs = self.tied_pairs(&stand);
                let sections: Vec<TiedSection> = pairs.iter().map(TiedPairs::section).collect();
                let (change, sections) = (&ties[turn], &sections[..]);
                let ties = Ties { change, sections };
                let tied = solve_tied(&problem, &ties, start).map_err(failed)?;
                (tied.0, Cow::Owned(tied.1))
            }
            None => {
                let solution = solve_joint(&problem, start).map_err(failed)?;
                (solution, Cow::Borrowed(gaps))
            }
        };
        for (i, (gap, pressure)) in gaps.iter().zip(&solution.pressure).enumerate() {
            let own = self.slices().offset[i];
            let mut corners = [f64::INFINITY; 2];
            for (depth, back) in flanks.of(i).iter().zip(flanks.back_of(i)) {
                let lost = self.lost_corners(*depth);
                corners = [0, 1].map(|side| corners[side].min(lost[side] + own + back));
            }
            let position = &self.cycle.positions[stand.at[i]];
            self.within_limits(position, gap, pressure, solution.approach, corners)?;
        }
        Ok(self.contacts(&stand, solution))
    }

    fn contacts(&self, stand: &Stand<'_>, solution: JointSolution) -> Vec<PositionContact> {
        let carried = |(pressure, number): (&Vec<f64>, &usize)| {
            let levers = stand.sections[*number].lever;
            pressure.iter().zip(levers).map(|(p, l)| p * l).sum()
        };
        let each = solution.pressure.iter().zip(&stand.number);
        let torque = self.slices().mean(each.map(carried));
        let torque_error = (torque / self.torque - 1.0).abs();
        (solution.pressure.into_iter().zip(solution.active))
            .map(|(pressure, active)| PositionContact {
                pressure,
                approach: solution.approach,
                active,
                iterations: solution.iterations,
                penetration: solution.penetration,
                torque_error,
            })
            .collect()
    }

    fn linear_on(
        &self,
        turn: usize,
        contacts: &[&PositionContact],
    ) -> Result<JointLinearised, ContactError> {
        let active: Vec<&[usize]> = contacts.iter().map(|c| c.active.as_slice()).collect();
        let stand = self.stand(turn);
        let gap = |&q: &usize| self.cycle.positions[q].gap.clone();
        let gaps: Vec<Vec<f64>> = stand.at.iter().map(gap).collect();
        let pairs = match self.ties {
            Some(_) => self.tied_pairs(&stand),
            None => Vec::new(),
        };
        let sections: Vec<TiedSection> = pairs.iter().map(TiedPairs::section).collect();
        let ties = self.ties.map(|ties| Ties {
            change: &ties[turn],
            sections: &sections,
        });
        JointLinearised::new(&self.joint(&stand, &gaps), ties.as_ref(), &active).map_err(
            |source: UnilateralError| ContactError::Unilateral {
                theta: self.cycle.positions[turn].theta,
                source,
            },
        )
    }

    /// By section.
    fn tied_pairs(&self, stand: &Stand<'_>) -> Vec<TiedPairs> {
        let sections = stand.different.iter();
        sections
            .map(|&q| TiedPairs::of(&self.cycle.positions[q]))
            .collect()
    }
}

impl SlicedContact for FemContact<'_> {
    fn slices(&self) -> &Slices {
        self.slices.expect("asked only where there are slices")
    }

    fn solve_all(
        &self,
        turn: usize,
        flanks: &Flanks<'_>,
        start: &[Vec<usize>],
    ) -> Result<Vec<PositionContact>, ContactError> {
        let at = self.slices().all_at(turn, self.cycle.positions.len());
        self.solve_gaps(turn, &self.gaps(&at, flanks), flanks, start)
    }

    fn sensitivities(
        &self,
        turn: usize,
        contacts: &[&PositionContact],
    ) -> Result<Option<Vec<Arc<SliceSensitivity>>>, ContactError> {
        Ok(Some(self.linear_on(turn, contacts)?.sensitivities()))
    }

    fn linearised_all<'m>(
        &'m self,
        turn: usize,
        contacts: &[&PositionContact],
        _: &Flanks<'_>,
    ) -> Result<Box<dyn LinearSlices + 'm>, ContactError> {
        Ok(Box::new(FaceLinear {
            model: self,
            at: self.slices().all_at(turn, self.cycle.positions.len()),
            joint: OnSets::new(self, turn, contacts)?,
        }))
    }
}

/// The contacts of one turn's slices on their active sets.
struct FaceLinear<'m> {
    model: &'m FemContact<'m>,
    /// Section positions of the slices.
    at: Vec<usize>,
    joint: OnSets,
}

struct OnSets {
    active: Vec<Vec<usize>>,
    pressure: Vec<Vec<f64>>,
    linear: JointLinearised,
}

impl OnSets {
    fn new(
        model: &FemContact<'_>,
        turn: usize,
        contacts: &[&PositionContact],
    ) -> Result<Self, ContactError> {
        let carried = |c: &&PositionContact| c.active.iter().map(|&k| c.pressure[k]).collect();
        Ok(Self {
            active: contacts.iter().map(|c| c.active.clone()).collect(),
            pressure: contacts.iter().map(carried).collect(),
            linear: model.linear_on(turn, contacts)?,
        })
    }
}

impl FaceLinear<'_> {
    /// How the weighted gaps open in each slice.
    fn openings(&self, change: &Change<'_>) -> Vec<Vec<f64>> {
        let opened = change.altered.and_then(|altered| altered.opened.as_ref());
        let lead = change.altered.and_then(|a| a.alteration.lead.as_ref());
        let of_slice = |(i, &q): (usize, &usize)| {
            let position = &self.model.cycle.positions[q];
            let mut gap = vec![0.0; position.gap.len()];
            position.open_each(change.flanks.of(i), &mut gap);
            if let Some(opened) = opened {
                for (gap, opened) in gap.iter_mut().zip(&opened[q]) {
                    *gap += opened;
                }
            }
            let lead = lead.map_or(0.0, |lead| lead[i]);
            for (pair, back) in position.pairs.iter().zip(change.flanks.back_of(i)) {
                set_back(&mut gap, pair, lead + back);
            }
            gap
        };
        self.at.iter().enumerate().map(of_slice).collect()
    }

    /// −dW λ by slice and −d(load) of what is altered, for values λ on the sets.
    fn altered(
        &self,
        on: &OnSets,
        values: &[Vec<f64>],
        change: &Alteration,
    ) -> (Vec<DVector<f64>>, f64) {
        let weights = &self.model.slices().weight;
        let mut load = 0.0;
        let mut all = Vec::with_capacity(values.len());
        let slices = on.active.iter().zip(values).zip(weights).zip(&self.at);
        for (((active, values), weight), &q) in slices {
            let (right, own) = self.model.altered_on(q, active, values, change);
            load += weight * own;
            all.push(right);
        }
        (all, load)
    }

    fn on_sets(
        &self,
        on: &OnSets,
        gaps: &[Vec<f64>],
        change: &Change<'_>,
    ) -> (Vec<DVector<f64>>, f64) {
        let (mut right, mut load) = match change.altered {
            Some(altered) => self.altered(on, &on.pressure, &altered.alteration),
            None => (
                on.active.iter().map(|a| DVector::zeros(a.len())).collect(),
                0.0,
            ),
        };
        for ((right, active), gap) in right.iter_mut().zip(&on.active).zip(gaps) {
            for (right, &k) in right.iter_mut().zip(active) {
                *right -= gap[k];
            }
        }
        if right.iter().all(|r| r.is_empty()) {
            load = 0.0;
        }
        on.linear.solve(right, load)
    }
}

impl LinearSlices for FaceLinear<'_> {
    fn tangents(&self, change: &Change<'_>) -> Vec<ContactTangent> {
        let gaps = self.openings(change);
        let mut out: Vec<ContactTangent> = (gaps.iter())
            .map(|gap| ContactTangent {
                pressure: vec![0.0; gap.len()],
                approach: 0.0,
            })
            .collect();
        let (pressures, approach) = self.on_sets(&self.joint, &gaps, change);
        for ((out, active), pressure) in out.iter_mut().zip(&self.joint.active).zip(&pressures) {
            for (&k, p) in active.iter().zip(pressure.iter()) {
                out.pressure[k] = *p;
            }
            out.approach = approach;
        }
        out
    }

    fn responses(&self, flanks: &Flanks<'_>) -> Vec<Vec<f64>> {
        let gaps = self.openings(&Change {
            flanks,
            altered: None,
        });
        let right = (self.joint.active.iter().zip(&gaps))
            .map(|(active, gap)| DVector::from_fn(active.len(), |i, _| gap[active[i]]));
        // as the Jacobian of a wear step has it
        let (x, _) = self.joint.linear.solve_untied(right.collect(), 0.0);
        x.iter().map(|x| x.as_slice().to_vec()).collect()
    }

    fn response_tangents(
        &self,
        responses: &[Vec<f64>],
        change: &AlterationChange,
    ) -> Option<Vec<Vec<f64>>> {
        let alteration = &change.alteration;
        if alteration.keeps_stiffness() {
            return None;
        }
        let (right, load) = self.altered(&self.joint, responses, alteration);
        let (x, _) = self.joint.linear.solve_untied(right, load);
        Some(x.iter().map(|x| x.as_slice().to_vec()).collect())
    }
}
