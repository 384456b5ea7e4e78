//! Writes files, and returns their entries for `urdd.json`. A document is in memory as a whole, or serialised row by row to
//! save memory.
#![expect(clippy::disallowed_methods, reason = "this is where files are written")]

use std::fmt;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::Serialize;
use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::source::Memory;
use crate::staging::StagingError;
use crate::unfinished::writing;
use crate::{canonical, take};
use urdd_format::hexadecimal::hexadecimal;
use urdd_format::index::Count;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::{self, FileEntry};

/// A document that can be written.
pub enum Document {
    /// Any document.
    Whole(Value),
    /// An object that contains long lists. Its member names need no quotes in YAML.
    Object(Vec<(&'static str, Member)>),
}

/// A member of a [`Document::Object`].
pub enum Member {
    /// Any value.
    Value(Value),
    /// A long list.
    Rows(Rows),
    /// An object that contains long lists, with at least one member.
    Object(Vec<(&'static str, Member)>),
}

/// A list of lists and objects, each serialised when it is written.
pub struct Rows {
    length: usize,
    row: Box<dyn Fn(usize) -> Result<Value, serde_json::Error> + Send>,
}

impl Rows {
    /// Rows of values that serialise to lists or objects.
    pub fn new<T: Serialize + Send + 'static>(rows: Vec<T>) -> Self {
        Rows { length: rows.len(), row: Box::new(move |idx| serde_json::to_value(&rows[idx])) }
    }

    /// Rows that serialise to lists or objects and are part of a shared value.
    pub fn of<M: Send + Sync + 'static, T: Serialize>(
        whole: &Arc<M>,
        rows: impl Fn(&M) -> &[T] + Send + 'static,
    ) -> Self {
        let whole = Arc::clone(whole);
        Rows {
            length: rows(&whole).len(),
            row: Box::new(move |idx| serde_json::to_value(&rows(&whole)[idx])),
        }
    }

    fn row(&self, idx: usize) -> Result<Value, fmt::Error> {
        (self.row)(idx).map_err(|_| fmt::Error)
    }
}

impl Member {
    /// A long list, or null for `None`.
    pub fn rows_or_null(rows: Option<Rows>) -> Self {
        rows.map_or(Member::Value(Value::Null), Member::Rows)
    }
}

impl Document {
    /// Writes its canonical JSON.
    ///
    /// # Errors
    /// Those of `out`, or if a row cannot be serialised.
    pub fn json(&self, out: &mut impl fmt::Write) -> fmt::Result {
        match self {
            Document::Whole(value) => return canonical::json(value, out),
            Document::Object(members) => json_object(members, 0, out)?,
        }
        out.write_char('\n')
    }

    /// Writes its canonical YAML.
    ///
    /// # Errors
    /// Those of `out`, or if a row cannot be serialised.
    pub fn yaml(&self, out: &mut impl fmt::Write) -> fmt::Result {
        match self {
            Document::Whole(value) => canonical::yaml(value, out),
            Document::Object(members) => yaml_members(members, 0, out),
        }
    }
}

fn json_object<W: fmt::Write>(
    members: &[(&str, Member)],
    indent: usize,
    out: &mut W,
) -> fmt::Result {
    let inner = indent + 2;
    canonical::json_block(['{', '}'], members, indent, out, |(name, member), out| {
        write!(out, "\"{name}\": ")?;
        match member {
            Member::Value(value) => canonical::json_node(value, inner, out),
            Member::Object(members) => json_object(members, inner, out),
            Member::Rows(rows) if rows.length == 0 => out.write_str("[]"),
            Member::Rows(rows) => {
                canonical::json_block(['[', ']'], 0..rows.length, inner, out, |idx, out| {
                    canonical::json_node(&rows.row(idx)?, inner + 2, out)
                })
            }
        }
    })
}

fn yaml_members(
    members: &[(&str, Member)],
    indent: usize,
    out: &mut impl fmt::Write,
) -> fmt::Result {
    for (name, member) in members {
        write!(out, "{:indent$}{name}:", "")?;
        match member {
            Member::Value(value) => canonical::yaml_rest(value, indent + 2, out)?,
            Member::Object(members) => {
                out.write_char('\n')?;
                yaml_members(members, indent + 2, out)?;
            }
            Member::Rows(rows) if rows.length == 0 => out.write_str(" []\n")?,
            Member::Rows(rows) => {
                out.write_char('\n')?;
                for idx in 0..rows.length {
                    canonical::yaml_element(&rows.row(idx)?, indent + 2, out)?;
                }
            }
        }
    }
    Ok(())
}

/// Writes the files of a URDD into a folder, or into memory.
#[derive(Debug, Clone)]
pub struct Writer {
    root: PathBuf,
    memory: Option<Memory>,
}

impl Writer {
    /// A writer into the folder `root`, which must exist.
    pub fn new(root: &Path) -> Self {
        Self { root: root.to_owned(), memory: None }
    }

    /// A writer into memory.
    pub fn in_memory(files: Memory) -> Self {
        Self { root: PathBuf::new(), memory: Some(files) }
    }

    /// Writes a file. `path` is relative to the root, with forward slashes.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn file(&self, path: &str, bytes: &[u8]) -> Result<FileEntry, StagingError> {
        self.written(path, |out| out.write_all(bytes))?;
        Ok(entry(path, bytes.len() as u64, Sha256::digest(bytes).as_slice()))
    }

    /// Copies an external file.
    ///
    /// # Errors
    /// If it cannot be read, or its copy cannot be written.
    pub fn copy(&self, from: &Path, path: &str) -> Result<FileEntry, StagingError> {
        let unread = StagingError::read(from);
        let mut source = File::open(from).map_err(&unread)?;
        let (mut hasher, mut size) = (Sha256::new(), 0);
        let mut piece = vec![0; 1 << 16];
        let mut failure = None;
        self.written(path, |out| {
            loop {
                match source.read(&mut piece) {
                    Ok(0) => return Ok(()),
                    Ok(read) => {
                        size += read as u64;
                        hasher.update(&piece[..read]);
                        out.write_all(&piece[..read])?;
                    }
                    Err(error) => {
                        failure = Some(error);
                        return Ok(());
                    }
                }
            }
        })?;
        match failure {
            Some(error) => Err(unread(error)),
            None => Ok(entry(path, size, hasher.finalize().as_slice())),
        }
    }

    /// Takes over a file from the URDD to be replaced: a hard link where the file system supports it, else a copy.
    ///
    /// # Errors
    /// If it cannot be read or written.
    pub fn keep(&self, from: &Path, path: &str) -> Result<(), StagingError> {
        take::file(from, &self.place(path)?)
    }

    /// Writes `VERSION`, `module.json` and `module.yaml` of a module.
    ///
    /// # Errors
    /// If one cannot be written.
    pub fn module(
        &self,
        kind: ModuleKind,
        version: &str,
        document: &Document,
    ) -> Result<Vec<FileEntry>, StagingError> {
        let folder = kind.folder();
        Ok(vec![
            self.file(&format!("{folder}/VERSION"), format!("{version}\n").as_bytes())?,
            self.document(&format!("{folder}/module.json"), document, |of, out| of.json(out))?,
            self.document(&format!("{folder}/module.yaml"), document, |of, out| of.yaml(out))?,
        ])
    }

    /// Writes a document in its canonical form, without holding the text in memory.
    fn document(
        &self,
        path: &str,
        document: &Document,
        emit: fn(&Document, &mut Sink) -> fmt::Result,
    ) -> Result<FileEntry, StagingError> {
        let (mut hasher, mut size) = (Sha256::new(), 0);
        self.written(path, |out| {
            let waiting = String::with_capacity(2 * WRITTEN_AT_ONCE);
            let mut sink = Sink { out, waiting, hasher: &mut hasher, size: &mut size, error: None };
            let emitted = emit(document, &mut sink).and_then(|()| sink.flush());
            match (sink.error.take(), emitted) {
                // The sink stores the I/O error.
                (Some(error), _) => Err(error),
                (None, Err(error)) => Err(io::Error::other(error)),
                (None, Ok(())) => Ok(()),
            }
        })?;
        Ok(entry(path, size, hasher.finalize().as_slice()))
    }

    fn written(
        &self,
        path: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), StagingError> {
        let failed = |error| StagingError::Write { path: self.root.join(path), error };
        if let Some(files) = &self.memory {
            let mut bytes = Vec::new();
            write(&mut bytes).map_err(failed)?;
            files.put(path, bytes);
            return Ok(());
        }
        let begun = writing();
        let place = self.place(path)?;
        // Never through a link, nor into a file of another folder that this one is a name of.
        let _ = fs::remove_file(&place);
        let mut file = File::create_new(place).map_err(failed)?;
        drop(begun);
        write(&mut file).map_err(failed)
    }

    /// Writes a file to the disk, and waits until it is there.
    pub(crate) fn synced(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let begun = writing();
        let place = self.root.join(path);
        place.parent().map_or(Ok(()), fs::create_dir_all)?;
        let mut file = File::create(place)?;
        drop(begun);
        file.write_all(bytes)?;
        file.sync_all()
    }

    /// The path on disk. Creates its parent folder, which may not be behind a link.
    fn place(&self, path: &str) -> Result<PathBuf, StagingError> {
        let place = self.root.join(path);
        if let Some(folder) = place.parent() {
            let below = folder.ancestors().take_while(|folder| *folder != self.root);
            if let Some(link) = below.into_iter().find(|folder| folder.is_symlink()) {
                return Err(StagingError::Link { path: link.to_owned() });
            }
            fs::create_dir_all(folder).map_err(StagingError::write(folder))?;
        }
        Ok(place)
    }
}

/// Number of bytes hashed and written at once.
const WRITTEN_AT_ONCE: usize = 1 << 16;

/// A buffered, hashing text sink for a file.
struct Sink<'a> {
    out: &'a mut dyn Write,
    waiting: String,
    hasher: &'a mut Sha256,
    size: &'a mut u64,
    error: Option<io::Error>,
}

impl Sink<'_> {
    fn flush(&mut self) -> fmt::Result {
        let bytes = self.waiting.as_bytes();
        self.hasher.update(bytes);
        *self.size += bytes.len() as u64;
        let written = self.out.write_all(bytes);
        self.waiting.clear();
        written.map_err(|error| {
            self.error = Some(error);
            fmt::Error
        })
    }
}

impl fmt::Write for Sink<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.waiting.push_str(text);
        if self.waiting.len() < WRITTEN_AT_ONCE { Ok(()) } else { self.flush() }
    }
}

fn entry(path: &str, size: u64, hash: &[u8]) -> FileEntry {
    FileEntry {
        path: path.to_owned(),
        // SPEC limits sizes to 32 bits; the validator reports larger files.
        size: Count(u32::try_from(size).unwrap_or(u32::MAX)),
        sha256: sha256(hash),
    }
}

/// A hash in the form of `urdd.json`.
pub fn sha256(hash: &[u8]) -> root_metadata::Sha256 {
    root_metadata::Sha256::new(hexadecimal(hash)).unwrap_or_else(|| unreachable!("64 digits"))
}
