//! Progress on standard error: a bar with the time left where somebody looks, nothing elsewhere.

use std::fmt::Write;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

/// A progress bar; hidden ones cost nothing.
#[derive(Debug)]
pub(crate) struct Progress(ProgressBar);

impl Progress {
    /// A bar named `what`. Standard error that is no terminal hides it, as `quiet` does.
    pub(super) fn new(what: &'static str, quiet: bool) -> Self {
        let target = if quiet {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(1000), target).with_prefix(what);
        let template = "{prefix} [{bar:30}] {percent:>3} %, {left}  {wide_msg}";
        Self(
            bar.with_style(
                ProgressStyle::with_template(template)
                    .unwrap_or_else(|_| ProgressStyle::default_bar())
                    .with_key("left", |state: &ProgressState, out: &mut dyn Write| {
                        let _ = out.write_str(&left(state.fraction(), state.elapsed()));
                    })
                    .progress_chars("=> "),
            ),
        )
    }

    /// Whether somebody may look at it: standard error is a terminal.
    pub(crate) fn is_seen(&self) -> bool {
        !self.0.is_hidden()
    }

    /// Shows which stage begins.
    pub(crate) fn stage(&self, name: &'static str) {
        self.0.set_message(name);
        self.0.tick();
    }

    /// The same, with the fraction that is behind us by then.
    pub(crate) fn stage_at(&self, done: f64, name: &'static str) {
        self.show(done, name.to_owned());
    }

    /// Shows that the fraction `done` (0 to 1) is behind us, and what is going on.
    pub(crate) fn show(&self, done: f64, doing: String) {
        self.0.set_message(doing);
        self.0.set_position((done.clamp(0.0, 1.0) * 1000.0) as u64);
    }
}

/// Share of the work from which the time left is shown.
const TELLS: f32 = 0.04;

/// The time left in words.
fn left(done: f32, elapsed: Duration) -> String {
    if done < TELLS {
        return "time left not known yet".to_owned();
    }
    let left = elapsed.as_secs_f32() * (1.0 - done) / done;
    match left.ceil() {
        ..120.0 => format!("{left:.0} s left"),
        ..7200.0 => format!("{:.0} min left", left / 60.0),
        _ => format!("{:.1} h left", left / 3600.0),
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_told_once_it_is_known() {
        let second = Duration::from_secs(1);
        assert_eq!(left(0.0, second), "time left not known yet");
        assert_eq!(left(0.5, 30 * second), "30 s left");
        assert_eq!(left(0.1, 60 * second), "9 min left");
        assert_eq!(left(0.1, 3600 * second), "9.0 h left");
    }
}
