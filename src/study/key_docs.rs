//! What every key of a study file is, in machine form: the guide is written from it and tests hold it against the readers.

mod schema;

use super::quantity::{self as q, Quantity};
use super::settings::ContactKind;

pub use schema::schema;

/// One key of a study file.
#[derive(Debug, Clone, Copy)]
pub struct KeyDoc {
    /// Its table as in the file, `gears.pinion` for both members; empty before the first table.
    pub table: &'static str,
    /// The key.
    pub key: &'static str,
    /// What holds where it is not stated.
    pub without: Without,
    /// What it is.
    pub meaning: &'static str,
    value: Value,
}

/// What holds where a key is not stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Without {
    /// The study is refused; for a table that may be absent: the table is.
    Refused,
    /// This value, as a study writes it.
    Default(&'static str),
    /// This, in words.
    Words(&'static str),
}

/// What the value may be.
#[derive(Debug, Clone, Copy)]
enum Value {
    Number(&'static Quantity),
    Count(usize, usize),
    Flag,
    Text,
    Texts,
    Numbers,
    Word(&'static [&'static str]),
    /// A word or a number.
    WordOr(&'static str, &'static Quantity),
    Table,
}

/// The unit of a study's key, or of a parameter of an effect in the catalogue; none for what has no number.
pub fn unit_of(key: &str) -> Option<&'static str> {
    let (table, name) = key.rsplit_once('.')?;
    if let Some(card) = crate::effects::CATALOGUE
        .iter()
        .find(|card| card.name == table)
    {
        let parameter = card
            .params
            .iter()
            .find(|parameter| parameter.name == name)?;
        return Some(parameter.unit);
    }
    // what is said of one member can be said of the other, or of both
    let of_pinion = table.replace(".gear", ".pinion");
    let plain = of_pinion
        .trim_end_matches(".pinion")
        .trim_end_matches(".gear");
    let doc = KEY_DOCS
        .iter()
        .find(|doc| doc.key == name && [table, &of_pinion, plain].contains(&doc.table))?;
    match doc.value {
        Value::Number(quantity) | Value::WordOr(_, quantity) => Some(quantity.unit),
        _ => None,
    }
}

impl KeyDoc {
    /// The allowed values, as a refusal states them.
    pub fn allowed(&self) -> String {
        match self.value {
            Value::Number(quantity) => format!("a number, {quantity}"),
            Value::Count(least, most) => format!("a whole number, {least} to {most}"),
            Value::Flag => "true or false".to_owned(),
            Value::Text => "a text in quotes".to_owned(),
            Value::Texts => "a list of texts, [\"...\"]".to_owned(),
            Value::Numbers => "a list of numbers, [...]".to_owned(),
            Value::Word(words) => {
                let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
                quoted.join(" or ")
            }
            Value::WordOr(word, quantity) => format!("\"{word}\" or a number, {quantity}"),
            Value::Table => "a table".to_owned(),
        }
    }
}

use Without::{Default, Refused, Words};

const fn doc(
    table: &'static str,
    key: &'static str,
    value: Value,
    without: Without,
    meaning: &'static str,
) -> KeyDoc {
    KeyDoc {
        table,
        key,
        without,
        meaning,
        value,
    }
}

const fn number(
    table: &'static str,
    key: &'static str,
    quantity: &'static Quantity,
    without: Without,
    meaning: &'static str,
) -> KeyDoc {
    doc(table, key, Value::Number(quantity), without, meaning)
}

const OUTLIERS: &[&str] = &["report", "robust"];
const CONTACTS: &[&str] = &[
    ContactKind::Fem.name(),
    ContactKind::Hertz.name(),
    ContactKind::Paper.name(),
];
const NOT_STATED: Without = Words("none; reported if needed");
const ANY: Without = Words("no limit");
const OPERATION: Without = Words("that of `[operation]`");

