//! Claim: the folders of `src` stand on floors, and each imports itself and lower floors only.
//!
//! Source: the list of floors in the architecture notes, repeated here as [`FLOORS`]. Every `crate::NAME`, also inside nested
//! braces and by a chain of `super`, is looked at; comments and texts are not. Tolerance: none.

use std::fs;
use std::path::{Path, PathBuf};

/// The modules of each floor, the lowest first. Modules of one floor do not know each other.
const FLOORS: &[&[&str]] = &[
    &["numeric", "source_text"],
    &["gear", "material", "analytic", "paper"],
    &["mesh", "tribology"],
    &["fem", "effects"],
    &["contact"],
    &["wear"],
    &["simulate", "measure"],
    &["study"],
    &["verify", "learn"],
    &["report", "serve"],
    &["cli"],
];

/// The stages of the learning half, the first first: sub-floors of `src/learn`, by its files and folders. A stage imports itself and those
/// before it; comparisons and made-up measurements stand beside the stages of a diagnosis, which do not know them.
const STAGES: &[(&str, &[&str])] = &[
    ("hypothesis", &["hypothesis"]),
    ("noise", &["noise"]),
    ("prediction", &["prediction"]),
    ("inference", &["inference"]),
    ("fitting", &["fitting"]),
    ("learned laws", &["learned"]),
    ("candidates", &["candidates"]),
    ("sampling", &["sampling"]),
    ("comparison", &["comparison"]),
    ("discrepancy", &["discrepancy"]),
    ("data checks", &["checks"]),
    ("model search", &["model_search"]),
    ("decision", &["decision"]),
    ("experiment", &["experiment"]),
    ("explanation", &["explanation"]),
    ("diagnosis", &["diagnose"]),
    ("climb", &["climb"]),
];

/// The stage that no stage of a diagnosis knows.
const BESIDE: &str = "comparison";
/// The stage that goes from one to the other.
const JOINING: &str = "climb";

#[test]
fn stages_of_learning_use_earlier_stages_only() {
    let files = learning();
    let faults: Vec<String> = (files.iter())
        .flat_map(|(module, text)| stage_faults(module, text))
        .collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn no_two_files_of_learning_need_each_other() {
    let files = learning();
    let found = circle(&files);
    assert!(found.is_empty(), "a circle: {}", found.join(" -> "));
}

#[test]
fn an_import_from_a_later_stage_is_found() {
    let fault = |module: &[&str], text: &str| {
        let module: Vec<String> = module.iter().map(|part| (*part).to_owned()).collect();
        stage_faults(&module, text)
    };
    assert_eq!(
        fault(
            &["learn", "decision", "rule"],
            "use crate::learn::{hypothesis::Hypothesis, explanation::{self, ranked}};"
        ),
        [
            "src/learn/decision/rule.rs:1: decision must not use explanation",
            "src/learn/decision/rule.rs:1: decision must not use explanation"
        ]
    );
    assert_eq!(
        fault(
            &["learn", "discrepancy", "smooth"],
            "use super::super::checks::sufficiency;"
        ),
        ["src/learn/discrepancy/smooth.rs:1: discrepancy must not use data checks"]
    );
    assert_eq!(
        fault(
            &["learn", "checks", "noise_level"],
            "use crate::learn::comparison;"
        ),
        ["src/learn/checks/noise_level.rs:1: data checks must not use comparison"]
    );
    assert_eq!(
        fault(
            &["learn", "checks", "noise_level"],
            "use super::sufficiency; use crate::learn::candidates::likelihood::Likelihood;"
        ),
        [""; 0]
    );
    assert_eq!(
        fault(&["learn", "misc"], ""),
        ["src/learn/misc.rs:1: misc belongs to no stage"]
    );
}

#[test]
fn a_circle_is_found_and_parent_and_child_are_none() {
    let file = |module: &[&str], text: &str| {
        let module: Vec<String> = module.iter().map(|part| (*part).to_owned()).collect();
        (module, text.to_owned())
    };
    let mut files = vec![
        file(&["learn", "a"], "use super::b::Thing;"),
        file(&["learn", "b"], "mod tests { use super::super::c::Other; }"),
        file(&["learn", "d"], "mod one;\nuse one::x;"),
        file(&["learn", "d", "one"], "use super::Shared;"),
        file(&["learn", "c"], "use crate::learn::d::one;"),
    ];
    assert_eq!(circle(&files), [""; 0]);
    files[4].1 = "use crate::learn::{d::one, a::{self}};".to_owned();
    assert_eq!(circle(&files), ["a", "b", "c", "a"]);
}

/// The files of the learning half by their modules.
fn learning() -> Vec<(Vec<String>, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root.join("learn"), &mut files);
    files.sort();
    assert!(files.len() > 10, "the sources were not found");
    let module = |file: &PathBuf| {
        let path = file.strip_prefix(&root).unwrap().with_extension("");
        let parts = path.iter().map(|part| part.to_string_lossy().into_owned());
        parts.filter(|part| part != "mod").collect::<Vec<_>>()
    };
    let read = |file: PathBuf| (module(&file), fs::read_to_string(&file).unwrap());
    files.into_iter().map(read).collect()
}

