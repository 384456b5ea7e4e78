//! Writes files, and returns their entries for `urdd.json`.

use std::fs::{self, File};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::document::Document;
use super::staging::StagingError;
use super::take;
use urdd_format::hexadecimal::hexadecimal;
use urdd_format::index::Count;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::{self, FileEntry};

/// Writes the files of a URDD into a folder.
#[derive(Debug, Clone)]
pub struct Writer {
    root: PathBuf,
}

impl Writer {
    /// A writer into `root`, which must exist.
    pub fn new(root: &Path) -> Self {
        let root = root.to_owned();
        Self { root }
    }

    /// Writes a file. `path` is relative to the root, with forward slashes.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn file(&self, path: &str, bytes: &[u8]) -> Result<FileEntry, StagingError> {
        let mut file = self.create(path)?;
        self.check(path, file.write_all(bytes))?;
        Ok(entry(path, bytes.len() as u64, Sha256::digest(bytes).as_slice()))
    }

    /// Copies an external file.
    ///
    /// # Errors
    /// If it cannot be read, or its copy cannot be written.
    pub fn copy(&self, from: &Path, path: &str) -> Result<FileEntry, StagingError> {
        let unread = |error| StagingError::Read { path: from.to_owned(), error };
        let mut source = File::open(from).map_err(unread)?;
        let mut file = self.create(path)?;
        let (mut hasher, mut size) = (Sha256::new(), 0);
        let mut piece = vec![0; 1 << 16];
        loop {
            let read = source.read(&mut piece).map_err(unread)?;
            if read == 0 {
                return Ok(entry(path, size, hasher.finalize().as_slice()));
            }
            size += read as u64;
            hasher.update(&piece[..read]);
            self.check(path, file.write_all(&piece[..read]))?;
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
            self.document(&format!("{folder}/module.json"), document, Document::json)?,
            self.document(&format!("{folder}/module.yaml"), document, Document::yaml)?,
        ])
    }

    /// Writes a document in its canonical form, without holding the text in memory.
    fn document(
        &self,
        path: &str,
        document: &Document,
        emit: fn(&Document, &mut Sink) -> std::fmt::Result,
    ) -> Result<FileEntry, StagingError> {
        let mut sink = Sink {
            file: self.create(path)?,
            waiting: String::with_capacity(2 * WRITTEN_AT_ONCE),
            hasher: Sha256::new(),
            size: 0,
            error: None,
        };
        let emitted = emit(document, &mut sink).and_then(|()| sink.flush());
        let result = match (sink.error.take(), emitted) {
            // The sink stores the I/O error.
            (Some(error), _) => Err(error),
            (None, Err(error)) => Err(std::io::Error::other(error)),
            (None, Ok(())) => Ok(()),
        };
        self.check(path, result)?;
        Ok(entry(path, sink.size, sink.hasher.finalize().as_slice()))
    }

    fn create(&self, path: &str) -> Result<File, StagingError> {
        let place = self.place(path)?;
        File::create(&place).map_err(|error| StagingError::Write { path: place, error })
    }

    /// The path on disk. Creates its parent folder.
    fn place(&self, path: &str) -> Result<PathBuf, StagingError> {
        let place = self.root.join(path);
        if let Some(folder) = place.parent() {
            fs::create_dir_all(folder)
                .map_err(|error| StagingError::Write { path: folder.to_owned(), error })?;
        }
        Ok(place)
    }

    fn check(&self, path: &str, result: std::io::Result<()>) -> Result<(), StagingError> {
        result.map_err(|error| StagingError::Write { path: self.root.join(path), error })
    }
}

/// Number of bytes hashed and written at once.
const WRITTEN_AT_ONCE: usize = 1 << 16;

/// A buffered, hashing text sink for a file.
pub struct Sink {
    file: File,
    waiting: String,
    hasher: Sha256,
    size: u64,
    error: Option<std::io::Error>,
}

impl Sink {
    fn flush(&mut self) -> std::fmt::Result {
        let bytes = self.waiting.as_bytes();
        self.hasher.update(bytes);
        self.size += bytes.len() as u64;
        let written = self.file.write_all(bytes);
        self.waiting.clear();
        written.map_err(|error| {
            self.error = Some(error);
            std::fmt::Error
        })
    }
}

impl std::fmt::Write for Sink {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.waiting.push_str(text);
        match self.waiting.len() < WRITTEN_AT_ONCE {
            true => Ok(()),
            false => self.flush(),
        }
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
