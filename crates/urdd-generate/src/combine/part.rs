//! Loads a part: its URDF, its meshes, the user's decisions about its skips, and its own composition; and stores the meshes of
//! all parts, each file once.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::DeserializeOwned;
use sha2::{Digest, Sha256};

use super::error::{CombineError, PartFault, Result};
use super::legacy;
use super::recipe::Part;
use super::sources::{Source, SourceKind, bytes, document, parsed};
use crate::error::GenerateError;
use crate::meshes::original::common_folder;
use crate::{Selection, Settings, generate, generate_text};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::{ReadError, Root};
use urdd_directory::writer::{Writer, sha256};
use urdd_directory::{outputs, regular};
use urdd_format::composition::{CompositionModule, PartSource};
use urdd_format::hexadecimal::hexadecimal;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::link_shapes_spheres::{LinkShapesSpheresModule, SphereOrigin};
use urdd_format::named_configurations::{ConfigurationEdit, NamedConfigurationsModule};
use urdd_format::original_meshes::OriginalMeshesModule;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::{self, RootMetadata};
use urdd_format::urdf::UrdfModule;
use urdd_source::note::Note;
use urdd_source::{MAX_SOURCE_BYTES, read_urdf};

#[derive(Debug)]
pub(super) struct Loaded {
    /// The URDD: the source, or the one generated from it.
    pub root: Root,
    pub text: String,
    pub robot: UrdfModule,
    pub links: HashMap<String, usize>,
    pub joints: HashMap<String, usize>,
    /// The mesh files in the URDD, by the names in the URDF.
    pub meshes: BTreeMap<String, MeshFile>,
    pub skips: Option<Skips>,
    pub configurations: Vec<ConfigurationEdit>,
    /// The kind of source and its digest.
    pub source: PartSource,
    pub composition: Option<CompositionModule>,
    /// The length of its composition document in bytes.
    pub composition_length: usize,
    pub notes: Vec<Note>,
    /// Links with the plain mesh of a legacy URDD because the original is missing.
    pub plain_meshes: Vec<String>,
    pub modules: Vec<String>,
    pub given_spheres: usize,
}

/// The file of a mesh and the files that it references, as paths in the URDD.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct MeshFile {
    pub path: String,
    pub side_files: Vec<String>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Skips {
    #[serde(rename = "skipped_reasons")]
    pub reasons: Vec<SkippedReason>,
    pub edits: Vec<SkipEdit>,
}

/// Loads a part. A URDD for a URDF source is generated in `workplace`, a folder that must not exist yet. `id` is the
/// name of a robot without one.
pub(super) fn load(
    source: &Source,
    id: &str,
    workplace: &Path,
    settings: &Settings,
) -> Result<Loaded> {
    let shown = source.path.display().to_string();
    let refused =
        |fault| CombineError::Part { id: id.to_owned(), source_path: shown.clone(), fault };
    let unreadable = |error: ReadError| refused(PartFault::unreadable("", error));
    if source.kind == SourceKind::Urdd {
        return read(Root::open(&source.path).map_err(unreadable)?, None, id).map_err(refused);
    }
    let mut settings = settings.clone();
    // Derived modules are only generated for the combined robot.
    settings.selection = Selection::parse(["original_meshes"]).unwrap_or_else(|_| Selection::all());
    settings.donors.clear();
    // A file that is named is about the combined robot.
    settings.source.loops = None;
    let (made, digest, plain_meshes) = match source.kind {
        SourceKind::Legacy => {
            let carried = legacy::read(&source.path).map_err(refused)?;
            let digest = sha256(&Sha256::digest(&carried.found));
            let shown = source.path.join(&carried.file).display().to_string();
            let made = generate_text(carried.text, &shown, &source.path, workplace, &settings, &());
            (made, digest, carried.plain_meshes)
        }
        _ => {
            let bytes = regular::read(&source.path, MAX_SOURCE_BYTES).map_err(unreadable)?;
            let digest = sha256(&Sha256::digest(&bytes));
            let made = generate(&source.path, workplace, &settings, &());
            (made, digest, Vec::new())
        }
    };
    let made = made.map_err(|error| CombineError::Generate { id: Some(id.to_owned()), error })?;
    let root = Root::open_folder(workplace).map_err(unreadable)?;
    let loaded = read(root, Some(PartSource::Urdf(digest)), id).map_err(refused)?;
    Ok(Loaded { notes: made.notes, plain_meshes, ..loaded })
}

