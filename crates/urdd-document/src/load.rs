//! Reads a URDD into memory: all of it once for all rules, or modules when they are first asked for, which are kept.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::fmt;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use rayon::prelude::*;
use serde::Deserialize;

use crate::module::{
    CarriedUrdf, JsonFile, MetadataFile, Mirror, Module, NoUrdf, VersionFile, is_extension,
    read_urdf,
};
use crate::schema_check::{self, SchemaViolation};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::{MAX_DOCUMENT_BYTES, MAX_VERSION_BYTES};
use urdd_directory::position::TextFaults;
use urdd_directory::root::{EntryKind, Listing, ReadError, Root};
use urdd_directory::yaml;
use urdd_format::registry::{self, ModuleDocument, ModuleKind, ModuleSpec, Profile};
use urdd_format::root_metadata::{RootMetadata, Version};

/// A URDD in memory.
pub struct Loaded {
    /// Its root folder.
    pub root: Root,
    /// Its files and folders.
    pub listing: Arc<Listing>,
    /// `urdd.json`.
    pub metadata: Arc<MetadataFile>,
    /// Its modules in the order of the specification, then others by folder.
    pub modules: Vec<Arc<Module>>,
    /// The source URDF, or why it is not available.
    pub urdf: Result<CarriedUrdf, NoUrdf>,
    /// Its format family.
    pub profile: Profile,
}

impl Loaded {
    /// Reads a URDD from any root.
    ///
    /// # Errors
    /// If the root itself cannot be listed.
    pub fn read(root: Root) -> Result<Self, ReadError> {
        let listing = root.list()?;
        let metadata = read_metadata(&root);
        let modules = read_modules(&root, &metadata, module_folders(&listing), Some(&listing));
        let urdf = read_urdf(&root, &listing, &metadata);
        Ok(Self { urdf, ..Self::of(root, listing.into(), metadata.into(), modules) })
    }

    /// These modules, without URDF.
    fn of(
        root: Root,
        listing: Arc<Listing>,
        metadata: Arc<MetadataFile>,
        modules: Vec<Arc<Module>>,
    ) -> Self {
        let profile = profile(&metadata, &modules);
        Loaded { root, listing, metadata, modules, urdf: Err(NoUrdf::NotRead), profile }
    }
}

/// Reads modules, and their mirrors if a listing is given.
fn read_modules(
    root: &Root,
    metadata: &MetadataFile,
    folders: Vec<(String, Option<ModuleKind>)>,
    mirrors: Option<&Listing>,
) -> Vec<Arc<Module>> {
    let mut listed: HashMap<&str, &Version> = HashMap::new();
    for entry in metadata.metadata.iter().flat_map(|m| &m.modules) {
        listed.entry(&entry.path).or_insert(&entry.version);
    }
    let read = |(folder, kind): (String, Option<ModuleKind>)| {
        let listed = listed.get(folder.as_str()).copied();
        Arc::new(read_module(root, folder, kind, listed, mirrors))
    };
    folders.into_par_iter().map(read).collect()
}

/// The format family of a URDD.
fn profile(metadata: &MetadataFile, modules: &[Arc<Module>]) -> Profile {
    let any = |profile: Profile| {
        let mut specs = modules.iter().filter_map(|module| module.spec);
        specs.any(|spec| spec.profile == profile)
    };
    let has_metadata = !matches!(metadata.json, JsonFile::Missing);
    if has_metadata || any(Profile::V1) || !any(Profile::Legacy) {
        Profile::V1
    } else {
        Profile::Legacy
    }
}

fn read_metadata(root: &Root) -> MetadataFile {
    let json = JsonFile::of(root.read(ROOT_METADATA, MAX_DOCUMENT_BYTES));
    let mut file = MetadataFile { json, violations: Vec::new(), metadata: None };
    if let JsonFile::Read(document) = &file.json {
        (file.metadata, file.violations) = metadata_of(&document.value);
    }
    file
}

/// The root metadata in a document, or its schema violations.
pub fn metadata_of(document: &serde_json::Value) -> (Option<RootMetadata>, Vec<SchemaViolation>) {
    let error = match RootMetadata::deserialize(document) {
        Ok(metadata) => return (Some(metadata), Vec::new()),
        Err(error) => error,
    };
    let schema = schemars::schema_for!(RootMetadata);
    schema_check::read_newer(&schema, document, newer_minor(document), &error, |value| {
        RootMetadata::deserialize(value).ok()
    })
}

/// Whether root metadata states a later version of the specification with the same major number.
fn newer_minor(metadata: &serde_json::Value) -> bool {
    let version = metadata["urdd_version"].as_str().map(semver::Version::parse);
    match (version, semver::Version::parse(registry::SPEC_VERSION)) {
        (Some(Ok(version)), Ok(known)) => version.major == known.major && version > known,
        _ => false,
    }
}

