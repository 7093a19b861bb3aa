//! Several versions of a model, each its own study, compared one after the other on as few benches as possible.

use super::compare::{CompareError, CompareStage, Compared, contact_of};
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::version::ModelVersion;
use crate::measure::{Dataset, Observation};
use crate::study::Study;

/// A study with its measurements.
pub type Item<'a> = (&'a Study, &'a Dataset);

/// Compares every study with its measurements; `watch` hears which one is at what.
///
/// Studies that differ in their effects, in what is free or in the wear coefficient share members and tests.
///
/// # Errors
/// [`CompareError`] of the first that cannot be compared.
pub fn compare_all(
    items: &[Item<'_>],
    watch: &(dyn Fn(usize, CompareStage) + Sync),
) -> Result<Vec<Compared>, CompareError> {
    let mut found: Vec<Option<Compared>> = vec![None; items.len()];
    for first in 0..items.len() {
        if found[first].is_some() {
            continue;
        }
        let kind = contact_of(items[first].0)?;
        let measured = Measured::new(items[first].0, items[first].1.clone());
        watch(first, CompareStage::Members);
        let workshop = measured.workshop(kind)?;
        watch(first, CompareStage::Tests);
        let bench = measured.bench(&workshop)?;
        for number in first..items.len() {
            if number > first && (found[number].is_some() || !share(items[first], items[number])) {
                continue;
            }
            let (study, data) = items[number];
            let measured = Measured::new(study, data.clone());
            let watch = |doing| watch(number, doing);
            found[number] = Some(measured.compare(&bench, &ModelVersion::of(study), &watch)?);
        }
    }
    Ok(found.into_iter().flatten().collect())
}

/// Whether two studies can be compared on one bench.
fn share(a: Item<'_>, b: Item<'_>) -> bool {
    let conditions = |study: &Study| -> Vec<_> {
        let tests = study.tests.iter();
        tests.map(|t| (t.id.clone(), t.conditions)).collect()
    };
    a.0.gears == b.0.gears
        && a.0.materials == b.0.materials
        && a.0.temperatures == b.0.temperatures
        && a.0.lubricant == b.0.lubricant
        && a.0.thermal == b.0.thermal
        && a.0.numerics == b.0.numerics
        && a.0.contact == b.0.contact
        && a.0.wear.members == b.0.wear.members
        && conditions(a.0) == conditions(b.0)
        && a.1.observations == b.1.observations
}

/// What of a version keeps it from being judged against another by its χ², in words; empty if nothing.
pub fn differences(a: Item<'_>, b: Item<'_>) -> Vec<&'static str> {
    let values = |data: &Dataset| -> Vec<_> {
        let told = |o: &Observation| {
            let key = (data.tests[o.test].clone(), o.member, o.quantity);
            (key, [o.cycles, o.value, o.sigma], o.position)
        };
        data.observations.iter().map(told).collect()
    };
    let tests = |study: &Study| -> Vec<_> {
        let tests = study.tests.iter();
        tests.map(|t| (t.id.clone(), t.conditions)).collect()
    };
    let roles = |study: &Study| -> Vec<_> { study.tests.iter().map(|t| t.role).collect() };
    let mut told = Vec::new();
    if values(a.1) != values(b.1) {
        told.push("its measurements are others");
    }
    if tests(a.0) != tests(b.0) {
        told.push("its tests are others");
    } else if roles(a.0) != roles(b.0) {
        told.push("other tests are held out");
    }
    if a.0.noise != b.0.noise {
        told.push("its [noise] is another");
    }
    told
}
