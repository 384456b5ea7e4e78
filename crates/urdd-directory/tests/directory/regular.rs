//! Files that are none, and files that are longer than they say.
#![cfg(unix)]

use std::fs::File;
use std::io::{self, Read};
use std::process::Command;
use std::thread;
use std::time::Duration;

use urdd_directory::listing::Listing;
use urdd_directory::listing::ReadError;
use urdd_directory::regular;
use urdd_directory::root::Root;
use urdd_directory::source::{OpenFile, Source};

/// A file that states a size, and has another.
#[derive(Debug)]
struct Growing {
    stated: u64,
    bytes: u64,
}

impl Source for Growing {
    fn folder_name(&self) -> String {
        String::new()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        Ok(Listing::default())
    }

    fn open(&self, _: &str) -> Result<(OpenFile, u64), ReadError> {
        Ok((Box::new(io::repeat(b'x').take(self.bytes)), self.stated))
    }
}

#[test]
fn a_file_that_grows_is_read_up_to_the_limit() {
    let read = |stated, bytes| {
        Root::of(Growing { stated, bytes }).read("file", 100).map(|bytes| bytes.len())
    };
    let stream = |bytes| regular::read_up_to(io::repeat(b'x').take(bytes), 100);
    assert_eq!((read(10, 100), stream(100).map(|bytes| bytes.len())), (Ok(100), Ok(100)));
    for bytes in [101, u64::MAX] {
        assert_eq!(read(10, bytes), Err(ReadError::TooLarge { size: 101, limit: 100 }));
        assert_eq!(stream(bytes), Err(ReadError::TooLong { limit: 100 }));
    }
    // Nothing is allocated for what it only states.
    assert_eq!(read(1 << 60, 0), Err(ReadError::TooLarge { size: 1 << 60, limit: 100 }));
}

#[test]
fn what_is_no_file_is_not_even_opened() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    // Whoever opens it for writing waits until somebody opens it for reading.
    let place = pipe.clone();
    let writer = thread::spawn(move || File::options().write(true).open(place).map(|_| ()));
    thread::sleep(Duration::from_millis(100));
    assert_eq!(regular::open(&pipe).err(), Some(ReadError::NotAFile));
    thread::sleep(Duration::from_millis(100));
    assert!(!writer.is_finished(), "the pipe was opened");
    drop(File::open(&pipe).unwrap());
    writer.join().unwrap().unwrap();
}
