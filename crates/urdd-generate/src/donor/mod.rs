//! Donors: the URDDs from which a new URDD takes over what need not be built again, or must not be lost. A donor is the
//! URDD that is replaced, or the URDD of a part of a combined robot.
//!
//! | what | from | when |
//! |---|---|---|
//! | a whole module: [`Donor::kept`] | the replaced URDD | its inputs are the same, and its files are unchanged |
//! | meshes and shapes of a link: [`links`] | parts | the link's geometry and the settings are the same |
//! | the user's edits of skips and named configurations: [`edits`] | the replaced URDD | always; edits that cannot be read are an error |
//! | all other files: [`carry_over`] | the replaced URDD | always; a file in the way of the new URDD is an error |
//!
//! Modules and meshes are taken over only from URDDs of this version of the program, and only if their bytes match
//! `urdd.json`.
//!
//! One cache cannot serve for both. A module is kept whole, also where it is about pairs of links, which no link alone
//! determines; a part's links are in another robot under other indices, so they are found by content. Equal meshes
//! within a run (`for_each_content`) have no files yet by which to find them.
//!
//! All other files are those that the replaced URDD does not list and that do not belong to a module: a README, a `.git`
//! folder, extension modules and notes in a module's folder survive a new run.

pub(super) mod edits;
pub(super) mod links;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::metadata::{self, FOUND_KEY, GENERATOR, INPUTS_KEY, MODULE_VERSION};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;
use urdd_directory::staging::StagingError;
use urdd_directory::take::take;
use urdd_directory::{file_entry, json, outputs};
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::{FileEntry, ModuleEntry, RootMetadata};

/// A URDD whose root metadata is readable.
#[derive(Debug)]
pub(super) struct Donor {
    pub root: Root,
    pub metadata: RootMetadata,
    /// The root metadata as a value, including keys that extend the format.
    pub value: Value,
}

impl Donor {
    /// Reads the root metadata of a URDD; `None` if it is missing or does not fit the format.
    pub fn open(root: Root) -> Option<Self> {
        let bytes = root.read(ROOT_METADATA, MAX_DOCUMENT_BYTES).ok()?;
        let value = json::read(&bytes).ok()?.value;
        let metadata = RootMetadata::deserialize(&value).ok()?;
        Some(Donor { root, metadata, value })
    }

    pub fn is_ours(&self) -> bool {
        let generator = self.metadata.generator.as_ref();
        generator.is_some_and(|generator| generator.name == GENERATOR)
    }

    /// The folder and the files of a module that was built from the same inputs, if they are all unchanged.
    pub fn kept(&self, kind: ModuleKind, inputs: &str) -> Option<(&Path, &[FileEntry])> {
        let module = self.same(kind, inputs)?;
        let intact = module.files.iter().all(|file| self.is_intact(file));
        intact.then_some((self.root.folder()?, module.files.as_slice()))
    }

    /// The document of a module that this program would build from the same inputs now. `text` gives the module's input
    /// besides other modules.
    fn same_document<T: DeserializeOwned>(
        &self,
        kind: ModuleKind,
        text: &dyn Fn(ModuleKind) -> Option<String>,
    ) -> Option<T> {
        self.same(kind, &metadata::inputs(kind, &text(kind)?, self.metadata.modules.iter()))?;
        self.current_document(kind)
    }

    /// The document of a module of the version that this program writes.
    fn current_document<T: DeserializeOwned>(&self, kind: ModuleKind) -> Option<T> {
        self.current(kind)?;
        document(&self.root, kind).ok()
    }

    /// The entry of a module that was built from these inputs.
    fn same(&self, kind: ModuleKind, inputs: &str) -> Option<&ModuleEntry> {
        let (module, value) = self.current(kind)?;
        (value[INPUTS_KEY].as_str() == Some(inputs)).then_some(module)
    }

    /// The entry of a module with the version and the folder that this program gives it, also as a value.
    fn current(&self, kind: ModuleKind) -> Option<(&ModuleEntry, &Value)> {
        let values = self.value["modules"].as_array()?;
        let mut modules = self.metadata.modules.iter().zip(values);
        let (module, value) = modules.find(|(module, _)| module.name == kind.name())?;
        let is_current = module.version.as_str() == MODULE_VERSION && module.path == kind.folder();
        is_current.then_some((module, value))
    }

    /// Whether a file matches its entry in the metadata.
    pub fn is_intact(&self, file: &FileEntry) -> bool {
        file_entry::of(&self.root, &file.path).is_ok_and(|(size, sha256)| {
            size == u64::from(file.size.0) && sha256 == file.sha256.as_str()
        })
    }
}

/// The document of a module of an intact URDD by this program, or the reason why it cannot be read.
pub(super) fn document<T: DeserializeOwned>(root: &Root, kind: ModuleKind) -> Result<T, String> {
    let path = format!("{}/module.json", kind.folder());
    let bytes = root.read(&path, MAX_DOCUMENT_BYTES).map_err(|error| error.to_string())?;
    // From the text, without a tree of values: some documents grow with the square of the number of links.
    let text = std::str::from_utf8(&bytes).map_err(|error| error.to_string())?;
    serde_json::from_str(text).map_err(|error| error.to_string())
}

