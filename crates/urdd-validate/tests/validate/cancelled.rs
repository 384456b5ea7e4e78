//! Cancelled validation returns a cancellation error, and no report.

use std::sync::atomic::{AtomicUsize, Ordering};

use testkit::robots::{made, our_robots};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::listing::ReadError;
use urdd_directory::source::{Disk, OpenFile, Source};
use urdd_validate::settings::Settings;
use urdd_validate::{ValidateError, validate, validate_source};

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
        let settings = Settings { cancellation: cancellation.clone(), ..Settings::default() };
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
    let settings = Settings { cancellation, ..Settings::default() };
    let stopped = validate(&[&path], &settings).err().expect("it stopped");
    assert!(matches!(stopped, ValidateError::Cancelled(_)), "{stopped}");
    assert_eq!(stopped.to_string(), "stopped before it was finished");
}
