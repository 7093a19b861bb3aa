//! Claim: what a run found stands in its files, whole, with the columns and keys that outside programs rely on; and a run that
//! fails leaves nothing under the final name.
//!
//! Source: the file formats of this program (README), the VTK XML format (types 5 and 22, six-component tensors XX YY ZZ XY YZ
//! XZ), closed forms for load (4/3 p b of a parabola) and area (Archimedes' parabola segment) of a made-up pair of blocks.
//! Tolerance: exact for text (shortest digits read back to the same double), 1e-12 for what is recomputed in doubles,
//! 1e-6 relative where an array is stored in single precision (24 bits: 6e-8).
mod fields;
mod folders;
mod pages;
mod synthetic;
mod tables;

use std::fs;

use gearwear::report::write_run;
use gearwear::simulate::result::Run;

fn written() -> (tempfile::TempDir, Run) {
    let dir = tempfile::tempdir().unwrap();
    let run = synthetic::run();
    write_run(&run, &dir.path().join("study.out/run")).unwrap();
    (dir, run)
}

fn read(dir: &tempfile::TempDir, name: &str) -> String {
    fs::read_to_string(dir.path().join("study.out/run").join(name)).unwrap()
}
