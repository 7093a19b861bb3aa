//! Claim: a study file that is not right is refused with one message that names the place (file, line, column), the key, what
//! was found and what is allowed; a right one gives the values it states, in the units the program works in; no text at all
//! makes the reader panic.
//!
//! Source: the format's description in the README's study section; the limits of the reference pair (27/53 teeth, module 2,
//! centre distance 80 mm) from the closed forms of involute geometry. Tolerance: none for texts; 1e-12 relative for units.

use gearwear::study::{ContactKind, Fault, Order, Role, Scatter, Study};
use proptest::prelude::*;

use crate::common::gears;

/// Every key of the format once, each on its own line.
const FULL: &str = include_str!("../../src/cli/examples/paper.toml");

const SHORT: &str = concat!(
    gears!(),
    "\
[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 6e-10
cycles = 50000
"
);

/// `SHORT` with the line that starts with `old` replaced by `new` (several lines may be given).
fn with(old: &str, new: &str) -> String {
    assert_eq!(SHORT.matches(old).count(), 1, "{old} must stand once");
    SHORT.replace(old, new)
}

struct Refusal {
    fault: Fault,
    key: &'static str,
    line: usize,
    column: usize,
    found: &'static str,
    allowed: &'static str,
    says: &'static str,
}

/// Asserts on the parts and on the whole message.
fn refused(text: &str, expected: Refusal) {
    let error = Study::parse(text, "some/study.toml").expect_err("must be refused");
    let message = error.to_string();
    let diagnostic = error.diagnostic();
    assert_eq!(diagnostic.fault, expected.fault, "{message}");
    assert_eq!(diagnostic.key, expected.key, "{message}");
    assert_eq!(
        error.position(),
        Some((expected.line, expected.column)),
        "{message}"
    );
    let place = format!("some/study.toml:{}:{}", expected.line, expected.column);
    for part in [
        place.as_str(),
        expected.key,
        expected.found,
        expected.allowed,
        expected.says,
        "^",
    ] {
        assert!(message.contains(part), "no `{part}` in:\n{message}");
    }
    assert!(diagnostic.found.contains(expected.found), "{message}");
    assert!(diagnostic.allowed.contains(expected.allowed), "{message}");
}

macro_rules! refusals {
    ($($name:ident: $text:expr => $fault:ident $key:literal at $line:literal:$column:literal, $found:literal, $allowed:literal, $says:literal;)+) => {
        $(#[test]
        fn $name() {
            refused(&$text, Refusal {
                fault: Fault::$fault, key: $key, line: $line, column: $column,
                found: $found, allowed: $allowed, says: $says,
            });
        })+
    };
}

