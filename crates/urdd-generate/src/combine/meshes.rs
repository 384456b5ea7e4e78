//! Stores the meshes of the parts, each file once.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::error::{CombineError, PartFault, Result};
use super::part::{Loaded, MeshFile};
use super::recipe::Part;
use crate::error::GenerateError;
use crate::meshes::layout::common_folder;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::outputs;
use urdd_directory::writer::Writer;
use urdd_format::hexadecimal::hexadecimal;
use urdd_format::registry::ModuleKind;

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
