//! The progress of long work: a bar on a terminal, a line now and then otherwise.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use etendue_renderer::progressive::ImageError;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::figures::error_in_percent;

/// How far the work is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standing {
    /// The part of the work that is done, from 0 to 1.
    pub(crate) fraction: f64,
    /// The present error of the picture, where there is one and it is known.
    pub(crate) error: Option<ImageError>,
}

impl Standing {
    /// That so many of `total` parts are finished.
    pub(crate) fn parts(finished: usize, total: usize) -> Self {
        Self { fraction: finished as f64 / total.max(1) as f64, error: None }
    }
}

/// Whether progress and summary are suppressed.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Quiet {
    /// Print no progress and no summary.
    #[arg(long, short)]
    pub(crate) quiet: bool,
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

/// Steps of the bar.
const STEPS: u64 = 10_000;

impl ProgressDisplay {
    /// A display on standard error that suits what standard error is; `work` is what goes on.
    pub(crate) fn new(work: &str, Quiet { quiet }: Quiet) -> Self {
        if quiet {
            return Self::Nothing;
        }
        if !std::io::stderr().is_terminal() {
            let now = Instant::now();
            return Self::Lines(Lines { start: now, last: Mutex::new(now) });
        }
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr());
        let template =
            format!("{work} {{wide_bar}} {{percent:>3}} %  {{msg}}{{elapsed}}, {{eta}} left");
        // The template is one of a few constants; a bar in the default style is no reason not to render.
        bar.set_style(
            ProgressStyle::with_template(&template)
                .unwrap_or_else(|_| ProgressStyle::default_bar()),
        );
        Self::Bar(bar)
    }

    /// Shows how far the work is.
    pub(crate) fn update(&self, now: Standing) {
        match self {
            Self::Nothing => {}
            Self::Bar(bar) => {
                if let Some(error) = &now.error {
                    bar.set_message(format!("{}, ", error_in_percent(error)));
                }
                bar.set_position((now.fraction * STEPS as f64) as u64);
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
    fn update(&self, now: Standing) {
        // Whoever finds the lock taken has nothing newer to say.
        let Ok(mut last) = self.last.try_lock() else { return };
        if last.elapsed() < INTERVAL {
            return;
        }
        *last = Instant::now();
        let error = now.error.map_or(String::new(), |e| format!("{}, ", error_in_percent(&e)));
        // Within an hour a fraction of a millionth is a year left, which is long enough.
        let left = (1.0 - now.fraction) / now.fraction.max(1e-6);
        let left = HumanDuration(self.start.elapsed().mul_f64(left));
        eprintln!("etendue: {:.0} %, {error}{left} left", 100.0 * now.fraction);
    }
}
