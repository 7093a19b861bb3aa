//! What is asked of measurements beside a diagnosis of them.

use super::sanity::sanity_of_data;
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::version::ModelVersion;
use crate::simulate::forward::ContactKind;

/// What `check` asks of the measurements: what they show by themselves; against the study's own model, by its analytic contact, only where what was found
/// missing leaves more than noise, for else that answers it. Nothing where that model cannot be fitted.
pub fn questions(measured: &Measured<'_>, leaves_only_noise: bool) -> Vec<String> {
    let by_themselves = sanity_of_data(measured.study(), &measured.data);
    if leaves_only_noise || !by_themselves.is_empty() {
        return by_themselves;
    }
    let against_the_model = || {
        let workshop = measured.workshop(ContactKind::Hertz).ok()?;
        let bench = measured.bench(&workshop).ok()?;
        let version = ModelVersion::of(measured.study());
        let compared = measured.compare(&bench, &version, &|_| {}).ok()?;
        Some(compared.comparison.sanity)
    };
    against_the_model().unwrap_or_default()
}
