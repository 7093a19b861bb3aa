//! Case C: the geometry of three pairs, closed forms (form radii and tip thicknesses by an independent program).

use crate::gear::{Member, Pair};
use crate::verify::gear_pairs::GearCase;
use crate::verify::{CaseError, Measured};

struct Row {
    case: GearCase,
    /// Centre distance; T1A to T1E; base pitch, mm.
    lengths: [f64; 7],
    angle_deg: f64,
    contact_ratio: f64,
    base: [f64; 2],
    tip: [f64; 2],
    root: [f64; 2],
    form: [f64; 2],
    thickness: [f64; 2],
}

/// Lengths within 1e-4 mm, ratios and angles (degrees) within 1e-5: the printed digits.
///
/// # Errors
/// [`CaseError`] if a pair cannot be built.
pub fn all() -> Result<Vec<Measured>, CaseError> {
    let rows = [
        Row {
            case: GearCase::reference()?,
            lengths: [80.0, 4.0251, 8.1413, 9.2345, 9.9294, 14.0455, 5.90426],
            angle_deg: 20.0,
            contact_ratio: 1.69714,
            base: [25.37170, 49.80371],
            tip: [29.0, 55.0],
            root: [24.5, 50.5],
            form: [25.5968, 51.2952],
            thickness: [1.4551, 1.5577],
        },
        Row {
            case: GearCase::fzg_c()?,
            lengths: [
                91.5001, 4.2946, 10.4378, 13.9702, 17.5792, 23.7224, 13.28459,
            ],
            angle_deg: 22.43891,
            contact_ratio: 1.46243,
            base: [33.82893, 50.74340],
            tip: [41.3177, 59.2717],
            root: [31.1927, 49.1467],
            form: [33.8643, 51.3048],
            thickness: [2.6163, 2.9645],
        },
        Row {
            case: GearCase::s30()?,
            lengths: [60.0, 5.3792, 9.2377, 10.2606, 11.2835, 15.1420, 5.90426],
            angle_deg: 20.0,
            contact_ratio: 1.65351,
            base: [28.19078; 2],
            tip: [32.0; 2],
            root: [27.5; 2],
            form: [28.5341; 2],
            thickness: [1.4748; 2],
        },
    ];
    let mut out = Vec::new();
    for row in rows {
        out.extend(row.measure(&row.case.pair()?));
    }
    Ok(out)
}

impl Row {
    fn measure(&self, p: &Pair) -> Vec<Measured> {
        let row = |what: &str, value: f64, target: f64, tolerance: f64| {
            Measured::absolute(
                "C",
                format!("{} {what}", self.case.name),
                value,
                target,
                tolerance,
            )
        };
        let lengths = [
            ("centre distance, mm", p.centre_distance),
            ("T1A, mm", p.rho_a),
            ("T1B, mm", p.rho_b),
            ("T1C, mm", p.rho_c),
            ("T1D, mm", p.rho_d),
            ("T1E, mm", p.rho_e),
            ("base pitch, mm", p.base_pitch),
        ];
        let mut out: Vec<Measured> = lengths
            .iter()
            .zip(self.lengths)
            .map(|((what, value), target)| row(what, *value, target, 1e-4))
            .collect();
        let angle = p.working_pressure_angle.to_degrees();
        out.push(row(
            "working pressure angle, deg",
            angle,
            self.angle_deg,
            1e-5,
        ));
        out.push(row(
            "contact ratio",
            p.contact_ratio,
            self.contact_ratio,
            1e-5,
        ));
        for (i, member) in Member::BOTH.into_iter().enumerate() {
            let g = p.member(member);
            for (what, value, target) in [
                ("base radius", g.base_radius, self.base[i]),
                ("tip radius", g.tip_radius, self.tip[i]),
                ("root radius", g.root_radius, self.root[i]),
                ("form radius", g.form_radius, self.form[i]),
                (
                    "tip thickness",
                    g.thickness(g.tip_radius),
                    self.thickness[i],
                ),
            ] {
                out.push(row(&format!("{member} {what}, mm"), value, target, 1e-4));
            }
        }
        out
    }
}
