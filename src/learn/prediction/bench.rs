//! The measured gears, prepared once for many fits: members, and for each test its mesh cycle and compliance.

use std::sync::Arc;

use rayon::prelude::*;

use super::mountings::Mountings;
use crate::effects::{Combined, Hook, Surroundings};
use crate::material::Elastic;
use crate::measure::Observation;
use crate::simulate::forward::{Conditions, ContactKind, Forward, ForwardError, GearSet};
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::wear::acting::Acting;

/// One measured test.
#[derive(Debug, Clone)]
pub struct MeasuredTest {
    /// Its id.
    pub id: String,
    /// Conditions.
    pub conditions: Conditions,
    /// The study's wear coefficient, mm²/N, and those of pinion and gear over it.
    pub wear: (f64, [f64; 2]),
    /// Elastic constants of pinion and gear at the test's temperature.
    pub materials: [Elastic; 2],
    /// Oil and heat.
    pub surroundings: Surroundings,
    /// Whether the drive direction is the other one.
    pub reversed: bool,
    /// What was measured, in the order of the data set.
    pub observations: Vec<Observation>,
}

/// Elastic members that serve all tests of a study.
pub struct Workshop {
    /// The gears; then the same gears with each of the tests' other materials, which their temperatures give them.
    sets: Vec<GearSet>,
    numerics: Numerics,
    /// By elements and materials: the least torque (N·mm) of tests of similar contact width, and members for these; ascending.
    members: Vec<Vec<(f64, Members)>>,
}

/// Step tolerance with which fits begin: that of a run by default. Whether it is too loose shows where the fit ends ([`Bench::finest`]). Twice as
/// loose saves a fifth of the steps but costs more than it saves where contacts are deep and wide: every fourth step is refused there, and
/// predictions become so rough in their parameters that derivatives must be taken by differences, each of which costs a history.
const STEP_TOLERANCE: f64 = 2e-3;

/// The finest step tolerance: where fits end, and with which measurements are made up.
const FINEST_TOLERANCE: f64 = 2.5e-4;

/// Members are condensed anew only after this depth in fits, modules; with module 2 what that leaves out is 4e-5 of the depth at 15 µm.
const CONDENSE_AFTER: f64 = 0.05;

/// Tests whose contacts differ in width by no more than this share their members, fine enough for the narrowest: contacts on finer meshes
/// than they need cost as the cube of their edges, and members of their own cost half a second.
const CLASS: f64 = 2.0;

/// Contact is looked for in a strip so much wider than a single run starts with, so that no parameter that
/// a fit tries calls for another.
const ROOM: f64 = 1.4;

/// Misalignments around each test's own for which teeth are meshed finely, mm.
const MISALIGNMENT_MARGIN: f64 = 0.2;

/// Resolution of the analytic model where it only looks for what may matter: flank edges per half width, positions, error of a wear step, depth
/// below which that is absolute (modules; with module 2, half a micrometre).
const LOOK_EDGES: f64 = 2.0;
const LOOK_POSITIONS: usize = 36;
const LOOK_STEP: f64 = 0.04;
const LOOK_FLOOR: f64 = 2.5e-4;

/// The resolution with which the analytic model looks at changes and for places to start from, where a study asks for `fine`.
pub(in crate::learn) fn for_looks(fine: Numerics) -> Numerics {
    Numerics {
        elements_per_half_width: fine.elements_per_half_width.min(LOOK_EDGES),
        positions: fine.positions.min(LOOK_POSITIONS),
        step_tolerance: fine.step_tolerance.max(LOOK_STEP),
        step_floor: fine.step_floor.max(LOOK_FLOOR),
        ..fine
    }
}

