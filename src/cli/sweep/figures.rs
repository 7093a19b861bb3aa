//! What a sweep keeps of each run: figures by their names, and whole wear profiles where they are asked for.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::simulate::result::{Member, Run};
use crate::source_text::nearest;

/// The outputs of one point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Figures {
    /// Figures by the names of their columns; none where a model has no such figure.
    #[serde(flatten)]
    values: BTreeMap<String, Option<f64>>,
    /// Wear profiles by the names of their outputs.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    profiles: BTreeMap<String, Depths>,
}

/// Depth along a flank at the end of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Depths {
    /// Radius, mm, ascending.
    pub radius: Vec<f64>,
    /// Depth, µm.
    pub depth: Vec<f64>,
}

impl Figures {
    /// The outputs of a finished run.
    pub(super) fn of(run: &Run, outputs: &Outputs) -> Self {
        let values = outputs.columns.iter();
        let profiles = outputs.profiles.iter().map(|&member| {
            let profile = run.last().profile(member);
            let depths = Depths {
                radius: profile.radius.clone(),
                depth: profile.depth.clone(),
            };
            (profile_name(member), depths)
        });
        Self {
            values: values
                .map(|column| (column.name.to_owned(), (column.of)(run)))
                .collect(),
            profiles: profiles.collect(),
        }
    }

    /// The figure of a column.
    pub(super) fn value(&self, column: &Column) -> Option<f64> {
        self.values.get(column.name).copied().flatten()
    }

    /// The wear profile of a member, if it was asked for.
    pub(super) fn profile(&self, member: Member) -> Option<&Depths> {
        self.profiles.get(&profile_name(member))
    }
}

/// The name of a wear profile among the outputs.
pub(super) fn profile_name(member: Member) -> String {
    format!("wear_profile_{}", member.name())
}

/// One column of the table.
#[derive(Debug)]
pub(super) struct Column {
    /// Name in the CSV file.
    pub name: &'static str,
    /// Head in the terminal.
    pub head: &'static str,
    /// What it is, above its picture.
    pub title: &'static str,
    /// Its unit in the picture.
    pub unit: &'static str,
    of: fn(&Run) -> Option<f64>,
}

/// Every column that can be asked for.
static COLUMNS: [Column; 17] = [
    Column {
        name: "peak_pressure",
        head: "peak MPa",
        title: "Peak pressure, unworn",
        unit: "MPa",
        of: |run| run.first().peak_pressure().map(|p| p.0),
    },
    Column {
        name: "te_peak_to_peak_urad",
        head: "TE µrad",
        title: "Transmission error, unworn, peak to peak",
        unit: "µrad",
        of: |run| run.first().te_peak_to_peak_urad(),
    },
    Column {
        name: "contact_ratio",
        head: "ratio",
        title: "Contact ratio",
        unit: "",
        of: |run| Some(run.geometry.contact_ratio),
    },
    Column {
        name: "max_depth_pinion_um",
        head: "pinion µm",
        title: "Largest depth worn, pinion",
        unit: "µm",
        of: |run| Some(run.last().pinion.max_depth()),
    },
    Column {
        name: "max_depth_gear_um",
        head: "gear µm",
        title: "Largest depth worn, gear",
        unit: "µm",
        of: |run| Some(run.last().gear.max_depth()),
    },
    Column {
        name: "mass_loss_pinion_mg",
        head: "pinion mg",
        title: "Mass lost, pinion",
        unit: "mg",
        of: |run| Some(run.last().pinion.mass_loss_mg),
    },
    Column {
        name: "mass_loss_gear_mg",
        head: "gear mg",
        title: "Mass lost, gear",
        unit: "mg",
        of: |run| Some(run.last().gear.mass_loss_mg),
    },
    Column {
        name: "balance_error",
        head: "balance",
        title: "Area balance",
        unit: "",
        of: |run| Some(run.balance_error),
    },
    Column {
        name: "peak_pressure_worn",
        head: "worn MPa",
        title: "Peak pressure, worn",
        unit: "MPa",
        of: |run| run.last().peak_pressure().map(|p| p.0),
    },
    Column {
        name: "peak_pressure_elsewhere",
        head: "no kink MPa",
        title: "Peak pressure away from kinks of the flanks, unworn",
        unit: "MPa",
        of: |run| run.first().pressure_elsewhere().map(|p| p.0),
    },
    Column {
        name: "peak_pressure_elsewhere_worn",
        head: "no kink, worn",
        title: "Peak pressure away from kinks of the flanks, worn",
        unit: "MPa",
        of: |run| run.last().pressure_elsewhere().map(|p| p.0),
    },
    Column {
        name: "te_peak_to_peak_worn_urad",
        head: "worn TE µrad",
        title: "Transmission error, worn, peak to peak",
        unit: "µrad",
        of: |run| run.last().te_peak_to_peak_urad(),
    },
    Column {
        name: "single_pair_stiffness",
        head: "N/(mm µm)",
        title: "Stiffness of a single pair",
        unit: "N/(mm µm)",
        of: Run::single_pair_stiffness,
    },
    Column {
        name: "face_load_factor",
        head: "K_Hβ",
        title: "Face load factor, unworn",
        unit: "",
        of: |run| Some(run.first().face_load_factor()),
    },
    Column {
        name: "least_film_ratio",
        head: "film ratio",
        title: "Least film ratio, unworn",
        unit: "",
        of: |run| run.first().least_film_ratio().map(|f| f.0),
    },
    Column {
        name: "largest_flash_temperature_k",
        head: "flash K",
        title: "Largest flash temperature, unworn",
        unit: "K",
        of: |run| run.first().largest_flash_temperature().map(|t| t.0),
    },
    Column {
        name: "friction_power_w",
        head: "friction W",
        title: "Friction power, unworn",
        unit: "W",
        of: |run| run.first().friction_power(),
    },
];

