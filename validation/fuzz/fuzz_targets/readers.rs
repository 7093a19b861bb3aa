//! One reader under libFuzzer: the environment's READER names it.
#![no_main]

use std::sync::OnceLock;

use libfuzzer_sys::fuzz_target;

#[path = "../src/readers.rs"]
mod readers;

static READER: OnceLock<fn(&[u8])> = OnceLock::new();

fuzz_target!(|data: &[u8]| {
    let read = READER.get_or_init(|| {
        let name = std::env::var("READER").expect("READER names one of the readers");
        readers::find(&name).unwrap_or_else(|| panic!("READER is one of {:?}", readers::names()))
    });
    read(data);
});
