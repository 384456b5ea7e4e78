//! Updates mirrors, and the sizes and hashes in `urdd.json`, of a URDD in memory.

use std::collections::BTreeSet;

use crate::change::mirror_of;
use crate::tree::{FilePath, Tree};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::{canonical, file_entry, json};

/// Adds a canonical `module.yaml` to every `module.json` without one.
pub fn add_mirrors(tree: &mut Tree) {
    let documents: Vec<FilePath> = tree.nodes.keys().cloned().collect();
    for path in documents {
        let Some(mirror) = mirror_of(&path) else {
            continue;
        };
        if tree.nodes.contains_key(&mirror) {
            continue;
        }
        let document = path.as_str().and_then(|path| tree.file(path));
        if let Some(Ok(document)) = document.map(json::read) {
            let text = canonical::yaml_string(&document.value);
            tree.put(mirror, text.into_bytes());
        }
    }
}

/// Updates the size and hash of every file that `urdd.json` lists, except files in `kept`, missing files and symbolic
/// links. Does nothing if `urdd.json` is not JSON.
pub fn rehash(tree: &mut Tree, kept: &BTreeSet<String>) {
    let Some(Ok(document)) = tree.file(ROOT_METADATA).map(json::read) else {
        return;
    };
    let mut metadata = document.value;
    let listed = |path: &str| tree.file(path).filter(|_| !kept.contains(path));
    if file_entry::reseal(&mut metadata, listed) {
        let text = canonical::json_string(&metadata);
        tree.put(ROOT_METADATA.into(), text.into_bytes());
    }
}
