//! Matches the modules that `urdd.json` lists with the module folders.

use std::collections::{HashMap, HashSet};

use super::module::{Module, is_extension};
use super::urdd::Urdd;
use urdd_directory::path;
use urdd_directory::root::{EntryKind, ReadError};
use urdd_format::registry::{self, ModuleKind, Profile};
use urdd_format::root_metadata::ModuleEntry;

/// The files of every module (2.4) and every extension (11.1).
pub const MODULE_FILES: [&str; 3] = ["VERSION", "module.json", "module.yaml"];

/// An entry of `modules` of `urdd.json`.
pub struct Entry<'a> {
    /// Its index in `modules`.
    pub index: usize,
    /// Its content.
    pub entry: &'a ModuleEntry,
    /// The module of this specification with its name, or else with its path.
    pub kind: Option<ModuleKind>,
    /// The module folder at its path, if it exists.
    pub module: Option<&'a Module>,
}

impl Entry<'_> {
    /// JSON Pointer to one of its keys.
    pub fn pointer(&self, key: &str) -> String {
        format!("/modules/{}/{key}", self.index)
    }

    /// Whether a listed file has a fault that another rule reports: an invalid path, a missing file, or a duplicate.
    pub fn has_faulty_file(&self, urdd: &Urdd) -> bool {
        let mut seen = HashSet::new();
        self.entry.files.iter().any(|file| {
            path::check(&file.path).is_err()
                || !seen.insert(file.path.as_str())
                || look(urdd, &file.path).is_err()
        })
    }

    /// Whether a path is inside its folder.
    pub fn holds(&self, path: &str) -> bool {
        path.strip_prefix(self.entry.path.as_str()).is_some_and(|rest| rest.starts_with('/'))
    }
}

/// Every entry, in order. Empty if the root metadata is unusable.
pub fn all(urdd: &Urdd) -> Vec<Entry<'_>> {
    let Some(metadata) = urdd.metadata() else {
        return Vec::new();
    };
    let modules: HashMap<&str, &Module> =
        urdd.modules().map(|module| (module.folder.as_str(), module)).collect();
    let by_name: HashMap<&str, ModuleKind> =
        version_1_kinds().map(|kind| (kind.name(), kind)).collect();
    let by_folder: HashMap<&str, ModuleKind> =
        version_1_kinds().map(|kind| (kind.folder(), kind)).collect();
    let entries = metadata.modules.iter().enumerate().map(|(index, entry)| {
        let (name, path) = (entry.name.as_str(), entry.path.as_str());
        let kind = by_name.get(name).or_else(|| by_folder.get(path)).copied();
        Entry { index, entry, kind, module: modules.get(path).copied() }
    });
    entries.collect()
}

/// The modules of this specification.
pub fn version_1_kinds() -> impl Iterator<Item = ModuleKind> {
    ModuleKind::ALL.iter().copied().filter(|kind| has_version_1(*kind))
}

fn has_version_1(kind: ModuleKind) -> bool {
    registry::modules().iter().any(|spec| spec.kind == kind && spec.profile == Profile::V1)
}

/// Whether a module folder is a module of this specification (in a legacy URDD: or of earlier versions), or an
/// extension. Only DIR022 reports other folders.
pub fn is_known(urdd: &Urdd, module: &Module) -> bool {
    match module.kind {
        Some(kind) => urdd.profile() == Profile::Legacy || has_version_1(kind),
        None => is_extension(&module.folder),
    }
}

/// The module folders that the rules check.
pub fn known_modules(urdd: &Urdd) -> impl Iterator<Item = &Module> {
    urdd.modules().filter(|module| is_known(urdd, module))
}

/// The size of the regular file at a path. Does not check whether a listed file can be opened.
///
/// # Errors
/// Why there is no such file.
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
    // An unlisted file may still exist below a folder link, or beyond the point where the listing stopped.
    let mut above =
        std::iter::successors(Some(path), |path| path.rsplit_once('/').map(|(parent, _)| parent));
    let nearest = above.find_map(|folder| listing.get(folder));
    let below_link =
        nearest.is_some_and(|entry| matches!(entry.kind, EntryKind::Link | EntryKind::LinkOut));
    if below_link || listing.cut || !listing.unreadable.is_empty() {
        return urdd.root().open_file(path).map(|(_, size)| size);
    }
    Err(ReadError::Missing)
}
