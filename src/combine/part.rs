//! A part as it is taken up: its URDF, its meshes, what a person decided about its skips, and how it was
//! put together itself.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde_json::Value;
use sha2::{Digest, Sha256};

use super::error::{CombineError, PartFault};
use super::legacy;
use super::recipe::{Part, Recipe};
use crate::directory::discover::ROOT_METADATA;
use crate::directory::json;
use crate::directory::limits::MAX_DOCUMENT_BYTES;
use crate::directory::root::Root;
use crate::directory::source::{is_archive, is_urdd};
use crate::directory::writer::sha256;
use crate::format::composition::{CompositionModule, PartSource};
use crate::format::link_shapes_skips::{SkipEdit, SkippedReason};
use crate::format::original_meshes::OriginalMeshesModule;
use crate::format::registry::ModuleKind;
use crate::format::root_metadata::{RootMetadata, Source};
use crate::format::urdf::UrdfModule;
use crate::generate::note::Note;
use crate::generate::{Selection, Settings, generate, generate_text, read_urdf};

/// What a source is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SourceKind {
    /// A URDD of version 1: a folder or an archive.
    Urdd,
    /// A URDD of before version 1, which is taken up by the URDF that it carries.
    Legacy,
    /// A URDF or xacro file.
    Urdf,
}

/// What the source of a part is.
///
/// # Errors
/// Where there is nothing.
pub fn source_kind(path: &Path) -> Result<SourceKind, PartFault> {
    if path.is_dir() {
        return match (is_urdd(path), path.join(ROOT_METADATA).is_file()) {
            (_, true) => Ok(SourceKind::Urdd),
            (true, false) => Ok(SourceKind::Legacy),
            (false, false) => Err(PartFault::Missing("this folder holds none".to_owned())),
        };
    }
    match (path.is_file(), is_archive(path)) {
        (true, true) => Ok(SourceKind::Urdd),
        (true, false) => Ok(SourceKind::Urdf),
        (false, _) => Err(PartFault::Missing("nothing is there".to_owned())),
    }
}

/// A part that was taken up.
#[derive(Debug)]
pub(super) struct Loaded {
    /// The URDD: the source, or what was made of it.
    pub root: Root,
    /// The text of its URDF.
    pub text: String,
    /// What that says.
    pub robot: UrdfModule,
    /// Where the files of its meshes are in the URDD, by the names in the URDF.
    pub meshes: BTreeMap<String, MeshFile>,
    /// What a person decided about its skips.
    pub skips: Option<Skips>,
    /// What it is, and its digest.
    pub source: PartSource,
    /// How it was put together.
    pub composition: Option<CompositionModule>,
    /// What was odd in a URDF.
    pub notes: Vec<Note>,
    /// The classes' modules that it has.
    pub modules: Vec<String>,
}

/// The file of a mesh, and the files that it names; paths in the URDD.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct MeshFile {
    pub path: String,
    pub side_files: Vec<String>,
}

/// What a person decided about skips.
#[derive(Debug)]
pub(super) struct Skips {
    pub reasons: Vec<SkippedReason>,
    pub edits: Vec<SkipEdit>,
}

/// Takes up a part. What has to be made of a URDF is made in `workplace`, a folder that is not there yet.
///
/// # Errors
/// Where it cannot be read, or is no robot.
pub(super) fn load(
    recipe: &Recipe,
    part: &Part,
    workplace: &Path,
    settings: &Settings,
) -> Result<Loaded, CombineError> {
    let shown = part.source.display().to_string();
    let refused = |fault| CombineError::Part {
        id: part.id.text.clone(),
        source_path: shown.clone(),
        fault,
    };
    let kind = source_kind(&part.source).map_err(refused)?;
    let urdf = match kind {
        SourceKind::Urdd => None,
        SourceKind::Urdf => Some(part.source.clone()),
        SourceKind::Legacy => {
            Some(carried(&part.source).ok_or_else(|| refused(PartFault::NoUrdf))?)
        }
    };
    let Some(urdf) = urdf else {
        let root = Root::open(&part.source).map_err(|error| {
            let file = String::new();
            let reason = error.to_string();
            refused(PartFault::Unreadable { file, reason })
        })?;
        return read(root, None, &part.id.text).map_err(refused);
    };
    let mut settings = settings.clone();
    // What is made of links is made once, of what is put together.
    settings.selection = Selection::parse(["original_meshes"]).unwrap_or_else(|_| Selection::all());
    settings.reuse.clear();
    let made = match kind {
        SourceKind::Legacy => {
            let text = legacy::with_carried_meshes(&urdf, &part.source).map_err(refused)?;
            let shown = urdf.display().to_string();
            generate_text(text, &shown, &part.source, workplace, &settings, &())
        }
        _ => generate(&urdf, workplace, &settings, &()),
    };
    let made = made.map_err(|error| CombineError::Generate {
        id: Some(part.id.text.clone()),
        error,
    })?;
    let unreadable = |reason: String| {
        let file = recipe.shown.clone();
        CombineError::Unreadable { file, reason }
    };
    let bytes = std::fs::read(&urdf).map_err(|error| unreadable(error.to_string()))?;
    let root = Root::open_folder(workplace).map_err(|error| unreadable(error.to_string()))?;
    let digest = sha256(&Sha256::digest(&bytes));
    let loaded = read(root, Some(PartSource::Urdf(digest)), &part.id.text).map_err(refused)?;
    Ok(Loaded {
        notes: made.notes,
        ..loaded
    })
}