fn stage(part: &str) -> Option<usize> {
    (STAGES.iter()).position(|(_, parts)| parts.contains(&part))
}

/// Imports of a file of the learning half from stages that it must not know.
fn stage_faults(module: &[String], text: &str) -> Vec<String> {
    let [_, part, ..] = module else {
        // the root of the learning half declares and re-exports all of them
        return Vec::new();
    };
    let file = format!("src/{}.rs", module.join("/"));
    let Some(own) = stage(part) else {
        return vec![format!("{file}:1: {part} belongs to no stage")];
    };
    let mut faults = Vec::new();
    for (line, path) in paths(&tokens(text), module) {
        let [root, used, ..] = &path[..] else {
            continue;
        };
        let Some(used) = (root == "learn").then(|| stage(used)).flatten() else {
            continue;
        };
        let beside = STAGES[used].0 == BESIDE && used != own && STAGES[own].0 != JOINING;
        if used > own || beside {
            faults.push(format!(
                "{file}:{line}: {} must not use {}",
                STAGES[own].0, STAGES[used].0
            ));
        }
    }
    faults
}

/// Files that need each other, the first again at the end; parents and their children may. Empty without.
fn circle(files: &[(Vec<String>, String)]) -> Vec<String> {
    let file_of = |path: &[String]| {
        let lengths = (1..=path.len()).rev();
        lengths
            .filter_map(|n| files.iter().position(|(module, _)| *module == path[..n]))
            .next()
    };
    let related = |a: usize, b: usize| {
        files[a].0.starts_with(&files[b].0) || files[b].0.starts_with(&files[a].0)
    };
    let uses: Vec<Vec<usize>> = (files.iter().enumerate())
        .map(|(own, (module, text))| {
            let used = paths(&tokens(text), module);
            let used = used.iter().filter_map(|(_, path)| file_of(path));
            used.filter(|&other| !related(own, other)).collect()
        })
        .collect();
    // depth first: a file on the way that is met again closes a circle
    fn visit(at: usize, uses: &[Vec<usize>], way: &mut Vec<usize>, done: &mut [bool]) -> bool {
        if let Some(start) = way.iter().position(|&known| known == at) {
            way.drain(..start);
            way.push(at);
            return true;
        }
        if done[at] {
            return false;
        }
        way.push(at);
        for &next in &uses[at] {
            if visit(next, uses, way, done) {
                return true;
            }
        }
        way.pop();
        done[at] = true;
        false
    }
    let mut done = vec![false; files.len()];
    for start in 0..files.len() {
        let mut way = Vec::new();
        if visit(start, &uses, &mut way, &mut done) {
            return way.into_iter().map(|i| files[i].0[1..].join("/")).collect();
        }
    }
    Vec::new()
}

/// The paths from the crate's root that a file names by `crate::` or `super::`, also inside nested braces, with their lines.
fn paths(tokens: &[Token], module: &[String]) -> Vec<(usize, Vec<String>)> {
    let word = |at: usize| tokens.get(at).map_or("", |(_, word)| word.as_str());
    let (mut braces, mut inline) = (0, Vec::new());
    let mut found = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        match word(at) {
            "{" => braces += 1,
            "}" => {
                braces -= 1;
                if inline.last() == Some(&braces) {
                    inline.pop();
                }
            }
            "mod" if word(at + 2) == "{" => inline.push(braces),
            "crate" if word(at + 1) == "::" => tree(tokens, at + 2, Vec::new(), &mut found),
            "super" if word(at + 1) == "::" => {
                let mut climbed = 1_usize;
                while word(at + 2) == "super" && word(at + 3) == "::" {
                    (climbed, at) = (climbed + 1, at + 2);
                }
                // inside its own inline modules a file climbs to itself first
                if let Some(out) = climbed.checked_sub(inline.len())
                    && out > 0
                    && out <= module.len()
                {
                    let base = module[..module.len() - out].to_vec();
                    tree(tokens, at + 2, base, &mut found);
                }
            }
            _ => {}
        }
        at += 1;
    }
    found
}

