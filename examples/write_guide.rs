//! Writes the pages of `guide/` that come from the code: `cargo run --example write_guide`.

use std::fs;
use std::io;
use std::path::Path;

use gearwear::report::guide;

fn main() -> io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("guide");
    fs::create_dir_all(&folder)?;
    fs::write(folder.join("effects.md"), guide::effects())?;
    fs::write(folder.join("study-file.md"), guide::study_file())
}
