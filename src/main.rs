//! The `gearwear` program: everything is in the library's `cli`.

use std::process::ExitCode;

/// Contacts, fits and histories make many short-lived vectors on several threads: a seventh of a diagnosis's time with the system's allocator.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    ExitCode::from(gearwear::cli::run(std::env::args_os()))
}