refusals! {
    no_slices: format!("{SHORT}[face]\nslices = 0\n")
        => BadValue "face.slices" at 22:10, "0", "1 to 201", "out of range";
    half_a_slice: format!("{SHORT}[face]\nslices = 2.5\n")
        => WrongType "face.slices" at 22:10, "2.5", "1 to 201", "is the number 2.5, not a whole number";
    unknown_ends_of_the_face: format!("{SHORT}[face]\nslices = 3\nends = \"loose\"\n")
        => BadValue "face.ends" at 23:8, "\"loose\"", "\"held\"", "not known";
    an_unknown_coupling: format!("{SHORT}[face]\nslices = 3\ncoupling = \"springs\"\n")
        => BadValue "face.coupling" at 23:12, "\"springs\"", "\"none\"", "not known";
    a_lead_without_slices: format!("{SHORT}[face.gear]\ncrowning = 5.0\n")
        => Inconsistent "face.gear.crowning" at 22:12, "5.0", "2 or more", "needs slices";
    helical_teeth: format!("{SHORT}[face]\nhelix_angle = 12.0\n")
        => Inconsistent "face.helix_angle" at 22:15, "12.0", "2 or more", "state slices = 11 in [face]";
    teeth_steeper_than_helical: format!("{SHORT}[face]\nhelix_angle = 46.0\nslices = 11\n")
        => BadValue "face.helix_angle" at 22:15, "46.0", "-45 to 45 deg", "8 to 30 is usual";
    analytic_slices_that_are_tied: format!("{SHORT}[face]\nhelix_angle = 12.0\nslices = 11\ncoupling = \"teeth\"\n[model]\ncontact = \"hertz\"\n")
        => Inconsistent "face.coupling" at 24:12, "\"teeth\"", "\"none\"", "ties slices of elastic bodies";
    helical_teeth_by_the_published_model: format!("{SHORT}[model]\ncontact = \"paper\"\n[face]\nhelix_angle = 12.0\nslices = 11\n")
        => Inconsistent "face.slices" at 25:10, "11", "1", "one section of the face";
    helical_teeth_elsewhere: with("module = 2.0", "module = 2.0\nhelix_angle = 12.0")
        => UnknownKey "gears.helix_angle" at 3:1, "helix_angle", "module", "the helix angle stands in [face]";
    an_axis_and_teeth_that_lie_off: format!("{SHORT}[[effect]]\nkind = \"run_out\"\naxis_shift = 20.0\n")
        => Inconsistent "effect.axis_shift" at 23:14, "20.0", "0 um, or amplitude = 0", "amplitude is not 0";
    an_axis_too_far_off: format!("{SHORT}[[effect]]\nkind = \"run_out\"\namplitude = 0.0\naxis_shift = 2e3\n")
        => BadValue "effect.axis_shift" at 24:14, "2e3", "-1000 to 1000 um", "out of range";
    a_gear_beyond_its_bearing: format!("{SHORT}[[effect]]\nkind = \"shaft_deflection\"\noffset = 60.0\n")
        => Inconsistent "effect.offset" at 23:10, "60.0", "-50 to 50 mm", "overhung = 1";
    a_pitch_chart_with_a_wrong_count: format!("{SHORT}[teeth.pinion]\npitch_deviations = [1.0, 2.0]\n")
        => Inconsistent "teeth.pinion.pitch_deviations" at 22:20, "[1.0, 2.0]", "27 numbers", "2 deviations for 27 teeth";
    a_pitch_chart_of_words: format!("{SHORT}[teeth.pinion]\npitch_deviations = [\"a\", \"b\"]\n")
        => WrongType "teeth.pinion.pitch_deviations" at 22:21, "\"a\"", "list of numbers", "not a list";
    a_pitch_chart_with_a_hole: format!("{SHORT}[teeth.pinion]\npitch_pattern = [0.0, nan]\n")
        => BadValue "teeth.pinion.pitch_pattern" at 22:17, "nan", "finite numbers", "holds NaN";
    a_pitch_chart_in_mm: format!("{SHORT}[teeth.pinion]\npitch_pattern = [0.0, 2000.0]\n")
        => BadValue "teeth.pinion.pitch_pattern" at 22:17, "2000", "-1000 to 1000 µm", "out of range";
    a_pattern_longer_than_the_teeth: format!("{SHORT}[teeth.pinion]\npitch_pattern = [1.0]\n")
        => Inconsistent "teeth.pinion.pitch_pattern" at 22:17, "[1.0]", "2 to 27 numbers", "1 deviations";
    two_pitch_charts: format!("{SHORT}[teeth.gear]\npitch_pattern = [1.0, 0.0]\npitch_file = \"p.csv\"\n")
        => Inconsistent "teeth.gear.pitch_file" at 23:14, "\"p.csv\"", "one of them", "pitch_pattern says";
    a_negative_eccentricity: format!("{SHORT}[teeth.gear]\neccentricity = -3.0\n")
        => BadValue "teeth.gear.eccentricity" at 22:16, "-3.0", "0 to 1000 µm", "out of range";
    a_phase_without_eccentricity: format!("{SHORT}[teeth.gear]\neccentricity_phase = 30.0\n")
        => MissingKey "teeth.gear.eccentricity" at 21:1, "no key", "0 to 1000 µm", "state both or none";
    no_class_of_teeth: format!("{SHORT}[teeth.gear]\nclasses = 0\n")
        => BadValue "teeth.gear.classes" at 22:11, "0", "1 to 64", "out of range";
    unknown_hunting: format!("{SHORT}[teeth]\nhunting = \"all\"\n")
        => BadValue "teeth.hunting" at 22:11, "\"all\"", "\"average\" or \"full\"", "not known";
    a_hunting_sequence_too_long: format!("{SHORT}[teeth]\nhunting = \"full\"\n")
        => Inconsistent "teeth.hunting" at 22:11, "\"full\"", "256", "1431 different meetings";
    slices_with_teeth: format!("{SHORT}[face]\nslices = 5\n[teeth.gear]\npitch_pattern = [5.0, 0.0]\n")
        => Inconsistent "face.slices" at 22:10, "5", "1", "one section";
    helical_teeth_that_differ: format!("{SHORT}[face]\nhelix_angle = 12.0\nslices = 11\n[teeth.gear]\npitch_pattern = [5.0, 0.0]\n")
        => Inconsistent "teeth.gear.pitch_pattern" at 25:17, "[5.0, 0.0]", "without this key", "not computed for helical gears";
    the_beginning_of_a_key: format!("{SHORT}[face]\nhelix = 18\n")
        => UnknownKey "face.helix" at 22:1, "`helix`", "helix_angle", "the nearest valid key is `helix_angle`";
    the_beginning_of_a_key_of_another_table: with("module = 2.0", "module = 2.0\nhelix = 18")
        => UnknownKey "gears.helix" at 3:1, "`helix`", "module", "`helix_angle` stands in [face]";
    end_relief_that_no_slice_has: format!("{SHORT}[face]\nslices = 3\n[face.gear]\nend_relief_amount = 10.0\nend_relief_length = 0.5\n")
        => Inconsistent "face.gear.end_relief_length" at 25:21, "0.5", "with 3 slices", "less than half a slice";
    end_relief_longer_than_the_face: format!("{SHORT}[face]\nslices = 3\n[face.gear]\nend_relief_amount = 10.0\nend_relief_length = 20\n")
        => Inconsistent "face.gear.end_relief_length" at 25:21, "20", "up to 16.5 mm: half of the face", "end_relief_length = 20 mm is too long for a face of 33 mm";
    end_relief_of_no_length: format!("{SHORT}[face]\nslices = 3\n[face.gear]\nend_relief_amount = 10.0\nend_relief_length = 0\n")
        => Inconsistent "face.gear.end_relief_length" at 25:21, "0", "above 0", "leaves no length to the relief";
    a_decimal_comma_before_a_unit: with("module = 2.0", "module = \"2,5 mm\"")
        => BadValue "gears.module" at 2:10, "\"2,5 mm\"", "0.05 to 100 mm", "decimals are written with a point: \"2.5 mm\"";
    a_decimal_comma_in_quotes: with("face_width = 33.0", "face_width = \"16,5\"")
        => BadValue "gears.face_width" at 4:14, "\"16,5\"", "0.1 to 5000 mm", "decimals are written with a point: 16.5, without quotes";
    thousands_marks_in_quotes: with("cycles = 50000", "cycles = \"1.000.000\"")
        => BadValue "wear.cycles" at 20:10, "\"1.000.000\"", "pinion revolutions", "marks between thousands are not read";
    a_kinematic_viscosity: format!("{SHORT}[lubricant]\nviscosity = \"20 cSt\"\n")
        => BadValue "lubricant.viscosity" at 22:13, "\"20 cSt\"", "mPa s", "dynamic viscosity = kinematic viscosity × density";
    degrees_fahrenheit: format!("{SHORT}[thermal]\nbulk_temperature = \"32 °F\"\n")
        => BadValue "thermal.bulk_temperature" at 22:20, "\"32 °F\"", "degC, K", "write it in °C or K";
    a_crushing_torque_with_its_unit: with("torque = 100.0", "torque = \"100 kN m\"")
        => Inconsistent "operation.torque" at 16:10, "\"100 kN m\"", "for this pair", "operation.torque = \"100 kN m\" crushes the teeth";
    a_crushing_torque_on_a_narrow_face: with("torque = 100.0", "torque = 100000.0")
        => Inconsistent "operation.torque" at 16:10, "100000.0", "for this pair", "face_width in [gears] is 33 mm, this torque needs";
    negative_module: with("module = 2.0", "module = -2.0")
        => BadValue "gears.module" at 2:10, "-2.0", "0.05 to 100 mm", "out of range";
    nan: with("module = 2.0", "module = nan")
        => BadValue "gears.module" at 2:10, "nan", "0.05 to 100 mm", "not a finite number";
    infinity: with("torque = 100.0", "torque = inf")
        => BadValue "operation.torque" at 16:10, "inf", "N m", "not a finite number";
    number_too_large_for_a_double: with("torque = 100.0", "torque = 1e400")
        => BadValue "operation.torque" at 16:10, "1e400", "N m", "not a finite number";
    unknown_key: with("module = 2.0", "modul = 2.0")
        => UnknownKey "gears.modul" at 2:1, "`modul`", "module, pressure_angle", "the nearest valid key is `module`";
    unknown_table: format!("{SHORT}[measurement]\nfile = \"m.csv\"\n")
        => UnknownKey "measurement" at 21:2, "`measurement`", "measurements", "the nearest valid key is `measurements`";
    key_of_another_table: with("coefficient = 6e-10", "coefficient = 6e-10\ntorque = 1.0")
        => UnknownKey "wear.torque" at 20:1, "`torque`", "coefficient, material, cycles", "`torque` stands in [operation]";
    missing_key: with("module = 2.0\n", "")
        => MissingKey "gears.module" at 1:1, "no key `module`", "0.05 to 100 mm", "gears.module is missing";
    missing_table: with("[wear]\ncoefficient = 6e-10\ncycles = 50000\n", "")
        => MissingKey "wear" at 17:15, "nothing", "coefficient, material, cycles", "the table [wear] is missing";
    text_for_a_number: with("module = 2.0", "module = \"2.0\"")
        => WrongType "gears.module" at 2:10, "the text \"2.0\"", "a number, 0.05 to 100 mm", "without quotes";
    text_with_a_unit_of_another_kind: with("module = 2.0", "module = \"2 deg\"")
        => BadValue "gears.module" at 2:10, "the unit `deg`", "0.05 to 100 mm; a plain number, or a text with one of the units nm, um, mm", "has the unit deg, an angle, where a length is asked for";
    text_with_an_unknown_unit: with("module = 2.0", "module = \"2 mn\"")
        => BadValue "gears.module" at 2:10, "the unit `mn`", "0.05 to 100 mm", "has a unit that is not known";
    text_with_a_unit_out_of_range: with("module = 2.0", "module = \"2 m\"")
        => BadValue "gears.module" at 2:10, "\"2 m\", 2000 mm", "0.05 to 100 mm", "is out of range";
    text_with_a_unit_for_a_plain_number: with("torque = 100.0", "torque = \"1 MPa\"")
        => BadValue "operation.torque" at 16:10, "the unit `MPa`", "N m, kN m, N mm", "a stress, where a torque is asked for";
    list_for_a_number: with("module = 2.0", "module = [2.0]")
        => WrongType "gears.module" at 2:10, "a list", "a number", "gears.module is a list";
    number_for_a_table: format!("lubricant = 3\n{SHORT}")
        => WrongType "lubricant" at 1:13, "3", "a table [lubricant]", "the whole number";
    single_brackets_for_tests: format!("{SHORT}[test]\nid = \"A\"\n")
        => WrongType "test" at 21:1, "a table", "tables [[test]]", "double brackets";
    double_brackets_for_a_table: with("[wear]", "[[wear]]")
        => WrongType "wear" at 18:1, "a list", "[wear]", "single brackets";
    number_for_a_title: format!("title = 3\n{SHORT}")
        => WrongType "title" at 1:9, "3", "a text in quotes", "the whole number";
    fractional_teeth: with("teeth = 27", "teeth = 27.5")
        => WrongType "gears.pinion.teeth" at 6:9, "27.5", "a whole number, 5 to 1000", "decimal point";
    three_teeth: with("teeth = 27", "teeth = 3")
        => BadValue "gears.pinion.teeth" at 6:9, "3", "a whole number, 5 to 1000", "keep contact";
    negative_teeth: with("teeth = 27", "teeth = -27")
        => BadValue "gears.pinion.teeth" at 6:9, "-27", "5 to 1000", "out of range";
    pressure_angle_in_radians: with("pressure_angle = 20.0", "pressure_angle = 0.349")
        => BadValue "gears.pressure_angle" at 3:18, "0.349", "10 to 35 deg", "looks like radians";
    face_width_in_metres: with("face_width = 33.0", "face_width = 0.033")
        => BadValue "gears.face_width" at 4:14, "0.033", "0.1 to 5000 mm", "looks like metres";
    pointed_tooth: with("teeth = 27", "teeth = 27\nprofile_shift = 1.9")
        => Inconsistent "gears.pinion.profile_shift" at 7:17, "1.9", "tip thickness", "tip thickness is";
    bore_wider_than_the_root: with("bore_diameter = 25.0", "bore_diameter = 49.0")
        => Inconsistent "gears.pinion.bore_diameter" at 7:17, "49.0", "0.1 to 47 mm", "rim";
    fillet_too_round: with("face_width = 33.0", "face_width = 33.0\nfillet_radius = 0.9")
        => Inconsistent "gears.fillet_radius" at 5:17, "0.9", "0 to 0.4719 modules", "full round";
    relief_without_a_length: with("teeth = 53", "teeth = 53\ntip_relief_amount = 20.0")
        => Inconsistent "gears.gear.tip_relief_length" at 8:1, "its default", "above 0", "tip relief length";
    gears_too_close: with("face_width = 33.0", "face_width = 33.0\ncentre_distance = 79.5")
        => Inconsistent "gears.centre_distance" at 5:19, "79.5", "80 to 81.499 mm", "jam";
    gears_too_far: with("face_width = 33.0", "face_width = 33.0\ncentre_distance = 84.0")
        => Inconsistent "gears.centre_distance" at 5:19, "84.0", "80 to 81.499 mm", "the teeth do not reach each other";
    misalignment_pulls_apart: with("speed = 2000.0", "speed = 2000.0\nmisalignment = 2.4")
        => Inconsistent "operation.misalignment" at 18:16, "2.4", "to 1.499 mm", "contact ratio is";
    misalignment_jams: with("speed = 2000.0", "speed = 2000.0\nmisalignment = -0.1")
        => Inconsistent "operation.misalignment" at 18:16, "-0.1", "to 1.499 mm", "jam";
    misalignment_of_a_test: format!("{SHORT}[[test]]\nid = \"A\"\n[[test]]\nid = \"B\"\nmisalignment = 2.4\n")
        => Inconsistent "test.misalignment" at 25:16, "2.4", "to 1.499 mm", "contact ratio is";
    interference: with("face_width = 33.0", "face_width = 33.0\naddendum = 1.15")
        => Inconsistent "gears.centre_distance" at 1:1, "its default", "for this pair", "free from 80.0480 mm on";
    youngs_modulus_in_gpa: with("youngs_modulus = 2.1e5", "youngs_modulus = 210")
        => BadValue "material.youngs_modulus" at 12:18, "210", "500 to 1.5e6 MPa", "looks like GPa";
    youngs_modulus_in_pa: with("youngs_modulus = 2.1e5", "youngs_modulus = 2.1e11")
        => BadValue "material.youngs_modulus" at 12:18, "2.1e11", "500 to 1.5e6 MPa", "looks like Pa";
    incompressible: with("poisson_ratio = 0.3", "poisson_ratio = 0.5")
        => BadValue "material.poisson_ratio" at 13:17, "0.5", "above -1, up to 0.4999", "incompressible";
    density_in_g_per_cm3: with("density = 7850.0", "density = 7.85")
        => BadValue "material.density" at 14:11, "7.85", "100 to 25000 kg/m3", "looks like g/cm3";
    material_twice: with("density = 7850.0", "density = 7850.0\n[material.gear]\nyoungs_modulus = 2.8e3\npoisson_ratio = 0.38\ndensity = 1400")
        => Inconsistent "material.youngs_modulus" at 12:18, "2.1e5", "[material.pinion]", "beside a member's own";
    torque_zero: with("torque = 100.0", "torque = 0")
        => BadValue "operation.torque" at 16:10, "0", "above 0", "out of range";
    torque_negative: with("torque = 100.0", "torque = -100.0")
        => BadValue "operation.torque" at 16:10, "-100.0", "above 0", "reversed = true";
    torque_in_nmm: with("torque = 100.0", "torque = 100000.0")
        => Inconsistent "operation.torque" at 16:10, "100000.0", "above 0, up to", "is it in N mm?";
    speed_zero: with("speed = 2000.0", "speed = 0")
        => BadValue "operation.speed" at 17:9, "0", "rpm", "out of range";
    wear_negative: with("coefficient = 6e-10", "coefficient = -6e-10")
        => BadValue "wear.coefficient" at 19:15, "-6e-10", "mm2/N", "out of range";
    wear_without_its_power: with("coefficient = 6e-10", "coefficient = 6.0")
        => BadValue "wear.coefficient" at 19:15, "6.0", "mm2/N", "power of ten";
    cycles_zero: with("cycles = 50000", "cycles = 0")
        => BadValue "wear.cycles" at 20:10, "0", "pinion revolutions", "out of range";
    cycles_negative: with("cycles = 50000", "cycles = -1e3")
        => BadValue "wear.cycles" at 20:10, "-1e3", "above 0", "out of range";
    unknown_contact: format!("{SHORT}[model]\ncontact = \"fme\"\n")
        => BadValue "model.contact" at 22:11, "\"fme\"", "\"fem\" or \"hertz\" or \"paper\"", "the nearest is \"fem\"";
    viscosity_in_cp: format!("{SHORT}[lubricant]\nviscosity = 15\n")
        => BadValue "lubricant.viscosity" at 22:13, "15", "Pa s", "looks like mPa s";
    temperature_in_kelvin: format!("{SHORT}[thermal]\nbulk_temperature = 333.0\n")
        => BadValue "thermal.bulk_temperature" at 22:20, "333.0", "-80 to 300 degC", "looks like kelvin";
    free_unknown: format!("{SHORT}[fit]\nfree = [\"wear.coeficient\"]\n")
        => BadValue "fit.free" at 22:9, "\"wear.coeficient\"", "\"wear.coefficient\"", "the nearest is";
    free_twice: format!("{SHORT}[fit]\nfree = [\"wear.coefficient\", \"wear.coefficient\"]\n")
        => BadValue "fit.free" at 22:29, "\"wear.coefficient\"", "\"wear.coefficient\"", "twice";
    free_of_numbers: format!("{SHORT}[fit]\nfree = [1]\n")
        => WrongType "fit.free" at 22:9, "1", "a text in quotes", "the whole number";
    scatter_of_an_unknown_word: format!("{SHORT}[noise]\ncoefficient_scatter = \"estimated\"\n")
        => BadValue "noise.coefficient_scatter" at 22:23, "\"estimated\"", "\"estimate\" or a number", "";
    scatter_negative: format!("{SHORT}[noise]\ncoefficient_scatter = -0.1\n")
        => BadValue "noise.coefficient_scatter" at 22:23, "-0.1", "0 to 10", "";
    effect_without_a_kind: format!("{SHORT}[[effect]]\namplitude = 3.0\n")
        => MissingKey "effect.kind" at 21:1, "no key `kind`", "a text", "is missing";
    formula_with_two_expressions: format!("{SHORT}[[effect]]\nkind = \"formula\"\nname = \"n\"\nprofile = \"1\"\nwear_factor = \"2\"\n")
        => BadValue "effect.profile" at 24:11, "\"1\"", "one of wear_factor", "second expression";
    test_without_an_id: format!("{SHORT}[[test]]\ntorque = 10\n")
        => MissingKey "test.id" at 21:1, "no key `id`", "a text", "is missing";
    test_twice: format!("{SHORT}[[test]]\nid = \"A\"\n[[test]]\nid = \"A\"\n")
        => BadValue "test.id" at 24:6, "\"A\"", "different in each test", "is taken";
    test_role: format!("{SHORT}[[test]]\nid = \"A\"\nrole = \"hold-out\"\n")
        => BadValue "test.role" at 23:8, "\"hold-out\"", "\"fit\" or \"holdout\"", "the nearest is \"holdout\"";
    test_reversed: format!("{SHORT}[[test]]\nid = \"A\"\nreversed = 1\n")
        => WrongType "test.reversed" at 23:12, "1", "true or false", "the whole number";
    measurements_without_a_file: format!("{SHORT}[measurements]\n")
        => MissingKey "measurements.file" at 21:1, "no key `file`", "file name", "is missing";
    order_three: format!("{SHORT}[numerics]\norder = 3\n")
        => BadValue "numerics.order" at 22:9, "3", "1 to 2", "linear";
    friction_without_a_coefficient: format!("{SHORT}[numerics]\nfriction = true\n")
        => Inconsistent "numerics.friction" at 22:12, "true", "lubricant.friction_coefficient", "[lubricant]";
    duplicate_key: with("module = 2.0", "module = 2.0\nmodule = 3.0")
        => Syntax "module" at 3:1, "`module`", "each key once", "stands twice";
    duplicate_table: format!("{SHORT}[wear]\n")
        => Syntax "wear" at 21:2, "`wear`", "each key once", "stands twice";
    syntax_value: with("module = 2.0", "module = two")
        => Syntax "module" at 2:10, "`two`", "a number, a text in quotes", "not valid TOML";
    a_decimal_comma: with("module = 2.0", "module = 2,0")
        => Syntax "module" at 2:11, "`,`", "newline", "decimals take a point here";
    syntax_header: with("[wear]", "[wear")
        => Syntax "" at 18:6, "the end of the line", "`]`", "unclosed table";
    syntax_decimal_comma: with("module = 2.0", "module = 2,0")
        => Syntax "module" at 2:11, "`,", "", "not valid TOML";
    syntax_end: "[gears]\nmodule ="
        => Syntax "module" at 2:9, "the end", "", "not valid TOML";
}

