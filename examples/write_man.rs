//! Writes the manual pages of the program and of every command into a folder: `cargo run --release --example write_man -- FOLDER`.

use std::path::PathBuf;
use std::{env, fs, io};

use clap::CommandFactory;
use gearwear::cli::args::Arguments;

fn main() -> io::Result<()> {
    let folder = env::args_os().nth(1).map(PathBuf::from);
    let folder = folder.ok_or_else(|| io::Error::other("name the folder of the pages"))?;
    fs::create_dir_all(&folder)?;
    let command = Arguments::command().disable_help_subcommand(true);
    clap_mangen::generate_to(command, folder)
}
