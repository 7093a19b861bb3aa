//! Progress on standard error: a bar with the time left where somebody looks, nothing elsewhere.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

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
        let template = "{prefix} [{bar:30}] {percent:>3} %, {eta} left  {wide_msg}";
        Self(
            bar.with_style(
                ProgressStyle::with_template(template)
                    .unwrap_or_else(|_| ProgressStyle::default_bar())
                    .progress_chars("=> "),
            ),
        )
    }

    /// Shows that the fraction `done` (0 to 1) is behind us, and what is going on.
    #[expect(dead_code, reason = "called by the command bodies")]
    pub(crate) fn show(&self, done: f64, doing: String) {
        self.0.set_message(doing);
        self.0.set_position((done.clamp(0.0, 1.0) * 1000.0) as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
