//! The entries of `urdd.json` that say how large a file is and what its SHA-256 is, as JSON.

use serde_json::{Value, json};

/// The entries of the files of all modules.
pub fn of_modules(metadata: &mut Value) -> impl Iterator<Item = &mut Value> {
    let modules = metadata.get_mut("modules").and_then(Value::as_array_mut);
    modules.into_iter().flatten().flat_map(of_module)
}

/// The entries of the files of a module.
pub fn of_module(module: &mut Value) -> impl Iterator<Item = &mut Value> {
    let files = module.get_mut("files").and_then(Value::as_array_mut);
    files.into_iter().flatten()
}

/// The path that an entry is of.
pub fn path(entry: &Value) -> Option<&str> {
    entry.get("path").and_then(Value::as_str)
}

/// Writes size and SHA-256 into an entry. Whether that changed it.
pub fn update(entry: &mut Value, size: u64, sha256: &str) -> bool {
    let (size, sha256) = (json!(size), json!(sha256));
    let changed = entry["size"] != size || entry["sha256"] != sha256;
    entry["size"] = size;
    entry["sha256"] = sha256;
    changed
}
