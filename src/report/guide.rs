//! The pages of the guide that are written from the code: the catalogue of effects and the keys of the study file.
//!
//! `cargo run --example write_guide` writes them; `tests/program/guide.rs` holds the committed ones against the code.

use std::fmt::Write;

use crate::effects::formula::FUNCTIONS;
use crate::effects::variables::{VARIABLES, Variable};
use crate::effects::{CATALOGUE, Card, Hook, Param};
use crate::numeric::written;
use crate::study::{KEY_DOCS, KeyDoc, Without};

const EFFECTS: &str = "# The catalogue of effects

Written from the code by `cargo run --example write_guide`; do not edit. `gearwear effects EFFECT` prints the same on the terminal.

An effect changes the base model (constant wear coefficient, perfect flanks, frictionless contact at the nominal centre distance)
through one hook. A study can hold any number of them, each as an `[[effect]]` table. Sources say what could be checked and what could not.
";

const VARIABLES_HEAD: &str = "## Variables of formulas

Formulas of the catalogue and your own (`kind = \"formula\"`) can use these. W: `wear_factor`, A: `added_depth`, L: `load_factor`
(evaluated before the contact is solved, so without pressure), P: `profile`.

| variable | unit | in | meaning | needs |
|---|---|---|---|---|
";

const STUDY: &str = "# The study file

Written from the code by `cargo run --example write_guide`; do not edit.

A study is one TOML file. Inside it lengths are mm, torques N m, speeds rpm, angles degrees, wear and relief µm, temperatures degC; what
is *in modules* is a length divided by the module. `gearwear init` writes a commented one to start from. A mistake gives one message with
its place, what was found and what is allowed, and nothing is written. **needed** means: without it the study is refused.
";

/// Introductions of the tables, in the order of the file.
const TABLES: &[(&str, &str, &str)] = &[
    ("", "Before the first table", ""),
    (
        "gears",
        "`[gears]`",
        "Needed. The basic rack and the pair; addendum, dedendum and fillet radius are ISO 53 profile A if not stated.",
    ),
    (
        "gears.pinion",
        "`[gears.pinion]` and `[gears.gear]`",
        "Both needed, with the same keys.",
    ),
    (
        "material",
        "`[material]`",
        "Needed. Of both members; or the same keys in `[material.pinion]` and `[material.gear]`, then none in `[material]` itself.",
    ),
    (
        "lubricant",
        "`[lubricant]`",
        "May be absent. Effects that need a key, and friction in the contact, report it if it is missing.",
    ),
    (
        "thermal",
        "`[thermal]`",
        "May be absent. Effects that need a key report it if it is missing.",
    ),
    (
        "operation",
        "`[operation]`",
        "Needed. What `gearwear run` runs without `--test`.",
    ),
    (
        "wear",
        "`[wear]`",
        "Needed. One cycle is one turn of the pinion.",
    ),
    (
        "wear.pinion",
        "`[wear.pinion]` and `[wear.gear]`",
        "Each may be absent. For pairs of unlike materials: a steel pinion does not wear like the plastic gear it meets. A fit keeps the ratio of the coefficients; the effect `member_hardness` makes it a fitted parameter.",
    ),
    ("model", "`[model]`", "May be absent."),
    ("fit", "`[fit]`", "May be absent."),
    (
        "noise",
        "`[noise]`",
        "May be absent. What measurements carry beyond the sigma of each row.",
    ),
    (
        "effect",
        "`[[effect]]`",
        "May be absent; there may be several. With a `kind` of the [catalogue](effects.md) the other keys are its parameters, each a number or `{ value = 3.0, lower = 0.0, upper = 10.0 }`; those not stated have their defaults. The keys below `kind` belong to `kind = \"formula\"`: see [an effect of your own](own-effect.md).",
    ),
    (
        "test",
        "`[[test]]`",
        "May be absent; there may be several. The conditions of a measured test, those of `[operation]` where it states none.",
    ),
    (
        "measurements",
        "`[measurements]`",
        "May be absent. The file has the columns `test,member,cycles,quantity,position,value,sigma,trace`.",
    ),
    (
        "face",
        "`[face]`",
        "May be absent. Described in [Across the face](face.md).",
    ),
    (
        "face.pinion",
        "`[face.pinion]` and `[face.gear]`",
        "May be absent; they need slices. Material missing on the loaded flanks of a member across the face.",
    ),
    (
        "teeth",
        "`[teeth]`",
        "May be absent. Described in [Tooth by tooth](teeth.md).",
    ),
    (
        "teeth.pinion",
        "`[teeth.pinion]` and `[teeth.gear]`",
        "May be absent. One of `pitch_file`, `pitch_deviations` and `pitch_pattern` at most.",
    ),
    (
        "rig",
        "`[rig]`",
        "May be absent. What the test rig can do: `gearwear plan` and `gearwear diagnose` then suggest only tests that it can run, at its limits where more would be better.",
    ),
    (
        "numerics",
        "`[numerics]`",
        "May be absent. The defaults are those whose error `gearwear validate convergence` shows.",
    ),
];

