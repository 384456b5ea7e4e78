//! Cancelled work returns a cancellation error, and leaves nothing behind.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use urdd_directory::cancellation::Cancellation;
use urdd_directory::read_error::ReadError;
use urdd_directory::source::{Disk, OpenFile, Source};
use urdd_format::registry::ModuleKind;
use urdd_generate::{GenerateError, Progress, Settings, generate};
use urdd_robot::{Obstacle, Queries, Robot, RobotError, ShapeKind, World};
use urdd_validate::settings::Settings as ValidateSettings;
use urdd_validate::{ValidateError, validate, validate_source};

use testkit::files::below;

use crate::robot::{made, our_robots};

/// Cancels when the module with this number begins.
struct StopsAt(usize, Cancellation);

impl Progress for StopsAt {
    fn module(&self, _: ModuleKind, done: usize, _: usize) {
        if done == self.0 {
            self.1.cancel();
        }
    }
}

#[test]
fn generate_leaves_what_was_there() {
    let (_, urdf) = our_robots().swap_remove(8);
    let modules = 15;
    for stop in [0, 1, 7, 8, 9, 10, 12, modules - 1] {
        let folder = testkit::temporary::folder();
        let target = folder.path().join("robot");
        let cancellation = Cancellation::default();
        let settings =
            Settings { cancellation: cancellation.clone(), num_samples: 10, ..Settings::default() };
        let progress = StopsAt(stop, cancellation);
        let stopped = generate(&urdf, &target, &settings, &progress).unwrap_err();
        assert!(matches!(stopped, GenerateError::Cancelled), "{stop}: {stopped}");
        assert_eq!(stopped.code(), "cancelled");
        assert_eq!(below(folder.path()), BTreeMap::new(), "{stop}");
    }
    // Over an existing URDD.
    let (folder, target) = made(&urdf);
    let before = below(folder.path());
    let cancellation = Cancellation::default();
    let settings =
        Settings { cancellation: cancellation.clone(), num_samples: 10, ..Settings::default() };
    let progress = StopsAt(12, cancellation);
    let stopped = generate(&urdf, &target, &settings, &progress).unwrap_err();
    assert!(matches!(stopped, GenerateError::Cancelled), "{stopped}");
    assert_eq!(below(folder.path()), before);
}

/// A folder that cancels when a file is opened for the n-th time.
#[derive(Debug)]
struct StopsWhenRead {
    disk: Disk,
    left: AtomicUsize,
    cancellation: Cancellation,
}

impl Source for StopsWhenRead {
    fn folder_name(&self) -> String {
        self.disk.folder_name()
    }

    fn list(&self) -> Result<urdd_directory::listing::Listing, ReadError> {
        self.disk.list()
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        if self.left.fetch_sub(1, Ordering::Relaxed) == 1 {
            self.cancellation.cancel();
        }
        self.disk.open(path)
    }
}

#[test]
fn validate_says_nothing_of_what_it_did_not_finish() {
    let (_folder, path) = made(&our_robots()[8].1);
    let ask = |reads: usize| {
        let cancellation = Cancellation::default();
        let settings =
            ValidateSettings { cancellation: cancellation.clone(), ..ValidateSettings::default() };
        let source = StopsWhenRead {
            disk: Disk::open(&path).unwrap(),
            left: AtomicUsize::new(reads),
            cancellation,
        };
        validate_source(source, "robot", &settings)
    };
    // While modules are loaded, and while rules read meshes.
    for reads in [1, 2, 20, 40] {
        let stopped = ask(reads).err().expect("it stopped");
        assert!(matches!(stopped, ValidateError::Cancelled(_)), "{reads}: {stopped}");
    }
    assert!(ask(usize::MAX).is_ok());
    let cancellation = Cancellation::default();
    cancellation.cancel();
    let settings = ValidateSettings { cancellation, ..ValidateSettings::default() };
    let stopped = validate(&[&path], &settings).err().expect("it stopped");
    assert!(matches!(stopped, ValidateError::Cancelled(_)), "{stopped}");
    assert_eq!(stopped.to_string(), "stopped before it was finished");
}

#[test]
fn batches_of_distances_stop() {
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(path).unwrap();
    let proximity = robot.proximity(ShapeKind::Pieces).unwrap();
    let q = robot.configurations().unwrap().random(1);
    // Minutes of work.
    let batch = q.repeat(1_000_000);
    let stopped = |ask: &(dyn Fn(&Cancellation) -> Result<(), RobotError> + Sync)| {
        let cancellation = Cancellation::default();
        std::thread::scope(|scope| {
            let asked = scope.spawn(|| ask(&cancellation));
            cancellation.cancel();
            asked.join().unwrap()
        })
    };
    let ball = Obstacle::sphere("ball", [0.5, 0.0, 0.5], 0.1).unwrap();
    let around = proximity.world_proximity(&World::new([ball])).unwrap();
    let (count, some) = (batch.len() / q.len(), &batch[..q.len() * 10_000]);
    for found in [
        stopped(&|on| proximity.in_collision_batch_into(&batch, on, &mut vec![false; count])),
        stopped(&|on| proximity.min_distance_batch_into(&batch, on, &mut vec![0.0; count])),
        stopped(&|on| {
            let mut out = vec![0.0; 10_000 * proximity.num_pairs()];
            proximity.distances_batch_into(some, on, &mut out)
        }),
        stopped(&|on| around.min_distance_batch_into(&batch, on, &mut vec![0.0; count])),
    ] {
        assert!(matches!(found, Err(RobotError::Cancelled(_))), "{found:?}");
    }
    // Without a cancellation, the result is the same.
    let (few, on) = (&batch[..q.len() * 3], Cancellation::default());
    let (mut touches, mut least) = ([false; 3], [0.0; 3]);
    let mut distances = vec![0.0; 3 * proximity.num_pairs()];
    proximity.in_collision_batch_into(few, &on, &mut touches).unwrap();
    proximity.min_distance_batch_into(few, &on, &mut least).unwrap();
    proximity.distances_batch_into(few, &on, &mut distances).unwrap();
    assert_eq!(proximity.in_collision_batch(few).unwrap(), touches);
    assert_eq!(proximity.min_distance_batch(few).unwrap(), least);
    assert_eq!(proximity.distances_batch(few).unwrap(), distances);
}
