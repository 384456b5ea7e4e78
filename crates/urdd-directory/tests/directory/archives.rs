//! Archives as people's programs pack them. `testkit/archives/make.py` made these.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use urdd_directory::archive_fault::{ArchiveFault, EntryFault};
use urdd_directory::listing::EntryKind;
use urdd_directory::root::Root;
use urdd_directory::source::Archive;

fn archives() -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../testkit/archives");
    let paths =
        fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let zips = paths.filter(|path| path.extension().is_some_and(|extension| extension == "zip"));
    let named = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    let mut all: Vec<_> = zips.map(|path| (named(&path), fs::read(path).unwrap())).collect();
    all.sort();
    all
}

#[test]
fn archives_of_every_program_have_the_same_files() {
    let found = archives();
    assert_eq!(found.len(), 10, "Info-ZIP, Git, 7-Zip, libarchive, macOS, Windows");
    for (name, bytes) in found {
        let root =
            Root::of(Archive::of_any("", bytes).unwrap_or_else(|error| panic!("{name}: {error}")));
        let entries = root.list().expect("a list").entries;
        let files = entries.iter().filter(|entry| entry.kind == EntryKind::File);
        let paths = files.map(|entry| entry.path.trim_start_matches("arm-main/"));
        let paths: Vec<&str> = paths.filter(|path| !path.ends_with(".DS_Store")).collect();
        let expected = ["meshes/base.stl", "meshes/äußen.stl", "package.xml", "urdf/arm.urdf"];
        assert_eq!(paths, expected.map(|path| format!("arm_description/{path}")), "{name}");
    }
}

#[test]
fn what_is_no_urdd_is_none_however_it_is_packed() {
    for (name, bytes) in archives() {
        let error = Archive::new("robot", Arc::<[u8]>::from(bytes)).expect_err("no URDD");
        // Backslashes, and `./`.
        let is_odd = matches!(&*name, "dotnet.zip" | "libarchive.zip");
        let is_refused = matches!(error, ArchiveFault::Entry { fault: EntryFault::Path, .. });
        assert_eq!(is_refused, is_odd, "{name}: {error}");
        assert!(is_refused || error == ArchiveFault::NoUrdd, "{name}: {error}");
    }
}
