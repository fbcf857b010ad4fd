//! Crashes and failures at every single operation.

use std::io;
use std::path::Path;

use super::super::simulated::{Fault, SimulatedDisk};
use super::super::store::Store;
use super::{Found, Generations};

const PATH: &str = "folder/a.checkpoint";

/// Content that knows whether it is complete, as checkpoints do by their checksum.
fn content(generation: u8) -> Vec<u8> {
    let mut bytes = vec![generation; 64 + usize::from(generation)];
    bytes.push(bytes.len() as u8);
    bytes
}

fn parse(bytes: &[u8]) -> Result<u8, String> {
    let generation = bytes.first().copied().unwrap_or(0);
    if generation != 0 && bytes == content(generation) {
        Ok(generation)
    } else {
        Err("damaged".to_owned())
    }
}

/// Someone who writes generation after generation into a file of a disk.
trait Writer {
    fn new(disk: SimulatedDisk) -> Self;
    fn save(&mut self, bytes: &[u8]) -> io::Result<()>;
}

impl Writer for Generations<SimulatedDisk> {
    fn new(disk: SimulatedDisk) -> Self {
        let mut generations = Self::new(disk, Path::new(PATH));
        generations.clean();
        generations.load(parse);
        generations
    }

    fn save(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.save(bytes)
    }
}

/// The newest generation that is found on a disk; 0 if there is none.
fn found(disk: SimulatedDisk) -> u8 {
    match Generations::new(disk, Path::new(PATH)).load(parse) {
        Found::Content(generation, _) => generation,
        Found::Nothing | Found::Damage(_) => 0,
    }
}

/// Has a writer save four generations with a crash at each of its operations in turn, and everything that a disk may be after it.
/// The number of disks on which less is found than had been saved, and of all disks.
fn losses<W: Writer>() -> [usize; 2] {
    let (mut losses, mut disks) = (0, 0);
    for operation in 0.. {
        let disk = SimulatedDisk::new(Fault::Crash { operation });
        let mut writer = W::new(disk.clone());
        let mut saved = 0;
        while saved < 4 && writer.save(&content(saved + 1)).is_ok() {
            saved += 1;
        }
        let crashed = saved < 4;
        for after in disk.after_power_loss() {
            disks += 1;
            losses += usize::from(found(after) < saved);
        }
        if !crashed {
            break;
        }
    }
    [losses, disks]
}

#[test]
fn no_crash_and_no_loss_of_power_costs_what_was_saved() {
    let [losses, disks] = losses::<Generations<SimulatedDisk>>();
    assert_eq!(losses, 0, "of {disks}");
    assert!(disks > 200, "{disks}");
}

/// A control: the file is written where it is.
struct InPlace(SimulatedDisk);
/// A control: renamed without having been synced.
struct Unsynced(SimulatedDisk);
/// A control: the folder is never synced.
struct UnsyncedFolder(SimulatedDisk);

impl Writer for InPlace {
    fn new(disk: SimulatedDisk) -> Self {
        Self(disk)
    }

    fn save(&mut self, bytes: &[u8]) -> io::Result<()> {
        let mut file = self.0.create(Path::new(PATH))?;
        self.0.write(&mut file, bytes)?;
        self.0.sync(&file)?;
        self.0.sync_folder(Path::new("folder"))
    }
}

impl Writer for Unsynced {
    fn new(disk: SimulatedDisk) -> Self {
        Self(disk)
    }

    fn save(&mut self, bytes: &[u8]) -> io::Result<()> {
        let mut file = self.0.create(Path::new("folder/tmp"))?;
        self.0.write(&mut file, bytes)?;
        self.0.rename(Path::new("folder/tmp"), Path::new(PATH))?;
        self.0.sync_folder(Path::new("folder"))
    }
}

impl Writer for UnsyncedFolder {
    fn new(disk: SimulatedDisk) -> Self {
        Self(disk)
    }

    fn save(&mut self, bytes: &[u8]) -> io::Result<()> {
        let mut file = self.0.create(Path::new("folder/tmp"))?;
        self.0.write(&mut file, bytes)?;
        self.0.sync(&file)?;
        self.0.rename(Path::new("folder/tmp"), Path::new(PATH))
    }
}

#[test]
fn writers_with_known_holes_are_caught() {
    for (name, [losses, disks]) in [
        ("in place", losses::<InPlace>()),
        ("without sync", losses::<Unsynced>()),
        ("without sync of the folder", losses::<UnsyncedFolder>()),
    ] {
        assert!(losses > 0, "{name}: nothing lost on {disks} disks");
    }
}

#[test]
fn an_operation_that_fails_costs_one_generation_at_most_and_the_next_one_is_saved() {
    for operation in 0.. {
        let disk = SimulatedDisk::new(Fault::Error { operation });
        let mut writer = <Generations<SimulatedDisk> as Writer>::new(disk.clone());
        let mut saved = 0;
        let mut failed = None;
        for generation in 1..=4 {
            match writer.save(&content(generation)) {
                Ok(()) => saved = generation,
                Err(_) => {
                    assert_eq!(failed, None, "one operation fails");
                    failed = Some(generation);
                }
            }
            assert!(found(disk.clone()) >= saved, "operation {operation}");
            for after in disk.after_power_loss() {
                assert!(found(after) >= saved, "operation {operation}, generation {generation}");
            }
        }
        if failed != Some(4) {
            assert_eq!(saved, 4, "operation {operation}");
            let names = disk.names();
            assert_eq!(
                names,
                [PATH.to_owned(), format!("{PATH}.previous")],
                "operation {operation}"
            );
        }
        if !disk.faulted() {
            break;
        }
    }
}

#[test]
fn a_disk_that_stays_full_keeps_what_it_has() {
    for operation in 8..30 {
        let disk = SimulatedDisk::new(Fault::Full { operation });
        let mut writer = <Generations<SimulatedDisk> as Writer>::new(disk.clone());
        let saved = (1..=6).filter(|&g| writer.save(&content(g)).is_ok()).count();
        assert!(saved > 0 && saved < 6, "operation {operation}: {saved}");
        assert_eq!(found(disk), saved as u8);
    }
}

#[test]
fn a_damaged_newest_generation_is_not_kept_in_place_of_the_one_before() {
    let disk = SimulatedDisk::new(Fault::None);
    let mut writer = <Generations<SimulatedDisk> as Writer>::new(disk.clone());
    for generation in [1, 2] {
        writer.save(&content(generation)).expect("no fault");
    }
    let mut file = disk.create(Path::new(PATH)).expect("no fault");
    disk.write(&mut file, b"damage").expect("no fault");
    let mut reopened = Generations::new(disk.clone(), Path::new(PATH));
    let Found::Content(1, Some(complaint)) = reopened.load(parse) else { panic!("the first") };
    assert!(complaint.contains("a.checkpoint: damaged"), "{complaint}");
    reopened.save(&content(3)).expect("no fault");
    assert_eq!(disk.read(Path::new("folder/a.checkpoint.previous")).ok(), Some(content(1)));
    assert_eq!(found(disk), 3);
}
