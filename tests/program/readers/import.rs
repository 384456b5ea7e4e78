//! Imports of MJCF, SDF and USD.

use std::path::Path;
use std::sync::Arc;

use urdd_import::import;
use urdd_source::{Files, Settings};

/// A mesh that any name of a description may find.
const MESH: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

pub fn mjcf(bytes: &[u8]) {
    imported(bytes, "robot.xml");
}

pub fn sdf(bytes: &[u8]) {
    imported(bytes, "model.sdf");
}

/// A layer of text, with its first line.
pub fn usd(bytes: &[u8]) {
    const FIRST: &[u8] = b"#usda 1.0\n";
    match bytes.starts_with(FIRST) {
        true => imported(bytes, "robot.usda"),
        false => imported(&[FIRST, bytes].concat(), "robot.usda"),
    }
}

/// A crate file, with its first bytes.
pub fn usd_crate(bytes: &[u8]) {
    const FIRST: &[u8] = b"PXR-USDC";
    let rest = bytes.get(FIRST.len()..).unwrap_or_default();
    imported(&[FIRST, rest].concat(), "robot.usdc");
}

/// A package: an archive of layers and meshes.
pub fn usd_package(bytes: &[u8]) {
    imported(bytes, "robot.usdz");
}

/// An import ends, whatever the bytes are. What it refuses has a reason; what it makes, both readers of URDF read as the
/// same robot, and it needs no repair.
fn imported(bytes: &[u8], name: &str) {
    let files = [(name, bytes), ("mesh.obj", MESH)];
    let files = files.map(|(name, bytes)| (name.to_owned(), Arc::from(bytes)));
    let files = Files::in_memory(files).expect("two files");
    let settings = Settings { files, ..Settings::default() };
    match import(&Path::new("/").join(name), &settings) {
        Ok(Some(made)) => {
            let read = urdd_source::read_urdf(made.text().as_bytes(), "file");
            if let Ok(read) = read {
                assert_eq!(read.carried, made.text().as_bytes(), "it is repaired");
            }
            super::urdf(made.text().as_bytes());
            assert!(!made.report.to_json().is_empty());
        }
        Ok(None) => {}
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
