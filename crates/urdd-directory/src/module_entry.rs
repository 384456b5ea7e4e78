//! The entries of modules in `urdd.json`, as JSON.

use serde_json::{Value, json};

use super::digest;
use urdd_format::registry::ModuleKind;

/// Lists a new module in `modules`, at its place: modules of the specification in the order of its table, then all others
/// by name. `files` are its files, by their paths relative to the root.
pub fn insert<'a>(
    modules: &mut Vec<Value>,
    name: &str,
    version: &str,
    folder: &str,
    depends_on: &[ModuleKind],
    files: impl Iterator<Item = (String, &'a [u8])>,
) {
    let mut files: Vec<_> = files.collect();
    files.sort();
    let files = files.iter().map(|(path, bytes)| {
        let (size, sha256) = digest::of_bytes(bytes);
        json!({ "path": path, "size": size, "sha256": sha256 })
    });
    let depends_on: Vec<&str> = depends_on.iter().map(|kind| kind.name()).collect();
    let entry = json!({
        "name": name, "version": version, "path": folder, "depends_on": depends_on,
        "files": files.collect::<Vec<_>>(),
    });
    let follows = |module: &Value| rank(module["name"].as_str().unwrap_or_default()) > rank(name);
    let place = modules.iter().position(follows);
    modules.insert(place.unwrap_or(modules.len()), entry);
}

/// Orders modules by their names.
fn rank(name: &str) -> (usize, &str) {
    let mut kinds = ModuleKind::ALL.iter();
    match kinds.position(|kind| kind.name() == name) {
        Some(place) => (place, ""),
        None => (ModuleKind::ALL.len(), name),
    }
}
