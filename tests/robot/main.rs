//! `urdd::robot`: a robot asked about itself, against closed forms, differences and other ways to the same number.

#[path = "../support/mod.rs"]
#[allow(unused)]
mod support;

mod cancelled;
mod command;
mod inverse;
mod motion;
mod nearness;
mod opening;

use std::path::{Path, PathBuf};

use urdd::generate::{Settings, generate};

/// The URDFs of our robots.
pub fn our_robots() -> Vec<(String, PathBuf)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/robots");
    let entries = std::fs::read_dir(folder).expect("our robots");
    let mut robots: Vec<(String, PathBuf)> = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "urdf")
        })
        .map(|path| {
            (
                path.file_stem()
                    .expect("a name")
                    .to_string_lossy()
                    .into_owned(),
                path,
            )
        })
        .collect();
    robots.sort();
    assert_eq!(robots.len(), 9);
    robots
}

/// A URDD of a URDF, in a folder that lasts as long as what is returned.
pub fn made(urdf: &Path) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let target = folder.path().join("robot");
    generate(urdf, &target, &Settings::default(), &()).expect("a URDD");
    (folder, target)
}

/// A URDD of a URDF's text.
pub fn made_of(urdf: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("robot.urdf");
    std::fs::write(&file, urdf).expect("a file");
    let target = folder.path().join("robot");
    generate(&file, &target, &Settings::default(), &()).expect("a URDD");
    (folder, target)
}
