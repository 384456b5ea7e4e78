//! Folders for tests.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use tempfile::TempDir;

/// An empty folder, removed with the returned guard.
pub fn folder() -> TempDir {
    tempfile::tempdir_in(place()).expect("a temporary folder")
}

/// Where tests write. Thousands of files that are made and removed take a fifth of the tests' time on a disk, so this is
/// memory where the system offers 2 GiB of it as files, and runs programs from there. Else it is the folder for
/// temporary files.
pub fn place() -> &'static Path {
    static PLACE: OnceLock<PathBuf> = OnceLock::new();
    PLACE.get_or_init(|| in_memory().unwrap_or_else(std::env::temp_dir))
}

#[cfg(target_os = "linux")]
fn in_memory() -> Option<PathBuf> {
    use rustix::fs::StatVfsMountFlags;
    let place = Path::new("/dev/shm");
    let room = rustix::fs::statvfs(place).ok()?;
    let bytes = room.f_bavail.checked_mul(room.f_frsize)?;
    let runs = !room.f_flag.contains(StatVfsMountFlags::NOEXEC);
    (runs && bytes >> 31 > 0 && tempfile::tempfile_in(place).is_ok()).then(|| place.to_owned())
}

#[cfg(not(target_os = "linux"))]
fn in_memory() -> Option<PathBuf> {
    None
}
