//! Two gears put at a centre distance, and every reason for which they cannot run together there.

use super::Pair;
use crate::gear::Member;
use crate::gear::error::PairError;
use crate::gear::fillet::bisect;
use crate::gear::helix::base_helix;
use crate::gear::tooth::Gear;
use crate::numeric::{Vec2, rotate};

impl Pair {
    /// The pair with no less than some backlash, mm.
    pub(super) fn mounted(
        pinion: Gear,
        gear: Gear,
        centre_distance: f64,
        misalignment: f64,
        least_backlash: f64,
    ) -> Result<Pair, PairError> {
        refuse_not_finite("centre distance", centre_distance)?;
        refuse_not_finite("misalignment", misalignment)?;
        let base_pitch = common_base_pitch(&pinion, &gear)?;
        let a = centre_distance + misalignment;
        let base_sum = pinion.base_radius + gear.base_radius;
        if a <= base_sum {
            let backlash = f64::NEG_INFINITY;
            return Err(jam(&pinion, &gear, a, backlash));
        }
        let (z1, z2) = (f64::from(pinion.spec.teeth), f64::from(gear.spec.teeth));
        let pitch_radius_pinion = a * z1 / (z1 + z2);
        let pitch_radius_gear = a - pitch_radius_pinion;
        let backlash = pitch_radius_pinion * pinion.pitch_angle()
            - pinion.thickness(pitch_radius_pinion)
            - gear.thickness(pitch_radius_gear);
        if backlash < least_backlash {
            return Err(jam(&pinion, &gear, a, backlash));
        }
        check_root_clearance(&pinion, &gear, a)?;
        let line_length = ((a - base_sum) * (a + base_sum)).sqrt();
        let rho_a = start_of_contact(&pinion, line_length - gear.rho_end);
        let rho_e = line_length - start_of_contact(&gear, line_length - pinion.rho_end);
        let path_length = rho_e - rho_a;
        if path_length < base_pitch {
            let ratio = path_length / base_pitch;
            return Err(too_far_apart(&pinion, &gear, [a, centre_distance], ratio));
        }
        let working_pressure_angle = line_length.atan2(base_sum);
        let pair = Pair {
            contact_ratio: path_length / base_pitch,
            rho_b: rho_e - base_pitch,
            rho_c: pitch_radius_pinion * working_pressure_angle.sin(),
            base_helix: base_helix(pinion.helix_angle, pinion.rack.pressure_angle),
            rho_d: rho_a + base_pitch,
            speed_ratio: z2 / z1,
            pinion,
            gear,
            centre_distance: a,
            nominal_centre_distance: centre_distance,
            working_pressure_angle,
            base_pitch,
            path_length,
            line_length,
            rho_a,
            rho_e,
            backlash,
            pitch_radius_pinion,
            pitch_radius_gear,
        };
        pair.check_interference()?;
        Ok(pair)
    }

    fn check_interference(&self) -> Result<(), PairError> {
        for member in Member::BOTH {
            let (own, mate) = (self.member(member), self.member(member.other()));
            if free_of_interference(own, mate, self.centre_distance) {
                continue;
            }
            let start = self.line_length - mate.rho_end;
            let base_sum = own.base_radius + mate.base_radius;
            let lower = self
                .centre_distance
                .max((own.rho_form + mate.rho_end).hypot(base_sum));
            let free = |a: f64| {
                if free_of_interference(own, mate, a) {
                    1.0
                } else {
                    -1.0
                }
            };
            return Err(PairError::Interference {
                member,
                start_radius: if start > 0.0 {
                    own.radius_at_rho(start)
                } else {
                    0.0
                },
                form_radius: own.form_radius,
                centre_distance: self.centre_distance,
                min: bisect(lower, lower + own.rack.module, free),
            });
        }
        Ok(())
    }
}

fn refuse_not_finite(quantity: &'static str, value: f64) -> Result<(), PairError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(PairError::NotFinite { quantity, value })
    }
}

/// Base pitch of both members, mm.
fn common_base_pitch(pinion: &Gear, gear: &Gear) -> Result<f64, PairError> {
    let [pinion, gear] = [pinion, gear].map(|member| member.rack.base_pitch());
    if (pinion / gear - 1.0).abs() > 1e-9 {
        return Err(PairError::BasePitch { pinion, gear });
    }
    Ok(pinion)
}

