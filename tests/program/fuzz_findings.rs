//! Replays the seeds of the fuzz targets, and what fuzzing found (`found_*`), on the readers.

use std::fs;
use std::path::Path;

/// Runs a target on every file of its folder.
fn replay(name: &str, target: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/fuzz").join(name);
    let mut files: Vec<_> = fs::read_dir(&folder)
        .expect("a folder of inputs")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    assert!(!files.is_empty(), "{} is empty", folder.display());
    for file in files {
        println!("{}", file.display());
        target(&fs::read(&file).expect("an input"));
    }
}

macro_rules! targets {
    ($($name:ident)*) => {
        $(#[test]
        fn $name() {
            replay(stringify!($name), crate::readers::$name);
        })*
    };
}

targets! {
    archive archive_names json yaml urdf mjcf sdf usd loops spheres programs stl obj gltf glb dae settings urdd
}
