//! Writing checkpoints while a render goes on.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Condvar, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::envelope::{Header, State, Stored};
use super::generations::{Found, Generations};
use super::lock::Lock;
use super::store::Disk;
use crate::commands::values::duration;
use crate::failure::{Exit, Failure};
use crate::output::Destination;

/// Where checkpoints go, and how often.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Target {
    pub(crate) path: PathBuf,
    pub(crate) interval: Duration,
}

/// Time between checkpoints if none is asked for: what a crash costs at most.
const INTERVAL: Duration = Duration::from_secs(60);

impl Target {
    /// `FILE` or `FILE:INTERVAL`.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let with_interval = text
            .rsplit_once(':')
            .and_then(|(path, interval)| Some((path, duration(interval).ok()?)));
        let (path, interval) = with_interval.unwrap_or((text, INTERVAL));
        if Path::new(path).file_name().is_none() {
            return Err("expected FILE or FILE:INTERVAL, as in a.checkpoint:30s".to_owned());
        }
        Ok(Self { path: path.into(), interval })
    }
}

/// A checkpoint that is written.
#[derive(Debug)]
pub(crate) struct Keeper {
    generations: Generations<Disk>,
    interval: Duration,
    _lock: Lock,
}

impl Keeper {
    /// Checks that the checkpoint can be written, cleans up after crashes, and reads the newest complete one.
    pub(crate) fn open(target: &Target) -> Result<(Self, Option<Stored>), Failure> {
        Destination::check(&target.path)?;
        let lock = Lock::of(&target.path)?;
        let mut generations = Generations::new(Disk, &target.path);
        generations.clean();
        let stored = match generations.load(Stored::from_bytes) {
            Found::Nothing => None,
            Found::Content(stored, complaint) => {
                if let Some(complaint) = complaint {
                    eprintln!("etendue: warning: {complaint}; the checkpoint before it is used");
                }
                Some(stored)
            }
            Found::Damage(complaint) => {
                let help = "name another file, or remove a damaged checkpoint and its .previous to begin anew";
                return Err(damaged(&format!("{complaint}\n  help: {help}")));
            }
        };
        Ok((Self { generations, interval: target.interval, _lock: lock }, stored))
    }

    /// The newest complete checkpoint under a name, if there is one.
    pub(crate) fn read(path: &Path) -> Result<Option<Stored>, Failure> {
        match Generations::new(Disk, path).load(Stored::from_bytes) {
            Found::Nothing => Ok(None),
            Found::Content(stored, _) => Ok(Some(stored)),
            Found::Damage(complaint) => Err(damaged(&complaint)),
        }
    }

    pub(crate) fn path(&self) -> &Path {
        self.generations.path()
    }

    /// Does a piece of work, writes a checkpoint of it at every interval and after its end, however it ends.
    ///
    /// * `snapshot`: copies the state, quickly.
    ///
    /// The work's outcome, or how it panicked; and whether the last checkpoint was written.
    pub(crate) fn keep<T>(
        &mut self,
        header: &Header,
        snapshot: &(dyn Fn() -> State + Sync),
        work: impl FnOnce() -> T,
    ) -> (thread::Result<T>, Result<(), Failure>) {
        let (ended, end) = (Mutex::new(false), Condvar::new());
        let begin = Instant::now();
        let interval = self.interval;
        let mut save = || {
            let seconds = header.seconds + begin.elapsed().as_secs_f64();
            self.save(&Stored::new(header, seconds, snapshot()))
        };
        thread::scope(|scope| {
            let writer = scope.spawn(|| {
                loop {
                    let waiting = ended.lock().unwrap_or_else(PoisonError::into_inner);
                    let waited = end.wait_timeout_while(waiting, interval, |ended| !*ended);
                    // Let go at once: the work must not wait for the disk before it can say that it has ended.
                    let last = *waited.unwrap_or_else(PoisonError::into_inner).0;
                    let saved = save();
                    if last {
                        return saved;
                    }
                    if let Err(failure) = saved {
                        eprintln!("etendue: warning: {failure}; the render goes on");
                    }
                }
            });
            let outcome = catch_unwind(AssertUnwindSafe(work));
            *ended.lock().unwrap_or_else(PoisonError::into_inner) = true;
            end.notify_one();
            let saved = writer.join().unwrap_or_else(|_| {
                Err(Failure::new(Exit::Internal, "the thread that writes checkpoints has failed"))
            });
            (outcome, saved)
        })
    }