#[test]
fn a_parameter_that_there_was_once_is_refused_with_what_holds_instead() {
    let once = format!("{SHORT}[[effect]]\nkind = \"shaft_deflection\"\nface_width = 30.0\n");
    let message = Study::parse(&once, "study.toml").unwrap_err().to_string();
    assert!(message.contains("study.toml:23:1"), "{message}");
    assert!(
        message.contains("the face width is that of [gears]"),
        "{message}"
    );
    assert!(
        message.contains("`gearwear effects shaft_deflection` explains"),
        "{message}"
    );
}

#[test]
fn spur_gears_may_say_that_they_are() {
    let stated = format!("{SHORT}[face]\nhelix_angle = 0.0\n");
    let study = Study::parse(&stated, "study.toml").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(study.face, Study::parse(SHORT, "study.toml").unwrap().face);
    let overhung = "[[effect]]\nkind = \"shaft_deflection\"\noffset = 60.0\noverhung = 1\n";
    Study::parse(&format!("{SHORT}{overhung}"), "study.toml").unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn empty_file_names_the_first_table() {
    let error = Study::parse("", "study.toml").unwrap_err();
    let message = error.to_string();
    assert_eq!(error.diagnostic().key, "gears");
    assert!(message.contains("study.toml:1:1"), "{message}");
}

#[test]
fn a_message_looks_like_a_compilers() {
    let error = Study::parse(
        &with("speed = 2000.0", "speed = 2000.0\nmisalignment = 2.4"),
        "study.toml",
    )
    .unwrap_err();
    insta_like(
        &error.to_string(),
        "\
error: operation.misalignment = 2.4: contact ratio is 0.6168, at least 1 is needed: centre distance 82.4000 mm found, at most 81.4996 mm allowed, a misalignment of at most 1.4996 mm
  --> study.toml:18:16
   |
18 | misalignment = 2.4
   |                ^^^ found 2.4, allowed: 0 to 1.499 mm for this pair
   |
   = help: the misalignment is added to the centre distance (80 mm)",
    );
}

fn insta_like(found: &str, expected: &str) {
    assert_eq!(
        found.trim_end(),
        expected.trim_end(),
        "\nfound:\n{found}\nexpected:\n{expected}"
    );
}

#[test]
fn values_arrive_in_the_units_of_the_program() {
    let study = Study::parse(FULL, "folder/study.toml").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(study.gears.pinion.spec.teeth, 27);
    assert_eq!(study.gears.gear.spec.teeth, 53);
    assert!((study.gears.pinion.rack.pressure_angle - std::f64::consts::PI / 9.0).abs() < 1e-15);
    assert_eq!(study.gears.centre_distance, 80.0);
    assert_eq!(study.operation.torque_nmm, 1e5, "100 N m");
    assert_eq!(study.operation.cycles, 50_000.0);
    assert_eq!(study.operation.bulk_temperature_c, Some(60.0));
    assert_eq!(study.operation.viscosity_pa_s, Some(0.015));
    assert_eq!(study.wear.coefficient, 6e-10);
    assert_eq!(study.contact, ContactKind::Fem);
    let free: Vec<&str> = study.free().iter().map(|p| p.name.as_str()).collect();
    assert_eq!(free, ["wear.coefficient"]);
    assert_eq!(study.noise.coefficient_scatter, Scatter::Estimate);
    assert_eq!(
        study.measurements.as_deref(),
        Some(std::path::Path::new("folder/measurements.csv"))
    );
    assert_eq!(study.materials.pinion, study.materials.gear);
}

#[test]
fn defaults_are_those_of_the_format() {
    let study = Study::parse(SHORT, "study.toml").unwrap();
    let rack = study.gears.pinion.rack;
    assert_eq!(
        (rack.addendum, rack.dedendum, rack.fillet_radius),
        (1.0, 1.25, 0.38),
        "ISO 53 profile A"
    );
    assert_eq!(
        study.gears.centre_distance, 80.0,
        "zero backlash: m (z1 + z2)/2 without profile shift"
    );
    assert_eq!(study.operation.misalignment_mm, 0.0);
    assert_eq!(
        (study.lubricant, study.thermal, study.measurements.clone()),
        (None, None, None)
    );
    assert_eq!(study.contact, ContactKind::Fem);
    let free: Vec<&str> = study.free().iter().map(|p| p.name.as_str()).collect();
    assert_eq!(free, ["wear.coefficient"]);
    assert_eq!(
        (study.noise.coefficient_scatter, study.noise.datum_um),
        (Scatter::Estimate, 0.5)
    );
    let n = &study.numerics;
    assert_eq!(
        (n.order, n.elements_per_half_width, n.positions, n.fields),
        (Order::Quadratic, 5, 100, 4)
    );
    assert_eq!(
        (n.step_tolerance, n.friction, n.stored_states),
        (2e-3, false, 5)
    );
}

/// The studies that `gearwear init` writes say that their numerics are the defaults.
#[test]
fn the_examples_have_the_default_numerics() {
    let default = Study::parse(SHORT, "study.toml").unwrap().numerics;
    for text in [
        include_str!("../../src/cli/examples/paper.toml"),
        include_str!("../../src/cli/examples/fzg-c.toml"),
        include_str!("../../src/cli/examples/plastic-steel.toml"),
    ] {
        assert!(text.contains(
            "[numerics]                # optional, and every key of it; these are the defaults"
        ));
        assert_eq!(Study::parse(text, "study.toml").unwrap().numerics, default);
    }
}

/// FZG type C: 91.5001 mm is free of backlash for x = 0.1817/0.1715, m 4.5, 16/24 teeth (published: 91.5 nominal).
#[test]
fn default_centre_distance_follows_the_profile_shifts() {
    let text = SHORT
        .replace("module = 2.0", "module = 4.5")
        .replace("face_width = 33.0", "face_width = 14.0")
        .replace("teeth = 27", "teeth = 16\nprofile_shift = 0.1817")
        .replace("teeth = 53", "teeth = 24\nprofile_shift = 0.1715");
    let study = Study::parse(&text, "study.toml").unwrap_or_else(|error| panic!("{error}"));
    assert!(
        (study.gears.centre_distance - 91.5001).abs() < 1e-4,
        "{}",
        study.gears.centre_distance
    );
}

#[test]
fn relief_is_stated_in_micrometres_and_used_in_millimetres() {
    let text = with(
        "teeth = 53",
        "teeth = 53\ntip_relief_amount = 20\ntip_relief_length = 2",
    );
    let study = Study::parse(&text, "study.toml").unwrap();
    assert!((study.gears.gear.spec.tip_relief_amount - 0.02).abs() < 1e-15);
    assert_eq!(study.gears.gear.spec.tip_relief_length, 2.0);
}

#[test]
fn tests_override_the_operation() {
    let text = format!(
        "{SHORT}[[test]]\nid = \"A\"\n[[test]]\nid = \"B\"\nrole = \"holdout\"\ntorque = 50\nspeed = 600\nmisalignment = 0.5\n\
         cycles = 1e6\nviscosity = 0.03\nbulk_temperature = 80\nreversed = true\n"
    );
    let study = Study::parse(&text, "study.toml").unwrap();
    assert_eq!(study.tests[0].conditions, study.operation);
    assert_eq!(study.tests[0].role, Role::Fit);
    let b = study.conditions(Some("B")).unwrap();
    assert_eq!(study.tests[1].role, Role::Holdout);
    assert_eq!(
        (b.torque_nmm, b.speed_rpm, b.misalignment_mm, b.cycles),
        (5e4, 600.0, 0.5, 1e6)
    );
    assert_eq!(
        (b.viscosity_pa_s, b.bulk_temperature_c, b.reversed),
        (Some(0.03), Some(80.0), true)
    );
    assert_eq!(study.conditions(None).unwrap(), &study.operation);
    let message = study.conditions(Some("b")).unwrap_err().to_string();
    for part in [
        "study.toml:21:1",
        "\"b\"",
        "\"A\", \"B\"",
        "the nearest is \"B\"",
    ] {
        assert!(message.contains(part), "{part} in:\n{message}");
    }
}

#[test]
fn each_member_may_have_its_own_material() {
    let text = with(
        "[material]\nyoungs_modulus = 2.1e5\npoisson_ratio = 0.3\ndensity = 7850.0\n",
        "[material.pinion]\nyoungs_modulus = 2.1e5\npoisson_ratio = 0.3\ndensity = 7850.0\n\
         [material.gear]\nyoungs_modulus = 2800\npoisson_ratio = 0.38\ndensity = 1410\n",
    );
    let study = Study::parse(&text, "study.toml").unwrap();
    assert_eq!(study.materials.gear.elastic.youngs_modulus, 2800.0);
    assert_eq!(study.materials.pinion.elastic.youngs_modulus, 2.1e5);
}

#[test]
fn a_byte_order_mark_and_windows_line_ends_change_nothing() {
    let plain = Study::parse(SHORT, "study.toml").unwrap();
    let windows = Study::parse(
        &format!("\u{feff}{}", SHORT.replace('\n', "\r\n")),
        "study.toml",
    )
    .unwrap();
    assert_eq!(windows.gears, plain.gears);
    assert_eq!(windows.operation, plain.operation);
    let bad = with("module = 2.0", "module = -2.0").replace('\n', "\r\n");
    let error = Study::parse(&format!("\u{feff}{bad}"), "study.toml").unwrap_err();
    assert_eq!(error.position(), Some((2, 10)));
    assert!(!error.to_string().contains('\r'), "{error}");
}

#[test]
fn files_that_cannot_be_read_are_refused_with_their_name() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("good.toml"), SHORT).unwrap();
    let missing = Study::load(&folder.path().join("god.toml")).unwrap_err();
    assert_eq!(missing.diagnostic().fault, Fault::Unreadable);
    for part in ["god.toml", "no such file", "study files here: good.toml"] {
        assert!(missing.to_string().contains(part), "{missing}");
    }
    let of_folder = Study::load(folder.path()).unwrap_err();
    assert!(
        of_folder.to_string().contains("found a folder"),
        "{of_folder}"
    );

    let latin = folder.path().join("latin.toml");
    std::fs::write(&latin, b"# ok\ntitle = \"Zahnr\xe4der\"\n").unwrap();
    let error = Study::load(&latin).unwrap_err();
    assert_eq!(error.diagnostic().fault, Fault::NotUtf8);
    assert_eq!(error.position(), Some((2, 15)));
    for part in [
        "latin.toml:2:15",
        "found the byte 0xE4",
        "allowed: UTF-8 text",
        "save the file as UTF-8",
    ] {
        assert!(error.to_string().contains(part), "{error}");
    }
    let wide = folder.path().join("wide.toml");
    std::fs::write(&wide, b"\xff\xfet\0i\0t\0l\0e\0").unwrap();
    assert!(
        Study::load(&wide)
            .unwrap_err()
            .to_string()
            .contains("looks like UTF-16")
    );
    assert!(Study::load(&folder.path().join("good.toml")).is_ok());
}

