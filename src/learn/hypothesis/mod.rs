//! Stage 1, hypothesis: what may be missing from a model.

pub(in crate::learn) mod candidate;
pub(in crate::learn) mod parameters;
mod starting_values;
pub(in crate::learn) mod version;

use std::cmp::Ordering;
use std::fmt;

use serde::{Deserialize, Serialize};

use crate::effects::{CATALOGUE, Card, EffectError, find};

/// One answer to the question what is missing.
///
/// All accepted forms of an effect's law belong to one hypothesis. In documents it has one name: `nothing_missing`, `unknown`,
/// `running_in`, `running_in+tip_relief`, `running_in+unknown`.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Hypothesis {
    /// The base model is complete, as far as these data show.
    NothingMissing,
    /// One or several effects of the catalogue are missing, and nothing else.
    Effects(EffectSet),
    /// Effects of the catalogue are missing, and beside them something that it does not hold.
    EffectsAndUnknown(EffectSet),
    /// Something is missing that the catalogue does not hold.
    Unknown,
}

/// One or several effects of the catalogue, in the catalogue's order.
#[derive(Clone, Serialize, Deserialize)]
#[serde(try_from = "Vec<String>", into = "Vec<String>")]
pub struct EffectSet(Vec<&'static Card>);

impl Hypothesis {
    /// Its effects, if they alone are missing.
    pub fn effects(&self) -> Option<&EffectSet> {
        match self {
            Self::Effects(effects) => Some(effects),
            Self::NothingMissing | Self::EffectsAndUnknown(_) | Self::Unknown => None,
        }
    }

    /// In a sentence: `running_in and tip_relief`.
    pub fn in_words(&self) -> String {
        match self {
            Self::Effects(effects) => effects.in_words(),
            Self::EffectsAndUnknown(effects) => {
                format!("{} beside something unknown", effects.in_words())
            }
            Self::NothingMissing | Self::Unknown => self.to_string(),
        }
    }
}

impl EffectSet {
    /// These effects, each once.
    pub fn new(cards: impl IntoIterator<Item = &'static Card>) -> Self {
        let mut cards: Vec<&'static Card> = cards.into_iter().collect();
        let place = |card: &&Card| CATALOGUE.iter().position(|known| known.name == card.name);
        cards.sort_by_key(place);
        cards.dedup_by_key(|card| card.name);
        Self(cards)
    }

    /// Their cards.
    pub fn cards(&self) -> &[&'static Card] {
        &self.0
    }

    /// Their names.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + use<'_> {
        self.0.iter().map(|card| card.name)
    }

    /// In a sentence: `running_in and tip_relief`.
    pub fn in_words(&self) -> String {
        self.names().collect::<Vec<_>>().join(" and ")
    }

    /// Those that are not among `other`.
    pub fn without(&self, other: &Self) -> Self {
        let kept = self.0.iter().copied();
        Self::new(kept.filter(|card| other.names().all(|name| name != card.name)))
    }

    /// How many they are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is none: the base model.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The card of a single effect.
    pub fn single(&self) -> Option<&'static Card> {
        match self.0[..] {
            [card] => Some(card),
            _ => None,
        }
    }

    /// Whether all of `other` are among them.
    pub fn contains(&self, other: &Self) -> bool {
        let own = |name: &str| self.names().any(|known| known == name);
        other.names().all(own)
    }
}

impl Ord for EffectSet {
    fn cmp(&self, other: &Self) -> Ordering {
        self.names().cmp(other.names())
    }
}

impl PartialOrd for EffectSet {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for EffectSet {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for EffectSet {}

impl fmt::Debug for EffectSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.names()).finish()
    }
}

impl fmt::Display for EffectSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.names().collect::<Vec<_>>().join("+"))
    }
}

impl From<EffectSet> for Vec<String> {
    fn from(effects: EffectSet) -> Self {
        effects.names().map(str::to_owned).collect()
    }
}

impl TryFrom<Vec<String>> for EffectSet {
    type Error = EffectError;

    fn try_from(names: Vec<String>) -> Result<Self, EffectError> {
        let cards: Result<Vec<_>, _> = names.iter().map(|name| find(name)).collect();
        Ok(Self::new(cards?))
    }
}

impl fmt::Display for Hypothesis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NothingMissing => f.write_str("nothing_missing"),
            Self::Effects(effects) => effects.fmt(f),
            Self::EffectsAndUnknown(effects) => write!(f, "{effects}+unknown"),
            Self::Unknown => f.write_str("unknown"),
        }
    }
}

impl Serialize for Hypothesis {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(names: &[&str]) -> EffectSet {
        EffectSet::new(names.iter().map(|name| find(name).unwrap()))
    }

    #[test]
    fn a_set_has_one_name_however_it_is_put_together() {
        let both = set(&["tip_relief", "running_in", "tip_relief"]);
        assert_eq!(both, set(&["running_in", "tip_relief"]));
        assert_eq!(
            Hypothesis::Effects(both.clone()).to_string(),
            "running_in+tip_relief"
        );
        assert!(both.contains(&set(&["tip_relief"])) && !set(&["tip_relief"]).contains(&both));
        assert_eq!(set(&["coating"]).single().unwrap().name, "coating");
        assert!(both.single().is_none());
    }

    #[test]
    fn a_document_holds_names_and_unknown_ones_are_refused() {
        let both = set(&["running_in", "tip_relief"]);
        let text = serde_json::to_string(&both).unwrap();
        assert_eq!(text, "[\"running_in\",\"tip_relief\"]");
        assert_eq!(serde_json::from_str::<EffectSet>(&text).unwrap(), both);
        assert!(serde_json::from_str::<EffectSet>("[\"running\"]").is_err());
        assert_eq!(
            serde_json::to_string(&Hypothesis::Unknown).unwrap(),
            "\"unknown\""
        );
    }
}