    fn save(&mut self, stored: &Stored) -> Result<(), Failure> {
        let bytes = stored
            .to_bytes()
            .map_err(|error| Failure::new(Exit::Internal, format!("checkpoint: {error}")))?;
        self.generations.save(&bytes).map_err(|error| Failure::write(self.path(), error))
    }
}

/// That there is no complete checkpoint where there should be one.
fn damaged(complaint: &str) -> Failure {
    Failure::new(Exit::InputOutput, complaint)
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_renderer::Accumulation;
    use etendue_scene::film::Crop;

    fn nothing() -> State {
        let crop = Crop { offset: [0, 0], size: [20, 3] };
        State::Plain(Accumulation::new(crop, 0..4))
    }

    fn target(folder: &tempfile::TempDir) -> Target {
        Target { path: folder.path().join("a.checkpoint"), interval: Duration::from_millis(1) }
    }

    #[test]
    fn checkpoints_are_written_while_the_work_goes_on() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let target = target(&folder);
        let (mut keeper, stored) = Keeper::open(&target).expect("writable");
        assert_eq!(stored, None);
        // The work ends when it sees the second checkpoint, or after so long that there is none.
        let previous = folder.path().join("a.checkpoint.previous");
        let (outcome, saved) = keeper.keep(&Header::default(), &nothing, || {
            let begin = Instant::now();
            while !previous.exists() && begin.elapsed() < Duration::from_secs(60) {
                thread::yield_now();
            }
            previous.exists()
        });
        assert!(outcome.is_ok_and(|seen| seen) && saved.is_ok());
        drop(keeper);
        let (_, stored) = Keeper::open(&target).expect("writable");
        let stored = stored.expect("a checkpoint");
        assert_eq!(stored.state, nothing());
        assert!(stored.header.seconds > 0.0);
    }

    #[test]
    fn work_that_panics_is_kept() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let target = Target { interval: Duration::from_secs(1000), ..target(&folder) };
        let (mut keeper, _) = Keeper::open(&target).expect("writable");
        let (outcome, saved) =
            keeper.keep(&Header::default(), &nothing, || panic!("a panic that is meant"));
        assert!(outcome.is_err() && saved.is_ok());
        assert!(Keeper::read(&target.path).is_ok_and(|stored| stored.is_some()));
    }

    #[test]
    fn a_checkpoint_that_another_one_writes_is_refused() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let target = target(&folder);
        let first = Keeper::open(&target).expect("writable");
        let second = Keeper::open(&target).expect_err("locked");
        assert!(second.to_string().contains("another render"), "{second}");
        drop(first);
        assert!(Keeper::open(&target).is_ok());
    }

    #[test]
    fn an_interval_is_a_time_after_the_last_colon() {
        let target = |path: &str, seconds| {
            Ok(Target { path: path.into(), interval: Duration::from_secs(seconds) })
        };
        assert_eq!(Target::parse("a.ck"), target("a.ck", 60));
        assert_eq!(Target::parse("a.ck:5min"), target("a.ck", 300));
        assert_eq!(Target::parse("c:a.ck"), target("c:a.ck", 60));
        assert_eq!(Target::parse("a:2s:10s"), target("a:2s", 10));
        assert!(Target::parse("").is_err());
        assert!(Target::parse("..:10s").is_err());
    }
}
