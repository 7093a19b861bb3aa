//! The program as its users meet it: commands, inputs that it refuses, result files, reports, the server.

mod add_command;
mod cli;
#[path = "../common/mod.rs"]
mod common;
mod compare_command;
mod each_command;
mod face_rows;
mod guide;
mod import_command;
mod metamorphic;
mod output_faults;
mod outputs;
mod readers;
mod refusals;
mod report_browser;
mod run_command;
mod serve;
mod study_input;
mod sweep_parts;
mod tools;
mod validate;
mod vtk_render;
#[path = "../common/vtu.rs"]
mod vtu;
