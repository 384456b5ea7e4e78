//! `page/dist` is what `page/` and `wasm/` make: `page/build.mjs` leaves a hash of all that it was made from. Built again
//! with `.ci/page`.

use std::fs;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use urdd_format::hexadecimal::hexadecimal;

/// As in `page/build.mjs`: folders, single files, and what the module is not made of.
const FOLDERS: &[&str] = &["page/src", "wasm/src", "crates"];
const FILES: &[&str] = &[
    "Cargo.lock",
    "page/index.html",
    "page/build.mjs",
    "page/package-lock.json",
    "page/tsconfig.json",
    "wasm/Cargo.toml",
];
/// Crates that the module does not stand on.
const WITHOUT: &[&str] = &["crates/urdd-generate/", "crates/urdd-export/"];

fn is_in_it(name: &str) -> bool {
    let is_test = name.starts_with("crates/") && name.split('/').nth(2) == Some("tests");
    !is_test && !WITHOUT.iter().any(|start| name.starts_with(start))
}

fn files_below(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => files_below(&path, files),
            false => files.push(path),
        }
    }
}

#[test]
fn the_committed_page_is_made_of_these_sources() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut paths: Vec<PathBuf> = FILES.iter().map(|file| root.join(file)).collect();
    for folder in FOLDERS {
        files_below(&root.join(folder), &mut paths);
    }
    let name = |path: &PathBuf| {
        let relative = path.strip_prefix(root).expect("below the root");
        relative.to_str().expect("UTF-8").replace('\\', "/")
    };
    let mut names: Vec<String> = paths.iter().map(name).collect();
    names.retain(|name| is_in_it(name));
    names.sort();
    assert!(names.len() > 300, "{} files", names.len());
    let mut hash = Sha256::new();
    for name in &names {
        let content = Sha256::digest(fs::read(root.join(name)).expect("a file"));
        hash.update(format!("{}  {name}\n", hexadecimal(&content)));
    }
    assert_eq!(
        urdd::view::assets::STAMP.trim(),
        hexadecimal(&hash.finalize()),
        "page/dist was made of other sources: run .ci/page and commit what it wrote"
    );
}