/// Those that a sweep has where none are named.
const DEFAULT: usize = 8;
/// Those of them that its picture shows.
const SHOWN: [&str; 4] = [
    "peak_pressure",
    "te_peak_to_peak_urad",
    "max_depth_pinion_um",
    "max_depth_gear_um",
];
/// Most panels of a picture.
const MOST_PANELS: usize = 8;

/// One output by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Output {
    /// A column of the table, by its place.
    Column(usize),
    /// The depth along the whole flank.
    Profile(Member),
}

/// Reads the name of an output.
pub(super) fn output(text: &str) -> Result<Output, String> {
    let name = text.trim();
    if let Some(place) = COLUMNS.iter().position(|column| column.name == name) {
        return Ok(Output::Column(place));
    }
    let profile = Member::BOTH.into_iter().find(|&m| profile_name(m) == name);
    profile.map(Output::Profile).ok_or_else(|| {
        let profiles = Member::BOTH.map(profile_name);
        let all = || {
            let columns = COLUMNS.iter().map(|column| column.name);
            columns.chain(profiles.iter().map(String::as_str))
        };
        let near =
            nearest(name, all()).map_or(String::new(), |near| format!("; the nearest is {near}"));
        let all: Vec<&str> = all().collect();
        format!("no output of this name{near}; there are {}", all.join(", "))
    })
}

/// The outputs of a sweep.
#[derive(Debug)]
pub(super) struct Outputs {
    /// The table's columns after the varied values.
    pub columns: Vec<&'static Column>,
    /// Members whose wear profiles are kept.
    pub profiles: Vec<Member>,
    named: bool,
}

impl Outputs {
    /// The named ones in their order, each once; the usual ones where none are named.
    pub(super) fn of(named: &[Output]) -> Self {
        let mut outputs = Self {
            columns: Vec::new(),
            profiles: Vec::new(),
            named: !named.is_empty(),
        };
        for (i, output) in named.iter().enumerate() {
            match *output {
                _ if named[..i].contains(output) => {}
                Output::Column(place) => outputs.columns.push(&COLUMNS[place]),
                Output::Profile(member) => outputs.profiles.push(member),
            }
        }
        if named.is_empty() {
            outputs.columns.extend(&COLUMNS[..DEFAULT]);
        }
        outputs
    }

    /// The columns that a picture shows.
    pub(super) fn shown(&self) -> Vec<&'static Column> {
        let all = self.columns.iter().copied();
        let shown = all.filter(|column| self.named || SHOWN.contains(&column.name));
        shown.take(MOST_PANELS).collect()
    }

    /// What distinguishes the points' files from those of the usual outputs; none for these.
    pub(super) fn told_apart(&self) -> Option<String> {
        let columns = self.columns.iter().map(|column| column.name.to_owned());
        let profiles = self.profiles.iter().map(|&member| profile_name(member));
        let mut names: Vec<String> = columns.chain(profiles).collect();
        names.sort_unstable();
        self.named.then(|| names.join(","))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outputs_are_read_by_their_names() {
        let named = ["friction_power_w", "wear_profile_gear", "friction_power_w"];
        let named = named.map(|name| output(name).unwrap());
        let outputs = Outputs::of(&named);
        assert_eq!(outputs.columns.len(), 1);
        assert_eq!(outputs.profiles, [Member::Gear]);
        let usual = Outputs::of(&[]);
        assert_eq!(
            usual.shown().iter().map(|c| c.name).collect::<Vec<_>>(),
            SHOWN
        );
        assert_eq!(usual.told_apart(), None);
        // a peak that may stand over a kink of the flanks has one beside it that does not
        let away = ["peak_pressure_elsewhere", "peak_pressure_elsewhere_worn"];
        let away = Outputs::of(&away.map(|name| output(name).unwrap()));
        assert_eq!(away.columns.len(), 2);
        assert!(
            output("peak_presure")
                .unwrap_err()
                .contains("nearest is peak_pressure;")
        );
    }
}
