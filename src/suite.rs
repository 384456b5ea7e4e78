//! The conformance suite that the program carries. A release build embeds its files as an archive; a debug build reads
//! them from the repository, so that new cases need no rebuild.

// `build.rs` packs.
#[cfg_attr(not(test), allow(dead_code, reason = "one build reads the folder, another unpacks"))]
mod archive;

use std::io;
#[cfg(any(test, suite_in_repository))]
use std::path::Path;

use urdd_conformance::data::{Damage, Files};
use urdd_conformance::suite::Suite;

/// Why there is no suite.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum CarriedError {
    #[error("the conformance suite cannot be read: {0}")]
    Read(#[from] io::Error),
    #[error("the suite is damaged: {0}")]
    Suite(#[from] Damage),
}

/// The suite of this build.
///
/// # Errors
/// If its files cannot be read, or are damaged.
pub fn carried() -> Result<Suite, CarriedError> {
    Ok(Suite::of(files()?)?)
}

#[cfg(not(suite_in_repository))]
fn files() -> io::Result<Files> {
    archive::unpack(include_bytes!(concat!(env!("OUT_DIR"), "/suite.tar.gz")))
}

#[cfg(suite_in_repository)]
fn files() -> io::Result<Files> {
    archive::read_folder(Path::new(REPOSITORY)).map_err(|error| {
        let message = format!("{error}; a debug build reads it from the repository");
        io::Error::new(error.kind(), message)
    })
}

/// The suite's folder in the repository.
#[cfg(any(test, suite_in_repository))]
const REPOSITORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/conformance");

#[cfg(test)]
mod tests {
    use super::*;
    use urdd_conformance::data::ROBOTS;

    #[test]
    fn an_archive_holds_what_the_folder_holds() {
        let files = archive::read_folder(Path::new(REPOSITORY)).expect("the repository's");
        let cases = files.keys().filter(|path| path.starts_with("cases/"));
        assert!(cases.count() > 150, "{} files", files.len());
        let packed = archive::pack(&files).expect("an archive");
        assert_eq!(archive::unpack(&packed).expect("what was packed"), files);
        assert_eq!(archive::pack(&files).expect("the same again"), packed);
        // The archive adds about 0.8 MB to the program.
        assert!(packed.len() < 1_500_000, "{} bytes", packed.len());
        assert!(archive::unpack(&packed[..packed.len() / 2]).is_err());
    }

    #[test]
    fn files_are_found_by_folder() {
        let data = carried().expect("a suite").data;
        assert!(data.file("README.md").is_some() && data.file("no/such").is_none());
        let mut robots = data.below(ROBOTS).map(|(path, _)| path);
        assert!(robots.any(|path| path == "gripper.urdf"));
        assert_eq!(data.below("no_such").count(), 0);
    }
}
