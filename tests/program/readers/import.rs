//! Imports of MJCF and SDF.

use std::path::Path;
use std::sync::Arc;

use urdd_source::import::import as imported;
use urdd_source::{Files, Settings};

/// An import ends, whatever the bytes are. What it refuses has a reason; what it makes, both readers of URDF read as the
/// same robot, and it needs no repair.
pub fn import(bytes: &[u8]) {
    let file = ("robot.xml".to_owned(), Arc::from(bytes));
    let files = Files::in_memory([file]).expect("a file");
    let settings = Settings { files, ..Settings::default() };
    match imported(Path::new("/robot.xml"), &settings) {
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
