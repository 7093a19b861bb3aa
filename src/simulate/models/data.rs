//! What a comparison of the models yields, as plain data.

use serde::Serialize;

use crate::gear::Region;
use crate::simulate::forward::Conditions;
use crate::simulate::result::Geometry;

/// The models at all radial misalignments.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Conditions; the misalignment is that of each [`Mounted`].
    pub conditions: Conditions,
    /// Numbers of teeth, pinion and gear.
    pub teeth: [u32; 2],
    /// Face width, mm.
    pub face_width: f64,
    /// The paper's own speed of the gear, rpm, for the paper's own pair; none where the tooth numbers decide.
    pub printed_gear_speed: Option<f64>,
    /// Flank edges on Hertz's half width that were asked for.
    pub edges_per_half_width: f64,
    /// One entry per misalignment at which the pair can run.
    pub mounted: Vec<Mounted>,
    /// Misalignments at which it cannot.
    pub left_out: Vec<LeftOut>,
}

/// A misalignment without a result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LeftOut {
    /// Radial misalignment, mm.
    pub misalignment: f64,
    /// Why the pair cannot run.
    pub reason: String,
}

/// The models at one centre distance.
#[derive(Debug, Clone, PartialEq)]
pub struct Mounted {
    /// Radial misalignment, mm.
    pub misalignment: f64,
    /// Working geometry.
    pub geometry: Geometry,
    /// The parts of the path of contact, ascending; empty ones are left out.
    pub spans: Vec<Span>,
    /// The models that could be run: paper, hertz, fem.
    pub models: Vec<ModelResult>,
    /// Why the published model could not be run.
    pub absent: Option<String>,
    /// Where one pair alone carries the load; none where two always share it.
    pub single: Option<SingleContact>,
    /// Each model against each later one of the list.
    pub differences: Vec<Difference>,
    /// From the published model to the Hertz model, from there to the finite elements.
    pub ladders: Vec<Ladder>,
    /// Each correction of the published model by itself; empty beyond 200 000 cycles, where it would cost too much.
    pub alone: Vec<Alone>,
}

impl Mounted {
    /// The result of `kind`.
    pub fn model(&self, kind: Kind) -> Option<&ModelResult> {
        self.models.iter().find(|model| model.kind == kind)
    }

    /// The difference of `model` from `reference` in `quantity`.
    pub fn difference(
        &self,
        quantity: Quantity,
        model: Kind,
        reference: Kind,
    ) -> Option<&Difference> {
        self.differences
            .iter()
            .find(|d| (d.quantity, d.model, d.reference) == (quantity, model, reference))
    }

    /// What each cause adds to the mean of `quantity` between the models `from` and `to`, over all ladders on the way, in the
    /// order in which causes first come up; empty where a ladder does not have the quantity.
    pub fn causes(&self, quantity: Quantity, from: Kind, to: Kind) -> Vec<(Cause, Means)> {
        let mut out: Vec<(Cause, Means)> = Vec::new();
        for ladder in self.ladders.iter().filter(|l| l.from >= from && l.to <= to) {
            let Some(column) = ladder
                .start
                .iter()
                .position(|means| means.quantity == quantity)
            else {
                return Vec::new();
            };
            for rung in &ladder.rungs {
                let change = &rung.changes[column];
                match out.iter_mut().find(|(cause, _)| *cause == rung.cause) {
                    Some((_, sum)) => sum.add(change),
                    None => out.push((rung.cause, change.clone())),
                }
            }
        }
        out
    }

    /// Means of `quantity` in the model `kind`.
    pub fn means(&self, quantity: Quantity, kind: Kind) -> Option<&Means> {
        let at = |ladder: &'_ Ladder| match kind {
            _ if kind == ladder.from => Some(true),
            _ if kind == ladder.to => Some(false),
            _ => None,
        };
        // a quantity may be missing from the ladder on one side only
        self.ladders
            .iter()
            .filter_map(|ladder| {
                at(ladder).map(|start| if start { &ladder.start } else { &ladder.end })
            })
            .find_map(|means| means.iter().find(|m| m.quantity == quantity))
    }
}