/// The paths of the tree of names that begins at `at` behind `prefix`.
fn tree(tokens: &[Token], at: usize, prefix: Vec<String>, found: &mut Vec<(usize, Vec<String>)>) {
    let word = |at: usize| tokens.get(at).map_or("", |(_, word)| word.as_str());
    let Some((line, first)) = tokens.get(at) else {
        return;
    };
    if first != "{" {
        let mut path = prefix;
        if !["self", "*"].contains(&first.as_str()) {
            path.push(first.clone());
        }
        if word(at + 1) == "::" {
            tree(tokens, at + 2, path, found);
        } else {
            found.push((*line, path));
        }
        return;
    }
    let mut depth = 0;
    for n in at..tokens.len() {
        match word(n) {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return;
        }
        if depth == 1 && ["{", ","].contains(&word(n)) && !["}", ""].contains(&word(n + 1)) {
            tree(tokens, n + 1, prefix.clone(), found);
        }
    }
}

#[test]
fn modules_use_lower_floors_only() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    collect(&root.join("src"), &mut files);
    files.sort();
    assert!(files.len() > 10, "the sources were not found");
    let mut faults = Vec::new();
    for file in files {
        let name = file
            .strip_prefix(root)
            .unwrap()
            .to_string_lossy()
            .replace('\\', "/");
        faults.extend(violations(&name, &fs::read_to_string(&file).unwrap()));
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn an_upward_import_is_found_with_its_place() {
    let text = "//! crate::contact in a comment\nuse crate::numeric::Vec2;\n\nuse crate::{\n    gear::{Gear, Pair},\n    contact::search,\n};\n";
    assert_eq!(
        violations("src/fem/cholesky.rs", text),
        ["src/fem/cholesky.rs:6: fem must not use contact"]
    );
    let inline = "fn f() { let a = \"crate::cli\"; /* crate::cli */ let b = crate::contact::solve(a, 'x', '\\''); }";
    assert_eq!(
        violations("src/fem/mod.rs", inline),
        ["src/fem/mod.rs:1: fem must not use contact"]
    );
}

#[test]
fn neighbours_on_a_floor_do_not_know_each_other() {
    assert_eq!(
        violations("src/gear/mod.rs", "use crate::material;"),
        ["src/gear/mod.rs:1: gear must not use material"]
    );
    assert_eq!(
        violations("src/gear/mod.rs", "use crate::gear::pair;"),
        [""; 0]
    );
}

#[test]
fn climbing_by_super_is_found() {
    assert_eq!(
        violations("src/fem/mod.rs", "use super::contact;"),
        ["src/fem/mod.rs:1: fem must not use contact"]
    );
    assert_eq!(
        violations("src/fem/cholesky.rs", "use super::super::{numeric, cli};"),
        ["src/fem/cholesky.rs:1: fem must not use cli"]
    );
    // A sibling that has another module's name, and a test module that reaches its own parents.
    assert_eq!(
        violations(
            "src/study/gears.rs",
            "use super::effects;\nmod tests { use super::super::report; }"
        ),
        [""; 0]
    );
}

#[test]
fn unknown_folders_and_modules_are_refused() {
    assert_eq!(
        violations("src/misc/mod.rs", ""),
        ["src/misc/mod.rs:1: the folder misc stands on no floor"]
    );
    assert_eq!(
        violations("src/gear/mod.rs", "use crate::misc;"),
        ["src/gear/mod.rs:1: misc stands on no floor"]
    );
}

#[test]
fn only_the_study_reads_toml() {
    assert_eq!(
        violations("src/report/a.rs", "use toml::de;"),
        ["src/report/a.rs:1: report must not use toml"]
    );
    assert_eq!(violations("src/study/a.rs", "use toml::de;"), [""; 0]);
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|end| end == "rs") {
            files.push(path);
        }
    }
}

fn floor(module: &str) -> Option<usize> {
    FLOORS.iter().position(|modules| modules.contains(&module))
}

/// All faults of one file, `src/...` with slashes.
fn violations(name: &str, text: &str) -> Vec<String> {
    let parts: Vec<&str> = name
        .trim_start_matches("src/")
        .trim_end_matches(".rs")
        .split('/')
        .collect();
    let own = parts[0];
    if ["lib", "main"].contains(&own) {
        return Vec::new();
    }
    let Some(own_floor) = floor(own) else {
        return vec![format!("{name}:1: the folder {own} stands on no floor")];
    };
    let depth = parts.iter().filter(|part| **part != "mod").count();
    let mut faults = Vec::new();
    for (line, used) in uses(&tokens(text), depth) {
        match floor(&used) {
            _ if ["toml", "toml_edit"].contains(&used.as_str()) => {
                if own != "study" {
                    faults.push(format!("{name}:{line}: {own} must not use {used}"));
                }
            }
            Some(_) if used == own => {}
            Some(floor) if floor < own_floor => {}
            Some(_) => faults.push(format!("{name}:{line}: {own} must not use {used}")),
            None => faults.push(format!("{name}:{line}: {used} stands on no floor")),
        }
    }
    faults
}

