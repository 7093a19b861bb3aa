//! The learning half: measurements, fits, evidence, diagnoses and what they decide.

mod challenges;
#[path = "../common/mod.rs"]
mod common;
mod decision;
mod diagnose;
mod histories_of_fits;
mod imperfect_traces;
mod learn;
mod learned;
mod measurements;
mod other_valleys;

/// The allocator of the program: with that of the system a diagnosis takes a quarter longer.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;
