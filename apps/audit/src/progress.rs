//! How far a run is, on the error output.

use core::sync::atomic::{AtomicUsize, Ordering};
use core::time::Duration;

use crate::checks;
use crate::run::Record;

/// Reports of a long run; the records themselves never depend on it.
#[derive(Debug)]
pub enum Progress {
    /// Nothing is printed.
    Silent,
    /// A line per model swept, and one per twentieth of the other checks.
    Lines {
        /// Checks done so far.
        done: AtomicUsize,
    },
}

impl Progress {
    /// Lines on the error output.
    pub fn lines() -> Self {
        Self::Lines { done: AtomicUsize::new(0) }
    }

    /// One of `total` checks is done.
    pub fn check_done(&self, total: usize) {
        let Self::Lines { done } = self else { return };
        let now = done.fetch_add(1, Ordering::Relaxed) + 1;
        if now * 20 / total > (now - 1) * 20 / total {
            eprintln!("{now} of {total} checks");
        }
    }

    /// A model was swept, in `time` summed over the threads.
    pub fn swept(&self, model: &str, records: &[Record], time: Duration) {
        if matches!(self, Self::Silent) {
            return;
        }
        let precision = records.iter().filter(|r| r.check == checks::SWEPT[0]);
        let measured = precision.filter_map(|r| r.outcome.measurement());
        let (inputs, worst) = measured
            .fold((0, 0.0_f64), |(inputs, worst), m| (inputs + m.evaluations, worst.max(m.worst)));
        let seconds = time.as_secs_f64();
        eprintln!(
            "{model}: {inputs} inputs swept in {seconds:.1} s of one core, {:.2e} per second; worst {worst:.3} ulp",
            inputs as f64 / seconds.max(f64::MIN_POSITIVE)
        );
    }
}
