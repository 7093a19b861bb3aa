//! What is said when the user stops a command: that nothing is lost, and how to go on.

/// From now on Ctrl-C (and a request to end) says `how` to go on if something is kept at `path`, and ends the program as it would have
/// ended without (exit code 130 or 143).
#[cfg(unix)]
pub(super) fn tells(path: std::path::PathBuf, how: String) {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use std::io::Write;

    // without signals the program ends silently, as any other
    let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGINT, SIGTERM]) else {
        return;
    };
    std::thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            let said = if path.exists() {
                format!("interrupted; what was computed is kept: {how}")
            } else {
                "interrupted before anything was kept".to_owned()
            };
            // the progress bar's line is left behind
            let _ = writeln!(std::io::stderr(), "\n{said}");
            // ends as the signal would have ended it; the exit is for systems that refuse
            let _ = signal_hook::low_level::emulate_default_handler(signal);
            std::process::exit(128 + signal);
        }
    });
}

/// Without signals there is nothing to tell.
#[cfg(not(unix))]
pub(super) fn tells(_: std::path::PathBuf, _: String) {}