#[test]
fn a_mesh_file_must_be_there() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    std::fs::write(
        &path,
        format!("{SHORT}[numerics]\nmesh_gear = \"gear.msh\"\n"),
    )
    .unwrap();
    let error = Study::load(&path).unwrap_err();
    assert_eq!(error.position(), Some((22, 13)), "{error}");
    std::fs::write(folder.path().join("gear.msh"), "").unwrap();
    let study = Study::load(&path).unwrap();
    assert_eq!(
        study.numerics.mesh_gear,
        Some(folder.path().join("gear.msh"))
    );
}

#[test]
fn a_measurement_file_that_is_missing_is_named_where_the_study_names_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    let named = "[measurements]\nfile = \"m.csv\"\n[[test]]\nid = \"A\"\n";
    std::fs::write(&path, format!("{SHORT}{named}")).unwrap();
    let error = Study::load(&path).unwrap().dataset().unwrap_err();
    let diagnostic = error.diagnostic();
    assert_eq!(
        (diagnostic.fault, diagnostic.key.as_str()),
        (Fault::Unreadable, "measurements.file")
    );
    assert_eq!(error.file(), path.display().to_string());
    assert_eq!(error.position(), Some((22, 8)), "{error}");
    for part in ["m.csv", "no such file", "measurement files here"] {
        assert!(error.to_string().contains(part), "{error}");
    }
}