fn known_folders(kinds: &[ModuleKind], listing: &Listing) -> Vec<(String, Option<ModuleKind>)> {
    let kinds = kinds.iter().filter(|kind| listing.has_folder(kind.folder()));
    kinds.map(|kind| (kind.folder().to_owned(), Some(*kind))).collect()
}

/// Every module folder: first those of the registry, then other folders that look like modules.
fn module_folders(listing: &Listing) -> Vec<(String, Option<ModuleKind>)> {
    let mut folders = known_folders(ModuleKind::ALL, listing);
    let known = folders.len();
    let mut inside: HashSet<String> = folders.iter().map(|(folder, _)| folder.clone()).collect();
    // Sorted by path, so that a folder comes before its contents.
    for entry in listing.entries.iter().filter(|entry| entry.kind == EntryKind::Folder) {
        let path = &entry.path;
        let in_a_module = path.rsplit_once('/').is_some_and(|(parent, _)| inside.contains(parent));
        if in_a_module || inside.contains(path) {
            inside.insert(path.clone());
            continue;
        }
        let like_a_module = path.ends_with("_module")
            && (listing.has_file(&format!("{path}/VERSION"))
                || listing.has_file(&format!("{path}/module.json")));
        if like_a_module || is_extension(path) {
            inside.insert(path.clone());
            folders.push((path.clone(), None));
        }
    }
    folders[known..].sort();
    folders
}

/// Reads a module, and its mirror if a listing is given.
fn read_module(
    root: &Root,
    folder: String,
    kind: Option<ModuleKind>,
    listed: Option<&Version>,
    mirrors: Option<&Listing>,
) -> Module {
    let file = |name: &str| format!("{folder}/{name}");
    let version_file = match root.read(&file("VERSION"), MAX_VERSION_BYTES) {
        Err(ReadError::Missing) => VersionFile::Missing,
        Err(error) => VersionFile::Unreadable(error),
        Ok(bytes) => {
            let text = String::from_utf8_lossy(&bytes);
            VersionFile::Text(text.strip_suffix('\n').unwrap_or(&text).to_owned())
        }
    };
    let stated = match &version_file {
        VersionFile::Text(text) => Version::new(text.as_str()),
        _ => None,
    };
    let version = choose_version(kind, [stated.as_ref(), listed]);
    let (spec, newer) = match kind {
        Some(kind) => find_spec(kind, version.as_deref()),
        None => (None, false),
    };
    let yaml = mirrors.map(|listing| read_yaml(root, listing, &file("module.yaml")));
    let mut bytes = root.read(&file("module.json"), MAX_DOCUMENT_BYTES);
    let taken = match (spec, &mut bytes) {
        (Some(spec), Ok(bytes)) => take(spec, bytes, yaml.as_ref()),
        _ => None,
    };
    let (document, json) = match taken {
        Some((document, text)) => (Some(document), JsonFile::Taken(text)),
        None => (None, JsonFile::of(bytes)),
    };
    let mut module = Module {
        folder,
        kind,
        version_file,
        version,
        spec,
        newer,
        json,
        mirror: Mirror::NotCompared,
        violations: Vec::new(),
        document,
        is_draft: false,
    };
    if module.document.is_some() {
        if yaml.is_some() {
            module.mirror = Mirror::Compared(TextFaults::default());
        }
        return module;
    }
    if let (Some(spec), Some(document)) = (module.spec, module.json.document()) {
        let (read, violations) = schema_check::read(spec, &document.value, newer);
        module.document = read;
        module.is_draft =
            module.document.is_none() && schema_check::is_draft(spec, &document.value);
        if !module.is_draft {
            module.violations = violations;
        }
    }
    if let Some(yaml) = yaml {
        module.mirror = mirror(yaml, &module);
    }
    module
}

/// Takes the text of a large document and parses it without building a JSON value. `None` if it breaks the
/// schema, or if a requested mirror is not canonical or the text has faults.
fn take(
    spec: &ModuleSpec,
    json: &mut Vec<u8>,
    yaml: Option<&Result<Vec<u8>, ReadError>>,
) -> Option<(ModuleDocument, String)> {
    let text = std::str::from_utf8(json).ok()?;
    let document = spec.read_text(text)?;
    match yaml {
        None => Some((document, String::new())),
        Some(Ok(yaml)) if yaml::is_mirrored(text, yaml) => {
            let text = String::from_utf8(std::mem::take(json)).ok()?;
            Some((document, text))
        }
        Some(_) => None,
    }
}

fn read_yaml(root: &Root, listing: &Listing, file: &str) -> Result<Vec<u8>, ReadError> {
    if listing.get(file).is_none() {
        return Err(ReadError::Missing);
    }
    root.read(file, MAX_DOCUMENT_BYTES)
}

