//! The file entries of `urdd.json` with size and SHA-256, as JSON.

use serde_json::{Value, json};

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

/// Writes size and SHA-256 into an entry. Returns whether they changed.
pub fn update(entry: &mut Value, size: u64, sha256: &str) -> bool {
    let (size, sha256) = (json!(size), json!(sha256));
    let changed = entry["size"] != size || entry["sha256"] != sha256;
    entry["size"] = size;
    entry["sha256"] = sha256;
    changed
}
