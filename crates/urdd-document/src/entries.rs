//! The modules that `urdd.json` lists, side by side with those that are there.

use std::collections::{HashMap, HashSet};

use super::module::{Module, is_extension};
use super::urdd::Urdd;
use urdd_directory::path;
use urdd_directory::root::{EntryKind, ReadError};
use urdd_format::registry::{self, ModuleKind, Profile};
use urdd_format::root_metadata::ModuleEntry;

/// The files that every module has, by 2.4, and that an extension has by 11.1.
pub const MODULE_FILES: [&str; 3] = ["VERSION", "module.json", "module.yaml"];

/// An entry of `modules` of `urdd.json`.
pub struct Entry<'a> {
    /// Its place in `modules`.
    pub index: usize,
    /// What it says.
    pub entry: &'a ModuleEntry,
    /// The module of this specification that it means, by its name or else by its path.
    pub kind: Option<ModuleKind>,
    /// The folder that is there under its path.
    pub module: Option<&'a Module>,
}

impl Entry<'_> {
    /// Pointer to one of its keys.
    pub fn pointer(&self, key: &str) -> String {
        format!("/modules/{}/{key}", self.index)
    }

    /// Whether one of the files in its list has a fault of its own, of which another rule tells:
    /// a path that may not be, that leads to nothing, or that is there twice.
    pub fn has_faulty_file(&self, urdd: &Urdd) -> bool {
        let mut seen = HashSet::new();
        self.entry.files.iter().any(|file| {
            path::check(&file.path).is_err()
                || !seen.insert(file.path.as_str())
                || look(urdd, &file.path).is_err()
        })
    }

    /// Whether a path lies in its folder.
    pub fn holds(&self, path: &str) -> bool {
        path.strip_prefix(self.entry.path.as_str())
            .is_some_and(|rest| rest.starts_with('/'))
    }
}

/// Every entry, in order; none where the root metadata is of no use.
pub fn all(urdd: &Urdd) -> Vec<Entry<'_>> {
    let Some(metadata) = urdd.metadata() else {
        return Vec::new();
    };
    let modules: HashMap<&str, &Module> = urdd
        .modules()
        .iter()
        .map(|module| (module.folder.as_str(), module))
        .collect();
    let by_name: HashMap<&str, ModuleKind> =
        version_1_kinds().map(|kind| (kind.name(), kind)).collect();
    let by_folder: HashMap<&str, ModuleKind> = version_1_kinds()
        .map(|kind| (kind.folder(), kind))
        .collect();
    metadata
        .modules
        .iter()
        .enumerate()
        .map(|(index, entry)| Entry {
            index,
            entry,
            kind: by_name
                .get(entry.name.as_str())
                .or_else(|| by_folder.get(entry.path.as_str()))
                .copied(),
            module: modules.get(entry.path.as_str()).copied(),
        })
        .collect()
}

/// The modules of this specification.
pub fn version_1_kinds() -> impl Iterator<Item = ModuleKind> {
    ModuleKind::ALL
        .iter()
        .copied()
        .filter(|kind| has_version_1(*kind))
}

fn has_version_1(kind: ModuleKind) -> bool {
    registry::MODULES
        .iter()
        .any(|spec| spec.kind == kind && spec.profile == Profile::V1)
}

/// Whether a module folder is of this specification (in a legacy URDD: or of those before it), or
/// an extension. Of others, DIR022 tells, and no other rule does.
pub fn is_known(urdd: &Urdd, module: &Module) -> bool {
    match module.kind {
        Some(kind) => urdd.profile() == Profile::Legacy || has_version_1(kind),
        None => is_extension(&module.folder),
    }
}

/// The module folders of which rules speak.
pub fn known_modules(urdd: &Urdd) -> impl Iterator<Item = &Module> {
    urdd.modules()
        .iter()
        .filter(|module| is_known(urdd, module))
}

/// Whether there is a regular file at a path, and how long it is. What cannot be opened is judged
/// by its place alone.
///
/// # Errors
/// Why there is none.
pub fn look(urdd: &Urdd, path: &str) -> Result<u64, ReadError> {
    path::check(path)?;
    let listing = urdd.listing();
    if let Some(entry) = listing.get(path) {
        return match entry.kind {
            EntryKind::File => Ok(entry.size),
            EntryKind::LinkOut => Err(ReadError::LeavesRoot),
            EntryKind::Folder | EntryKind::Other => Err(ReadError::NotAFile),
            EntryKind::Link => urdd.root().open_file(path).map(|(_, size)| size),
        };
    }
    // Not listed, but below a link to a folder, or beyond where the listing stopped, it may be there.
    let mut above = std::iter::successors(Some(path), |path| {
        path.rsplit_once('/').map(|(parent, _)| parent)
    });
    let nearest = above.find_map(|folder| listing.get(folder));
    let below_link =
        nearest.is_some_and(|entry| matches!(entry.kind, EntryKind::Link | EntryKind::LinkOut));
    if below_link || listing.cut || !listing.unreadable.is_empty() {
        return urdd.root().open_file(path).map(|(_, size)| size);
    }
    Err(ReadError::Missing)
}
