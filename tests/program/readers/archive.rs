//! A zip archive.

use urdd_directory::listing::EntryKind;
use urdd_directory::root::Root;
use urdd_directory::source::Archive;

/// An accepted archive can be listed, every file in it has its stated length, and all of them are within the limits for
/// an archive of this size.
pub fn archive(bytes: &[u8]) {
    let Ok(archive) = Archive::new("robot", bytes.to_vec()) else {
        return;
    };
    let root = Root::of(archive);
    let listing = root.list().expect("a listing");
    let mut total = 0;
    for entry in &listing.entries {
        let parts = entry.path.split('/');
        assert!(!entry.path.starts_with('/'), "{}", entry.path);
        assert!(parts.clone().all(|part| !matches!(part, "" | "." | "..")));
        // A path that no document may name is listed, and not opened.
        let is_named = urdd_directory::path::check(&entry.path).is_ok();
        if entry.kind == EntryKind::File && is_named && entry.utf8 {
            let read = root.read(&entry.path, entry.size).expect("a file");
            assert_eq!(read.len() as u64, entry.size);
            total += entry.size;
        }
    }
    // Links are counted with their targets.
    let links = listing.entries.len() as u64;
    assert!(total <= ((64 << 20) + 250 * bytes.len() as u64) * links.max(1));
}