#[test]
fn later_faults_find_the_place_of_their_key() {
    let study = Study::parse(SHORT, "study.toml").unwrap();
    let stated = study.refuse("wear.coefficient", "is too small", "1 to 2", "try 1");
    assert_eq!(stated.position(), Some((19, 15)));
    assert_eq!(stated.diagnostic().found, "6e-10");
    let absent = study.refuse("operation.misalignment", "is missing", "", "");
    assert_eq!(absent.position(), Some((15, 1)), "the table's header");
    assert!(
        study
            .refuse("lubricant.viscosity", "is needed", "", "")
            .position()
            .is_some()
    );
}

/// Nesting as deep as the text allows: refused, without running out of stack.
#[test]
fn deep_nesting_is_refused() {
    let deep = 200_000;
    for text in [
        format!("a = {}", "[".repeat(deep)),
        format!("a = {}1{}", "[".repeat(deep), "]".repeat(deep)),
        format!("a = {}", "{a=".repeat(deep)),
        format!("{} = 1", vec!["a"; deep].join(".")),
        format!("[{}]", vec!["a"; deep].join(".")),
    ] {
        assert!(Study::parse(&text, "study.toml").is_err());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, rng_seed: proptest::test_runner::RngSeed::Fixed(20), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn truncated_studies_never_panic(cut in 0..FULL.len(), seed in any::<prop::sample::Index>()) {
        let mut end = cut;
        while !FULL.is_char_boundary(end) { end -= 1; }
        check(&FULL[..end])?;
        let start = seed.index(end + 1);
        if FULL.is_char_boundary(start) { check(&FULL[start..])?; }
    }

    #[test]
    fn mutated_studies_never_panic(edits in prop::collection::vec((any::<prop::sample::Index>(), "[ -~äµ\u{0}\n\r\t]{0,3}", 0..6usize), 1..6)) {
        let mut text: Vec<char> = FULL.chars().collect();
        for (at, insert, remove) in edits {
            let at = at.index(text.len());
            let end = (at + remove).min(text.len());
            text.splice(at..end, insert.chars());
        }
        check(&text.into_iter().collect::<String>())?;
    }

    #[test]
    fn swapped_values_never_panic(
        line in any::<prop::sample::Index>(),
        value in prop::sample::select(vec!["0", "-1", "1e308", "-1e308", "1e-308", "nan", "-inf", "[]", "{}", "\"\"", "true",
            "1979-05-27", "99999999999999999999999999999999999999999999", "0x7fffffffffffffff", "[[1]]", "{ value = 1 }", "'x'"]),
    ) {
        let mut lines: Vec<String> = FULL.lines().map(str::to_owned).collect();
        let keyed: Vec<usize> = (0..lines.len()).filter(|&i| lines[i].contains(" = ")).collect();
        let at = keyed[line.index(keyed.len())];
        let key = lines[at].split(" = ").next().unwrap().to_owned();
        lines[at] = format!("{key} = {value}");
        check(&lines.join("\n"))?;
    }
}

/// Either a study, or a message with its parts.
fn check(text: &str) -> Result<(), TestCaseError> {
    if let Err(error) = Study::parse(text, "study.toml") {
        let message = error.to_string();
        prop_assert!(message.starts_with("error: "), "{message}");
        prop_assert!(message.contains("--> study.toml:"), "{message}");
        prop_assert!(
            !error.diagnostic().found.is_empty() && !error.diagnostic().allowed.is_empty(),
            "{message}"
        );
    }
    Ok(())
}

/// A study with a table of tests beside it.
fn tabled(study: &str, table: &str) -> Result<Study, gearwear::study::StudyError> {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("tests.csv"), table).unwrap();
    let path = home.path().join("study.toml");
    std::fs::write(&path, study).unwrap();
    Study::load(&path)
}

