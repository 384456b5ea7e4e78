//! The files and folders below the root of a URDD.

use super::read_error::ReadError;

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
    /// Whether a limit cut the listing: [`super::limits::MAX_FILES`] or [`super::limits::MAX_FOLDER_DEPTH`].
    pub cut: bool,
}

impl Listing {
    /// The entry at a path.
    pub fn get(&self, path: &str) -> Option<&Entry> {
        self.place(path).map(|place| &self.entries[place])
    }

    /// The place of a path in the list.
    pub(super) fn place(&self, path: &str) -> Option<usize> {
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
