//! What a sweep keeps of each run.

use serde::{Deserialize, Serialize};

use crate::simulate::result::{Member, Run};

/// The figures of one point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Figures {
    /// Largest pressure on the unworn flanks, MPa.
    pub peak_pressure: Option<f64>,
    /// Transmission error of the unworn flanks, peak to peak, µrad at the pinion.
    pub te_peak_to_peak_urad: Option<f64>,
    /// Transverse contact ratio.
    pub contact_ratio: f64,
    /// Largest worn depth of the pinion, µm.
    pub max_depth_pinion_um: f64,
    /// Largest worn depth of the gear, µm.
    pub max_depth_gear_um: f64,
    /// Mass lost by the pinion, mg.
    pub mass_loss_pinion_mg: f64,
    /// Mass lost by the gear, mg.
    pub mass_loss_gear_mg: f64,
    /// Relative difference of worn area by law and by geometry.
    pub balance_error: f64,
}

impl Figures {
    /// The figures of a finished run.
    pub(super) fn of(run: &Run) -> Self {
        let [pinion, gear] = Member::BOTH.map(|member| run.last().profile(member));
        Self {
            peak_pressure: run.first().peak_pressure().map(|p| p.0),
            te_peak_to_peak_urad: run.first().te_peak_to_peak_urad(),
            contact_ratio: run.geometry.contact_ratio,
            max_depth_pinion_um: pinion.max_depth(),
            max_depth_gear_um: gear.max_depth(),
            mass_loss_pinion_mg: pinion.mass_loss_mg,
            mass_loss_gear_mg: gear.mass_loss_mg,
            balance_error: run.balance_error,
        }
    }
}

/// One column of the table.
pub(super) struct Column {
    /// Name in the CSV file.
    pub name: &'static str,
    /// Head in the terminal.
    pub head: &'static str,
    /// Its value.
    pub of: fn(&Figures) -> Option<f64>,
}

/// The columns after the varied values.
pub(super) const COLUMNS: [Column; 8] = [
    Column {
        name: "peak_pressure",
        head: "peak MPa",
        of: |f| f.peak_pressure,
    },
    Column {
        name: "te_peak_to_peak_urad",
        head: "TE µrad",
        of: |f| f.te_peak_to_peak_urad,
    },
    Column {
        name: "contact_ratio",
        head: "ratio",
        of: |f| Some(f.contact_ratio),
    },
    Column {
        name: "max_depth_pinion_um",
        head: "pinion µm",
        of: |f| Some(f.max_depth_pinion_um),
    },
    Column {
        name: "max_depth_gear_um",
        head: "gear µm",
        of: |f| Some(f.max_depth_gear_um),
    },
    Column {
        name: "mass_loss_pinion_mg",
        head: "pinion mg",
        of: |f| Some(f.mass_loss_pinion_mg),
    },
    Column {
        name: "mass_loss_gear_mg",
        head: "gear mg",
        of: |f| Some(f.mass_loss_gear_mg),
    },
    Column {
        name: "balance_error",
        head: "balance",
        of: |f| Some(f.balance_error),
    },
];