type Token = (usize, String);

/// The modules of the crate's root that the tokens of a file `depth` modules down name, with their lines.
fn uses(tokens: &[Token], depth: usize) -> Vec<(usize, String)> {
    let word = |at: usize| tokens.get(at).map_or("", |(_, word)| word.as_str());
    let mut found = Vec::new();
    let (mut braces, mut inline) = (0, Vec::new());
    let mut at = 0;
    while at < tokens.len() {
        match word(at) {
            "{" => braces += 1,
            "}" => {
                braces -= 1;
                if inline.last() == Some(&braces) {
                    inline.pop();
                }
            }
            "mod" if word(at + 2) == "{" => inline.push(braces),
            "toml" | "toml_edit" if word(at + 1) == "::" => found.push(tokens[at].clone()),
            "crate" if word(at + 1) == "::" => names(tokens, at + 2, &mut found),
            "super" if word(at + 1) == "::" => {
                let mut climbed = 1;
                while word(at + 2) == "super" && word(at + 3) == "::" {
                    (climbed, at) = (climbed + 1, at + 2);
                }
                if climbed >= depth + inline.len() {
                    names(tokens, at + 2, &mut found);
                }
            }
            _ => {}
        }
        at += 1;
    }
    found
}

/// The first names of a path or of a braced list of paths that begins at `at`.
fn names(tokens: &[Token], at: usize, found: &mut Vec<(usize, String)>) {
    if tokens.get(at).is_none_or(|(_, word)| word != "{") {
        found.extend(
            tokens
                .get(at)
                .filter(|(_, word)| !["self", "*"].contains(&word.as_str()))
                .cloned(),
        );
        return;
    }
    let mut depth = 0;
    for (n, (_, word)) in tokens.iter().enumerate().skip(at) {
        match word.as_str() {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return;
        }
        let begins = depth == 1 && ["{", ","].contains(&word.as_str());
        let next = tokens.get(n + 1).filter(|(_, next)| {
            next.starts_with(|c: char| c.is_alphabetic() || c == '_') && next != "self"
        });
        if begins {
            found.extend(next.cloned());
        }
    }
}

/// Words, `::` and single signs of a Rust text with their lines; comments, texts and characters are left out.
fn tokens(text: &str) -> Vec<Token> {
    let chars: Vec<char> = text.chars().collect();
    let get = |at: usize| chars.get(at).copied().unwrap_or('\0');
    let (mut at, mut line, mut tokens) = (0, 1, Vec::new());
    while at < chars.len() {
        let start = at;
        let c = chars[at];
        if c == '/' && get(at + 1) == '/' {
            while at < chars.len() && chars[at] != '\n' {
                at += 1;
            }
        } else if c == '/' && get(at + 1) == '*' {
            let mut depth = 0;
            loop {
                match (get(at), get(at + 1)) {
                    ('/', '*') => (depth, at) = (depth + 1, at + 2),
                    ('*', '/') => (depth, at) = (depth - 1, at + 2),
                    _ => at += 1,
                }
                if depth == 0 || at >= chars.len() {
                    break;
                }
            }
        } else if c == 'r'
            && (get(at + 1) == '"' || (get(at + 1) == '#' && ['"', '#'].contains(&get(at + 2))))
        {
            let hashes = chars[at + 1..].iter().take_while(|c| **c == '#').count();
            at += 2 + hashes;
            while at < chars.len()
                && !(chars[at] == '"' && (1..=hashes).all(|i| get(at + i) == '#'))
            {
                at += 1;
            }
            at += 1 + hashes;
        } else if c == '"' {
            at += 1;
            while at < chars.len() && chars[at] != '"' {
                at += if chars[at] == '\\' { 2 } else { 1 };
            }
            at += 1;
        } else if c == '\'' && (get(at + 1) == '\\' || get(at + 2) == '\'') {
            at += 2;
            while at < chars.len() && chars[at] != '\'' {
                at += 1;
            }
            // The quote of '\'' itself.
            at += if get(at - 1) == '\\' && get(at + 1) == '\'' {
                2
            } else {
                1
            };
        } else if c.is_alphanumeric() || c == '_' {
            while get(at).is_alphanumeric() || get(at) == '_' {
                at += 1;
            }
            tokens.push((line, chars[start..at].iter().collect()));
        } else if c == ':' && get(at + 1) == ':' {
            at += 2;
            tokens.push((line, "::".to_owned()));
        } else {
            at += 1;
            if !c.is_whitespace() {
                tokens.push((line, c.to_string()));
            }
        }
        line += chars[start..at.min(chars.len())]
            .iter()
            .filter(|c| **c == '\n')
            .count();
    }
    tokens
}
