//! The changes that a case applies to its base.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use json_patch::Patch;
use serde::Deserialize;
use serde_json::{Map, Value};

use crate::tree::{FilePath, Node, Tree};
use urdd_directory::canonical;
use urdd_directory::json;

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
    /// As `Patch`, but without updating `module.yaml`.
    PatchAlone(Patch),
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
        /// Bytes to insert, in base64.
        insert_base64: String,
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
    /// Writes these bytes, in base64, to the file.
    WriteBase64(String),
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

/// Why a change cannot be applied.
#[derive(Debug, thiserror::Error)]
pub enum ChangeError {
    /// The file does not exist.
    #[error("{0}: there is no such file to change")]
    Missing(FilePath),
    /// Not a JSON document.
    #[error("{0}: this is not JSON, and cannot be patched")]
    NotJson(FilePath),
    /// The patch does not apply.
    #[error("{file}: {error}")]
    Patch {
        /// The file.
        file: FilePath,
        /// Reason.
        error: json_patch::PatchError,
    },
    /// The text to replace does not occur.
    #[error("{file}: the text {from:?} was not found")]
    NotThere {
        /// The file.
        file: FilePath,
        /// The text.
        from: String,
    },
    /// The bytes to replace are beyond the end of the file.
    #[error("{0}: the file is too short for this change")]
    Outside(FilePath),
    /// Not base64.
    #[error("{file}: not base64: {error}")]
    Base64 {
        /// The file.
        file: FilePath,
        /// Reason.
        error: base64::DecodeError,
    },
}

impl Change {
    /// Applies the change.
    ///
    /// # Errors
    /// If it does not fit the tree.
    pub fn apply(&self, tree: &mut Tree) -> Result<(), ChangeError> {
        let file = || self.file.clone();
        match &self.action {
            Action::Patch(patch) => self.patch(patch, true, tree),
            Action::PatchAlone(patch) => self.patch(patch, false, tree),
            Action::Replace { from, by } => self.replace(from, by, 1, tree),
            Action::ReplaceAll { from, by } => self.replace(from, by, usize::MAX, tree),
            Action::Splice { at, remove, insert_base64 } => {
                let mut bytes = self.bytes(tree)?.to_vec();
                let insert = self.base64(insert_base64)?;
                let outside = || ChangeError::Outside(file());
                let end = at.checked_add(*remove).filter(|end| *end <= bytes.len());
                bytes.splice(*at..end.ok_or_else(outside)?, insert);
                tree.put(file(), bytes);
                Ok(())
            }
            Action::Repeat { at, text, times } => {
                let mut bytes = self.bytes(tree)?.to_vec();
                let end = at.checked_add(text.len());
                let there = end.and_then(|end| bytes.get(*at..end));
                let (true, Some(end)) = (there == Some(text.as_bytes()), end) else {
                    return Err(ChangeError::NotThere { file: file(), from: text.clone() });
                };
                if text.len().saturating_mul(*times) > MAX_REPEATED {
                    return Err(ChangeError::Outside(file()));
                }
                bytes.splice(*at..end, text.repeat(*times).into_bytes());
                tree.put(file(), bytes);
                Ok(())
            }
            Action::Write(text) => {
                tree.put(file(), text.as_bytes());
                Ok(())
            }
            Action::WriteBase64(text) => {
                let bytes = self.base64(text)?;
                tree.put(file(), bytes);
                Ok(())
            }
            Action::CutTo(length) => {
                let bytes = self.bytes(tree)?;
                let bytes = bytes.get(..*length).unwrap_or(bytes).to_vec();
                tree.put(file(), bytes);
                Ok(())
            }
            Action::Delete(Yes) => self.delete(tree),
            Action::CopyOf(other) => {
                let found: Vec<(FilePath, Node)> = tree
                    .nodes
                    .iter()
                    .filter(|(path, _)| path.is_within(other))
                    .map(|(path, node)| (path.moved(other, &self.file), node.clone()))
                    .collect();
                if found.is_empty() {
                    return Err(ChangeError::Missing(other.clone()));
                }
                tree.nodes.extend(found);
                Ok(())
            }
            Action::LinkTo(target) => {
                self.clear(tree);
                tree.nodes.insert(file(), Node::Link(target.clone()));
                Ok(())
            }
            Action::Folder(Yes) => {
                self.clear(tree);
                tree.nodes.insert(file(), Node::Folder);
                Ok(())
            }
        }
    }

    fn bytes<'a>(&self, tree: &'a Tree) -> Result<&'a [u8], ChangeError> {
        match tree.nodes.get(&self.file) {
            Some(Node::File(bytes)) => Ok(bytes),
            _ => Err(ChangeError::Missing(self.file.clone())),
        }
    }

    fn base64(&self, text: &str) -> Result<Vec<u8>, ChangeError> {
        STANDARD
            .decode(text)
            .map_err(|error| ChangeError::Base64 { file: self.file.clone(), error })
    }

    fn replace(
        &self,
        from: &str,
        by: &str,
        most: usize,
        tree: &mut Tree,
    ) -> Result<(), ChangeError> {
        let not_there = || ChangeError::NotThere { file: self.file.clone(), from: from.to_owned() };
        let text = std::str::from_utf8(self.bytes(tree)?).map_err(|_| not_there())?;
        if !text.contains(from) {
            return Err(not_there());
        }
        let text = text.replacen(from, by, most);
        tree.put(self.file.clone(), text.into_bytes());
        Ok(())
    }

    fn clear(&self, tree: &mut Tree) {
        tree.nodes.retain(|path, _| !path.is_within(&self.file));
    }

    fn delete(&self, tree: &mut Tree) -> Result<(), ChangeError> {
        let before = tree.nodes.len();
        self.clear(tree);
        if tree.nodes.len() == before {
            return Err(ChangeError::Missing(self.file.clone()));
        }
        Ok(())
    }

    fn patch(&self, patch: &Patch, mirrored: bool, tree: &mut Tree) -> Result<(), ChangeError> {
        let bytes = self.bytes(tree)?;
        let not_json = |_| ChangeError::NotJson(self.file.clone());
        let mut document = json::read(bytes).map_err(not_json)?.value;
        // Keep a one-line document on one line, as legacy documents are.
        let on_one_line = !bytes.contains(&b'\n');
        json_patch::patch(&mut document, patch)
            .map_err(|error| ChangeError::Patch { file: self.file.clone(), error })?;
        tree.put(self.file.clone(), text_of(&document, on_one_line));
        if mirrored
            && let Some(mirror) = mirror_of(&self.file)
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
