//! SIGINT and SIGTERM: the first asks for an end, the second leaves at once.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::failure::{Exit, Failure};

/// Flags that the signal handlers set.
#[derive(Clone, Debug)]
pub(crate) struct Interrupt {
    requested: Arc<AtomicBool>,
    signal: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Installs the handlers.
    pub(crate) fn install() -> Result<Self, Failure> {
        Self::try_install()
            .map_err(|e| Failure::new(Exit::Internal, format!("cannot handle signals: {e}")))
    }

    fn try_install() -> io::Result<Self> {
        let interrupt = Self { requested: Arc::default(), signal: Arc::default() };
        for signal in [SIGINT, SIGTERM] {
            // Handlers run in this order: a second signal finds the flag set and ends the process.
            let second = Arc::clone(&interrupt.requested);
            flag::register_conditional_shutdown(signal, 128 + signal, second)?;
            flag::register(signal, Arc::clone(&interrupt.requested))?;
            flag::register_usize(signal, Arc::clone(&interrupt.signal), signal as usize)?;
        }
        Ok(interrupt)
    }

    /// The flag a render looks at between tiles.
    pub(crate) fn flag(&self) -> &AtomicBool {
        &self.requested
    }

    /// Whether a signal has come.
    pub(crate) fn requested(&self) -> bool {
        self.requested.load(Ordering::Relaxed)
    }

    /// The exit code of the signal that came, if one did.
    pub(crate) fn exit(&self) -> Option<Exit> {
        match self.signal.load(Ordering::Relaxed) as i32 {
            0 => None,
            SIGTERM => Some(Exit::Terminated),
            _ => Some(Exit::Interrupted),
        }
    }
}