fn read(root: Root, source: Option<PartSource>, id: &str) -> Result<Loaded, PartFault> {
    let text = bytes(&root, ROOT_METADATA)?;
    let metadata: RootMetadata = parsed(&text, ROOT_METADATA)?;
    let Some(root_metadata::Source::Urdf(urdf)) = &metadata.source else {
        return Err(PartFault::no_urdf());
    };
    let robot = read_urdf(&bytes(&root, &urdf.path)?, id)
        .map_err(|error| PartFault::unreadable(&urdf.path, error))?;
    let text_of_urdf = String::from_utf8(robot.carried)
        .map_err(|_| PartFault::unreadable(&urdf.path, "it is not UTF-8"))?;
    let listed = (&root, &metadata);
    let original = module(listed, ModuleKind::OriginalMeshes)?;
    let (skips, _) = module(listed, ModuleKind::LinkShapesSkips)?.unzip();
    let named: Option<(NamedConfigurationsModule, _)> =
        module(listed, ModuleKind::NamedConfigurations)?;
    let named = named.map_or_else(Vec::new, |(module, _)| module.configurations);
    let spheres: Option<(LinkShapesSpheresModule, _)> =
        module(listed, ModuleKind::LinkShapesSpheres)?;
    let levels = spheres.map_or_else(Vec::new, |(module, _)| module.levels);
    let given = levels.iter().filter(|level| level.origin == SphereOrigin::Given);
    let given_spheres = given.flat_map(|level| &level.spheres).map(Vec::len).sum();
    let (composition, composition_length) = module(listed, ModuleKind::Composition)?.unzip();
    Ok(Loaded {
        meshes: original.map(|(module, _)| meshes(module)).unwrap_or_default(),
        skips,
        configurations: named.iter().map(ConfigurationEdit::from).collect(),
        given_spheres,
        composition,
        composition_length: composition_length.unwrap_or_default(),
        source: source.unwrap_or_else(|| PartSource::Urdd(sha256(&Sha256::digest(&text)))),
        modules: metadata.modules.iter().map(|module| module.name.clone()).collect(),
        text: text_of_urdf,
        links: indices(robot.robot.links.iter().map(|link| &link.name)),
        joints: indices(robot.robot.joints.iter().map(|joint| &joint.name)),
        robot: robot.robot,
        notes: Vec::new(),
        plain_meshes: Vec::new(),
        root,
    })
}

fn indices<'a>(names: impl Iterator<Item = &'a String>) -> HashMap<String, usize> {
    names.cloned().zip(0..).collect()
}

fn meshes(original: OriginalMeshesModule) -> BTreeMap<String, MeshFile> {
    let files: BTreeMap<&str, &Vec<String>> =
        (original.files.iter()).map(|file| (file.path.as_str(), &file.side_files)).collect();
    let mut meshes = BTreeMap::new();
    for reference in &original.references {
        let Some(path) = &reference.path else { continue };
        let side_files = files.get(path.as_str()).map(|files| (*files).clone());
        let file = MeshFile { path: path.clone(), side_files: side_files.unwrap_or_default() };
        meshes.insert(reference.filename.clone(), file);
    }
    meshes
}

/// The document of a module with its length in bytes, if the URDD lists it.
fn module<T: DeserializeOwned>(
    (root, metadata): (&Root, &RootMetadata),
    kind: ModuleKind,
) -> Result<Option<(T, usize)>, PartFault> {
    let mut listed = metadata.modules.iter();
    let module = listed.find(|module| module.name == kind.name());
    module.map(|module| document(root, &format!("{}/module.json", module.path))).transpose()
}

/// The meshes of all parts. Each is written to `store` after it was read, and put into its place at the end. No more
/// than one mesh with its side files is in memory.
pub(super) struct Meshes<'a> {
    /// Places below `meshes`, by the content of a mesh and the files that it references.
    places: BTreeMap<String, String>,
    /// The file in `store` for each place.
    files: BTreeMap<String, PathBuf>,
    store: PathBuf,
    cancellation: &'a Cancellation,
}

