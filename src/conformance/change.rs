//! Changes of a URDD: what a case does to its base.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use json_patch::Patch;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::tree::{FilePath, Node, Tree};
use urdd_directory::canonical;
use urdd_directory::json;

/// A change of one file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// Which, relative to the URDD's root.
    pub file: FilePath,
    /// What is done.
    #[serde(flatten)]
    pub action: Action,
}

/// What is done to a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// RFC 6902 operations on a JSON document. `module.yaml` beside it follows.
    Patch(Patch),
    /// The same, but `module.yaml` beside it stays as it is.
    PatchAlone(Patch),
    /// The first place where `from` stands gets `by` instead.
    Replace {
        /// What is there.
        from: String,
        /// What comes there.
        by: String,
    },
    /// The same, wherever `from` stands.
    ReplaceAll {
        /// What is there.
        from: String,
        /// What comes there.
        by: String,
    },
    /// Bytes are exchanged.
    Splice {
        /// From which byte on.
        at: usize,
        /// How many go.
        remove: usize,
        /// What comes there, in base64.
        insert_base64: String,
    },
    /// The file gets this text.
    Write(String),
    /// The file gets these bytes, in base64.
    WriteBase64(String),
    /// Of the file only so many bytes stay.
    CutTo(usize),
    /// The file, or the folder with all that is in it, goes.
    Delete(Yes),
    /// The file, or the folder, becomes one like another.
    CopyOf(FilePath),
    /// It becomes a symbolic link that leads there.
    LinkTo(FilePath),
    /// It becomes an empty folder.
    Folder(Yes),
}

/// `true`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Yes;

impl Serialize for Yes {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        true.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Yes {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match bool::deserialize(deserializer)? {
            true => Ok(Yes),
            false => Err(serde::de::Error::custom("only `true` has a meaning here")),
        }
    }
}

/// Why a change cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum ChangeError {
    /// No such file.
    #[error("{0}: there is no such file to change")]
    Missing(FilePath),
    /// Not a JSON document.
    #[error("{0}: this is not JSON, and cannot be patched")]
    NotJson(FilePath),
    /// The patch does not fit.
    #[error("{file}: {error}")]
    Patch {
        /// Which file.
        file: FilePath,
        /// Why.
        error: json_patch::PatchError,
    },
    /// The text to be replaced is not there.
    #[error("{file}: the text {from:?} is not there")]
    NotThere {
        /// Which file.
        file: FilePath,
        /// The text.
        from: String,
    },
    /// The bytes to be exchanged are not there.
    #[error("{0}: the file is too short for this change")]
    Outside(FilePath),
    /// Not base64.
    #[error("{file}: not base64: {error}")]
    Base64 {
        /// Which file.
        file: FilePath,
        /// Why.
        error: base64::DecodeError,
    },
}

impl Change {
    /// Makes the change.
    ///
    /// # Errors
    /// Where it does not fit what is there.
    pub fn apply(&self, tree: &mut Tree) -> Result<(), ChangeError> {
        let file = || self.file.clone();
        match &self.action {
            Action::Patch(patch) => self.patch(patch, true, tree),
            Action::PatchAlone(patch) => self.patch(patch, false, tree),
            Action::Replace { from, by } => self.replace(from, by, 1, tree),
            Action::ReplaceAll { from, by } => self.replace(from, by, usize::MAX, tree),
            Action::Splice {
                at,
                remove,
                insert_base64,
            } => {
                let mut bytes = self.bytes(tree)?.to_vec();
                let insert = self.base64(insert_base64)?;
                let outside = || ChangeError::Outside(file());
                let end = at.checked_add(*remove).filter(|end| *end <= bytes.len());
                bytes.splice(*at..end.ok_or_else(outside)?, insert);
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
        STANDARD.decode(text).map_err(|error| ChangeError::Base64 {
            file: self.file.clone(),
            error,
        })
    }

    fn replace(
        &self,
        from: &str,
        by: &str,
        most: usize,
        tree: &mut Tree,
    ) -> Result<(), ChangeError> {
        let not_there = || ChangeError::NotThere {
            file: self.file.clone(),
            from: from.to_owned(),
        };
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
        // Legacy documents stand on one line: one that does stays so.
        let on_one_line = !bytes.contains(&b'\n');
        json_patch::patch(&mut document, patch).map_err(|error| ChangeError::Patch {
            file: self.file.clone(),
            error,
        })?;
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

/// The text of a document: the canonical emission, or all of it on one line.
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