/// The one URDF in the folder of a legacy URDD.
fn carried(folder: &Path) -> Option<PathBuf> {
    let entries = std::fs::read_dir(folder).ok()?;
    let files = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let is_urdf = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "urdf");
    let mut urdfs: Vec<PathBuf> = files.filter(is_urdf).collect();
    urdfs.sort();
    let first = urdfs.pop()?;
    urdfs.is_empty().then_some(first)
}

/// Takes up a URDD of version 1.
fn read(root: Root, source: Option<PartSource>, id: &str) -> Result<Loaded, PartFault> {
    let unreadable = |file: &str, reason: String| PartFault::Unreadable {
        file: file.to_owned(),
        reason,
    };
    let bytes = |path: &str| {
        root.read(path, MAX_DOCUMENT_BYTES)
            .map_err(|error| unreadable(path, error.to_string()))
    };
    let text = bytes(ROOT_METADATA)?;
    let value = json::read(&text).map_err(|error| unreadable(ROOT_METADATA, error.to_string()))?;
    let metadata: RootMetadata = serde_json::from_value(value.value)
        .map_err(|error| unreadable(ROOT_METADATA, error.to_string()))?;
    let Some(Source::Urdf(urdf)) = &metadata.source else {
        return Err(PartFault::NoUrdf);
    };
    let robot = read_urdf(&bytes(&urdf.path)?, id)
        .map_err(|error| unreadable(&urdf.path, error.to_string()))?;
    let text_of_urdf = String::from_utf8(robot.carried)
        .map_err(|_| unreadable(&urdf.path, "it is not UTF-8".to_owned()))?;
    let modules = Modules {
        root: &root,
        metadata: &metadata,
    };
    let original: Option<OriginalMeshesModule> = modules.read(ModuleKind::OriginalMeshes)?;
    let skips: Option<Value> = modules.read(ModuleKind::LinkShapesSkips)?;
    let skips = skips.map(|document| {
        let of = |key: &str| document.get(key).cloned().unwrap_or_default();
        let wrong = |error: serde_json::Error| {
            let path = format!("{}/module.json", ModuleKind::LinkShapesSkips.folder());
            unreadable(&path, error.to_string())
        };
        Ok(Skips {
            reasons: serde_json::from_value(of("skipped_reasons")).map_err(wrong)?,
            edits: serde_json::from_value(of("edits")).map_err(wrong)?,
        })
    });
    Ok(Loaded {
        meshes: original.map(meshes).unwrap_or_default(),
        skips: skips.transpose()?,
        composition: modules.read(ModuleKind::Composition)?,
        source: source.unwrap_or_else(|| PartSource::Urdd(sha256(&Sha256::digest(&text)))),
        modules: metadata
            .modules
            .iter()
            .map(|module| module.name.clone())
            .collect(),
        text: text_of_urdf,
        robot: robot.robot,
        notes: Vec::new(),
        root,
    })
}

/// The files of meshes, by the names in the URDF.
fn meshes(original: OriginalMeshesModule) -> BTreeMap<String, MeshFile> {
    let files: BTreeMap<&str, &Vec<String>> = (original.files.iter())
        .map(|file| (file.path.as_str(), &file.side_files))
        .collect();
    let mut meshes = BTreeMap::new();
    for reference in &original.references {
        let Some(path) = &reference.path else {
            continue;
        };
        let side_files = files.get(path.as_str()).map(|files| (*files).clone());
        let file = MeshFile {
            path: path.clone(),
            side_files: side_files.unwrap_or_default(),
        };
        meshes.insert(reference.filename.clone(), file);
    }
    meshes
}

struct Modules<'a> {
    root: &'a Root,
    metadata: &'a RootMetadata,
}

impl Modules<'_> {
    /// The document of a module, where the URDD lists it.
    fn read<T: DeserializeOwned>(&self, kind: ModuleKind) -> Result<Option<T>, PartFault> {
        let mut listed = self.metadata.modules.iter();
        let Some(module) = listed.find(|module| module.name == kind.name()) else {
            return Ok(None);
        };
        let path = format!("{}/module.json", module.path);
        let unreadable = |reason: String| PartFault::Unreadable {
            file: path.clone(),
            reason,
        };
        let bytes = self.root.read(&path, MAX_DOCUMENT_BYTES);
        let bytes = bytes.map_err(|error| unreadable(error.to_string()))?;
        let value = json::read(&bytes).map_err(|error| unreadable(error.to_string()))?;
        let document = serde_json::from_value(value.value);
        document
            .map(Some)
            .map_err(|error| unreadable(error.to_string()))
    }
}
