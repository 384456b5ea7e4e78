//! The entries of modules and files in `urdd.json`, the latter with size and SHA-256, as JSON.

use serde_json::{Value, json};

use super::digest;
use urdd_format::registry::ModuleKind;

/// The file entries that are objects: that of the source, then those of the modules.
pub fn all(metadata: &mut Value) -> impl Iterator<Item = &mut Value> {
    let (mut source, mut modules) = (None, None);
    for (key, value) in metadata.as_object_mut().into_iter().flatten() {
        match key.as_str() {
            "source" => source = value.get_mut("Urdf"),
            "modules" => modules = value.as_array_mut(),
            _ => {}
        }
    }
    let modules = modules.into_iter().flatten().flat_map(of_module);
    let entries = source.into_iter().chain(modules);
    entries.filter(|entry| entry.is_object())
}

/// The file entries of all modules.
pub fn of_modules(metadata: &mut Value) -> impl Iterator<Item = &mut Value> {
    let modules = metadata.get_mut("modules").and_then(Value::as_array_mut);
    modules.into_iter().flatten().flat_map(of_module)
}

/// The file entries of a module.
pub fn of_module(module: &mut Value) -> impl Iterator<Item = &mut Value> {
    let files = module.get_mut("files").and_then(Value::as_array_mut);
    files.into_iter().flatten()
}

/// The path of an entry.
pub fn path(entry: &Value) -> Option<&str> {
    entry.get("path").and_then(Value::as_str)
}

/// Updates the entries of those files that `bytes` returns. Returns whether one of them changed.
pub fn reseal<'a>(metadata: &mut Value, bytes: impl Fn(&str) -> Option<&'a [u8]>) -> bool {
    let mut changed = false;
    for entry in all(metadata) {
        if let Some(bytes) = path(entry).and_then(&bytes) {
            let (size, sha256) = digest::of_bytes(bytes);
            changed |= update(entry, size, &sha256);
        }
    }
    changed
}

/// Removes the entries of files of modules.
pub fn unlist(metadata: &mut Value, is_gone: impl Fn(&str) -> bool) {
    let modules = metadata.get_mut("modules").and_then(Value::as_array_mut);
    for module in modules.into_iter().flatten() {
        if let Some(files) = module.get_mut("files").and_then(Value::as_array_mut) {
            files.retain(|entry| !path(entry).is_some_and(&is_gone));
        }
    }
}

/// Writes size and SHA-256 into an entry. Returns whether they changed.
pub fn update(entry: &mut Value, size: u64, sha256: &str) -> bool {
    let (size, sha256) = (json!(size), json!(sha256));
    let changed = entry["size"] != size || entry["sha256"] != sha256;
    entry["size"] = size;
    entry["sha256"] = sha256;
    changed
}

/// Lists a new module in `modules`, at its place: modules of the specification in the order of its table, then all others
/// by name. `files` are its files, by their paths relative to the root.
pub fn insert_module<'a>(
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

/// States the version of the specification that has this module first, where the one that is stated is older.
pub fn raise_version(metadata: &mut Value, kind: ModuleKind) {
    let numbers = |version: &str| -> Vec<u64> {
        version.split('.').map(|number| number.parse().unwrap_or_default()).collect()
    };
    let stated = metadata.get("urdd_version").and_then(Value::as_str);
    if stated.is_some_and(|stated| numbers(stated) < numbers(kind.since())) {
        metadata["urdd_version"] = kind.since().into();
    }
}

/// Orders modules by their names.
fn rank(name: &str) -> (usize, &str) {
    let mut kinds = ModuleKind::ALL.iter();
    match kinds.position(|kind| kind.name() == name) {
        Some(place) => (place, ""),
        None => (ModuleKind::ALL.len(), name),
    }
}
