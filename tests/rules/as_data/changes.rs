//! The difference between two URDDs, as changes that a case can list.

use std::collections::BTreeSet;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use urdd_conformance::change::{Action, Change, Yes, mirror_of, text_of};
use urdd_conformance::seal::rehash;
use urdd_conformance::tree::{FilePath, Node, Tree};
use urdd_directory::{canonical, digest, file_entry, json as json_text};

use super::patch::patch;
use testkit::fixture::ROOT;

/// Changes, and the files whose entries in `urdd.json` are not updated by them.
pub type Difference = (Vec<Change>, BTreeSet<String>);

/// Files shorter than this are written out, even if an equal file exists elsewhere.
const SHORT: usize = 200;

/// The changes from `old` to `new`.
pub fn difference(old: &Tree, new: &Tree) -> Difference {
    let mut work = Work { tree: old.clone(), changes: Vec::new() };
    work.patch_documents(old, new);
    work.change_files(new);
    work.add_and_delete(new);
    let kept = untrue_entries(new);
    rehash(&mut work.tree, &kept);
    if let Some(path) = missed(&work.tree, new) {
        panic!("{path}: the changes miss it");
    }
    (work.changes, kept)
}

/// Whether earlier changes still turn `old` into `new`.
pub fn makes(old: &Tree, changes: &[Change], kept: &BTreeSet<String>, new: &Tree) -> bool {
    let mut tree = old.clone();
    let applied = changes.iter().all(|change| change.apply(&mut tree).is_ok());
    rehash(&mut tree, kept);
    applied && *kept == untrue_entries(new) && missed(&tree, new).is_none()
}

/// A path at which the two differ.
fn missed<'a>(tree: &'a Tree, new: &'a Tree) -> Option<&'a FilePath> {
    let mut paths = new.nodes.keys().chain(tree.nodes.keys());
    paths.find(|path| !same(tree, new, path))
}

struct Work {
    tree: Tree,
    changes: Vec<Change>,
}

fn document(tree: &Tree, path: &FilePath) -> Option<Value> {
    let bytes = tree.file(path.as_str()?)?;
    let read = json_text::read(bytes).ok()?;
    // Text with more information than the document (a repeated key, a byte order mark) is compared as text.
    let same = |on_one_line| text_of(&read.value, on_one_line) == bytes;
    (same(false) || same(true)).then_some(read.value)
}

