//! S3: helical gears as transverse sections that stand turned along the face.
//!
//! ```text
//! σ_H = Z_H Z_E √(F_t/(d₁ b) (u + 1)/u),  Z_H² = 2 cos β_b cos α_wt/(cos² α_t sin α_wt)      ISO 6336-2, at the pitch point
//! c_γ ∝ c'_th(z_n) cos β (0.75 ε_α + 0.25)                                                  ISO 6336-1
//! length of contact lines = b ε_α/cos β_b at every turn, where ε_β is a whole number
//! ```

use std::f64::consts::PI;

use crate::simulate::forward::Forward;
use crate::simulate::wear_state::WearState;
use crate::study::Study;
use crate::verify::contact_and_wear::Effort;
use crate::verify::{CaseError, Measured};

/// The id of these cases.
pub const ID: &str = "S3";

/// Whence the targets come.
pub const SOURCE: &str = "ISO 21771, ISO 6336-1 and ISO 6336-2; equal lengths of contact lines";

/// Why the tolerances are what they are.
pub const REASON: &str = "1 and 2 % of the contact stress: cells of the analytic contact and edges of the mesh, six on the half width; the standard's mesh stiffness bends the tooth in its normal \
     section, slices in the transverse one, further apart the larger the helix";

/// Module of the normal section, mm.
pub const MODULE: f64 = 3.0;
/// Numbers of teeth of pinion and gear.
pub const TEETH: [f64; 2] = [23.0, 67.0];
const MODULUS: f64 = 2.06e5;
const POISSON: f64 = 0.3;
/// Torque per face width, N·mm/mm.
const TORQUE: f64 = 9000.0;

/// All of them.
///
/// # Errors
/// [`CaseError`] if a pair cannot be built or its contact not solved.
pub fn all(_: Effort) -> Result<Vec<Measured>, CaseError> {
    let mut out = Vec::new();
    for helix in [12.0, 25.0] {
        out.extend(pitch_point(helix)?);
    }
    let spur = stiffness_over_standard(0.0)?;
    for (helix, tolerance) in [(8.0, 0.01), (12.0, 0.015), (20.0, 0.03), (30.0, 0.06)] {
        out.push(Measured::relative(
            ID,
            format!("{helix}°: mean mesh stiffness over ISO 6336-1's, relative to the spur pair"),
            stiffness_over_standard(helix)? / spur,
            1.0,
            tolerance,
        ));
    }
    out.push(whole_overlap()?);
    Ok(out)
}

/// A pair of steel gears: helix angle (deg), slices, face width (mm), edges on the half width.
fn study(helix: f64, slices: usize, width: f64, edges: usize) -> Result<Study, CaseError> {
    let text = format!(
        "[gears]\nmodule = {MODULE}\npressure_angle = 20.0\nface_width = {width}\n\
         [gears.pinion]\nteeth = {}\nbore_diameter = 30.0\n[gears.gear]\nteeth = {}\nbore_diameter = 60.0\n\
         [material]\nyoungs_modulus = {MODULUS}\npoisson_ratio = {POISSON}\ndensity = 7850.0\n\
         [operation]\ntorque = {}\nspeed = 1500.0\n[wear]\ncoefficient = 6e-10\ncycles = 1e5\n\
         [numerics]\npositions = 40\nelements_per_half_width = {edges}\n\
         [face]\nslices = {slices}\ncoupling = \"none\"\nhelix_angle = {helix}\n",
        TEETH[0],
        TEETH[1],
        1e-3 * TORQUE * width
    );
    Study::parse(&text, "study.toml").map_err(CaseError::gears)
}

/// Face width of an overlap ratio, mm.
fn width_of(overlap: f64, helix: f64) -> f64 {
    overlap * PI * MODULE / helix.to_radians().sin()
}