/// `guide/effects.md`.
pub fn effects() -> String {
    let mut text = EFFECTS.to_owned();
    text.push_str("\n| effect | gives | shows as |\n|---|---|---|\n");
    for card in CATALOGUE {
        let signature = card.signature.split(';').next().unwrap_or_default();
        let _ = writeln!(
            text,
            "| [`{0}`](#{0}) | {1} | {2} |",
            card.name,
            card.hook.meaning(),
            cell(signature)
        );
    }
    for card in CATALOGUE {
        effect(&mut text, card);
    }
    let _ = write!(text, "\n{VARIABLES_HEAD}");
    for variable in VARIABLES {
        let _ = writeln!(
            text,
            "| `{}` | {} | {} | {} | {} |",
            variable.name,
            cell(&written::unit(variable.unit)),
            hooks(variable),
            cell(variable.meaning),
            code_list(variable.needs)
        );
    }
    text.push_str("\nFunctions:\n\n| function | arguments | meaning |\n|---|---|---|\n");
    for (name, arguments, meaning) in FUNCTIONS {
        let _ = writeln!(text, "| `{name}` | {arguments} | {} |", cell(meaning));
    }
    text.push_str("\nOperators `+ - * / ^`, parentheses, the constant `pi`.\n");
    text
}

fn effect(text: &mut String, card: &Card) {
    let _ = writeln!(
        text,
        "\n## {}\n\nGives: {}.\n\n```text\n{}\n```\n",
        card.name,
        card.hook.meaning(),
        card.formula
    );
    text.push_str(
        "| parameter | unit | default | range | prior | meaning |\n|---|---|---|---|---|---|\n",
    );
    for param in card.params {
        parameter(text, param);
    }
    text.push('\n');
    for form in card.forms {
        let settings = form.settings.iter();
        let settings = settings.map(|(name, value)| format!("`{name} = {value}`"));
        let freed = form.frees.iter().map(|name| format!("`{name}` fitted"));
        let all: Vec<String> = settings.chain(freed).collect();
        let shows = match form.signature {
            "" => String::new(),
            own => format!("; {}", cell(own)),
        };
        let _ = writeln!(
            text,
            "- *also accepted, {}*: {}{shows}",
            form.name,
            all.join(", ")
        );
    }
    if !card.needs.is_empty() {
        let _ = writeln!(text, "- *needs from the study*: {}", code_list(card.needs));
    }
    let confounded: Vec<String> = card
        .confounded_with
        .iter()
        .map(|name| format!("[`{name}`](#{name})"))
        .collect();
    let confounded = match confounded.is_empty() {
        true => "no effect of the catalogue".to_owned(),
        false => confounded.join(", "),
    };
    let _ = writeln!(text, "- *signature*: {}", cell(card.signature));
    let _ = writeln!(text, "- *confounded with*: {confounded}");
    let _ = writeln!(text, "- *separated by*: {}", cell(card.separated_by));
    let _ = writeln!(text, "- *left out*: {}", cell(card.left_out));
    let _ = writeln!(text, "- *source*: {}", cell(card.source));
}

fn parameter(text: &mut String, param: &Param) {
    let mut meaning = cell(param.meaning);
    if let Some(neutral) = param.neutral {
        let _ = write!(meaning, "; does nothing at {neutral}");
    }
    if !param.fitted {
        meaning.push_str("; not fitted by default");
    }
    let _ = writeln!(
        text,
        "| `{}` | {} | {} | {} to {} | {} | {meaning} |",
        param.name,
        cell(&written::unit(param.unit)),
        param.default,
        param.range.0,
        param.range.1,
        param.prior
    );
}

/// Letters of the hooks that know a variable.
fn hooks(variable: &Variable) -> String {
    let known = [
        (Hook::WearFactor, 'W'),
        (Hook::AddedDepth, 'A'),
        (Hook::LoadFactor, 'L'),
        (Hook::Profile, 'P'),
    ];
    let letters = known
        .into_iter()
        .filter(|(hook, _)| variable.available(*hook))
        .map(|(_, letter)| letter);
    let text: String = letters.collect();
    if text.is_empty() {
        "cards only".to_owned()
    } else {
        text
    }
}

/// `guide/study-file.md`.
pub fn study_file() -> String {
    let mut text = STUDY.to_owned();
    for (table, title, words) in TABLES {
        let _ = writeln!(text, "\n## {title}\n");
        if !words.is_empty() {
            let _ = writeln!(text, "{words}\n");
        }
        text.push_str("| key | value | without it | meaning |\n|---|---|---|---|\n");
        for doc in KEY_DOCS.iter().filter(|doc| doc.table == *table) {
            key(&mut text, doc);
        }
    }
    text
}

fn key(text: &mut String, doc: &KeyDoc) {
    let without = match doc.without {
        Without::Refused => "**needed**".to_owned(),
        Without::Default(value) => format!("`{value}`"),
        Without::Words(words) => words.to_owned(),
    };
    let _ = writeln!(
        text,
        "| `{}` | {} | {without} | {} |",
        doc.key,
        cell(&doc.allowed()),
        cell(doc.meaning)
    );
}

fn code_list(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}

/// Text that markdown takes for plain text, in a table's cell too.
fn cell(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '|' | '*' => out.extend(['\\', c]),
            _ => out.push(c),
        }
    }
    out
}