/// Every key there is, in the order of the tables.
#[rustfmt::skip]
pub static KEY_DOCS: &[KeyDoc] = &[
    doc("", "title", Value::Text, Default("\"\""), "free text, shown in reports"),

    number("gears", "module", &q::MODULE, Refused, "module of the basic rack; of helical gears (`face.helix_angle`) the normal one, as all of `[gears]`"),
    number("gears", "pressure_angle", &q::PRESSURE_ANGLE, Refused, "at the reference circle, in the normal section"),
    number("gears", "face_width", &q::FACE_WIDTH, Refused, "common width that carries the load"),
    number("gears", "centre_distance", &q::CENTRE_DISTANCE, Words("the zero-backlash distance for the profile shifts"), "nominal, without misalignment"),
    number("gears", "addendum", &q::ADDENDUM, Default("1.0"), "of the teeth, without profile shift"),
    number("gears", "dedendum", &q::DEDENDUM, Default("1.25"), "of the teeth, without profile shift"),
    number("gears", "fillet_radius", &q::FILLET_RADIUS, Default("0.38"), "tip radius of the cutting rack"),

    doc("gears.pinion", "teeth", Value::Count(5, 1000), Refused, "number of teeth"),
    number("gears.pinion", "profile_shift", &q::PROFILE_SHIFT, Default("0.0"), "shift of the rack away from the axis"),
    number("gears.pinion", "thickness_reduction", &q::THICKNESS_REDUCTION, Default("0.0"), "taken off the tooth's thickness at the reference circle (backlash allowance)"),
    number("gears.pinion", "bore_diameter", &q::BORE_DIAMETER, Refused, "the bore is rigid: the pinion's turns, the gear's is held"),
    number("gears.pinion", "tip_relief_amount", &q::RELIEF_AMOUNT, Default("0.0"), "linear relief at the tip"),
    number("gears.pinion", "tip_relief_length", &q::RELIEF_LENGTH, Default("0.0"), "along the path of contact, from the tip"),
    number("gears.pinion", "tip_rounding", &q::TIP_ROUNDING, Default("0.0"), "radius at the tip corner, 0 is sharp"),
    doc("gears.pinion", "profile_file", Value::Text, Words("an involute"), "a CSV file (radius,deviation in mm and µm) of the unworn flank's measured deviation, relative to the study"),

    number("material", "youngs_modulus", &q::YOUNGS_MODULUS, Refused, "Young's modulus"),
    number("material", "poisson_ratio", &q::POISSON_RATIO, Refused, "Poisson's ratio"),
    number("material", "density", &q::DENSITY, Refused, "turns worn volume into mass"),

    doc("material", "temperatures", Value::Numbers, NOT_STATED, "degC, ascending: where `moduli` hold; a run outside them is refused"),
    doc("material", "moduli", Value::Numbers, NOT_STATED, "MPa, Young's modulus at each of the `temperatures`, linear between them; `youngs_modulus` then only bounds the torque"),

    number("lubricant", "viscosity", &q::VISCOSITY, NOT_STATED, "dynamic, at the operating temperature"),
    number("lubricant", "pressure_viscosity", &q::PRESSURE_VISCOSITY, NOT_STATED, "pressure viscosity coefficient"),
    number("lubricant", "roughness", &q::ROUGHNESS, NOT_STATED, "composite Rq of both flanks, sqrt(Rq1^2 + Rq2^2); of a stated Ra, Rq is about 1.25 Ra (normal heights: sqrt(pi/2))"),
    number("lubricant", "friction_coefficient", &q::FRICTION, NOT_STATED, "coefficient of friction"),

    number("thermal", "bulk_temperature", &q::TEMPERATURE, NOT_STATED, "bulk temperature of the teeth"),
    number("thermal", "conductivity", &q::CONDUCTIVITY, NOT_STATED, "heat conductivity of the teeth"),
    number("thermal", "specific_heat", &q::SPECIFIC_HEAT, NOT_STATED, "specific heat of the teeth"),

    doc("thermal", "tooth_temperature", Value::Word(&["vdi2736"]), Words("as stated"), "bulk and flank temperature of plastic teeth from friction losses where a test states no `bulk_temperature`"),
    number("thermal", "ambient_temperature", &q::TEMPERATURE, Default("20.0"), "around the gears, with `tooth_temperature`"),
    number("thermal", "housing_resistance", &q::HOUSING, Default("0.0"), "resistance of the housing to heat over its surface, with `tooth_temperature`; 0 in the open"),
    number("thermal", "duty", &q::DUTY, Default("1.0"), "part of the time that the gears run, with `tooth_temperature`"),

    number("operation", "torque", &q::TORQUE, Refused, "on the pinion"),
    number("operation", "speed", &q::SPEED, Refused, "of the pinion"),
    number("operation", "misalignment", &q::MISALIGNMENT, Default("0.0"), "radial: added to the centre distance"),

    number("wear", "coefficient", &q::WEAR_COEFFICIENT, Refused, "specific wear coefficient k = K/H of both members; not needed beside `material`"),
    doc("wear", "material", Value::Text, Words("mild wear of metals: 3.2e-10 mm2/N, factor 18"), "a pair of `gearwear materials`: its k is `coefficient` where none is stated, its spread the width of the prior in fits"),
    number("wear", "cycles", &q::CYCLES, Refused, "length of the run"),

    doc("wear", "temperatures", Value::Numbers, NOT_STATED, "degC, ascending: where `factors` hold; a run outside them is refused"),
    doc("wear", "factors", Value::Numbers, NOT_STATED, "k over `coefficient` at each of the `temperatures`, its logarithm linear between them"),

    number("wear.pinion", "coefficient", &q::WEAR_COEFFICIENT, Words("that of `[wear]`"), "the member's own k; a fit scales it with that of `[wear]`"),

    doc("wear.pinion", "material", Value::Text, Words("that of `[wear]`"), "a pair of `gearwear materials`: its k is the member's where none is stated"),

    doc("model", "contact", Value::Word(CONTACTS), Default("\"fem\""), "finite elements, analytic line contact, or the published model with its mistakes"),

    doc("fit", "free", Value::Texts, Default("[\"wear.coefficient\"]"), "what a comparison may adjust: `wear.coefficient`, `EFFECT.PARAMETER`"),

    doc("noise", "coefficient_scatter", Value::WordOr("estimate", &q::SCATTER), Default("\"estimate\""), "relative scatter of k between tests"),
    number("noise", "datum", &q::DATUM, Default("0.5"), "prior standard deviation of a trace's unknown constant datum"),
    number("noise", "trace_tilt", &q::TILT, Default("0.0"), "prior standard deviation of a wear trace's unknown tilt, from end to end"),
    number("noise", "trace_shift", &q::SHIFT, Default("0.0"), "prior standard deviation of the unknown shift of a wear trace's radii on the measuring machine"),
    number("noise", "new_profile", &q::NEW_PROFILE, Default("0.0"), "standard deviation of the scatter of the new profile from which all worn ones of a flank were taken off: every checkpoint shares it"),
    doc("noise", "outliers", Value::Word(OUTLIERS), Default("\"report\""), "rows far from their neighbours: `report` names them and counts them as they are, `robust` counts them with sigma enlarged by their deviation (root of the sum of squares)"),

    doc("effect", "kind", Value::Text, Refused, "an effect of the catalogue, whose parameters are then keys of this table, `\"formula\"` or `\"learned\"`"),
    doc("effect", "name", Value::Text, Refused, "a formula: what results call it; a learned law: a title of your own"),
    doc("effect", "wear_factor", Value::Text, Words("one of the four is stated"), "formula only: factor on the wear coefficient"),
    doc("effect", "added_depth", Value::Text, Words("one of the four is stated"), "formula only: depth besides sliding wear, µm per contact of that member"),
    doc("effect", "load_factor", Value::Text, Words("one of the four is stated"), "formula only: factor on the load of a tooth pair"),
    doc("effect", "profile", Value::Text, Words("one of the four is stated"), "formula only: material removed before the start, µm"),
    doc("effect", "parameters", Value::Table, Words("no parameters"), "formula only: its own parameters, numbers or `{ value, lower, upper }`"),

    doc("effect", "acts", Value::Word(&["wear_factor", "added_depth", "profile"]), Refused, "learned law only: what its values are"),
    doc("effect", "driver", Value::Text, Refused, "learned law only: the variable of formulas that it follows"),
    doc("effect", "member", Value::Word(&["both", "pinion", "gear"]), Default("\"both\""), "learned law only: whose flanks it acts on"),
    doc("effect", "knots", Value::Numbers, Refused, "learned law only: values of the driver, ascending, in its unit"),
    doc("effect", "values", Value::Numbers, Refused, "learned law only, one for each knot: natural logarithm of the factor, µm for a profile, µm per contact for added depth; linear between knots, constant beyond"),
    doc("effect", "size", Value::Number(&q::ANY), Words("1, a profile 5"), "learned law only: prior standard deviation of its values, in their unit; used when it is fitted"),
    doc("effect", "length", Value::Number(&q::ANY), Words("a quarter of the knots' span"), "learned law only: distance of the driver over which it changes; used when it is fitted"),

    doc("test", "id", Value::Text, Refused, "its name in the measurement file, different in each test"),
    doc("test", "role", Value::Word(&["fit", "holdout"]), Default("\"fit\""), "a held-out test is never fitted, only judged"),
    number("test", "torque", &q::TORQUE, OPERATION, "on the pinion"),
    number("test", "speed", &q::SPEED, OPERATION, "of the pinion"),
    number("test", "misalignment", &q::MISALIGNMENT, OPERATION, "radial: added to the centre distance"),
    number("test", "cycles", &q::CYCLES, Words("that of `[wear]`"), "length of the test"),
    number("test", "bulk_temperature", &q::TEMPERATURE, Words("that of `[thermal]`"), "bulk temperature of the teeth"),
    number("test", "viscosity", &q::VISCOSITY, Words("that of `[lubricant]`"), "dynamic, at the test's temperature"),
    doc("test", "reversed", Value::Flag, Default("false"), "the other drive direction"),

    doc("measurements", "file", Value::Text, Refused, "the CSV file, relative to the study"),
    doc("measurements", "tests", Value::Text, Words("`[[test]]` alone"), "a CSV file with a row for each test and the keys of `[[test]]` as columns, relative to the study; its tests come after those of `[[test]]`"),

    doc("face", "slices", Value::Count(1, 201), Words("1, or 7 where an effect acts across the face (11 where it bends)"), "sections across the face that turn together, each with its own wear; 1: one section represents the whole face, and effects across it are a factor on the load there"),
    doc("face", "coupling", Value::Word(super::face::COUPLINGS), Words("`\"teeth\"` for stated slices by finite elements, else `\"none\"`"), "what couples slices besides the common rotation: the teeth that they are cut from, or nothing"),
    doc("face", "ends", Value::Word(super::face::ENDS), Default("\"free\""), "the ends of a face whose slices are coupled by the teeth: free, or held along the axis as if the gear went on behind them"),
    number("face", "helix_angle", &q::HELIX_ANGLE, Default("0.0"), "of helical gears at the reference circle, positive: the pinion is right-handed, and its end +face_width/2 comes into mesh first; needs slices. `[gears]` then states the normal section"),
    number("face.pinion", "lead_slope", &q::LEAD, Default("0.0"), "from end to end of the face, positive: material missing at the end +face_width/2, standing proud at the other"),
    number("face.pinion", "crowning", &q::LEAD, Default("0.0"), "material missing at both ends, a parabola from mid-face"),
    number("face.pinion", "end_relief_amount", &q::LEAD, Default("0.0"), "material missing at both ends, straight"),
    number("face.pinion", "end_relief_length", &q::END_RELIEF_LENGTH, Default("0.0"), "from each end inwards; needed with an amount"),
    doc("face.pinion", "lead_file", Value::Text, Words("straight"), "a CSV file (face,deviation in mm from mid-face and µm) of the measured lead, relative to the study; beyond its rows as at its ends"),

    doc("teeth", "hunting", Value::Word(super::teeth::HUNTING), Default("\"average\""), "average: a tooth meets the mean of its mates; full: each of them in turn, up to 256 different meetings"),
    doc("teeth.pinion", "pitch_file", Value::Text, Words("all in their places"), "a CSV file (tooth,deviation: a row for each tooth from 1 on, µm) of the measured pitch deviations, relative to the study"),
    doc("teeth.pinion", "pitch_deviations", Value::Numbers, Words("all in their places"), "how far each tooth stands back, µm along the path of contact, negative where it stands proud; in the order of coming into mesh, tooth 1 first"),
    doc("teeth.pinion", "pitch_pattern", Value::Numbers, Words("all in their places"), "the same for the first teeth, repeated around the member: [-5, 0] for every second tooth proud; cut short where it does not fit into the number of teeth"),
    number("teeth.pinion", "eccentricity", &q::ECCENTRICITY, Default("0.0"), "of the member's axis: all pairs in mesh stand back by its cosine over the turn, so the lag varies; load sharing is unchanged"),
    number("teeth.pinion", "eccentricity_phase", &q::ECCENTRICITY_PHASE, Default("0.0"), "0: the pairs stand back most as tooth 1 passes the pitch point"),
    doc("teeth.pinion", "classes", Value::Count(1, 64), Default("64"), "largest number of classes of teeth, each with wear of its own; teeth with equal deviation, equal neighbours and equal mates form a class, and beyond this number the most similar classes are merged: faster, and wrong by as much as they differ; by hunting = \"full\" none are"),

    number("rig", "torque_min", &q::TORQUE, ANY, "least on the pinion"),
    number("rig", "torque_max", &q::TORQUE, ANY, "largest on the pinion"),
    number("rig", "speed_min", &q::SPEED, ANY, "least of the pinion"),
    number("rig", "speed_max", &q::SPEED, ANY, "largest of the pinion"),
    number("rig", "misalignment_max", &q::MISALIGNMENT, ANY, "largest radial misalignment that can be set; that of `[operation]` where it cannot be changed"),
    number("rig", "temperature_min", &q::TEMPERATURE, ANY, "least bulk temperature of the teeth that can be held"),
    number("rig", "temperature_max", &q::TEMPERATURE, ANY, "largest bulk temperature of the teeth that can be held"),
    number("rig", "hours_max", &q::RIG_HOURS, ANY, "longest test"),
    doc("rig", "reversible", Value::Flag, Default("true"), "whether it can drive the other flanks"),

    doc("numerics", "order", Value::Count(1, 2), Default("2"), "1: linear triangles, 2: quadratic ones"),
    doc("numerics", "elements_per_half_width", Value::Count(1, 64), Default("5"), "flank elements on the smallest Hertz half width; if not stated, fewer are used (down to 1) where 5 would need more than 3000 unknowns on the parts of a member's flanks that touch"),
    doc("numerics", "positions", Value::Count(8, 5000), Default("100"), "mesh positions per base pitch"),
    number("numerics", "step_tolerance", &q::STEP_TOLERANCE, Default("2e-3"), "relative error of one wear step"),
    doc("numerics", "fields", Value::Count(0, 500), Default("4"), "mesh positions whose stress fields are written"),
    doc("numerics", "friction", Value::Flag, Default("false"), "Coulomb friction (full slip) with `lubricant.friction_coefficient`"),
    doc("numerics", "mesh_pinion", Value::Text, Words("meshed by gearwear"), "a mesh of your own, .vtu or .msh, relative to the study"),
    doc("numerics", "mesh_gear", Value::Text, Words("meshed by gearwear"), "a mesh of your own, .vtu or .msh, relative to the study"),
    doc("numerics", "stored_states", Value::Count(1, 10_000), Default("5"), "worn states that are kept and written"),
];