const TABLED: &str = concat!(
    gears!(),
    "\
[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 6e-10
cycles = 50000
[measurements]
file = \"m.csv\"
tests = \"tests.csv\"
[[test]]
id = \"first\"
torque = 50.0
"
);

/// Each row is the `[[test]]` that states the same, whatever the spreadsheet wrote between cells; they come after those of the study.
#[test]
fn a_table_of_tests_is_so_many_tests() {
    let stated = format!(
        "{}\n[[test]]\nid = \"A\"\nrole = \"fit\"\ntorque = 60.0\nbulk_temperature = 45.5\n[[test]]\nid = \"B\"\nrole = \"holdout\"\ncycles = 1e6\nreversed = true\n",
        TABLED.replace("tests = \"tests.csv\"\n", "")
    );
    let stated = Study::parse(&stated, "study.toml").unwrap();
    assert_eq!(stated.tests.len(), 3);
    let plain = "id,role,torque,bulk_temperature,cycles,reversed\nA,fit,60,45.5,,\n# a comment\nB,holdout,,,1e6,true\n";
    let german = "ID;Role;Torque [N mm];Bulk_Temperature;Cycles;reversed;Notes\n\"A\";fit;60000;45,5;;;warm; \n\nB;holdout;;;1e6;TRUE;\n";
    let tabs = plain.replace(',', "\t");
    for table in [plain, german, tabs.as_str()] {
        let study = tabled(TABLED, table).unwrap_or_else(|e| panic!("{table}: {e}"));
        assert_eq!(study.tests, stated.tests, "{table}");
        assert!(
            study
                .inputs()
                .iter()
                .any(|path| path.ends_with("tests.csv"))
        );
        assert_eq!(study.text(), TABLED);
    }
}

