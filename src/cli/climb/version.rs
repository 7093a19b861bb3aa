//! Versions of a study on the way up: the study with some effects in it, fitted.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::CliError;
use crate::cli::add::drafts::{forms, with_form};
use crate::cli::fitting;
use crate::effects::find;
use crate::learn::climb::{Answer, Standing};
use crate::learn::{AddedForm, CompareStage, Comparison, ModelVersion, compare, left_out};
use crate::measure::Dataset;
use crate::study::{Study, rounded};

/// Form of an effect that its card's own values make.
const OWN: &str = "own";

/// An effect that was added, in one of its forms.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Rung {
    /// Name in the catalogue.
    pub(super) effect: String,
    form: String,
}

/// A version of the study with its fit.
pub(super) struct Fitted {
    pub(super) rungs: Vec<Rung>,
    /// Fitted parameters by their full names.
    pub(super) values: Vec<(String, f64)>,
    pub(super) comparison: Comparison,
    pub(super) standing: Standing,
}

/// The study that is climbed from, with its measurements.
pub(super) struct Fitter<'a> {
    pub(super) study: &'a Study,
    pub(super) path: &'a Path,
    pub(super) data: &'a Dataset,
}

impl Fitter<'_> {
    /// The study with these effects in it and these values, at the place of the study that it comes from.
    pub(super) fn version(
        &self,
        rungs: &[Rung],
        values: &[(String, f64)],
    ) -> Result<Study, CliError> {
        self.with_values(rungs, values, None)
    }

    /// The same for the folder `target`, as `climbed.toml`.
    pub(super) fn moved(
        &self,
        rungs: &[Rung],
        values: &[(String, f64)],
        target: &Path,
    ) -> Result<Study, CliError> {
        self.with_values(rungs, values, Some(target))
    }

    fn with_values(
        &self,
        rungs: &[Rung],
        values: &[(String, f64)],
        target: Option<&Path>,
    ) -> Result<Study, CliError> {
        let name = self.path.display().to_string();
        let mut study = self.study.edit().finish(&name)?;
        for rung in rungs {
            let card = find(&rung.effect)?;
            let form = card.forms.iter().find(|form| form.name == rung.form);
            study = with_form(&study, card, form, &name)?;
        }
        let mut edit = study.edit();
        for (name, value) in values {
            edit.set(name, rounded(*value));
        }
        let name = match target {
            None => name,
            Some(target) => {
                // its paths lead out of the folder, which must be there to be left
                fs::create_dir_all(target).map_err(|source| CliError::Io {
                    doing: "make",
                    path: target.to_owned(),
                    source,
                })?;
                edit.move_between(self.path.parent().unwrap_or(Path::new("")), target)?;
                target.join("climbed.toml").display().to_string()
            }
        };
        Ok(edit.finish(&name)?)
    }

    /// Fits the study with these effects, from these values.
    pub(super) fn fit(
        &self,
        rungs: Vec<Rung>,
        values: &[(String, f64)],
        watch: &(dyn Fn(String) + Sync),
    ) -> Result<Fitted, CliError> {
        let study = self.version(&rungs, values)?;
        let compared = compare(&study, self.data, &ModelVersion::of(&study), &|doing| {
            watch(in_words(doing));
        })?;
        self.judged(rungs, compared.comparison, watch)
    }

    /// Fits the study with one effect more, in the form of it that fits best, from what a diagnosis of it has found.
    pub(super) fn with_effect(
        &self,
        rungs: &[Rung],
        values: &[(String, f64)],
        effect: &str,
        answer: &Answer,
        watch: &(dyn Fn(String) + Sync),
    ) -> Result<Fitted, CliError> {
        let study = self.version(rungs, values)?;
        let card = find(effect)?;
        let name = self.path.display().to_string();
        let all = forms(card, None, false, &study)?;
        let drafts = all.iter().map(|form| with_form(&study, card, *form, &name));
        let drafts: Vec<Study> = drafts.collect::<Result<_, _>>()?;
        // forms that the climbed study's own measurements would be refused with are none
        let own =
            |draft: &Study| study.check_places_across_the_face(self.data, draft.effect_model());
        let first = own(&drafts[0]);
        let (drafts, all): (Vec<Study>, Vec<_>) = (drafts.into_iter().zip(all))
            .filter(|(draft, _)| own(draft).is_ok())
            .unzip();
        if drafts.is_empty() {
            first?;
        }
        let added: Vec<AddedForm> = (drafts.iter().zip(&all))
            .map(|(draft, form)| {
                let found = answer.values_of(effect, form.map_or("", |form| form.name));
                AddedForm {
                    named: !found.is_empty(),
                    version: ModelVersion::of(draft).beginning_at(effect, found),
                    grown: form.map_or(&[], |form| form.grown),
                }
            })
            .collect();
        let addition = crate::learn::add(&drafts[0], self.data, &added, &|doing, _| {
            watch(format!("with {effect}: {}", in_words(doing)));
        })?;
        let mut rungs = rungs.to_vec();
        rungs.push(Rung {
            effect: effect.to_owned(),
            form: all[addition.form].map_or(OWN, |form| form.name).to_owned(),
        });
        self.judged(rungs, addition.compared.comparison, watch)
    }

    /// A fit with its error on tests that it was not fitted to.
    fn judged(
        &self,
        rungs: Vec<Rung>,
        comparison: Comparison,
        watch: &(dyn Fn(String) + Sync),
    ) -> Result<Fitted, CliError> {
        let parameters = comparison.parameters.iter();
        let values: Vec<(String, f64)> = parameters.map(|p| (p.name.clone(), p.value)).collect();
        let error = if comparison.holdout.points > 0 {
            None
        } else {
            let study = self.version(&rungs, &values)?;
            left_out(&study, self.data, &|doing| {
                watch(format!("leaving tests out: {}", in_words(doing)));
            })?
        };
        Ok(Fitted {
            standing: Standing::new(&comparison, error),
            rungs,
            values,
            comparison,
        })
    }
}

fn in_words(doing: CompareStage) -> String {
    fitting::state(doing).1
}