const MODULE_FILES: [&str; 3] = ["VERSION", "module.json", "module.yaml"];

/// Links or copies the files to keep from `folder` into `root`.
/// Fails if something cannot be read or written, or a user's file has a name that the URDD needs.
pub(crate) fn carry_over(
    folder: &Path,
    replaced: Option<&Donor>,
    root: &Path,
) -> Result<(), StagingError> {
    merge(folder, root, "", &replaced.map(listed).unwrap_or_default())
}

/// The modules that were not made, but whose folders have files that were carried over.
pub(crate) fn left_behind(root: &Path, made: &[ModuleKind]) -> Vec<ModuleKind> {
    let kinds = ModuleKind::ALL.iter().copied();
    kinds.filter(|kind| !made.contains(kind) && root.join(kind.folder()).exists()).collect()
}

/// Every path that the replaced URDD lists, except those of extension modules.
fn listed(replaced: &Donor) -> BTreeSet<String> {
    let source = &replaced.value["source"];
    let sources = [&source["Urdf"]["path"], &source[FOUND_KEY]["path"]];
    let sources = sources.iter().filter_map(|path| path.as_str());
    let modules = replaced.metadata.modules.iter();
    let files = modules.filter(|module| is_known(&module.name)).flat_map(|module| &module.files);
    files.map(|file| file.path.clone()).chain(sources.map(str::to_owned)).collect()
}

fn is_known(module: &str) -> bool {
    ModuleKind::ALL.iter().any(|kind| kind.name() == module)
}

/// Carries over the folder at `path`, relative to both roots. Folders of modules are merged entry by entry.
fn merge(
    folder: &Path,
    root: &Path,
    path: &str,
    listed: &BTreeSet<String>,
) -> Result<(), StagingError> {
    let from = folder.join(path);
    let unread = |error| StagingError::Read { path: from.clone(), error };
    for entry in fs::read_dir(&from).map_err(unread)? {
        let entry = entry.map_err(unread)?;
        let name = entry.file_name();
        let inside = match (path, name.to_string_lossy()) {
            ("", name) => name.into_owned(),
            (path, name) => format!("{path}/{name}"),
        };
        let from = entry.path();
        let to = root.join(path).join(&name);
        let kind = entry.file_type().map_err(unread)?;
        if kind.is_dir() {
            let there = fs::symlink_metadata(&to);
            let is_free = there.as_ref().map_or(inside != ROOT_METADATA, |there| there.is_dir());
            if is_free && is_of_modules(&inside) {
                merge(folder, root, &inside, listed)?;
            } else if is_free && there.is_err() {
                make_above(&to)?;
                take(&from, &to)?;
            } else {
                return Err(StagingError::InTheWay { path: from });
            }
        } else if is_ours(&inside, listed) {
            // A pipe, a device or a socket.
            if !kind.is_file() && !kind.is_symlink() {
                return Err(StagingError::InTheWay { path: from });
            }
        } else {
            make_above(&to)?;
            match fs::symlink_metadata(&to) {
                Err(_) => take(&from, &to)?,
                Ok(_) if is_same(&from, &to) => {}
                Ok(_) => return Err(StagingError::InTheWay { path: from }),
            }
        }
    }
    Ok(())
}

fn make_above(path: &Path) -> Result<(), StagingError> {
    let Some(above) = path.parent() else { return Ok(()) };
    fs::create_dir_all(above).map_err(|error| StagingError::Write { path: above.to_owned(), error })
}

/// Whether a folder is a module's, or contains one, or is inside one.
fn is_of_modules(path: &str) -> bool {
    let begins = |long: &str, short: &str| {
        long.strip_prefix(short).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    };
    let mut folders = ModuleKind::ALL.iter().map(|kind| kind.folder());
    folders.any(|folder| begins(path, folder) || begins(folder, path))
}

/// Whether a file belongs to the replaced URDD: `urdd.json`, a listed file, or a module's own file.
fn is_ours(path: &str, listed: &BTreeSet<String>) -> bool {
    let of_a_module = || {
        let (folder, file) = path.rsplit_once('/')?;
        let is_module = ModuleKind::ALL.iter().any(|kind| kind.folder() == folder);
        Some(is_module && MODULE_FILES.contains(&file))
    };
    path == ROOT_METADATA || listed.contains(path) || of_a_module().unwrap_or(false)
}

fn is_same(one: &Path, other: &Path) -> bool {
    fs::read(other).is_ok_and(|bytes| !outputs::is_other(one, &bytes))
}

/// The entries of extension modules that were carried over, with updated sizes and hashes.
pub(crate) fn extensions(replaced: Option<&Donor>, root: &Path) -> Vec<Value> {
    let modules = replaced.and_then(|replaced| replaced.value["modules"].as_array());
    let Ok(root) = Root::open(root) else { return Vec::new() };
    let mut entries = Vec::new();
    for module in modules.into_iter().flatten() {
        if module["name"].as_str().is_none_or(is_known) {
            continue;
        }
        let mut module = module.clone();
        for entry in file_entry::of_module(&mut module) {
            let found = file_entry::path(entry).and_then(|path| file_entry::of(&root, path).ok());
            if let Some((size, sha256)) = found {
                file_entry::update(entry, size, &sha256);
            }
        }
        entries.push(module);
    }
    entries
}