/// The teeth jam at the working centre distance `a` with this `backlash`, mm.
fn jam(pinion: &Gear, gear: &Gear, a: f64, backlash: f64) -> PairError {
    PairError::Jam {
        centre_distance: a,
        backlash_um: 1e3 * backlash,
        min: Pair::tight_centre_distance(pinion, gear),
    }
}

/// Refuses tips that reach the mate's root at the centre distance `a`, mm.
fn check_root_clearance(pinion: &Gear, gear: &Gear, a: f64) -> Result<(), PairError> {
    for (member, tip, root) in [
        (Member::Pinion, pinion.tip_radius, gear.root_radius),
        (Member::Gear, gear.tip_radius, pinion.root_radius),
    ] {
        let clearance = a - tip - root;
        if clearance <= 0.0 {
            return Err(PairError::RootClearance {
                member,
                clearance,
                centre_distance: a,
                min: tip + root,
            });
        }
    }
    Ok(())
}

/// No pair of teeth is in contact at times: the working centre distance `a`, mm, is too large.
fn too_far_apart(
    pinion: &Gear,
    gear: &Gear,
    [a, nominal]: [f64; 2],
    contact_ratio: f64,
) -> PairError {
    let base_sum = pinion.base_radius + gear.base_radius;
    let reach = pinion.rho_end + gear.rho_end - pinion.rack.base_pitch();
    let max = reach.max(0.0).hypot(base_sum);
    PairError::ContactRatio {
        contact_ratio,
        centre_distance: a,
        max_centre_distance: max,
        max_misalignment: max - nominal,
    }
}

/// Whether the mate's tip works on `own`'s involute only, at the centre distance `a`, mm. Two conditions: contact does not
/// begin below the form point (on an undercut flank it cannot), and the tip corner stays out of the fillet on the loaded
/// side while it swings through the space.
fn free_of_interference(own: &Gear, mate: &Gear, a: f64) -> bool {
    const STEPS: u32 = 300;
    let module = own.rack.module;
    let base_sum = own.base_radius + mate.base_radius;
    let line_length = ((a - base_sum) * (a + base_sum)).sqrt();
    let start = line_length - mate.rho_end;
    if !own.undercut && start < own.rho_form - 1e-9 * module {
        return false;
    }
    let alpha = line_length.atan2(base_sum);
    let corner = match mate.tip_rounding_arc() {
        Some(arc) => arc.points(4),
        None => vec![mate.involute_point(mate.rho_tip)],
    };
    // Farther out than this the corner is off the fillet, whatever rounding does to its distance.
    let far = (own.form_radius * (1.0 + 1e-9)).powi(2);
    let reach: Vec<f64> = corner.iter().map(|point| point.norm_squared()).collect();
    // Seen from either member the pair looks the same, so `own` stands at the origin. The corner is on the line of action
    // at `start` and deepest soon after.
    (0..=STEPS).all(|i| {
        let rho = start + (-1.0 + 3.0 * f64::from(i) / f64::from(STEPS)) * own.rack.base_pitch();
        let mate_angle = std::f64::consts::PI - alpha - mate.tangent_angle(line_length - rho);
        let (sin, cos) = mate_angle.sin_cos();
        corner.iter().zip(&reach).all(|(&point, &reach)| {
            // the law of cosines
            if reach + a * (a + 2.0 * (point.x * cos - point.y * sin)) > far {
                return true;
            }
            let own_angle = -alpha - own.tangent_angle(rho);
            let p = rotate(rotate(point, mate_angle) + Vec2::new(a, 0.0), -own_angle);
            let r = p.norm();
            r >= own.form_radius
                || r > own.root_radius && own.is_off_fillet(r, p.y.atan2(p.x), 1e-5 * module)
        })
    })
}

/// Where contact begins on `own`, given where the mate's tip would begin it, mm of own curvature radius.
fn start_of_contact(own: &Gear, by_mate_tip: f64) -> f64 {
    if own.undercut {
        by_mate_tip.max(own.rho_form)
    } else {
        by_mate_tip
    }
}
