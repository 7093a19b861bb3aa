//! Each effect against its formula worked out by hand, at [`ordinary`] unless said.

use std::f64::consts::PI;

use gearwear::effects::{CATALOGUE, Combined, Effect, FaceAt, Hook, Local, Tooth};
use gearwear::gear::Member;

use super::places::{operation, ordinary, profile};
use super::{close, effect, same};

#[test]
fn running_in() {
    let at = ordinary();
    same(
        effect("running_in", &[]).wear_factor(&at),
        1.246_254_995_871_696_4,
    );
    same(
        effect("running_in", &[("shape", 2.0)]).wear_factor(&at),
        1.592_592_592_592_592_6,
    );
    // 1 + 3/e after a decay's worth of own contacts, whatever the pinion's cycles
    let own = effect("running_in", &[("own_contacts", 1.0)]);
    let after = Local {
        contacts: 1e5,
        ..at
    };
    same(own.wear_factor(&after), 2.103_638_323_514_327);
    // local memory: 1 + 3 exp(-2.5e5/1e9) exp(-4/3)
    let memory = [("decay_cycles", 1e9), ("decay_depth", 3.0)];
    same(
        effect("running_in", &memory).wear_factor(&at),
        1.790593741203766,
    );
    // worn depth over k D: N + A N_r (1 − exp(−N/N_r)), by the midpoint rule
    let (end, steps) = (4e5, 40_000);
    let law = effect("running_in", &[]);
    let sum: f64 = (0..steps)
        .map(|i| {
            let cycles = (f64::from(i) + 0.5) * end / f64::from(steps);
            law.wear_factor(&Local { cycles, ..at }) * end / f64::from(steps)
        })
        .sum();
    close(sum / (end + 3e5 * (1.0 - (-4f64).exp())), 1.0, 1e-8);
    // the gear counts pinion cycles too
    assert_eq!(
        law.wear_factor(&Local {
            member: Member::Gear,
            contacts: 1.0,
            ..at
        }),
        law.wear_factor(&at)
    );
}

