//! The difference between two URDDs as changes of a case: patches of documents, and whole files.

use std::collections::BTreeSet;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use urdd_conformance::change::{Change, mirror_of, rehash, text_of};
use urdd_conformance::tree::{FilePath, Node, Tree};
use urdd_directory::{canonical, file_entry, json as json_text};

use testkit::fixture::ROOT;

/// `changes` from `old` to `new`, and `hashes_kept`: files whose entries in `urdd.json` are not those of the files.
pub fn difference(old: &Tree, new: &Tree) -> Value {
    let mut tree = old.clone();
    let mut changes = Vec::new();
    let mut push = |tree: &mut Tree, change: Value| {
        apply(&change, tree).unwrap_or_else(|error| panic!("a change that does not fit: {error}"));
        changes.push(change);
    };
    for path in old.nodes.keys() {
        if let (false, Some(patch)) =
            (old.nodes.get(path) == new.nodes.get(path), patch(old, new, path))
        {
            push(&mut tree, json!({ "file": name(path), "patch": patch }));
        }
    }
    for (path, node) in &new.nodes {
        let Node::File(bytes) = node else { panic!("{path}: a computed case has files alone") };
        if path.as_str() != Some(ROOT) && !same(&tree, new, path) {
            push(&mut tree, written(path, bytes));
        }
    }
    // Sizes and hashes of what has changed follow.
    let mut sealed = tree.clone();
    rehash(&mut sealed, &untrue_entries(new));
    let root = FilePath::from(ROOT);
    if let (false, Some(bytes)) = (same(&sealed, new, &root), new.file(ROOT)) {
        push(&mut tree, written(&root, bytes));
    }
    for path in old.nodes.keys().filter(|path| !new.nodes.contains_key(path)) {
        push(&mut tree, json!({ "file": name(path), "delete": true }));
    }
    let difference = json!({ "changes": changes, "hashes_kept": untrue_entries(new) });
    assert!(makes(old, &difference, new), "the changes make another URDD");
    difference
}

fn written(path: &FilePath, bytes: &[u8]) -> Value {
    match std::str::from_utf8(bytes) {
        Ok(text) => json!({ "file": name(path), "write": text }),
        Err(_) => json!({ "file": name(path), "write_base64": STANDARD.encode(bytes) }),
    }
}

fn name(path: &FilePath) -> &str {
    path.as_str().expect("a computed case has names in UTF-8")
}

fn apply(change: &Value, tree: &mut Tree) -> Result<(), String> {
    let change =
        serde_json::from_value::<Change>(change.clone()).map_err(|error| error.to_string());
    change?.apply(tree).map_err(|error| error.to_string())
}

/// Whether stored changes turn `old` into `new`.
pub fn makes(old: &Tree, stored: &Value, new: &Tree) -> bool {
    let list = |key: &str| stored.get(key).and_then(Value::as_array).cloned().unwrap_or_default();
    let mut tree = old.clone();
    let applied = list("changes").iter().all(|change| apply(change, &mut tree).is_ok());
    let kept = list("hashes_kept").into_iter();
    let kept: BTreeSet<String> = kept.filter_map(|path| path.as_str().map(str::to_owned)).collect();
    rehash(&mut tree, &kept);
    let mut paths = new.nodes.keys().chain(tree.nodes.keys());
    applied && kept == untrue_entries(new) && paths.all(|path| same(&tree, new, path))
}

/// The patch of a document that is one before and after, if there is anything to patch.
fn patch(old: &Tree, new: &Tree, path: &FilePath) -> Option<Value> {
    let is_root = path.as_str() == Some(ROOT);
    mirror_of(path).is_some().then_some(()).or(is_root.then_some(()))?;
    let (mut before, mut after) = (document(old, path)?, document(new, path)?);
    if is_root {
        mark_right(old, &mut before);
        mark_right(new, &mut after);
    }
    let patch = serde_json::to_value(json_patch::diff(&before, &after)).expect("a patch is JSON");
    (patch != json!([])).then_some(patch)
}

fn document(tree: &Tree, path: &FilePath) -> Option<Value> {
    let bytes = tree.file(path.as_str()?)?;
    let read = json_text::read(bytes).ok()?;
    // Text with more information than the document (a repeated key, a byte order mark) is compared as text.
    let same = |on_one_line| text_of(&read.value, on_one_line) == bytes;
    (same(false) || same(true)).then_some(read.value)
}

/// The document that `path` mirrors.
fn mirrored(tree: &Tree, path: &FilePath) -> Option<Value> {
    let folder = path.as_str()?.strip_suffix("module.yaml")?;
    document(tree, &format!("{folder}module.json").as_str().into())
}

/// Whether both have the same content at this path. The order of keys is ignored, and all correct hashes are equal.
fn same(ours: &Tree, theirs: &Tree, path: &FilePath) -> bool {
    if ours.nodes.get(path) == theirs.nodes.get(path) {
        return true;
    }
    if let (Some(mut our), Some(mut their)) = (document(ours, path), document(theirs, path)) {
        if path.as_str() == Some(ROOT) {
            mark_right(ours, &mut our);
            mark_right(theirs, &mut their);
        }
        return our == their;
    }
    let is_mirror = |tree: &Tree| {
        let text = mirrored(tree, path).map(|document| canonical::yaml_string(&document));
        text.is_some_and(|text| path.as_str().and_then(|p| tree.file(p)) == Some(text.as_bytes()))
    };
    is_mirror(ours) && is_mirror(theirs)
}

/// Leaves size and hash out of entries where both are correct: sealing fills them in.
fn mark_right(tree: &Tree, metadata: &mut Value) {
    for entry in file_entry::all(metadata) {
        if is_right(tree, entry) == Some(true) {
            (entry["size"], entry["sha256"]) = (json!(0), json!(""));
        }
    }
}

/// Whether an entry matches its file; `None` if the file does not exist.
fn is_right(tree: &Tree, entry: &Value) -> Option<bool> {
    let bytes = tree.file(entry["path"].as_str()?)?;
    let (size, sha256) = file_entry::of_bytes(bytes);
    Some(entry["size"] == json!(size) && entry["sha256"] == json!(sha256))
}

/// Files whose entry does not match.
fn untrue_entries(tree: &Tree) -> BTreeSet<String> {
    let mut metadata = document(tree, &ROOT.into()).unwrap_or_default();
    let entries = file_entry::all(&mut metadata);
    let untrue = entries.filter(|entry| is_right(tree, entry) == Some(false));
    untrue.filter_map(|entry| entry["path"].as_str().map(str::to_owned)).collect()
}