fn is_document(path: &FilePath) -> bool {
    path.as_str() == Some(ROOT) || mirror_of(path).is_some()
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
    if is_document(path) {
        let both = (document(ours, path), document(theirs, path));
        let (Some(mut our), Some(mut their)) = both else {
            return false;
        };
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

/// Removes size and hash from entries where both are correct.
fn mark_right(tree: &Tree, metadata: &mut Value) {
    for entry in file_entry::all(metadata) {
        if is_right(tree, entry) == Some(true) {
            entry["size"] = Value::Null;
            entry["sha256"] = Value::Null;
        }
    }
}

/// Removes size and hash from unchanged entries, unless they are no longer correct.
fn leave_out_kept(before: &mut Value, after: &mut Value) {
    let before: Vec<_> = file_entry::all(before).collect();
    for entry in file_entry::all(after) {
        if before.contains(&entry) {
            entry["size"] = Value::Null;
            entry["sha256"] = Value::Null;
        }
    }
}

/// Whether an entry matches its file; `None` if the file does not exist.
fn is_right(tree: &Tree, entry: &Value) -> Option<bool> {
    let bytes = tree.file(entry["path"].as_str()?)?;
    let (size, sha256) = digest::of_bytes(bytes);
    Some(entry["size"] == json!(size) && entry["sha256"] == json!(sha256))
}

/// Files whose entry does not match.
fn untrue_entries(tree: &Tree) -> BTreeSet<String> {
    let mut metadata = document(tree, &ROOT.into()).unwrap_or_default();
    let entries = file_entry::all(&mut metadata);
    let untrue = entries.filter(|entry| is_right(tree, entry) == Some(false));
    untrue.filter_map(|entry| entry["path"].as_str().map(str::to_owned)).collect()
}

impl Work {
    fn push(&mut self, file: &FilePath, action: Action) {
        let change = Change { file: file.clone(), action };
        let done = change.apply(&mut self.tree);
        done.unwrap_or_else(|error| panic!("a change that does not fit: {error}"));
        self.changes.push(change);
    }

    /// Documents that remain documents, except for entries that `rehash` updates.
    fn patch_documents(&mut self, old: &Tree, new: &Tree) {
        let paths: Vec<FilePath> = self.tree.nodes.keys().cloned().collect();
        for path in paths.iter().filter(|path| is_document(path)) {
            if self.tree.nodes.get(path) == new.nodes.get(path) {
                continue;
            }
            let both = (document(&self.tree, path), document(new, path));
            let (Some(mut before), Some(mut after)) = both else {
                continue;
            };
            if path.as_str() == Some(ROOT) {
                leave_out_kept(&mut before.clone(), &mut after);
                mark_right(old, &mut before);
                mark_right(new, &mut after);
                // Files that are new in `urdd.json` get an entry to be filled in.
                for entry in file_entry::all(&mut after) {
                    let known =
                        file_entry::all(&mut before).any(|old| old["path"] == entry["path"]);
                    if entry["size"].is_null() && !known {
                        entry["size"] = json!(0);
                        entry["sha256"] = json!("");
                    }
                }
            }
            let patch = patch(&before, &after);
            if patch.0.is_empty() {
                continue;
            }
            let mirror = mirror_of(path).filter(|mirror| self.tree.nodes.contains_key(mirror));
            let stays = |mirror: FilePath| new.nodes.get(&mirror) == self.tree.nodes.get(&mirror);
            match mirror.is_some_and(stays) {
                true => self.push(path, Action::PatchAlone(patch)),
                false => self.push(path, Action::Patch(patch)),
            }
        }
    }

    /// Files that exist before and after.
    fn change_files(&mut self, new: &Tree) {
        for (path, node) in &new.nodes {
            if same(&self.tree, new, path) || path.as_str() == Some(ROOT) && self.root_follows(new)
            {
                continue;
            }
            if let (Some(Node::File(before)), Node::File(after)) =
                (self.tree.nodes.get(path).cloned(), node)
            {
                match repetition(after) {
                    Some((short, repeat)) => {
                        if *before != *short {
                            self.push(path, edit(&before, &short));
                        }
                        self.push(path, repeat);
                    }
                    None => self.push(path, edit(&before, after)),
                }
            }
        }
    }

    /// Whether `rehash` makes the remaining changes in `urdd.json`.
    fn root_follows(&self, new: &Tree) -> bool {
        document(new, &ROOT.into()).is_some()
    }

    fn add_and_delete(&mut self, new: &Tree) {
        for (path, node) in &new.nodes {
            if let (None, Node::File(bytes)) = (self.tree.nodes.get(path), node) {
                let alike = |(_, other): &(&FilePath, &Node)| *other == node;
                match (self.tree.nodes.iter().find(alike), repetition(bytes)) {
                    (Some((other, _)), _) if bytes.len() >= SHORT => {
                        let other = other.clone();
                        self.push(path, Action::CopyOf(other));
                    }
                    (_, Some((short, repeat))) => {
                        self.push(path, written(&short));
                        self.push(path, repeat);
                    }
                    _ => self.push(path, written(bytes)),
                }
            }
        }
        for (path, node) in &new.nodes {
            if self.tree.nodes.get(path) != Some(node) {
                match node {
                    Node::Link(target) => self.push(path, Action::LinkTo(target.clone())),
                    Node::Folder => self.push(path, Action::Folder(Yes)),
                    Node::File(_) => {}
                }
            }
        }
        while let Some(path) =
            self.tree.nodes.keys().find(|path| !new.nodes.contains_key(path)).cloned()
        {
            let folder = widest_folder_without(&path, new);
            self.push(&folder, Action::Delete(Yes));
        }
    }
}

/// The highest folder above `path`, or `path` itself, in which `new` has nothing.
fn widest_folder_without(path: &FilePath, new: &Tree) -> FilePath {
    let text = path.as_str().expect("bases have names in UTF-8");
    let ends = text.match_indices('/').map(|(end, _)| end);
    let folders = ends.map(|end| FilePath::from(&text[..end]));
    let empty = |folder: &FilePath| !new.nodes.keys().any(|other| other.is_within(folder));
    let named = |folder: &FilePath| folder.as_str() != Some("..");
    let found = folders.filter(named).find(empty);
    found.unwrap_or_else(|| path.clone())
}

fn written(bytes: &[u8]) -> Action {
    match std::str::from_utf8(bytes) {
        Ok(text) => Action::Write(text.to_owned()),
        Err(_) => Action::WriteBase64(STANDARD.encode(bytes)),
    }
}

/// Fewer bytes than this are not written as a repetition, and longer texts are not looked for.
const LONG: usize = 16_384;
const MAX_PERIOD: usize = 32;

/// A long run of one text in a file: the file with that text once, and the action that repeats it.
fn repetition(bytes: &[u8]) -> Option<(Vec<u8>, Action)> {
    if bytes.len() < LONG {
        return None;
    }
    (1..=MAX_PERIOD).find_map(|period| {
        let mut start = 0;
        let mut at = 0;
        while at + period < bytes.len() {
            if bytes[at] == bytes[at + period] {
                at += 1;
                continue;
            }
            if at - start >= LONG {
                break;
            }
            at += 1;
            start = at;
        }
        if at - start < LONG {
            return None;
        }
        let times = (at + period - start) / period;
        let text = std::str::from_utf8(&bytes[start..start + period]).ok()?;
        let rest = &bytes[start + times * period..];
        let short = [&bytes[..start + period], rest].concat();
        let text = text.to_owned();
        Some((short, Action::Repeat { at: start, text, times }))
    })
}

#[test]
fn repetitions_are_short_and_right() {
    let large = format!("<a>{}</a>", "<b/>".repeat(100_000)).into_bytes();
    let (short, repeat) = repetition(&large).expect("a run");
    assert!(short.len() < 20, "{}", short.len());
    let mut tree = Tree::default();
    tree.put("file".into(), short);
    let change = Change { file: "file".into(), action: repeat };
    change.apply(&mut tree).expect("it fits");
    assert_eq!(tree.file("file"), Some(large.as_slice()));
    assert!(change.apply(&mut Tree::default()).is_err(), "no file");
}

/// The shortest change that gives a file other bytes.
fn edit(before: &[u8], after: &[u8]) -> Action {
    let mut ways = vec![written(after)];
    if before.starts_with(after) {
        ways.push(Action::CutTo(after.len()));
    }
    let start = before.iter().zip(after).take_while(|(a, b)| a == b).count();
    let rest = before[start..].iter().rev().zip(after[start..].iter().rev());
    let end = rest.take_while(|(a, b)| a == b).count();
    let (gone, come) = (start..before.len() - end, start..after.len() - end);
    ways.push(Action::Splice {
        at: start,
        remove: gone.len(),
        insert_base64: STANDARD.encode(&after[come.clone()]),
    });
    if let (Ok(before), Ok(after)) = (std::str::from_utf8(before), std::str::from_utf8(after)) {
        ways.extend(replacement(before, after, start, end));
        for (from, by) in [("\n", "\r\n"), ("\n", " \t\r\n")] {
            if before.replace(from, by) == after {
                let (from, by) = (from.to_owned(), by.to_owned());
                ways.push(Action::ReplaceAll { from, by });
            }
        }
    }
    // Text is easier to read than bytes, even where it is longer.
    let cost = |way: &Action| {
        let length = serde_json::to_string(way).map_or(usize::MAX, |text| text.len());
        match way {
            Action::Splice { .. } => length + 300,
            _ => length,
        }
    };
    ways.into_iter().min_by_key(cost).expect("a way")
}

/// The text between an equal start and end, extended to the left until its first occurrence is this one.
fn replacement(before: &str, after: &str, start: usize, end: usize) -> Option<Action> {
    let (mut start, mut end) = (start, end);
    while !before.is_char_boundary(start) {
        start -= 1;
    }
    while !before.is_char_boundary(before.len() - end) {
        end -= 1;
    }
    // From the beginning of the word, for readability.
    let word = before[..start].rfind(|c: char| c.is_whitespace());
    start = word.map_or(start, |space| space + 1).max(start.saturating_sub(60));
    loop {
        let from = before.get(start..before.len() - end);
        let first = |from: &str| !from.is_empty() && before.find(from) == Some(start);
        if let Some(from) = from.filter(|from| first(from)) {
            let by = after.get(start..after.len() - end)?.to_owned();
            return Some(Action::Replace { from: from.to_owned(), by });
        }
        match start {
            0 if end == 0 => return None,
            0 => end -= 1,
            _ => start -= 1,
        }
    }
}
