//! Claim: nothing that is read from a file can upset the program: every reader ends, soon, in a value or in an error.
//!
//! Source: the seeds of `validation/fuzz` (valid files of each kind), the smallest forms of everything that the fuzzer found (`findings`), and
//! mutants of both by proptest from a fixed seed. Tolerance: no panic, no reading of more than five seconds.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

#[path = "../../validation/fuzz/src/readers.rs"]
mod all;

/// Mutants of each reader.
const MUTANTS: u32 = 4000;
/// Longest reading.
const SOON: Duration = Duration::from_secs(5);

/// One change of a file.
#[derive(Debug, Clone)]
enum Edit {
    Replace(Index, u8),
    Remove(Index, Index),
    Repeat(Index, Index),
    Insert(Index, &'static str),
    Number(Index, f64),
}

/// Texts that readers have reason to trip over.
const AWKWARD: [&str; 18] = [
    "\n", "\r", "\"", "'", ",", ";", "\t", "=", "[", "]", "#", "\0", "\u{feff}", "é", "NaN", "inf",
    "-", "1e400",
];

fn edit() -> impl Strategy<Value = Edit> {
    prop_oneof![
        (any::<Index>(), any::<u8>()).prop_map(|(at, byte)| Edit::Replace(at, byte)),
        (any::<Index>(), any::<Index>()).prop_map(|(from, to)| Edit::Remove(from, to)),
        (any::<Index>(), any::<Index>()).prop_map(|(from, to)| Edit::Repeat(from, to)),
        (any::<Index>(), proptest::sample::select(&AWKWARD[..]))
            .prop_map(|(at, text)| Edit::Insert(at, text)),
        (any::<Index>(), any::<f64>()).prop_map(|(at, number)| Edit::Number(at, number)),
    ]
}

fn edited(mut bytes: Vec<u8>, edits: &[Edit]) -> Vec<u8> {
    for edit in edits {
        let size = bytes.len();
        let place = |at: &Index| at.index(size + 1);
        let stretch = |a: &Index, b: &Index| {
            let (a, b) = (place(a), place(b));
            a.min(b)..a.max(b)
        };
        match edit {
            Edit::Replace(at, byte) if size > 0 => bytes[at.index(size)] = *byte,
            Edit::Replace(..) => {}
            Edit::Remove(from, to) => {
                bytes.drain(stretch(from, to));
            }
            Edit::Repeat(from, to) => {
                let again = bytes[stretch(from, to)].to_vec();
                let end = place(to);
                bytes.splice(end..end, again);
            }
            Edit::Insert(at, text) => {
                let at = place(at);
                bytes.splice(at..at, text.bytes());
            }
            Edit::Number(at, number) => {
                // over the digits that stand there
                let start = place(at);
                let digits = bytes[start..]
                    .iter()
                    .take_while(|b| b.is_ascii_digit())
                    .count();
                bytes.splice(start..start + digits, number.to_string().into_bytes());
            }
        }
    }
    bytes
}

/// The files of a folder beside the fuzzer, by name; none if it is not there.
fn files(kind: &str, reader: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("validation/fuzz")
        .join(kind)
        .join(reader);
    let Ok(entries) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
        .into_iter()
        .map(|path| fs::read(path).unwrap())
        .collect()
}

fn read_soon(read: fn(&[u8]), bytes: &[u8]) {
    let start = Instant::now();
    read(bytes);
    let took = start.elapsed();
    assert!(took < SOON, "{took:?} for {} bytes", bytes.len());
}

fn check(reader: &str) {
    let read = all::find(reader).expect("a reader of that name");
    let seeds = files("seeds", reader);
    assert!(!seeds.is_empty(), "{reader} has no seed");
    let mut all = seeds;
    all.extend(files("findings", reader));
    for bytes in &all {
        read_soon(read, bytes);
    }
    let config = Config {
        cases: MUTANTS,
        failure_persistence: None,
        ..Config::default()
    };
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    TestRunner::new_with_rng(config, rng)
        .run(&(any::<Index>(), vec(edit(), 0..6)), |(file, edits)| {
            let bytes = edited(all[file.index(all.len())].clone(), &edits);
            read_soon(read, &bytes);
            Ok(())
        })
        .unwrap_or_else(|failure| panic!("{reader}: {failure}"));
}

#[test]
fn every_reader_survives_findings_and_mutants() {
    for reader in all::names() {
        check(reader);
    }
}