/// A fault of a cell is told at the cell, in the table, in the words of the study's own reader; one that shows later too.
/// A unit of five million letters took minutes to refuse, an effect's name of as many six seconds, a hundred thousand tests more than a minute.
#[test]
fn texts_keys_and_lists_beyond_any_use_are_refused_at_once() {
    let letters = |count: usize| "x".repeat(count);
    let unit = with(
        "torque =",
        &format!("torque = \"100 {}\" #", letters(5_000_000)),
    );
    let kind = format!("{SHORT}[[effect]]\nkind = \"{}\"\n", letters(5_000_000));
    let key = format!("{SHORT}{} = 1\n", letters(5_000_000));
    let tests: String = (0..100_000)
        .map(|i| format!("[[test]]\nid = \"T{i}\"\n"))
        .collect();
    let begun = std::time::Instant::now();
    for (text, place, found, allowed) in [
        (
            unit,
            "operation.torque",
            "5000004 characters",
            "at most 10000",
        ),
        (
            kind,
            "effect[0].kind",
            "5000000 characters",
            "at most 10000",
        ),
        (key, "wear.xxxxx", "5000000 characters", "at most 200"),
        (
            format!("{SHORT}{tests}"),
            "test",
            "100000 entries",
            "at most 10000",
        ),
    ] {
        let error = Study::parse(&text, "study.toml").expect_err("must be refused");
        let message = error.to_string();
        for part in [place, found, allowed] {
            assert!(
                message.contains(part),
                "{part}: {}",
                &message[..message.len().min(600)]
            );
        }
        assert!(message.len() < 2000, "{} characters", message.len());
    }
    assert!(begun.elapsed().as_secs() < 20, "{:?}", begun.elapsed());
}

#[test]
fn faults_in_a_table_of_tests_name_its_line_and_column() {
    let refusal = |table: &str| {
        let error = tabled(TABLED, table).expect_err(table);
        let place = error.to_string();
        assert!(place.contains("tests.csv:"), "{place}");
        (error.position(), error.diagnostic().key.clone(), place)
    };
    for (table, position, key, says) in [
        ("id,torque\nA,60\nB,-6\n", (3, 3), "test.torque", "-6"),
        ("id,torque\nA,much\n", (2, 3), "test.torque", "much"),
        ("id,torque\nfirst,60\n", (2, 1), "test.id", "taken"),
        ("id,torque\n,60\n", (2, 1), "test.id", "missing"),
        ("id,role\nA,hold-out\n", (2, 3), "test.role", "hold-out"),
        ("id,torqe\nA,60\n", (1, 4), "torqe", "no test has"),
        ("id,torque,torque\nA,6,7\n", (1, 11), "torque", "twice"),
        ("id,torque\nA,60,7\n", (2, 6), "", "3 cells"),
        ("id,torque\n", (1, 10), "", "no rows"),
        ("# nothing\n", (1, 10), "", "empty"),
    ] {
        let (at, found, message) = refusal(table);
        assert_eq!(at, Some(position), "{table}: {message}");
        assert_eq!(found, key, "{message}");
        assert!(message.contains(says), "{message}");
    }
    for (table, position, says) in [
        (
            "id;torque;speed\nA;2.5;1.000\n",
            (2, 7),
            "is that 1000, or 1.000 with decimals?",
        ),
        (
            "id;torque\nA;2,5\nB;1.5\n",
            (3, 3),
            "decimal points and decimal commas stand in one file",
        ),
        (
            "id;torque\nA;1.5\nB;2,5 N m\n",
            (3, 3),
            "decimal points and decimal commas stand in one file",
        ),
        (
            "id;cycles\nA;13,333\n",
            (2, 3),
            "is that 13333, or 13.333 with decimals?",
        ),
        (
            "id,cycles\nA,1.000\n",
            (2, 3),
            "is that 1000, or 1.000 with",
        ),
        ("id;torque\nA;1.000,5\n", (2, 3), "has thousands marks"),
    ] {
        let (at, _, message) = refusal(table);
        assert_eq!(at, Some(position), "{table}: {message}");
        assert!(
            message.contains(says) && message.contains("help: "),
            "{message}"
        );
        assert!(!message.contains("unit"), "{message}");
    }
    for (table, cycles) in [
        ("id;torque;cycles\nA;2,5;1.000.000\n", 1e6),
        ("id,cycles\nA,1.000.000\n", 1e6),
        ("id;cycles\nA;250.000\nB;1.000.000\n", 250e3),
        ("id;torque;cycles\nA;2,5;250.000\n", 250e3),
        ("id;torque;cycles\nA;2.5;13,333\n", 13333.0),
    ] {
        let study = tabled(TABLED, table).expect(table);
        let test = study.tests.iter().find(|test| test.id == "A").unwrap();
        assert_eq!(test.conditions.cycles, cycles, "{table}");
    }
    let with_unit = tabled(TABLED, "id;torque\nA;2,5 N m\n").unwrap();
    assert_eq!(with_unit.tests[1].conditions.torque_nmm, 2500.0);
    let study = tabled(TABLED, "id,torque\nA,60\n").unwrap();
    let later = study.refuse("test[1].torque", "is too much", "less", "");
    assert_eq!(later.position(), Some((2, 3)));
    assert!(later.to_string().contains("tests.csv:2:3"), "{later}");
    let here = study.refuse("test[0].torque", "is too much", "less", "");
    assert!(here.to_string().contains("study.toml:"), "{here}");
    let missing = Study::parse(TABLED, "nowhere/study.toml").expect_err("no such table");
    assert_eq!(missing.diagnostic().fault, Fault::Unreadable);
}

