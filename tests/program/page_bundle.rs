//! `crates/urdd-view/dist` is built from `page/` and `wasm/`: `page/build.mjs` leaves a hash of all its inputs. Rebuild it with
//! `.ci/page`.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use sha2::{Digest, Sha256};
use urdd_format::hexadecimal::hexadecimal;

/// As in `page/build.mjs`: folders, single files, and what the module does not depend on.
const FOLDERS: &[&str] = &["page/src", "wasm/src", "crates"];
const FILES: &[&str] = &[
    "Cargo.lock",
    "page/index.html",
    "page/build.mjs",
    "page/package-lock.json",
    "page/tsconfig.json",
    "wasm/Cargo.toml",
];
/// Crates that the module does not depend on.
const WITHOUT: &[&str] = &[
    "crates/urdd-c/",
    "crates/urdd-conformance/",
    "crates/urdd-diff/",
    "crates/urdd-export/",
    "crates/urdd-generate/",
    "crates/urdd-lint/",
    "crates/urdd-lsp/",
    "crates/urdd-view/",
];

fn is_in_it(name: &str) -> bool {
    let is_test = name.starts_with("crates/") && name.split('/').nth(2) == Some("tests");
    !is_test && !WITHOUT.iter().any(|start| name.starts_with(start))
}

#[test]
fn the_committed_page_is_made_of_these_sources() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files: BTreeMap<String, Vec<u8>> = FILES
        .iter()
        .map(|file| ((*file).to_owned(), fs::read(root.join(file)).expect("a file")))
        .collect();
    for folder in FOLDERS {
        let below = testkit::files::below(&root.join(folder)).into_iter();
        files.extend(below.map(|(path, bytes)| (format!("{folder}/{path}"), bytes)));
    }
    files.retain(|name, _| is_in_it(name));
    assert!(files.len() > 300, "{} files", files.len());
    let mut hash = Sha256::new();
    for (name, bytes) in &files {
        hash.update(format!("{}  {name}\n", hexadecimal(&Sha256::digest(bytes))));
    }
    assert_eq!(
        urdd_view::assets::STAMP.trim(),
        hexadecimal(&hash.finalize()),
        "crates/urdd-view/dist was made of other sources: run .ci/page and commit what it wrote"
    );
}