/// Where one pair alone carries the load of the unworn flanks by finite elements, and how Hertz's pressure fits there.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SingleContact {
    /// First mesh position, mm along the path of contact from the pitch point; on the nominal path it would be B.
    pub from: f64,
    /// Last mesh position, mm; nominally D.
    pub to: f64,
    /// Largest difference of the finite-element peak pressure from Hertz's under the same load, over Hertz's.
    pub largest_difference: f64,
    /// Mean of the absolute differences, over Hertz's.
    pub mean_difference: f64,
}

/// A contact model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The published model, mistakes included.
    Paper,
    /// Elastic load sharing and Hertz line contact.
    Hertz,
    /// Finite elements.
    Fem,
}

impl Kind {
    /// `paper`, `hertz` or `fem`.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Paper => "paper",
            Kind::Hertz => "hertz",
            Kind::Fem => "fem",
        }
    }

    /// What it assumes.
    pub fn assumptions(self) -> &'static str {
        match self {
            Kind::Paper => {
                "half the load on each pair wherever two pairs are in contact; Hertzian pressure at 50 points, without the tip; each point slides \
                 for as long as the contact takes to reach it from the pitch point; wear changes the profile angle; pinion only"
            }
            Kind::Hertz => {
                "each pair of teeth as a spring along the path of contact, with a gap where it has worn; Hertzian pressure over the width of \
                 the contact; contact on the line of action only"
            }
            Kind::Fem => {
                "elastic gears by finite elements, contact solved at every mesh position on the flanks as worn, including tip corners \
                 that touch off the line of action"
            }
        }
    }
}

/// Part of the path of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Which part.
    pub region: Region,
    /// Where it begins, mm along the path of contact from the pitch point.
    pub from: f64,
    /// Where it ends, mm.
    pub to: f64,
}

/// One model's result.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelResult {
    /// Which model.
    pub kind: Kind,
    /// Contact of the unworn flanks.
    pub contact: ContactCurve,
    /// Contact at the end.
    pub contact_end: ContactCurve,
    /// Wear of the pinion at the end.
    pub pinion: Flank,
    /// Wear of the gear at the end; the published model has none.
    pub gear: Option<Flank>,
}

/// One tooth pair along its way through the mesh; columns of equal length, path ascending.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ContactCurve {
    /// Distance along the path of contact from the pitch point, mm. Where tip corners touch outside the path of contact it is
    /// where the nominal contact would be.
    pub path: Vec<f64>,
    /// Radius of the contact on the pinion, mm.
    pub radius_pinion: Vec<f64>,
    /// Radius of the contact on the gear, mm.
    pub radius_gear: Vec<f64>,
    /// Share of the torque.
    pub load_share: Vec<f64>,
    /// Normal load per face width, N/mm.
    pub line_load: Vec<f64>,
    /// Largest pressure, MPa.
    pub peak_pressure: Vec<f64>,
    /// Whether a tip corner touches outside the line of action.
    pub off_line_of_action: Vec<bool>,
}

/// Worn depth along one flank; columns of equal length, path ascending.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Flank {
    /// Radius, mm.
    pub radius: Vec<f64>,
    /// Distance along the path of contact from the pitch point, mm.
    pub path: Vec<f64>,
    /// Worn depth, µm.
    pub depth_um: Vec<f64>,
}

impl Flank {
    /// The largest depth, µm, and where it is, mm along the path of contact.
    pub fn deepest(&self) -> Option<(f64, f64)> {
        (self.depth_um.iter().zip(&self.path))
            .map(|(&depth, &path)| (depth, path))
            .max_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// What is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Largest contact pressure of the unworn flanks, MPa.
    PeakPressure,
    /// Share of the torque of the unworn flanks.
    LoadShare,
    /// Worn depth of the pinion at the end, µm.
    DepthPinion,
    /// Worn depth of the gear at the end, µm.
    DepthGear,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Quantity; 4] = [
        Quantity::PeakPressure,
        Quantity::LoadShare,
        Quantity::DepthPinion,
        Quantity::DepthGear,
    ];

    /// What it is, in words.
    pub fn label(self) -> &'static str {
        match self {
            Quantity::PeakPressure => "peak pressure",
            Quantity::LoadShare => "load share",
            Quantity::DepthPinion => "worn depth of the pinion",
            Quantity::DepthGear => "worn depth of the gear",
        }
    }

    /// Its unit; `-` for a ratio.
    pub fn unit(self) -> &'static str {
        match self {
            Quantity::PeakPressure => "MPa",
            Quantity::LoadShare => "-",
            Quantity::DepthPinion | Quantity::DepthGear => "µm",
        }
    }
}

