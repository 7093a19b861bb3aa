//! Claim: the pages of `guide/` that are written from the code are those of this code, and links and commands of the hand-written
//! pages lead somewhere.
//!
//! Source: the catalogue of effects and the table of study keys, which unit tests hold against the readers; the files of the
//! repository; the program's own list of commands. Tolerance: none.

use std::fs;
use std::path::{Path, PathBuf};

use gearwear::report::guide;
use gearwear::study::{KEY_DOCS, Study};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The hand-written pages and the others, with their texts.
fn pages() -> Vec<(PathBuf, String)> {
    let mut paths: Vec<PathBuf> = fs::read_dir(root().join("guide"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "md"))
        .collect();
    paths.sort();
    paths.push(root().join("README.md"));
    paths
        .into_iter()
        .map(|path| {
            let text = fs::read_to_string(&path).unwrap();
            (path, text)
        })
        .collect()
}

#[test]
fn every_documented_table_has_its_place_in_the_page_of_keys() {
    let page = guide::study_file();
    for doc in KEY_DOCS.iter().filter(|doc| !doc.table.is_empty()) {
        // a table of members or a list stands under its own name too
        let title = |line: &str| {
            let name = format!("[{}]", doc.table);
            line.starts_with("## ") && line.contains(&name)
        };
        assert!(page.lines().any(title), "[{}]", doc.table);
    }
}

#[test]
fn pages_written_from_the_code_are_up_to_date() {
    for (name, text) in [
        ("effects.md", guide::effects()),
        ("study-file.md", guide::study_file()),
    ] {
        let written = fs::read_to_string(root().join("guide").join(name)).unwrap();
        assert!(
            written == text,
            "guide/{name} is not what the code says: run `cargo run --example write_guide`"
        );
    }
}

#[test]
fn links_and_pictures_lead_to_files_of_the_repository() {
    let mut links = 0;
    for (path, text) in pages() {
        for rest in text.split("](").skip(1) {
            let target = rest.split(')').next().unwrap_or_default();
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            if file.starts_with("http") {
                continue;
            }
            let to = match file {
                "" => path.clone(),
                file => path.parent().unwrap().join(file),
            };
            assert!(to.exists(), "{}: {target}", path.display());
            if !anchor.is_empty() {
                let found = fs::read_to_string(&to).unwrap();
                let heading = |line: &str| {
                    line.starts_with('#')
                        && line
                            .trim_start_matches('#')
                            .trim()
                            .to_lowercase()
                            .replace(' ', "-")
                            == anchor
                };
                assert!(found.lines().any(heading), "{}: {target}", path.display());
            }
            links += 1;
        }
    }
    assert!(links > 50, "only {links} links were found");
}

/// Every ```toml block of the guide that holds effects is accepted behind a plain study.
#[test]
fn effects_shown_in_the_guide_are_accepted() {
    let base = fs::read_to_string(root().join("validation/challenges/none_L2/study.toml")).unwrap();
    let mut shown = 0;
    for (path, text) in pages() {
        for block in text.split("```toml\n").skip(1) {
            let block = block.split("```").next().unwrap_or_default();
            if block.contains("[[effect]]") {
                Study::parse(&format!("{base}\n{block}"), "study.toml")
                    .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
                shown += 1;
            }
        }
    }
    assert!(shown >= 2, "the blocks were not found");
}