impl Workshop {
    /// Meshes and condenses the gears finely enough for all `tests`; nothing to do for the analytic model.
    ///
    /// # Errors
    /// [`ForwardError`] if a pair cannot run or a member cannot be built.
    pub fn new(
        set: GearSet,
        numerics: Numerics,
        kind: ContactKind,
        tests: &[MeasuredTest],
    ) -> Result<Self, ForwardError> {
        let numerics = Numerics {
            step_tolerance: numerics.step_tolerance.max(STEP_TOLERANCE),
            condense_after: numerics.condense_after.max(CONDENSE_AFTER),
            room: ROOM,
            ..numerics
        };
        let mut sets = vec![set];
        for test in tests {
            if !sets.iter().any(|set| set.materials == test.materials) {
                sets.push(GearSet {
                    materials: test.materials,
                    ..sets[0].clone()
                });
            }
        }
        let members_of = |set: &GearSet| -> Result<Vec<(f64, Members)>, ForwardError> {
            let own: Vec<&MeasuredTest> = (tests.iter())
                .filter(|test| test.materials == set.materials)
                .collect();
            (classes(own, |t| t.conditions.torque).iter())
                .map(|class| {
                    let members = members_for(set, &numerics, class)?;
                    Ok((class[0].conditions.torque, members))
                })
                .collect()
        };
        let members = match kind {
            ContactKind::Fem => sets.iter().map(members_of).collect::<Result<_, _>>()?,
            ContactKind::Hertz => Vec::new(),
        };
        Ok(Self {
            sets,
            numerics,
            members,
        })
    }

    /// The gears, with the materials that they have under the study's own conditions.
    pub fn set(&self) -> &GearSet {
        &self.sets[0]
    }

    /// Prepares every test.
    ///
    /// # Errors
    /// [`ForwardError`] of the first test that cannot run.
    pub fn bench(&self, tests: Vec<MeasuredTest>) -> Result<Bench<'_>, ForwardError> {
        self.stepping(tests, self.numerics.step_tolerance)
    }

    /// Prepares every test, to be worn with the finest steps.
    ///
    /// # Errors
    /// As [`Workshop::bench`].
    pub fn finest(&self, tests: Vec<MeasuredTest>) -> Result<Bench<'_>, ForwardError> {
        self.stepping(tests, FINEST_TOLERANCE)
    }

    /// The gears with a test's materials, and its members: of the classes that begin with a smaller load the nearest, or else the finest; none for
    /// the analytic model.
    fn gears_of(&self, test: &MeasuredTest) -> (&GearSet, Option<&Members>) {
        let same = |set: &GearSet| set.materials == test.materials;
        let place = self.sets.iter().position(same).unwrap_or(0);
        let torque = test.conditions.torque;
        let begins = |(least, _): &&(f64, Members)| *least <= torque * (1.0 + 1e-9);
        let members = self.members.get(place).and_then(|classes| {
            let class = classes.iter().rfind(begins).or(classes.first());
            class.map(|(_, members)| members)
        });
        (&self.sets[place], members)
    }

    fn stepping(
        &self,
        tests: Vec<MeasuredTest>,
        step_tolerance: f64,
    ) -> Result<Bench<'_>, ForwardError> {
        let numerics = Numerics {
            step_tolerance,
            ..self.numerics
        };
        let templates = tests
            .par_iter()
            .map(|test| {
                let (set, members) = self.gears_of(test);
                Forward::new(set, members, test.conditions, numerics)
            })
            .collect::<Result<_, ForwardError>>()?;
        let mountings = tests.iter().map(|_| Mountings::default()).collect();
        Ok(Bench {
            shop: self,
            step_tolerance,
            tests,
            templates,
            mountings,
        })
    }
}

/// Every test ready to be run with any wear coefficient and effects.
pub struct Bench<'a> {
    shop: &'a Workshop,
    step_tolerance: f64,
    /// The tests.
    pub tests: Vec<MeasuredTest>,
    pub(in crate::learn) templates: Vec<Forward<'a>>,
    /// Where effects have moved the axes of each test; the same for all wear steps.
    mountings: Arc<[Mountings]>,
}

impl<'a> Bench<'a> {
    /// Whether contacts are solved by finite elements.
    pub(in crate::learn) fn is_elastic(&self) -> bool {
        !self.shop.members.is_empty()
    }