#[test]
fn pressure_exponent() {
    let at = ordinary();
    let law = effect("pressure_exponent", &[("exponent", 2.46)]);
    same(law.wear_factor(&at), 0.521_222_028_407_028_9);
    let alike = effect("pressure_exponent", &[("exponent", 2.46), ("hertz", 1.0)]);
    // 0.82^1.46
    same(alike.wear_factor(&at), 0.7484593609856252);
    // 140 MPa above a threshold of 500: 1 + 3 140/1000
    let above = effect("pressure_exponent", &[("exponent", 1.0), ("gain", 3.0)]);
    same(above.wear_factor(&at), 1.42);
    let below = Local {
        pressure: 499.0,
        ..at
    };
    assert_eq!(above.wear_factor(&below), 1.0);
    // Over a Hertz passage of half width a and peak p0: ∫ p f dx = B_m 2a p0^m p_ref^(1−m),
    // B_m = (√π/2) Γ(m/2 + 1)/Γ(m/2 + 3/2): π/4 for m = 1, 2/3 for m = 2, 3π/16 for m = 3.
    let (half_width, peak, n) = (0.087, 876.0, 200_000);
    for (exponent, integral) in [(1.0, PI / 4.0), (2.0, 2.0 / 3.0), (3.0, 3.0 * PI / 16.0)] {
        let law = effect("pressure_exponent", &[("exponent", exponent)]);
        let sum: f64 = (0..n)
            .map(|i| {
                let x = (f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0;
                let pressure = peak * (1.0 - x * x).sqrt();
                let factor = law.wear_factor(&Local { pressure, ..at });
                pressure * factor * 2.0 * half_width / f64::from(n)
            })
            .sum();
        let expected =
            integral * 2.0 * half_width * f64::powf(peak, exponent) * 1000f64.powf(1.0 - exponent);
        close(sum / expected, 1.0, 1e-7);
    }
}

#[test]
fn severe_transition() {
    let at = ordinary();
    same(
        effect("severe_transition", &[]).wear_factor(&at),
        8.440_406_146_636_061,
    );
    let at = Local {
        rolling: [1.0, 1.7],
        ..at
    };
    let by_power = effect(
        "severe_transition",
        &[("speed_exponent", 1.0), ("limit", 500.0)],
    );
    same(by_power.wear_factor(&at), 9.922_802_631_276_593);
    // Hertz's pressure instead of the solved one: as that one where they are equal, whatever the solved one is
    let of_load = effect("severe_transition", &[("hertz", 1.0)]);
    let worn = Local {
        hertz_pressure: at.peak_pressure,
        peak_pressure: 0.5 * at.peak_pressure,
        ..at
    };
    same(of_load.wear_factor(&worn), 8.440_406_146_636_061);
    // far below and far above
    let law = effect("severe_transition", &[]);
    close(
        law.wear_factor(&Local {
            peak_pressure: 400.0,
            ..at
        }),
        1.0,
        1e-4,
    );
    close(
        law.wear_factor(&Local {
            peak_pressure: 1600.0,
            ..at
        }),
        10.0,
        1e-9,
    );
}

#[test]
fn film_thickness() {
    let at = Local {
        film_ratio: 0.6,
        ..ordinary()
    };
    let law = effect("film_thickness", &[("lambda0", 0.9), ("exponent", 3.0)]);
    same(law.wear_factor(&at), 27.0 / 35.0);
    same(
        law.wear_factor(&Local {
            film_ratio: 0.9,
            ..at
        }),
        0.5,
    );
    assert_eq!(
        law.wear_factor(&Local {
            film_ratio: 0.0,
            ..at
        }),
        1.0
    );
    // 0.2 + 0.8 × 27/35
    let left = [("lambda0", 0.9), ("exponent", 3.0), ("floor", 0.2)];
    same(
        effect("film_thickness", &left).wear_factor(&at),
        0.2 + 0.8 * 27.0 / 35.0,
    );
}

#[test]
fn flash_temperature() {
    let at = ordinary();
    same(
        effect("flash_temperature", &[]).wear_factor(&at),
        1.296_930_086_665_771_8,
    );
    // 1/(1 − β (T_c − T_ref))
    same(
        effect("flash_temperature", &[("shape", 1.0)]).wear_factor(&at),
        1.351_351_351_351_351_3,
    );
    // 12.5 K above the transition, of width 5 K: 1 + 4/(1 + exp(-2.5))
    same(
        effect("flash_temperature", &[("sensitivity", 0.0), ("ratio", 5.0)]).wear_factor(&at),
        4.696567279915026,
    );
}

#[test]
fn sliding_speed_exponent() {
    let at = Local {
        rolling: [1.0, 1.25],
        ..ordinary()
    };
    let law = effect("sliding_speed_exponent", &[]);
    same(law.wear_factor(&at), 1.515_716_566_510_398);
    // one sign of sliding as the other; floor at 0.02 m/s
    same(
        law.wear_factor(&Local {
            rolling: [1.25, 1.0],
            ..at
        }),
        1.515_716_566_510_398,
    );
    same(
        law.wear_factor(&Local {
            rolling: [1.0, 1.0],
            ..at
        }),
        50f64.powf(0.3),
    );
}

#[test]
fn oxidative() {
    let at = Local {
        rolling: [1.0, 1.25],
        ..ordinary()
    };
    same(
        effect("oxidative", &[]).wear_factor(&at),
        98.998_304_318_311_78,
    );
    // per contact, sliding times factor: the speed cancels
    let faster = Local {
        rolling: [2.0, 2.5],
        ..at
    };
    let law = effect("oxidative", &[]);
    same(law.wear_factor(&faster) * 0.5, law.wear_factor(&at) * 0.25);
}

#[test]
fn surface_layer_and_coating() {
    let at = ordinary();
    same(
        effect("surface_layer", &[("ratio", 3.0)]).wear_factor(&at),
        1.786_938_680_574_733_2,
    );
    let coating = effect("coating", &[]);
    for (depth, factor) in [(0.0, 1.0), (1.7, 1.0), (2.0, 5.5), (2.1, 7.75), (2.5, 10.0)] {
        close(coating.wear_factor(&Local { depth, ..at }), factor, 1e-12);
    }
}

#[test]
fn micropitting() {
    // 3 µm in 1e6 contacts at 1000 MPa
    let at = Local {
        peak_pressure: 1200.0,
        ..ordinary()
    };
    let plain = effect("micropitting", &[]);
    same(plain.added_depth(&at), 6.2208e-6);
    // whatever the sliding, whichever the member
    assert_eq!(
        plain.added_depth(&Local {
            rolling: [1.0, 1.0],
            member: Member::Gear,
            ..at
        }),
        plain.added_depth(&at)
    );
    // capped at 2 GPa
    same(
        plain.added_depth(&Local {
            peak_pressure: 3500.0,
            ..at
        }),
        4.8e-5,
    );
    assert_eq!(
        plain.added_depth(&Local {
            peak_pressure: 0.0,
            ..at
        }),
        0.0
    );
    let full = effect(
        "micropitting",
        &[("lambda_c", 0.6), ("asymmetry", 0.4), ("onset", 1e5)],
    );
    // the pinion's dedendum slides against its rolling (u1 < u2); the gear's addendum meets it
    same(full.added_depth(&at), 4.354_56e-6);
    same(
        full.added_depth(&Local {
            member: Member::Gear,
            ..at
        }),
        3.1104e-6,
    );
    same(
        full.added_depth(&Local {
            member: Member::Gear,
            rolling: [2.1, 1.6],
            ..at
        }),
        4.354_56e-6,
    );
    assert_eq!(
        full.added_depth(&Local {
            film_ratio: 0.6,
            ..at
        }),
        0.0
    );
    assert_eq!(
        full.added_depth(&Local {
            contacts: 99_999.0,
            ..at
        }),
        0.0
    );
    assert!(
        full.added_depth(&Local {
            contacts: 1e5,
            ..at
        }) > 0.0
    );
}

#[test]
fn debris_and_ageing() {
    let at = ordinary();
    same(
        effect("debris_abrasion", &[("amplitude", 0.8)]).wear_factor(&at),
        1.4,
    );
    let settling = effect(
        "debris_abrasion",
        &[("amplitude", 0.8), ("saturation_volume", 200.0)],
    );
    same(settling.wear_factor(&at), 1.32);
    same(
        effect("lubricant_ageing", &[]).wear_factor(&at),
        1.259_181_779_318_282_2,
    );
}

#[test]
fn corrosive_loss() {
    // 0.1 µm in 100 h; at 2000 rpm a pinion tooth meets 12 million contacts in 100 h
    let at = ordinary();
    let law = effect("corrosive_loss", &[]);
    same(law.added_depth(&at) * 12e6, 0.1);
    let gear = Local {
        member: Member::Gear,
        contact_hours: at.contact_hours * 53.0 / 27.0,
        peak_pressure: 0.0,
        ..at
    };
    same(law.added_depth(&gear), 1.635_802_469_135_802_7e-8);
    // after three times the protective hours half of that of a fresh surface: √(1 + 3) = 2
    let slowed = effect("corrosive_loss", &[("protective_hours", 10.0)]);
    let rate = |law: &dyn gearwear::effects::Effect, hours: f64| {
        let at = Local { hours, ..at };
        law.added_depth(&at) / at.contact_hours
    };
    let fresh = rate(&*slowed, 0.0);
    same(rate(&*slowed, 30.0), 0.5 * fresh);
    let depth = |law: &dyn gearwear::effects::Effect, until: f64| -> f64 {
        let step = until / 40_000.0;
        let middles = (0..40_000).map(|i| step * (f64::from(i) + 0.5));
        middles.map(|hours| rate(law, hours) * step).sum()
    };
    // x² + A x = B t of Deal and Grove, linear first with B/A, then with √t
    let after = depth(&*slowed, 400.0);
    let parabolic = 4.0 * 10.0 * fresh * fresh;
    close(
        after * after + parabolic / fresh * after,
        parabolic * 400.0,
        1e-4,
    );
    // the rate is what the first 100 h take
    for protective in [0.1, 10.0, 1000.0] {
        let slowed = effect("corrosive_loss", &[("protective_hours", protective)]);
        close(depth(&*slowed, 100.0), 0.1, 1e-3);
    }
}

#[test]
fn approach_recess() {
    let law = effect("approach_recess", &[]);
    let at = Local {
        path: -0.045,
        ..ordinary()
    };
    same(law.wear_factor(&at), 1.365_529_289_315_002_4);
    let recess = Local {
        path: 0.045,
        approach: false,
        ..at
    };
    same(law.wear_factor(&recess), 1.134_470_710_684_997_6);
    same(law.wear_factor(&Local { path: 0.0, ..at }), 1.25);
    close(law.wear_factor(&ordinary()), 1.5, 1e-12);
    // reversed drive: what was recess is approach
    same(
        law.wear_factor(&Local {
            approach: true,
            ..recess
        }),
        1.365_529_289_315_002_4,
    );
    // growing: nothing in recess and at the pitch point, the whole a base pitch away, as much in proportion between
    let growing = effect("approach_recess", &[("growing", 1.0)]);
    for share in [0.0, 0.25, 1.0] {
        let path = -share * at.base_pitch;
        same(
            growing.wear_factor(&Local { path, ..at }),
            1.0 + 0.5 * share,
        );
    }
    assert_eq!(growing.wear_factor(&recess), 1.0);
}

#[test]
fn member_hardness() {
    let law = effect("member_hardness", &[]);
    let at = ordinary();
    let gear = Local {
        member: Member::Gear,
        ..at
    };
    same(law.wear_factor(&at), 1.221_402_758_160_169_9);
    same(law.wear_factor(&gear), 0.818_730_753_077_981_9);
    same(law.wear_factor(&at) * law.wear_factor(&gear), 1.0);
}

#[test]
fn energy_wear() {
    same(effect("energy_wear", &[]).wear_factor(&ordinary()), 0.75);
}

#[test]
fn roughness_polish_and_plastic_deformation() {
    let polish = effect("roughness_polish", &[]);
    let at = Local {
        contacts: 5000.0,
        ..ordinary()
    };
    same(polish.added_depth(&at), 6.065_306_597_126_335e-5);
    assert_eq!(
        polish.added_depth(&Local {
            peak_pressure: 0.0,
            ..at
        }),
        0.0
    );
    assert!(!polish.keeps_mass());
    let dent = effect("plastic_deformation", &[]);
    let at = Local {
        contacts: 1000.0,
        ..at
    };
    same(dent.added_depth(&at), 7.581_633_246_407_918e-5);
    // exp(-1/2)/2000 of 1/(1 + e)
    let smooth = effect("plastic_deformation", &[("smooth", 1.0)]);
    same(smooth.added_depth(&at), 8.156060886379824e-05);
    assert_eq!(
        dent.added_depth(&Local {
            peak_pressure: 800.0,
            ..at
        }),
        0.0
    );
    assert!(dent.keeps_mass());
    // contact by contact they sum to their limit: h_r (1 − exp(−n/N)); the sum of left values errs by 1/(2N)
    for (law, settling, limit) in [(polish, 1e4, 1.0), (dent, 2e3, 0.25)] {
        let n = 20_000;
        let sum: f64 = (0..n)
            .map(|i| {
                law.added_depth(&Local {
                    contacts: f64::from(i) + 0.5,
                    ..at
                })
            })
            .sum();
        close(sum, limit * (1.0 - (-f64::from(n) / settling).exp()), 1e-8);
    }
}

/// One coefficient; another in recess, which a reversed drive swaps; and the power law of load over speed and radius by hand.
#[test]
fn friction_load() {
    let recess = Local {
        approach: false,
        ..ordinary()
    };
    let approach = Local {
        approach: true,
        ..ordinary()
    };
    let one = effect("friction_load", &[("coefficient", 0.1)]);
    assert_eq!(one.friction(&approach), 0.1);
    assert_eq!(one.friction(&recess), 0.1);
    assert_eq!(one.load_factor(&recess), 1.0);
    let two = effect(
        "friction_load",
        &[("coefficient", 0.1), ("recess_ratio", 0.7)],
    );
    assert_eq!(two.friction(&approach), 0.1);
    same(two.friction(&recess), 0.07);
    let power = effect(
        "friction_load",
        &[("coefficient", 0.05), ("load_exponent", 0.2)],
    );
    // w = 192 N/mm, v_Σ = 2 m/s, ρ = 3 mm: 32^0.2 = 2
    let loaded = Local {
        normal_load: 192.0,
        rolling: [1.2, 0.8],
        curvature: [4.0, 12.0],
        ..ordinary()
    };
    same(power.friction(&loaded), 0.1);
}

#[test]
fn dynamic_load() {
    let law = effect("dynamic_load", &[("phase", 0.4)]);
    let at = Local {
        path: 1.5,
        ..ordinary()
    };
    same(law.load_factor(&at), 0.936_968_525_535_122_3);
    // both pairs of a mesh position carry the same factor: they stand one base pitch apart
    same(
        law.load_factor(&Local {
            path: 1.5 - 5.904,
            ..at
        }),
        law.load_factor(&at),
    );
    // at resonance the ripple grows by 1/(2ζ)
    let at = Local {
        speed: 15_000.0,
        path: 0.0,
        ..at
    };
    same(
        effect("dynamic_load", &[("amplitude", 0.05)]).load_factor(&at),
        1.0 + 0.05 / 0.14,
    );
    // the second harmonic is in resonance at half that speed, and has turned by half a wave after a quarter of a base pitch
    let second = effect(
        "dynamic_load",
        &[("amplitude", 0.0), ("second_amplitude", 0.05)],
    );
    for (share, sign) in [(0.0, 1.0), (0.25, -1.0), (0.5, 1.0)] {
        let at = Local {
            speed: 7_500.0,
            path: share * at.base_pitch,
            ..at
        };
        same(second.load_factor(&at), 1.0 + sign * 0.05 / 0.14);
    }
    // mean and ripple apart: at half the reference speed a quarter of the rise, an eighth of a ripple of the third power
    let apart = effect(
        "dynamic_load",
        &[
            ("amplitude", 0.4),
            ("resonance_speed", 1e6),
            ("mean_rise", 0.2),
            ("speed_exponent", 3.0),
            ("reference_speed", 4000.0),
        ],
    );
    let slow = Local {
        speed: 2000.0,
        path: 0.0,
        ..at
    };
    let gain = 1.0 / (1.0f64 - 4e-6).hypot(0.14 * 2e-3);
    same(apart.load_factor(&slow), 1.0 + 0.05 + 0.05 * gain);
}

/// 6 µm at 119 N/mm and 20 N/(mm µm) give K_Hβ = 1.5.
#[test]
fn where_traces_are_taken_does_not_depend_on_the_order_of_effects() {
    let pair = |names: [&str; 2]| {
        let mut both = Combined::default();
        for name in names {
            both.push(Hook::LoadFactor, effect(name, &[]));
        }
        both.usual_trace().unwrap()
    };
    let trace = pair(["lead_misalignment", "lead_crowning"]);
    assert_eq!(trace, pair(["lead_crowning", "lead_misalignment"]));
    assert_eq!((trace.place, trace.mean), (1.0, 0.0));
}

#[test]
fn lead_misalignment() {
    let at = Local {
        normal_load: 119.0,
        ..ordinary()
    };
    same(
        effect("lead_misalignment", &[]).load_factor(&at),
        1.504_201_680_672_269,
    );
    let wide = |position| {
        effect(
            "lead_misalignment",
            &[("slope", 30.0), ("face_position", position)],
        )
    };
    // √(2 F c/w) where only part of the face carries; a slice in the middle carries less than the mean
    same(wide(1.0).load_factor(&at), 3.175_536_744_149_779);
    same(wide(0.0).load_factor(&at), 0.654_528_340_788_434_4);
    // with the other sign the other end is loaded
    for position in [-1.0, -0.3, 0.0, 0.8] {
        let other = [("slope", -30.0), ("face_position", -position)];
        let other = effect("lead_misalignment", &other);
        same(other.load_factor(&at), wide(position).load_factor(&at));
        let place = |place| FaceAt {
            place,
            width: 30.0,
            normal_force: 0.0,
        };
        assert_eq!(
            other.lead(&place(-position)),
            wide(position).lead(&place(position))
        );
    }
    // the mean over the face is 1: loads of all slices sum to the whole
    let n = 20_000;
    for slope in [6.0, 30.0] {
        let sum: f64 = (0..n)
            .map(|i| {
                let face_position = (f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0;
                let law = effect(
                    "lead_misalignment",
                    &[("slope", slope), ("face_position", face_position)],
                );
                law.load_factor(&at) / f64::from(n)
            })
            .sum();
        // slices off the contact carry the floor of 0.05 instead of nothing
        let bare = if slope == 6.0 {
            0.0
        } else {
            1.0 - (119.0f64 / 300.0).sqrt() + 0.05 * 119.0 / 1200.0
        };
        close(sum, 1.0 + 0.05 * bare, 1e-6);
    }
}

/// 6 µm at 119 N/mm and 20 N/(mm µm): the middle carries 1 + X/3 of the mean, the ends 1 − 2X/3; where only part of the face carries the
/// loads of all slices still sum to the whole.
#[test]
fn lead_crowning() {
    let at = Local {
        normal_load: 119.0,
        ..ordinary()
    };
    let law = |amount: f64, position: f64| {
        effect(
            "lead_crowning",
            &[("amount", amount), ("face_position", position)],
        )
        .load_factor(&at)
    };
    same(law(6.0, 0.0), 1.336_134_453_781_512_6);
    same(law(6.0, 1.0), 0.327_731_092_436_974_8);
    let n = 20_000;
    let place = |i: i32| (f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0;
    for amount in [6.0, 12.0, 40.0] {
        let x = amount * 20.0 / 119.0;
        let sum: f64 = (0..n).map(|i| law(amount, place(i)) / f64::from(n)).sum();
        let reach = (1.5f64 / x).cbrt().min(1.0);
        // slices off the contact carry the floor of 0.05, and those near its end as much at least
        let floor = 0.05 * (1.0 - reach) + 0.05 * 0.05 / (4.0 * x * reach);
        close(sum, 1.0 + f64::from(u8::from(reach < 1.0)) * floor, 2e-5);
    }
    let mean = effect("lead_crowning", &[("amount", 40.0), ("face_mean", 1.0)]);
    assert_eq!(mean.load_factor(&at), 1.0);
}

/// A shaft of 25 mm, 100 mm between its bearings: the slope is the derivative of the textbook's bending line (here integrated numerically from the bending
/// moments), and the load factor does not depend on the torque.
#[test]
fn shaft_deflection() {
    let (span, diameter, force) = (100.0, 25.0, 2500.0);
    let bending = 206_000.0 * std::f64::consts::PI * f64::powi(diameter, 4) / 64.0;
    // slope at `at` of a beam on supports at 0 and `span`: deflection by Mohr's double integral, zero at both supports
    let slope = |load_at: f64, at: f64| {
        let right = force * load_at / span;
        let moment = |x: f64| {
            let from_left = (force - right) * x - force * (x - load_at).max(0.0);
            from_left + right * (x - span).max(0.0)
        };
        let n = 200_000;
        let h = load_at.max(span) / f64::from(n);
        let (mut turn, mut down, mut at_span, mut found) = (0.0, 0.0, 0.0, 0.0);
        for i in 0..n {
            let x = (f64::from(i) + 0.5) * h;
            turn -= h * moment(x) / bending;
            down += h * turn;
            if x < span {
                at_span = down;
            }
            if x < at {
                found = turn;
            }
        }
        found - at_span / span
    };
    let end = |stated: &[(&str, f64)]| {
        let at = FaceAt {
            place: 1.0,
            width: 30.0,
            normal_force: force,
        };
        -effect("shaft_deflection", stated).lead(&at).unwrap()
    };
    for (stated, load_at) in [
        (vec![("offset", 15.0)], 65.0),
        (vec![("offset", 22.0), ("overhung", 1.0)], 122.0),
    ] {
        let expected = 0.5 * 1e3 * 30.0 * slope(load_at, load_at).abs();
        let found = end(&stated);
        close(found, expected, 2e-4 * expected);
    }
    // on the other side of mid-span, or beyond the other bearing, the other end is loaded
    for overhung in [0.0, 1.0] {
        let of = |offset| end(&[("offset", offset), ("overhung", overhung)]);
        same(of(-22.0), -of(22.0));
    }
    let law = effect("shaft_deflection", &[("offset", 15.0)]);
    // the face width is that of the gears: torque over base radius and load per width
    let at = |face_width: f64, torque: f64| {
        let ordinary = ordinary();
        law.load_factor(&Local {
            torque,
            normal_load: 1e3 * torque / (ordinary.base_radius * face_width),
            ..ordinary
        })
    };
    assert!(at(30.0, 100.0) > 1.01);
    same(at(30.0, 100.0), at(30.0, 300.0));
    same(4.0 * (at(15.0, 100.0) - 1.0), at(30.0, 100.0) - 1.0);
}

#[test]
fn mounting() {
    let state = operation();
    let change =
        |name: &str, stated: &[(&str, f64)]| effect(name, stated).operation(&state).centre_distance;
    assert_eq!(change("radial_misalignment", &[("amount", -0.25)]), -0.25);
    same(
        change("bearing_compliance", &[("clearance", 20.0)]),
        0.033_472_838_419_327_626,
    );
    // 80 mm, aluminium on steel, 40 K: 37 µm
    same(change("thermal_expansion", &[("heating", 0.0)]), 0.0368);
    same(state.power(), 20.943_951_023_931_95);
    same(change("thermal_expansion", &[]), 0.056_068_434_942_017_395);
    // stated for the oil's temperature: 1.15e-5 · 80 mm · 20.94 kW · 1 K/kW
    same(
        change("thermal_expansion", &[("warm", 1.0)]),
        0.019_268_434_942_017_4,
    );
    assert!(change("thermal_expansion", &[("expansion", -1e-5)]) < 0.0);
    let off = [("amplitude", 0.0), ("axis_shift", -30.0)];
    same(change("run_out", &off), -0.03);
    let combined = |stated: &[(&str, f64)]| {
        let mut all = Combined::default();
        all.push(Hook::ToothOffset, effect("run_out", stated));
        all
    };
    assert!(combined(&off).acts(Hook::Operation) && !combined(&off).acts(Hook::ToothOffset));
    assert!(combined(&[]).acts(Hook::ToothOffset) && !combined(&[]).acts(Hook::Operation));
    assert_eq!(combined(&off).measured_teeth(), [Member::Pinion]);
    assert!(combined(&[]).measured_teeth().is_empty());
    assert_eq!(combined(&off).felt_by(Some(Member::Pinion)).len(), 1);
    assert!(combined(&off).felt_by(Some(Member::Gear)).is_empty());
    assert_eq!(combined(&[]).felt_by(None).len(), 1);
    assert_eq!(effect("extra_flexibility", &[]).compliance(), 0.02);
}

#[test]
fn flanks_as_made() {
    let at = profile();
    let relief = effect("tip_relief", &[]);
    same(relief.profile(&at), 6.0);
    for member in Member::BOTH {
        let tip = gearwear::effects::ProfileAt {
            member,
            from_tip: 0.0,
            ..at
        };
        same(relief.profile(&tip), 8.0);
        assert_eq!(
            relief.profile(&gearwear::effects::ProfileAt {
                from_tip: 2.0,
                ..tip
            }),
            0.0
        );
    }
    for (other, relieved) in [("on_gear", Member::Pinion), ("on_pinion", Member::Gear)] {
        let relief = effect("tip_relief", &[(other, 0.0)]);
        for member in Member::BOTH {
            let expected = if member == relieved { 6.0 } else { 0.0 };
            same(
                relief.profile(&gearwear::effects::ProfileAt { member, ..at }),
                expected,
            );
        }
    }
    same(effect("tip_relief", &[("exponent", 2.0)]).profile(&at), 4.5);
    same(
        effect("profile_slope", &[("crowning", 4.0)]).profile(&at),
        2.94,
    );
    let wave = gearwear::effects::ProfileAt { along: 0.3, ..at };
    same(
        effect("profile_form", &[("phase", 0.4)]).profile(&wave),
        -1.032_519_276_846_017_2,
    );
    let two = [
        ("phase", 0.4),
        ("second_amplitude", 1.5),
        ("second_phase", 0.7),
        ("second_waves", 5.0),
    ];
    same(
        effect("profile_form", &two).profile(&wave),
        -2.179782557772751,
    );
    let pitch = effect("pitch_error", &[("deviation", -7.0)]);
    let offsets = |effect: &dyn Effect, member: Member| {
        [9, 0, 1, 2].map(|number| {
            effect.tooth_offset(Tooth {
                member,
                number,
                of: 10,
            })
        })
    };
    let none = [0.0; 4];
    assert_eq!(
        offsets(pitch.as_ref(), Member::Pinion),
        [0.0, -7.0, 0.0, 0.0]
    );
    assert_eq!(offsets(pitch.as_ref(), Member::Gear), none);
    let before = [("deviation", 7.0), ("tooth", -1.0), ("on_gear", 1.0)];
    let before = effect("pitch_error", &before);
    assert_eq!(offsets(before.as_ref(), Member::Gear), [7.0, 0.0, 0.0, 0.0]);
    let second = effect("pitch_error", &[("deviation", 7.0), ("alternate", 1.0)]);
    assert_eq!(
        offsets(second.as_ref(), Member::Pinion),
        [0.0, 7.0, 0.0, 7.0]
    );
    // a tenth of a turn from tooth to tooth, the measured one where it stands back most
    let turning = effect("run_out", &[("amplitude", 8.0)]);
    let found = offsets(turning.as_ref(), Member::Pinion);
    for (found, degrees) in found.iter().zip([-36.0_f64, 0.0, 36.0, 72.0]) {
        same(*found, 8.0 * degrees.to_radians().cos());
    }
}

/// Laws that call themselves even over a contact ask for no point's place, depth or pressure, and all others do: with defaults and in every form.
#[test]
fn even_laws_are_the_same_all_over_a_contact() {
    let at = ordinary();
    // thresholds anywhere within what wears and presses
    let radii = [25.4, 26.0, 27.0, 28.0, 29.0].map(|radius| Local { radius, ..at });
    let depths = [0.0, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0].map(|depth| Local { depth, ..at });
    let pressures =
        [1.0, 50.0, 200.0, 500.0, 1000.0, 2000.0].map(|pressure| Local { pressure, ..at });
    let moved = || radii.iter().chain(&depths).chain(&pressures);
    let mut even = 0;
    let cards = CATALOGUE.iter();
    for card in cards.filter(|card| card.hook == Hook::WearFactor) {
        let plain: &[(&str, f64)] = &[];
        for settings in std::iter::once(plain).chain(card.forms.iter().map(|form| form.settings)) {
            let law = effect(card.name, settings);
            let here = law.wear_factor(&at);
            let same = moved().all(|there| law.wear_factor(there) == here);
            assert_eq!(law.is_even(), same, "{} with {settings:?}", card.name);
            even += usize::from(same);
        }
    }
    assert!(even > 10);
}
