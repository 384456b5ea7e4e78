//! Updates mirrors, and the sizes and hashes in `urdd.json`, of a URDD in memory.

use std::collections::BTreeSet;

use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::change::mirror_of;
use super::tree::{FilePath, Tree};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::{canonical, json};
use urdd_format::hexadecimal::hexadecimal;

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
    let before = metadata.clone();
    for entry in entries_mut(&mut metadata) {
        let path = entry.get("path").and_then(Value::as_str);
        let path = path.filter(|path| !kept.contains(*path));
        if let Some(bytes) = path.and_then(|path| tree.file(path)) {
            let (size, sha256) = size_and_hash(bytes);
            entry["size"] = json!(size);
            entry["sha256"] = json!(sha256);
        }
    }
    if metadata != before {
        let text = canonical::json_string(&metadata);
        tree.put(ROOT_METADATA.into(), text.into_bytes());
    }
}

/// Size and SHA-256 of a file, in the form of `urdd.json`.
pub fn size_and_hash(bytes: &[u8]) -> (usize, String) {
    (bytes.len(), hexadecimal(&Sha256::digest(bytes)))
}

/// The file entries of `urdd.json`.
pub fn entries_mut(metadata: &mut Value) -> Vec<&mut Value> {
    let mut entries = Vec::new();
    let Some(root) = metadata.as_object_mut() else {
        return entries;
    };
    for (key, value) in root {
        match key.as_str() {
            "source" => entries.extend(value.get_mut("Urdf")),
            "modules" => {
                let modules = value.as_array_mut().into_iter().flatten();
                let files = modules.filter_map(|module| module.get_mut("files")?.as_array_mut());
                entries.extend(files.flatten());
            }
            _ => {}
        }
    }
    entries.retain(|entry| entry.is_object());
    entries
}
