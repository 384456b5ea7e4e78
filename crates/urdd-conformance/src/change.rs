//! The changes that a case applies to its base, and what follows from them: mirrors, and the sizes and hashes in
//! `urdd.json`.

use std::collections::BTreeSet;

use json_patch::Patch;
use serde::Deserialize;
use serde_json::{Map, Value};

use crate::tree::{Base64, FilePath, Node, Tree};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::{canonical, file_entry, json};

/// Largest text that a repetition makes, bytes.
const MAX_REPEATED: usize = 1 << 27;

/// A change of one file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Written")]
pub struct Change {
    /// The file, relative to the URDD's root.
    pub file: FilePath,
    /// The action.
    pub action: Action,
}

/// A change in JSON: the action is a key beside `file`.
#[derive(Deserialize)]
struct Written {
    file: FilePath,
    #[serde(flatten)]
    action: Map<String, Value>,
}

impl TryFrom<Written> for Change {
    type Error = String;

    fn try_from(Written { file, action }: Written) -> Result<Change, String> {
        let [key] = action.keys().collect::<Vec<_>>()[..] else {
            let keys = action.keys().cloned().collect::<Vec<_>>().join(", ");
            return Err(format!(
                "a change of {file} needs one action beside `file`, and has {{{keys}}}"
            ));
        };
        let reason = format!("{key} of {file}");
        let action = serde_json::from_value(Value::Object(action));
        Ok(Change { action: action.map_err(|error| format!("{reason}: {error}"))?, file })
    }
}

/// An action on a file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// RFC 6902 operations on a JSON document. Updates `module.yaml` beside it.
    Patch(Patch),
    /// Replaces the first occurrence of `from` by `by`.
    Replace {
        /// Text to replace.
        from: String,
        /// New text.
        by: String,
    },
    /// Replaces all occurrences of `from` by `by`.
    ReplaceAll {
        /// Text to replace.
        from: String,
        /// New text.
        by: String,
    },
    /// Replaces bytes.
    Splice {
        /// Offset of the first byte.
        at: usize,
        /// Number of bytes to remove.
        remove: usize,
        /// Bytes to insert.
        insert_base64: Base64,
    },
    /// Repeats a text, so that a large file is a small case.
    Repeat {
        /// Offset of its first byte.
        at: usize,
        /// The text, which is there once.
        text: String,
        /// How often it is there afterwards.
        times: usize,
    },
    /// Writes this text to the file.
    Write(String),
    /// Writes these bytes to the file.
    WriteBase64(Base64),
    /// Truncates the file to this many bytes.
    CutTo(usize),
    /// Deletes the file, or the folder with its contents.
    Delete(Yes),
    /// Replaces the file or folder by a copy of another.
    CopyOf(FilePath),
    /// Replaces it by a symbolic link to this path.
    LinkTo(FilePath),
    /// Replaces it by an empty folder.
    Folder(Yes),
}

/// `true`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Yes;

impl<'de> Deserialize<'de> for Yes {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match bool::deserialize(deserializer)? {
            true => Ok(Yes),
            false => Err(serde::de::Error::custom("only `true` has a meaning here")),
        }
    }
}

/// How a change does not fit its file.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum Misfit {
    #[error("there is no such file to change")]
    Missing,
    #[error("there is no {0} to copy")]
    NoOriginal(FilePath),
    #[error("this is not JSON, and cannot be patched")]
    NotJson,
    #[error(transparent)]
    Patch(#[from] json_patch::PatchError),
    #[error("the text {0:?} was not found")]
    NotThere(String),
    #[error("the file is too short or too long for this change")]
    Outside,
}

impl Change {
    /// Applies the change.
    ///
    /// # Errors
    /// If it does not fit the tree.
    pub fn apply(&self, tree: &mut Tree) -> Result<(), Misfit> {
        let bytes = match &self.action {
            Action::Patch(patch) => return self.patch(patch, tree),
            Action::Delete(Yes) => return self.clear(tree),
            Action::CopyOf(original) => return self.copy(original, tree),
            Action::LinkTo(target) => return self.become_node(Node::Link(target.clone()), tree),
            Action::Folder(Yes) => return self.become_node(Node::Folder, tree),
            Action::Write(text) => text.as_bytes().to_vec(),
            Action::WriteBase64(Base64(bytes)) => bytes.clone(),
            Action::Replace { from, by } => self.replaced(from, by, 1, tree)?,
            Action::ReplaceAll { from, by } => self.replaced(from, by, usize::MAX, tree)?,
            Action::Splice { at, remove, insert_base64: Base64(insert) } => {
                let mut bytes = self.bytes(tree)?.to_vec();
                let end = at.checked_add(*remove).filter(|end| *end <= bytes.len());
                let end = end.ok_or(Misfit::Outside)?;
                bytes.splice(*at..end, insert.iter().copied());
                bytes
            }
            Action::Repeat { at, text, times } => {
                let mut bytes = self.bytes(tree)?.to_vec();
                let not_there = || Misfit::NotThere(text.clone());
                let end = at.checked_add(text.len()).ok_or_else(not_there)?;
                if bytes.get(*at..end) != Some(text.as_bytes()) {
                    return Err(not_there());
                }
                if text.len().saturating_mul(*times) > MAX_REPEATED {
                    return Err(Misfit::Outside);
                }
                bytes.splice(*at..end, text.repeat(*times).into_bytes());
                bytes
            }
            Action::CutTo(length) => {
                let bytes = self.bytes(tree)?;
                bytes.get(..*length).unwrap_or(bytes).to_vec()
            }
        };
        tree.put(self.file.clone(), bytes);
        Ok(())
    }