/// Claim: the table holds every key and nothing else, and says what the readers do.
/// Source: the readers, by studies that state, leave out and misstate each key. Tolerance: none.
#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::{KEYS, Study, formula, learned};
    use super::*;
    use crate::source_text::Fault;

    const NEEDED: &[(&str, &[(&str, &str)])] = &[
        (
            "gears",
            &[
                ("module", "2.0"),
                ("pressure_angle", "20.0"),
                ("face_width", "33.0"),
            ],
        ),
        (
            "gears.pinion",
            &[("teeth", "27"), ("bore_diameter", "25.0")],
        ),
        ("gears.gear", &[("teeth", "53"), ("bore_diameter", "40.0")]),
        (
            "material",
            &[
                ("youngs_modulus", "2.1e5"),
                ("poisson_ratio", "0.3"),
                ("density", "7850.0"),
            ],
        ),
        ("lubricant", &[]),
        ("thermal", &[]),
        ("operation", &[("torque", "100.0"), ("speed", "2000.0")]),
        ("wear", &[("coefficient", "6e-10"), ("cycles", "1e6")]),
        ("wear.pinion", &[("coefficient", "6e-10")]),
        ("model", &[]),
        ("fit", &[]),
        ("noise", &[]),
        ("test", &[("id", "\"A\"")]),
        ("measurements", &[("file", "\"m.csv\"")]),
        ("face", &[]),
        ("face.pinion", &[]),
        ("teeth", &[]),
        ("teeth.pinion", &[]),
        ("rig", &[]),
        ("numerics", &[]),
    ];

    /// The smallest study with `key` of `table` set to `value`, or left out if there is none.
    fn with(table: &str, key: &str, value: Option<&str>) -> Result<Study, Box<(Fault, String)>> {
        let mut text = String::new();
        let mut state = |key: &str, value: &str| text.push_str(&format!("{key} = {value}\n"));
        if let ("", Some(value)) = (table, value) {
            state(key, value);
        }
        for (name, needed) in NEEDED {
            text.push_str(&match *name {
                "test" => "[[test]]\n".to_owned(),
                name => format!("[{name}]\n"),
            });
            for (needed, sample) in *needed {
                if (*name, *needed) != (table, key) {
                    text.push_str(&format!("{needed} = {sample}\n"));
                }
            }
            if let (true, Some(value)) = (*name == table, value) {
                text.push_str(&format!("{key} = {value}\n"));
            }
        }
        Study::parse(&text, "study.toml").map_err(|error| {
            let found = error.diagnostic();
            Box::new((found.fault, found.allowed.clone()))
        })
    }

    fn readable() -> impl Iterator<Item = &'static KeyDoc> {
        KEY_DOCS.iter().filter(|doc| doc.table != "effect")
    }

    #[test]
    fn every_key_is_there_and_nothing_else() {
        let told: BTreeSet<_> = KEY_DOCS.iter().map(|doc| (doc.table, doc.key)).collect();
        assert_eq!(told.len(), KEY_DOCS.len(), "a key stands there twice");
        let members = |key: &str| ["pinion", "gear"].contains(&key);
        let known: BTreeSet<_> = KEYS
            .iter()
            .chain(&[("effect", formula::KEYS), ("effect", learned::KEYS)])
            .flat_map(|(table, keys)| keys.iter().map(move |key| (*table, *key)))
            .filter(|(_, key)| !members(key))
            .collect();
        assert_eq!(told, known);
    }

    #[test]
    fn what_is_needed_and_the_defaults_are_the_readers() {
        let plain = with("", "", None).unwrap_or_else(|e| panic!("{e:?}"));
        for doc in readable() {
            let place = format!("{}.{}", doc.table, doc.key);
            match doc.without {
                Refused => {
                    let refused = with(doc.table, doc.key, None).map_err(|e| e.0);
                    assert_eq!(refused.err(), Some(Fault::MissingKey), "{place}");
                }
                Default(value) => {
                    let stated = with(doc.table, doc.key, Some(value))
                        .unwrap_or_else(|e| panic!("{place}: {e:?}"));
                    // whether the edges were stated only decides what a run does where they cannot be had
                    let numerics = |study: &Study| crate::study::Numerics {
                        edges_stated: false,
                        ..study.numerics.clone()
                    };
                    let same = stated.title == plain.title
                        && stated.gears == plain.gears
                        && stated.operation == plain.operation
                        && stated.contact == plain.contact
                        && stated.noise == plain.noise
                        && stated.tests == plain.tests
                        && stated.free == plain.free
                        && stated.face == plain.face
                        && stated.rig == plain.rig
                        && numerics(&stated) == numerics(&plain);
                    assert!(same, "{place} = {value} is not its default");
                }
                Words(_) => {}
            }
        }
    }

    #[test]
    fn what_is_allowed_is_what_a_refusal_says() {
        for doc in readable() {
            let wrong = match doc.value {
                Value::Word(_) => "\"?\"",
                _ => "1979-05-27",
            };
            let Err(refusal) = with(doc.table, doc.key, Some(wrong)) else {
                panic!("{}.{} took a wrong value", doc.table, doc.key);
            };
            assert_eq!(refusal.1, doc.allowed(), "{}.{}", doc.table, doc.key);
        }
    }
}
