//! Progress on standard error: a bar with the time left on a terminal, now and then a line in a log.

use std::fmt::Write;
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

/// Time between two drawings of a bar of which nothing new is told.
const REDRAWN: Duration = Duration::from_secs(1);

/// How far a command has come. Quiet ones cost nothing.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    /// Where standard error is no terminal: lines instead of a bar.
    log: Option<Log>,
    /// Whether no one knows how much there is to do: no share is shown, and no time left but what the work says itself.
    open_ended: bool,
}

/// Lines of progress for a file or a pipe: none of short work, and of long work few.
#[derive(Debug, Default)]
struct Log {
    /// Since the start, when the last line was written.
    last: Mutex<Duration>,
}

impl Log {
    /// Between two lines, and before the first.
    const BETWEEN: Duration = Duration::from_secs(60);

    /// Whether a line is due after the time `elapsed`; the next one then waits again.
    fn is_due(&self, elapsed: Duration) -> bool {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let due = elapsed >= *last + Self::BETWEEN;
        if due {
            *last = elapsed;
        }
        due
    }
}

impl Progress {
    /// Progress of `what`: nothing where `quiet`.
    pub(super) fn new(what: &'static str, quiet: bool) -> Self {
        let target = if quiet {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(1000), target).with_prefix(what);
        let template = "{prefix} [{bar:30}] {percent:>3} %, {left}  {wide_msg}";
        let style = ProgressStyle::with_template(template)
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .with_key("left", |state: &ProgressState, out: &mut dyn Write| {
                let _ = out.write_str(&left(state.fraction(), state.elapsed()));
            })
            .progress_chars("=> ");
        if !bar.is_hidden() {
            // so that the time left grows while nothing is told
            bar.enable_steady_tick(REDRAWN);
        }
        let is_log = !quiet && !std::io::stderr().is_terminal();
        Self {
            bar: bar.with_style(style),
            log: is_log.then(Log::default),
            open_ended: false,
        }
    }

    /// Of work that goes on until nothing more is found.
    pub(super) fn without_end(mut self) -> Self {
        let style = ProgressStyle::with_template("{prefix} {spinner}  {wide_msg}");
        if let Ok(style) = style {
            self.bar.set_style(style);
        }
        self.open_ended = true;
        self
    }

    /// Whether somebody may look at it: standard error is a terminal.
    pub(crate) fn is_seen(&self) -> bool {
        !self.bar.is_hidden()
    }

    /// Shows which stage begins.
    pub(crate) fn stage(&self, name: &'static str) {
        self.bar.set_message(name);
        self.bar.tick();
        self.write_log(name);
    }

    /// The same, with the fraction that is behind us by then.
    pub(crate) fn stage_at(&self, done: f64, name: &'static str) {
        self.show(done, name.to_owned());
    }

    /// Shows that the fraction `done` (0 to 1) is behind us, and what is going on.
    pub(crate) fn show(&self, done: f64, doing: String) {
        self.bar
            .set_position((done.clamp(0.0, 1.0) * 1000.0) as u64);
        self.write_log(&doing);
        self.bar.set_message(doing);
    }

    /// Writes where the work stands to a log, if a line is due.
    #[expect(clippy::print_stderr, reason = "progress is for people")]
    fn write_log(&self, doing: &str) {
        let elapsed = self.bar.elapsed();
        if self.log.as_ref().is_some_and(|log| log.is_due(elapsed)) {
            let done = self.bar.position() as f32 / 1000.0;
            let what = self.bar.prefix();
            if self.open_ended {
                eprintln!("{what}: {doing}");
                return;
            }
            eprintln!(
                "{what}: {:.0} %, {}: {doing}",
                100.0 * done,
                left(done, elapsed)
            );
        }
    }
}

/// Seconds in words.
pub(super) fn in_words(seconds: f32) -> String {
    match seconds.ceil() {
        ..120.0 => format!("{seconds:.0} s"),
        ..7200.0 => format!("{:.0} min", seconds / 60.0),
        _ => format!("{:.1} h", seconds / 3600.0),
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
    format!("{} left", in_words(left))
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_gets_a_line_every_minute() {
        let log = Log::default();
        let due: Vec<u64> = (0..200)
            .filter(|&second| log.is_due(Duration::from_secs(second)))
            .collect();
        assert_eq!(due, [60, 120, 180]);
    }

    #[test]
    fn the_time_left_is_told_once_it_is_known() {
        let second = Duration::from_secs(1);
        assert_eq!(left(0.0, second), "time left not known yet");
        assert_eq!(left(0.5, 30 * second), "30 s left");
        assert_eq!(left(0.1, 60 * second), "9 min left");
        assert_eq!(left(0.1, 3600 * second), "9.0 h left");
    }
}