    fn bytes<'a>(&self, tree: &'a Tree) -> Result<&'a [u8], Misfit> {
        match tree.nodes.get(&self.file) {
            Some(Node::File(bytes)) => Ok(bytes),
            _ => Err(Misfit::Missing),
        }
    }

    fn replaced(&self, from: &str, by: &str, most: usize, tree: &Tree) -> Result<Vec<u8>, Misfit> {
        let text = std::str::from_utf8(self.bytes(tree)?).ok().filter(|text| text.contains(from));
        let text = text.ok_or_else(|| Misfit::NotThere(from.to_owned()))?;
        Ok(text.replacen(from, by, most).into_bytes())
    }

    fn clear(&self, tree: &mut Tree) -> Result<(), Misfit> {
        let before = tree.nodes.len();
        tree.nodes.retain(|path, _| !path.is_within(&self.file));
        if tree.nodes.len() == before { Err(Misfit::Missing) } else { Ok(()) }
    }

    fn become_node(&self, node: Node, tree: &mut Tree) -> Result<(), Misfit> {
        tree.nodes.retain(|path, _| !path.is_within(&self.file));
        tree.nodes.insert(self.file.clone(), node);
        Ok(())
    }

    fn copy(&self, original: &FilePath, tree: &mut Tree) -> Result<(), Misfit> {
        let nodes = tree.nodes.iter().filter(|(path, _)| path.is_within(original));
        let copies = nodes.map(|(path, node)| (path.moved(original, &self.file), node.clone()));
        let copies: Vec<(FilePath, Node)> = copies.collect();
        if copies.is_empty() {
            return Err(Misfit::NoOriginal(original.clone()));
        }
        tree.nodes.extend(copies);
        Ok(())
    }

    fn patch(&self, patch: &Patch, tree: &mut Tree) -> Result<(), Misfit> {
        let bytes = self.bytes(tree)?;
        let mut document = json::read(bytes).map_err(|_| Misfit::NotJson)?.value;
        // Keep a one-line document on one line, as legacy documents are.
        let on_one_line = !bytes.contains(&b'\n');
        json_patch::patch(&mut document, patch)?;
        tree.put(self.file.clone(), text_of(&document, on_one_line));
        if let Some(mirror) = mirror_of(&self.file)
            && let Some(Node::File(_)) = tree.nodes.get(&mirror)
        {
            tree.put(mirror, canonical::yaml_string(&document).into_bytes());
        }
        Ok(())
    }
}

/// The text of a document: canonical, or on one line.
pub fn text_of(document: &Value, on_one_line: bool) -> Vec<u8> {
    match on_one_line {
        true => document.to_string().into_bytes(),
        false => canonical::json_string(document).into_bytes(),
    }
}

/// The path of `module.yaml` beside a `module.json`.
pub fn mirror_of(document: &FilePath) -> Option<FilePath> {
    let folder = document.as_str()?.strip_suffix("module.json")?;
    Some(FilePath::from(format!("{folder}module.yaml").as_str()))
}

/// Adds a canonical `module.yaml` to every `module.json` without one.
pub fn add_mirrors(tree: &mut Tree) {
    let documents: Vec<FilePath> = tree.nodes.keys().cloned().collect();
    for path in documents {
        let Some(mirror) = mirror_of(&path) else { continue };
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
    let Some(Ok(document)) = tree.file(ROOT_METADATA).map(json::read) else { return };
    let mut metadata = document.value;
    let listed = |path: &str| tree.file(path).filter(|_| !kept.contains(path));
    if file_entry::reseal(&mut metadata, listed) {
        let text = canonical::json_string(&metadata);
        tree.put(ROOT_METADATA.into(), text.into_bytes());
    }
}