/// The meshes of a part: places below `meshes`, by the names in its URDF.
pub(super) type Placed = BTreeMap<String, String>;

impl<'a> Meshes<'a> {
    /// Starts without meshes. `store` is an existing folder for the files.
    pub fn new(store: PathBuf, cancellation: &'a Cancellation) -> Self {
        Meshes { places: BTreeMap::new(), files: BTreeMap::new(), store, cancellation }
    }

    pub fn add(&mut self, part: &Part, loaded: &Loaded, used: &BTreeSet<String>) -> Result<Placed> {
        let mut placed = Placed::new();
        for (name, mesh) in loaded.meshes.iter().filter(|(name, _)| used.contains(*name)) {
            self.cancellation.check()?;
            let read = |path: &String| {
                let bytes = loaded.root.read(path, MAX_DOCUMENT_BYTES);
                bytes.map_err(|error| part.refused(PartFault::unreadable(path, error)))
            };
            placed.insert(name.clone(), self.place(&part.id.text, mesh, &read)?);
        }
        Ok(placed)
    }

    fn place(
        &mut self,
        id: &str,
        mesh: &MeshFile,
        read: &dyn Fn(&String) -> Result<Vec<u8>>,
    ) -> Result<String> {
        let own = read(&mesh.path)?;
        let mut sides = Vec::new();
        for side in &mesh.side_files {
            sides.push((side, read(side)?));
        }
        let hash = |bytes: &[u8]| hexadecimal(&Sha256::digest(bytes));
        let ending = mesh.path.rsplit_once('.').map_or("", |(_, ending)| ending);
        let mut content = format!("{} {}\n", ending.to_ascii_lowercase(), hash(&own));
        for (side, bytes) in &sides {
            // Their relative position matters to the mesh.
            content += &format!("{} {}\n", relative(&mesh.path, side), hash(bytes));
        }
        if let Some(place) = self.places.get(&content) {
            return Ok(place.clone());
        }
        let place = format!("{id}/{}", below_meshes(&mesh.path));
        for (side, bytes) in sides {
            self.store(format!("{id}/{}", below_meshes(side)), &bytes)?;
        }
        self.store(place.clone(), &own)?;
        self.places.insert(content, place.clone());
        Ok(place)
    }

    fn store(&mut self, place: String, bytes: &[u8]) -> Result<()> {
        let path = self.store.join(self.files.len().to_string());
        outputs::fresh(&path, bytes).map_err(|error| CombineError::unwritable(&path, error))?;
        self.files.insert(place, path);
        Ok(())
    }

    /// Puts the files where the URDF names them, below `folder`. Returns the folder that all places share, which is
    /// left out of the names.
    pub fn write(&self, folder: &Path) -> Result<PathBuf> {
        let places: Vec<&Path> = self.files.keys().map(Path::new).collect();
        let shared = common_folder(&places);
        for (place, stored) in &self.files {
            let (writer, path) = (Writer::new(folder), carried(place, &shared));
            writer
                .keep(stored, &path)
                .map_err(GenerateError::from)
                .map_err(|error| CombineError::Generate { id: None, error })?;
        }
        Ok(shared)
    }
}

/// The path of a file in the URDD. The URDF uses the same name, so that it is found from there too.
pub(super) fn carried(place: &str, shared: &Path) -> String {
    let place = Path::new(place).strip_prefix(shared).ok().and_then(Path::to_str).unwrap_or(place);
    format!("{}/meshes/{place}", ModuleKind::OriginalMeshes.folder())
}

fn below_meshes(path: &str) -> &str {
    let folder = ModuleKind::OriginalMeshes.folder();
    path.strip_prefix(folder).and_then(|path| path.strip_prefix("/meshes/")).unwrap_or(path)
}

/// The path of a file relative to the folder of another, both below one root.
fn relative(from: &str, to: &str) -> String {
    let from: Vec<&str> = from.split('/').collect();
    let to: Vec<&str> = to.split('/').collect();
    let folders = &from[..from.len() - 1];
    let same = folders.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = vec![".."; folders.len() - same];
    let path: Vec<&str> = up.into_iter().chain(to[same..].iter().copied()).collect();
    path.join("/")
}
