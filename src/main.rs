//! The `gearwear` program: everything is in the library's `cli`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(gearwear::cli::run(std::env::args_os()))
}
