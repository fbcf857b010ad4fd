//! The progress of a render: a bar on a terminal, a line now and then otherwise.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use etendue_renderer::Progress;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Whether progress and summary are suppressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quiet {
    Yes,
    No,
}

/// Where progress goes.
#[derive(Debug)]
pub(crate) enum ProgressDisplay {
    /// Nowhere.
    Nothing,
    /// A bar with the time left.
    Bar(ProgressBar),
    /// Log lines for files and pipes.
    Lines(Lines),
}

/// Log lines, at most one per interval.
#[derive(Debug)]
pub(crate) struct Lines {
    start: Instant,
    last: Mutex<Instant>,
}

const INTERVAL: Duration = Duration::from_secs(5);

impl ProgressDisplay {
    /// A display on standard error that suits what standard error is.
    pub(crate) fn new(quiet: Quiet) -> Self {
        if quiet == Quiet::Yes {
            return Self::Nothing;
        }
        if !std::io::stderr().is_terminal() {
            let now = Instant::now();
            return Self::Lines(Lines { start: now, last: Mutex::new(now) });
        }
        let bar = ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::stderr());
        let template = "rendering {wide_bar} {percent:>3} %  {elapsed}, {eta} left";
        // The template is a constant; a bar in the default style is no reason not to render.
        bar.set_style(
            ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()),
        );
        Self::Bar(bar)
    }

    /// Shows how far the render is.
    pub(crate) fn update(&self, now: Progress) {
        match self {
            Self::Nothing => {}
            Self::Bar(bar) => {
                bar.set_length(now.total as u64);
                bar.set_position(now.finished as u64);
            }
            Self::Lines(lines) => lines.update(now),
        }
    }

    /// Clears the bar.
    pub(crate) fn finish(&self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

impl Lines {
    fn update(&self, now: Progress) {
        // Whoever finds the lock taken has nothing newer to say.
        let Ok(mut last) = self.last.try_lock() else { return };
        if last.elapsed() < INTERVAL {
            return;
        }
        *last = Instant::now();
        let left = (now.total - now.finished) as f64 / now.finished as f64;
        let left = HumanDuration(self.start.elapsed().mul_f64(left));
        eprintln!("etendue: {} %, {left} left", 100 * now.finished / now.total);
    }
}