/// Compares the mirror with a module's document.
fn mirror(yaml: Result<Vec<u8>, ReadError>, module: &Module) -> Mirror {
    match (yaml, module.json.document()) {
        (Err(ReadError::Missing), _) => Mirror::Missing,
        (Err(error), _) => Mirror::Unreadable(error),
        (Ok(_), None) => Mirror::NotCompared,
        (Ok(bytes), Some(document)) => {
            Mirror::Compared(yaml::check_mirror(&bytes, &document.value))
        }
    }
}

/// The version used to read a module: that of its `VERSION` file, unless only the one in the root metadata belongs to
/// version 1 of the specification. DIR007 reports differences.
fn choose_version(kind: Option<ModuleKind>, versions: [Option<&Version>; 2]) -> Option<String> {
    let of_version_1 = |version: &&Version| {
        let spec = kind.and_then(|kind| find_spec(kind, Some(version.as_str())).0);
        spec.is_some_and(|spec| spec.profile == Profile::V1)
    };
    let versions = || versions.into_iter().flatten();
    versions()
        .find(of_version_1)
        .or_else(|| versions().next())
        .map(|version| version.as_str().to_owned())
}

/// The registry's entry for a version. For an unknown newer minor or patch version, the newest entry with the same
/// major number, and `true`.
pub fn find_spec(kind: ModuleKind, version: Option<&str>) -> (Option<&'static ModuleSpec>, bool) {
    let Some(text) = version else {
        return (registry::find(kind, ""), false);
    };
    if let Some(spec) = registry::find(kind, text) {
        return (Some(spec), false);
    }
    let Ok(version) = semver::Version::parse(text) else {
        return (None, false);
    };
    let newest = registry::modules()
        .iter()
        .filter(|spec| spec.kind == kind && version.major >= 1)
        .filter_map(|spec| semver::Version::parse(spec.version).ok().map(|v| (v, spec)))
        .filter(|(known, _)| known.major == version.major && *known < version)
        .max_by(|a, b| a.0.cmp(&b.0))
        .map(|(_, spec)| spec);
    (newest, newest.is_some())
}

/// A URDD as it is when this is made: each module is read when it is first asked for, and kept. One that changed
/// before is [`ReadError::Changed`].
pub struct Kept {
    root: Root,
    listing: OnceLock<Arc<Listing>>,
    metadata: OnceLock<Arc<MetadataFile>>,
    modules: Mutex<BTreeMap<ModuleKind, Arc<Module>>>,
}

impl fmt::Debug for Kept {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Kept").field(&self.root).finish()
    }
}

impl Kept {
    /// The URDD at a root, as it is now.
    pub fn new(root: &Root) -> Self {
        let (listing, metadata) = (OnceLock::new(), OnceLock::new());
        Kept { root: root.kept(), listing, metadata, modules: Mutex::default() }
    }

    /// Its root, as it was.
    pub fn root(&self) -> &Root {
        &self.root
    }

    /// These modules, as far as they are there, without mirrors and URDF.
    ///
    /// # Errors
    /// If the root could not be listed, or [`ReadError::Changed`].
    pub fn part(&self, kinds: &[ModuleKind]) -> Result<Loaded, ReadError> {
        let listing = keep(&self.listing, || self.root.list().map(Arc::new))?;
        let metadata = match self.metadata.get() {
            Some(metadata) => Arc::clone(metadata),
            None => {
                let read = Arc::new(read_metadata(&self.root));
                match read.json.unreadable() {
                    Some(ReadError::Changed) => return Err(ReadError::Changed),
                    Some(_) => read,
                    None => Arc::clone(self.metadata.get_or_init(|| read)),
                }
            }
        };
        let known = || self.modules.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = kinds.iter().filter_map(|kind| known().get(kind).cloned());
        let mut modules: Vec<Arc<Module>> = kept.collect();
        let is_new = |kind: &ModuleKind| modules.iter().all(|module| module.kind != Some(*kind));
        let new: Vec<ModuleKind> = kinds.iter().copied().filter(is_new).collect();
        let folders = known_folders(&new, listing);
        if !folders.is_empty() {
            for module in read_modules(&self.root, &metadata, folders, None) {
                match (module.unreadable(), module.kind) {
                    (Some(ReadError::Changed), _) => return Err(ReadError::Changed),
                    (None, Some(kind)) => drop(known().insert(kind, Arc::clone(&module))),
                    _ => {}
                }
                modules.push(module);
            }
        }
        Ok(Loaded::of(self.root.clone(), Arc::clone(listing), metadata, modules))
    }
}

/// What is there already, or what `read` gives, which stays. An error does not stay. No lock is held during the read,
/// which may run on other threads.
///
/// # Errors
/// Those of `read`.
pub fn keep<T, E>(kept: &OnceLock<T>, read: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
    match kept.get() {
        Some(known) => Ok(known),
        None => {
            let read = read()?;
            Ok(kept.get_or_init(|| read))
        }
    }
}
