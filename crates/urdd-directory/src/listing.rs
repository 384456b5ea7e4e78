//! What a storage of files answers: the list of its files, and why one cannot be read.

use std::io;

use thiserror::Error;

use crate::path::PathFault;

/// Kind of a folder entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EntryKind {
    /// A regular file, or a link to one inside the root.
    File,
    /// A folder.
    Folder,
    /// A symbolic link that leads out of the root.
    LinkOut,
    /// A dangling symbolic link, or one to a folder inside the root (not followed).
    Link,
    /// Neither a file nor a folder.
    Other,
}

/// A file or folder below the root.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// Path relative to the root, with forward slashes. Invalid UTF-8 is replaced.
    pub path: String,
    /// Its kind.
    pub kind: EntryKind,
    /// Size in bytes; for files only.
    pub size: u64,
    /// Whether the name is valid UTF-8.
    pub utf8: bool,
}

/// All entries below a root.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Listing {
    /// Entries, sorted by path.
    pub entries: Vec<Entry>,
    /// Folders that could not be listed, with the reason.
    pub unreadable: Vec<(String, ReadError)>,
    /// Whether a limit cut the listing: [`crate::limits::MAX_FILES`] or [`crate::limits::MAX_FOLDER_DEPTH`].
    pub cut: bool,
}

impl Listing {
    /// The entry at a path.
    pub fn get(&self, path: &str) -> Option<&Entry> {
        self.place(path).map(|place| &self.entries[place])
    }

    /// The place of a path in the list.
    pub(crate) fn place(&self, path: &str) -> Option<usize> {
        self.entries.binary_search_by(|entry| entry.path.as_str().cmp(path)).ok()
    }

    /// Whether a path is a folder.
    pub fn has_folder(&self, path: &str) -> bool {
        self.get(path).is_some_and(|entry| entry.kind == EntryKind::Folder)
    }

    /// Whether a path is a regular file.
    pub fn has_file(&self, path: &str) -> bool {
        self.get(path).is_some_and(|entry| entry.kind == EntryKind::File)
    }

    /// The entries below a folder, at any depth.
    pub fn below<'a>(&'a self, folder: &'a str) -> impl Iterator<Item = &'a Entry> {
        let is_below = move |entry: &&Entry| {
            entry.path.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/'))
        };
        // In path order, all entries below a folder are adjacent.
        let prefix = format!("{folder}/");
        let first = self.entries.partition_point(|entry| entry.path.as_str() < prefix.as_str());
        self.entries.iter().skip(first).take_while(is_below)
    }
}

/// Why a file could not be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum ReadError {
    #[error("there is no such file")]
    Missing,
    /// The path violates SPEC 2.8.
    #[error("{0}")]
    Path(#[from] PathFault),
    #[error("it changed on disk since it was opened: open it again")]
    Changed,
    #[error("a symbolic link leads out of the URDD's root")]
    LeavesRoot,
    #[error("it is not a regular file")]
    NotAFile,
    #[error("it is neither a folder nor a zip archive")]
    NotAUrdd,
    #[error("it is {size} bytes long; the limit is {limit}")]
    TooLarge { size: u64, limit: u64 },
    #[error("it is longer than {} MiB", .limit >> 20)]
    TooLong { limit: u64 },
    #[error("{0}")]
    Archive(#[from] ArchiveFault),
    /// A folder too deep to be searched.
    #[error("it is deeper than {limit} folders; give its path to examine it")]
    TooDeep { limit: usize },
    #[error("it cannot be read: {0}")]
    Io(String),
}

impl From<io::Error> for ReadError {
    fn from(error: io::Error) -> Self {
        if let Some(own) = error.get_ref().and_then(|inner| inner.downcast_ref::<ReadError>()) {
            return own.clone();
        }
        match error.kind() {
            io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => ReadError::Missing,
            io::ErrorKind::PermissionDenied => ReadError::Io("permission denied".to_owned()),
            _ => ReadError::Io(error.to_string()),
        }
    }
}

/// Why a zip archive cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum ArchiveFault {
    #[error("it is not a complete zip archive ({reason}); pack it again")]
    Broken { reason: String },
    #[error(
        "it is a zip64 archive, made for more than 65,535 entries or 4 GiB; pack it without zip64, or unpack it and give the folder"
    )]
    Zip64,
    #[error("it states {stated} entries, but lists {listed}; pack it again")]
    Count { stated: usize, listed: usize },
    /// Other programs may extract different files.
    #[error(
        "it contains bytes that belong to no entry or to two entries, as if two archives were in one file; pack it again"
    )]
    OtherBytes,
    #[error(
        "its files have {size} bytes in total; the limit for an archive of its size is {limit}; unpack it, and give the folder"
    )]
    Inflates { size: u64, limit: u64 },
    #[error("its entry `{}` {fault}", start(name).escape_debug())]
    Entry { name: String, fault: EntryFault },
    #[error(
        "it contains no URDD: neither its root nor a top-level folder contains urdd.json or a module folder such as urdf_module"
    )]
    NoUrdd,
    #[error(
        "it contains several URDDs ({} and {}); unpack it, and give the folder, or pack each one separately",
        first.escape_debug(), second.escape_debug()
    )]
    ManyUrdds { first: String, second: String },
}

/// The first 200 characters of a name: it may have 65,535 bytes.
fn start(name: &str) -> &str {
    const LONGEST: usize = 200;
    let end = name.char_indices().nth(LONGEST).map_or(name.len(), |(at, _)| at);
    &name[..end]
}

/// Why an entry of a zip archive cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum EntryFault {
    #[error("has a name that is not a path inside the archive")]
    Path,
    #[error(
        "has a name of {length} bytes; the limit is {limit}, and {part} between two slashes; rename it"
    )]
    LongName { length: usize, limit: usize, part: usize },
    #[error("is described differently in its own header and in the archive's list; pack it again")]
    Header,
    #[error("occurs twice")]
    Duplicate,
    #[error("is encrypted; pack it without a password")]
    Encrypted,
    #[error("is compressed by method {method} of zip; pack it with deflate")]
    Method { method: u16 },
    #[error("is {size} bytes long; the limit is {limit}")]
    TooLarge { size: u64, limit: u64 },
    #[error("is damaged ({reason}); pack it again")]
    Damaged { reason: String },
}