/// One model against another in one quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// What is compared.
    pub quantity: Quantity,
    /// The model.
    pub model: Kind,
    /// What it is held against.
    pub reference: Kind,
    /// By part of the path of contact, as [`Mounted::spans`].
    pub regions: Vec<RegionDifference>,
}

/// One model against another on one part of the path of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegionDifference {
    /// Which part.
    pub region: Region,
    /// Mean of the model along the path.
    pub model: f64,
    /// Mean of the reference along the path.
    pub reference: f64,
    /// Difference of the two means over the reference's mean; none where that is zero.
    pub mean: Option<f64>,
    /// Mean of the absolute difference over the reference's mean.
    pub mean_absolute: Option<f64>,
    /// Largest difference at one place, with its sign, over the reference's mean.
    pub max: Option<f64>,
    /// Where that is, mm along the path of contact from the pitch point.
    pub max_path: f64,
}

/// Means (or changes of means) of one quantity along the path of contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Means {
    /// Of what.
    pub quantity: Quantity,
    /// By part of the path, as [`Mounted::spans`].
    pub regions: Vec<f64>,
    /// From the start to the end of the path of contact.
    pub whole: f64,
}

impl Means {
    fn add(&mut self, more: &Means) {
        for (sum, more) in self.regions.iter_mut().zip(&more.regions) {
            *sum += more;
        }
        self.whole += more.whole;
    }
}

/// The way from one model to another, one assumption at a time.
#[derive(Debug, Clone, PartialEq)]
pub struct Ladder {
    /// Where it starts.
    pub from: Kind,
    /// Where it ends.
    pub to: Kind,
    /// Means of the quantities that both ends have, at the start.
    pub start: Vec<Means>,
    /// The same at the end.
    pub end: Vec<Means>,
    /// The replacements in their order.
    pub rungs: Vec<Rung>,
}

/// One assumption replaced.
#[derive(Debug, Clone, PartialEq)]
pub struct Rung {
    /// What kind of assumption.
    pub cause: Cause,
    /// The assumption taken out.
    pub replaced: &'static str,
    /// What stands there from here on.
    pub by: &'static str,
    /// Change of the means, in the order of [`Ladder::start`].
    pub changes: Vec<Means>,
}

/// What an assumption is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Cause {
    /// Wear that changes the profile angle.
    AngleUpdate,
    /// Speed of the gear.
    GearSpeed,
    /// How long a point of the flank is rubbed.
    Dwell,
    /// The points at which the flank is looked at.
    Grid,
    /// Width of the contact.
    ContactWidth,
    /// How the pairs share the load.
    LoadShare,
    /// Contact outside the line of action.
    TipContact,
    /// Distribution of the pressure over the contact.
    PressureShape,
    /// Wear that changes the contact.
    Feedback,
    /// Friction in the contact.
    Friction,
}

impl Cause {
    /// Its name in words.
    pub fn label(self) -> &'static str {
        match self {
            Cause::AngleUpdate => "angle update",
            Cause::GearSpeed => "gear speed",
            Cause::Dwell => "dwell",
            Cause::Grid => "grid",
            Cause::ContactWidth => "contact width",
            Cause::LoadShare => "load share",
            Cause::TipContact => "tip contact",
            Cause::PressureShape => "pressure shape",
            Cause::Feedback => "feedback",
            Cause::Friction => "friction",
        }
    }

    /// What it is, where the name alone does not say it.
    pub fn meaning(self) -> Option<&'static str> {
        match self {
            Cause::AngleUpdate => Some("the profile angle changed by wear"),
            Cause::Dwell => Some("how long each point is taken to slide"),
            Cause::Grid => Some("the points at which wear is computed"),
            Cause::TipContact => Some("tip corners touching off the line of action"),
            Cause::Feedback => Some("wear changing the load and pressure"),
            Cause::GearSpeed
            | Cause::ContactWidth
            | Cause::LoadShare
            | Cause::PressureShape
            | Cause::Friction => None,
        }
    }
}

/// One correction of the published model by itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Alone {
    /// What is corrected.
    pub cause: Cause,
    /// In words.
    pub correction: &'static str,
    /// Change of the pinion's mean depth, µm.
    pub change: Means,
}