/// A lead file is refused at its row where it is off the face, does not ascend or has no number.
#[test]
fn faults_in_a_lead_file_name_its_line_and_column() {
    let study = format!("{SHORT}[face]\nslices = 3\n[face.pinion]\nlead_file = \"lead.csv\"\n");
    let refusal = |table: &str| {
        let home = tempfile::tempdir().unwrap();
        std::fs::write(home.path().join("lead.csv"), table).unwrap();
        let path = home.path().join("study.toml");
        std::fs::write(&path, &study).unwrap();
        let error = Study::load(&path).expect_err(table);
        (error.position(), error.to_string())
    };
    for (rows, position, says) in [
        ("-20,1\n12,2", (2, 1), "-16.5 to 16.5 mm"),
        ("-10,1\n-12,2", (3, 1), "ascend"),
        ("-10,1\n10,deep", (3, 4), "not a finite number"),
        ("-10000,1\n10000,2", (2, 1), "micrometres"),
        (
            "-10;1\n10;2",
            (2, 1),
            "a comma stands between the two, as in the header",
        ),
        ("-10,5,1\n10,2", (2, 1), "decimals are written with a point"),
    ] {
        let (at, message) = refusal(&format!("face,deviation\n{rows}\n"));
        assert_eq!(at, Some(position), "{message}");
        assert!(
            message.contains(says) && message.contains("lead.csv"),
            "{message}"
        );
    }
    let (_, message) = refusal("face,deviation\n-20,1\n12,2\n");
    assert!(!message.contains("micrometres"), "{message}");
}

/// A lead file with semicolons or tabs is that with commas, with decimal commas too; both marks in one file are refused.
#[test]
fn a_lead_file_may_be_a_spreadsheets() {
    let study = format!("{SHORT}[face]\nslices = 3\n[face.pinion]\nlead_file = \"lead.csv\"\n");
    let load = |table: &str| {
        let home = tempfile::tempdir().unwrap();
        std::fs::write(home.path().join("lead.csv"), table).unwrap();
        let path = home.path().join("study.toml");
        std::fs::write(&path, &study).unwrap();
        Study::load(&path)
    };
    let plain = load("face,deviation\n-10.5,1\n10,2.5\n").unwrap().face;
    for table in [
        "face;deviation\n-10,5;1\n10;2,5\n",
        "face;deviation\n-10.5;1\n10;2.5\n",
        "face\tdeviation\n-10,5\t1\n10\t2,5\n",
    ] {
        let face = load(table).unwrap_or_else(|e| panic!("{table}: {e}")).face;
        assert_eq!(face, plain, "{table}");
    }
    let error = load("face;deviation\n-10,5;1\n10;2.5\n").unwrap_err();
    assert_eq!(error.position(), Some((3, 4)), "{error}");
    assert!(error.to_string().contains("stand in one file"), "{error}");
}

/// A pitch file is refused at its row where a tooth is left out, is one too many or has no number, and at its end where teeth are missing.
#[test]
fn faults_in_a_pitch_file_name_its_line_and_column() {
    let study = format!("{SHORT}[teeth.pinion]\npitch_file = \"pitch.csv\"\n");
    let read = |table: &str| {
        let home = tempfile::tempdir().unwrap();
        std::fs::write(home.path().join("pitch.csv"), table).unwrap();
        let path = home.path().join("study.toml");
        std::fs::write(&path, &study).unwrap();
        Study::load(&path)
    };
    let rows = |teeth: std::ops::RangeInclusive<usize>| -> String {
        teeth.map(|i| format!("{i},{}\n", i % 3)).collect()
    };
    let whole = rows(1..=27);
    for (rows, position, says) in [
        (rows(1..=26), None, "27 rows"),
        (rows(1..=28), Some((29, 1)), "27 rows"),
        (rows(2..=27), Some((2, 1)), "1: teeth ascend"),
        (
            whole.replace("\n5,2\n", "\n5,proud\n"),
            Some((6, 3)),
            "not a finite number",
        ),
        (
            whole.replace("\n5,2\n", "\n5,2000\n"),
            Some((6, 3)),
            "200 µm",
        ),
    ] {
        let error = read(&format!("tooth,deviation\n{rows}")).expect_err(&rows);
        let message = error.to_string();
        if position.is_some() {
            assert_eq!(error.position(), position, "{message}");
        }
        assert!(
            message.contains(says) && message.contains("pitch.csv"),
            "{message}"
        );
    }
    let study = read(&format!("tooth,deviation\n{whole}")).unwrap();
    let expected: Vec<f64> = (1..=27).map(|i| 1e-3 * f64::from(i % 3)).collect();
    assert_eq!(study.teeth.back, [expected, Vec::new()]);
    let missing = format!("{SHORT}[teeth.pinion]\npitch_file = \"nowhere.csv\"\n");
    let error = Study::parse(&missing, "study.toml")
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("teeth.pinion.pitch_file") && error.contains("nowhere.csv"),
        "{error}"
    );
}