    /// The gears.
    pub fn set(&self) -> &'a GearSet {
        self.shop.set()
    }

    /// A fresh run of a test with this wear coefficient, mm²/N, and with these effects.
    ///
    /// # Errors
    /// As [`Forward::again`].
    pub(in crate::learn) fn forward<'b>(
        &'b self,
        test: usize,
        coefficient: f64,
        acting: Option<&'b Acting>,
    ) -> Result<Forward<'b>, ForwardError> {
        let template = &self.templates[test];
        let (_, members) = self.tests[test].wear;
        let coefficients = members.map(|factor| factor * coefficient);
        match acting.filter(|acting| acting.acts(Hook::Operation)) {
            Some(acting) => self.mountings[test].run(template, coefficients, acting),
            None => template.again(coefficients, acting),
        }
    }

    /// Effects at the conditions of a test.
    pub(in crate::learn) fn acting(&self, test: usize, effects: Combined) -> Acting {
        let measured = &self.tests[test];
        Acting {
            effects,
            surroundings: measured.surroundings,
            torque: 1e-3 * measured.conditions.torque,
            speed: measured.conditions.speed,
            reversed: measured.reversed,
            face_width: self.set().face_width,
        }
    }

    /// The backlash that effects leave in a test, mm: negative where teeth of full thickness would overlap. None: they do not move the
    /// axes, or not to where the gears can run.
    pub(in crate::learn) fn moved_backlash(&self, test: usize, effects: Combined) -> Option<f64> {
        let acting = self.acting(test, effects);
        if !acting.acts(Hook::Operation) {
            return None;
        }
        let own = self.tests[test].conditions.misalignment;
        let pair = self.set().mount(own).ok()?;
        let moved = own + acting.added_centre_distance(&pair);
        Some(self.set().mount_moved(moved).ok()?.backlash)
    }

    /// The same tests with the finest wear steps; none if theirs are.
    ///
    /// # Errors
    /// As [`Workshop::bench`].
    pub fn finest(&self) -> Result<Option<Self>, ForwardError> {
        if self.step_tolerance <= FINEST_TOLERANCE {
            return Ok(None);
        }
        self.stepping(FINEST_TOLERANCE).map(Some)
    }

    /// The same tests with rough wear steps: good enough to rule out what cannot matter.
    ///
    /// # Errors
    /// As [`Workshop::bench`].
    pub(in crate::learn) fn rougher(&self) -> Result<Self, ForwardError> {
        self.stepping(self.step_tolerance.max(LOOK_STEP))
    }

    fn stepping(&self, tolerance: f64) -> Result<Self, ForwardError> {
        let templates = self.templates.iter();
        Ok(Self {
            shop: self.shop,
            step_tolerance: tolerance,
            tests: self.tests.clone(),
            templates: templates
                .map(|template| template.stepping(tolerance))
                .collect::<Result<_, ForwardError>>()?,
            mountings: Arc::clone(&self.mountings),
        })
    }
}

/// Tests in classes of similar contact width, narrowest first: widths go with the root of the torque.
fn classes<'t, T>(mut ascending: Vec<&'t T>, torque: impl Fn(&T) -> f64) -> Vec<Vec<&'t T>> {
    ascending.sort_by(|a, b| torque(a).total_cmp(&torque(b)));
    let mut classes: Vec<Vec<&'t T>> = Vec::new();
    for test in ascending {
        match classes.last_mut() {
            Some(class) if torque(test) <= CLASS * CLASS * torque(class[0]) => class.push(test),
            _ => classes.push(vec![test]),
        }
    }
    classes
}

/// Members for all tests of a class.
fn members_for(
    set: &GearSet,
    numerics: &Numerics,
    class: &[&MeasuredTest],
) -> Result<Members, ForwardError> {
    let torques: Vec<f64> = class.iter().map(|t| t.conditions.torque).collect();
    let mut misalignments: Vec<f64> = Vec::new();
    for test in class {
        let own = test.conditions.misalignment;
        let around = [own - MISALIGNMENT_MARGIN, own, own + MISALIGNMENT_MARGIN];
        misalignments.extend(around.iter().filter(|m| set.mount_moved(**m).is_ok()));
    }
    set.members(numerics, &torques, &misalignments)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four times the torque make a contact twice as wide, which is as far as a class goes.
    #[test]
    fn classes_span_twice_the_width() {
        let torques = [160.0, 50.0, 200.0, 900.0, 201.0];
        let classes = classes(torques.iter().collect(), |t| *t);
        assert_eq!(
            classes,
            [vec![&50.0, &160.0, &200.0], vec![&201.0], vec![&900.0]]
        );
    }
}