/// What `read` makes of a study's new flanks, by finite elements or analytically.
fn unworn<T>(
    study: &Study,
    elastic: bool,
    read: impl FnOnce(&Forward<'_>, &WearState) -> T,
) -> Result<T, CaseError> {
    let (set, numerics) = (study.gear_set(), study.resolution());
    let conditions = study.operation.simulated(&study.wear);
    let members = if elastic {
        let members = set.members(&numerics, &[conditions.torque], &[0.0]);
        Some(members.map_err(CaseError::gears)?)
    } else {
        None
    };
    let mut forward =
        Forward::new(&set, members.as_ref(), conditions, numerics).map_err(CaseError::gears)?;
    let (mut progress, mut first) = (None, None);
    let store = &mut |state| first = Some(state);
    forward
        .wear(&mut progress, &[0.0], &mut |_| true, store)
        .map_err(CaseError::gears)?;
    let state = first.ok_or_else(|| CaseError::gears("no state was stored"))?;
    Ok(read(&forward, &state))
}

/// The transverse section of the pair without profile shift, from the formulas of ISO 21771 alone.
pub struct Section {
    helix: f64,
    /// Helix angle at the base circles, rad.
    pub base_helix: f64,
    /// Transverse base pitch, mm.
    pub pitch: f64,
    /// Base radii of pinion and gear, mm.
    pub base_radius: [f64; 2],
    /// Ends of the path of contact from the pitch point, mm.
    pub ends: [f64; 2],
    reference: [f64; 2],
    /// Transverse pressure angle, rad.
    angle: f64,
}

impl Section {
    /// Of teeth with the helix angle `helix`, degrees.
    pub fn new(helix: f64) -> Self {
        let helix = helix.to_radians();
        let normal = 20f64.to_radians();
        let angle = (normal.tan() / helix.cos()).atan();
        let reference = TEETH.map(|z| 0.5 * z * MODULE / helix.cos());
        let base_radius = reference.map(|r| r * angle.cos());
        let beyond = |i: usize| {
            let tip = reference[i] + MODULE;
            (tip * tip - base_radius[i] * base_radius[i]).sqrt() - reference[i] * angle.sin()
        };
        Self {
            helix,
            base_helix: (helix.sin() * normal.cos()).asin(),
            pitch: PI * MODULE / helix.cos() * angle.cos(),
            base_radius,
            ends: [-beyond(1), beyond(0)],
            reference,
            angle,
        }
    }

    /// ε_α.
    pub fn contact_ratio(&self) -> f64 {
        (self.ends[1] - self.ends[0]) / self.pitch
    }

    /// c'_th of ISO 6336-1 with the virtual numbers of teeth, N/(mm µm).
    pub fn theoretical(&self) -> f64 {
        let [z1, z2] = TEETH.map(|z| z / (self.base_helix.cos().powi(2) * self.helix.cos()));
        1.0 / (0.04723 + 0.15551 / z1 + 0.25791 / z2)
    }

    /// Mesh stiffness of ISO 6336-1 to a factor that all pairs of these numbers of teeth share.
    fn mesh_stiffness(&self) -> f64 {
        self.theoretical() * self.helix.cos() * (0.75 * self.contact_ratio() + 0.25)
    }

    /// Contact stress of ISO 6336-2 at the pitch point, MPa, under a line load of the transverse section, N/mm.
    fn contact_stress(&self, load: f64) -> f64 {
        let (sin, cos) = self.angle.sin_cos();
        let zone = (2.0 * self.base_helix.cos() * cos / (cos * cos * sin)).sqrt();
        let elastic = (MODULUS / (2.0 * PI * (1.0 - POISSON * POISSON))).sqrt();
        let ratio = TEETH[1] / TEETH[0];
        let tangential = load * cos;
        zone * elastic * (tangential / (2.0 * self.reference[0]) * (ratio + 1.0) / ratio).sqrt()
    }
}

/// Peak pressure of the middle slice where it is nearest to the pitch point, against the standard under the line load found there.
fn pitch_point(helix: f64) -> Result<Vec<Measured>, CaseError> {
    let study = study(helix, 3, 20.0, 6)?;
    let section = Section::new(helix);
    let mut out = Vec::new();
    for (model, elastic, tolerance) in [("analytic", false, 0.01), ("finite elements", true, 0.02)]
    {
        let [found, expected] = unworn(&study, elastic, |forward, state| {
            let positions = &forward.cycle().positions;
            let pairs = (0..positions.len())
                .flat_map(|q| positions[q].pairs.iter().map(move |pair| (q, pair)));
            let nearest = pairs.min_by(|a, b| a.1.path.abs().total_cmp(&b.1.path.abs()));
            let (q, pair) = nearest.expect("a mesh cycle has pairs in contact");
            let own = &state.slices[1].contacts[q].pressure[pair.offset..][..pair.xi.len()];
            let load: f64 = pair.length.iter().zip(own).map(|(l, p)| l * p).sum();
            let peak = own.iter().fold(0.0, |m: f64, p| m.max(*p));
            [peak, section.contact_stress(load)]
        })?;
        out.push(Measured::relative(
            ID,
            format!("{helix}°, {model}: contact stress at the pitch point, MPa"),
            found,
            expected,
            tolerance,
        ));
    }
    Ok(out)
}

/// Mean mesh stiffness of the model over that of the standard.
fn stiffness_over_standard(helix: f64) -> Result<f64, CaseError> {
    let width = if helix == 0.0 {
        30.0
    } else {
        width_of(1.0, helix)
    };
    let section = Section::new(helix);
    let load = TORQUE / section.base_radius[0];
    unworn(&study(helix, 8, width, 2)?, true, |_, state| {
        let secants = (state.contacts.iter())
            .map(|contact| load / (1e3 * contact.approach * section.base_radius[0]));
        secants.sum::<f64>() / state.contacts.len() as f64 / section.mesh_stiffness()
    })
}

/// With a whole number of base pitches between the ends of the face the contact lines have one length at every turn, to the width of a slice.
fn whole_overlap() -> Result<Measured, CaseError> {
    const SLICES: usize = 10;
    let section = Section::new(12.0);
    let study = study(12.0, SLICES, width_of(1.0, 12.0), 2)?;
    let worst = unworn(&study, false, |forward, _| {
        let cycle = forward.cycle();
        let slices = forward.slices().expect("helical gears have slices");
        let length = |turn: usize| {
            let lines = (0..SLICES).map(|i| {
                let q = slices.at(i, turn, cycle.positions.len());
                let paths = cycle.positions[q].pairs.iter().map(|pair| pair.path);
                let on_path = |path: &f64| section.ends[0] < *path && *path < section.ends[1];
                paths.filter(on_path).count()
            });
            lines.sum::<usize>() as f64 / SLICES as f64
        };
        let off = (0..cycle.positions.len()).map(|t| (length(t) - section.contact_ratio()).abs());
        off.fold(0.0, f64::max)
    })?;
    Ok(Measured::bound(
        ID,
        "12°, overlap ratio 1: length of contact lines over b/cos β_b, largest difference from the contact ratio",
        worst,
        1.0 / SLICES as f64,
    ))
}
