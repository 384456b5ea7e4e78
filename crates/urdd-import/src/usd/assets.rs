//! The files of a USD, by the gate, and those that the URDF names: meshes, which are written, and images, which are there or in
//! packages.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;
use std::sync::Arc;

use sha2::{Digest, Sha256};
use urdd_directory::account::Charged;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::path::file_name;
use urdd_source::gate::Gate;
use urdd_source::is_image;
use urdd_usd::Door;

use crate::fault::Unreachable;
use crate::features::{self, Tally};
use crate::model::Asset;
use crate::place::{Fallible, Place, Placing, TextFile};

pub struct Assets<'g> {
    pub gate: &'g Gate,
    door: GateDoor<'g>,
    all: Charged<Asset>,
    meshes: HashMap<[u8; 32], usize>,
    images: HashMap<String, Option<usize>>,
    taken: BTreeSet<String>,
}

impl<'g> Assets<'g> {
    pub fn new(gate: &'g Gate) -> Self {
        Assets {
            gate,
            door: GateDoor { gate, files: BTreeMap::new() },
            all: Charged::default(),
            meshes: HashMap::new(),
            images: HashMap::new(),
            taken: BTreeSet::new(),
        }
    }

    pub fn into_all(self) -> Charged<Asset> {
        self.all
    }

    /// A mesh, once.
    pub fn mesh(
        &mut self,
        bytes: Vec<u8>,
        name: &str,
        ending: &str,
        place: Place,
    ) -> Fallible<usize> {
        let key: [u8; 32] = Sha256::digest(&bytes).into();
        if let Some(known) = self.meshes.get(&key) {
            return Ok(*known);
        }
        self.meshes.insert(key, self.all.len());
        self.add("meshes", name, ending, bytes.into(), place)
    }

    /// The image at a path; none if it is not there or is not an image.
    pub fn image(
        &mut self,
        path: &str,
        place: Place,
        tally: &mut Tally,
    ) -> Fallible<Option<usize>> {
        if let Some(known) = self.images.get(path) {
            return Ok(*known);
        }
        let bytes = urdd_usd::file(path, &mut self.door).map_err(|fault| fault.to_string());
        let image = match bytes {
            Ok(bytes) if is_image(&bytes) => {
                let name = path.trim_end_matches(']').rsplit(['/', '[']).next().unwrap_or(path);
                let (stem, ending) = name.split_at(name.rfind('.').unwrap_or(name.len()));
                Some(self.add("textures", stem, ending, bytes, place)?)
            }
            other => {
                self.gate.account().charge(other.as_ref().map_or(0, |of| of.len())).at(place)?;
                let why = other.err().unwrap_or_else(|| format!("`{path}` is not an image"));
                let text = format!("an image is left out: {why}");
                tally.say(features::MISSING_MESHES, place, text);
                None
            }
        };
        self.images.insert(path.to_owned(), image);
        Ok(image)
    }

    /// Adds a file under a name that is free.
    fn add(
        &mut self,
        folder: &str,
        name: &str,
        ending: &str,
        bytes: Arc<[u8]>,
        place: Place,
    ) -> Fallible<usize> {
        let mut path = format!("{folder}/{}", file_name(name, ending));
        for number in 2.. {
            if self.taken.insert(path.to_lowercase()) {
                break;
            }
            path = format!("{folder}/{}", file_name(&format!("{name}_{number}"), ending));
        }
        self.all.push(Asset { path, bytes }, self.gate.account()).at(place)?;
        Ok(self.all.len() - 1)
    }
}

/// Reads layers by the gate of a description.
pub struct GateDoor<'g> {
    pub gate: &'g Gate,
    /// What was read, by the path that layers have.
    pub files: BTreeMap<String, TextFile>,
}

impl Door for GateDoor<'_> {
    fn read(&mut self, path: &str) -> Result<Arc<[u8]>, String> {
        if let Some(known) = self.files.get(path) {
            return Ok(Arc::clone(&known.bytes));
        }
        let found = match Path::new(path).is_absolute() {
            true => self.gate.at(Path::new(path)),
            false => self.gate.find(path),
        };
        let found = found.map_err(|why| Unreachable::of(path, why).to_string())?;
        let bytes = self.gate.bytes(&found, MAX_DOCUMENT_BYTES).map_err(|why| why.to_string())?;
        let bytes: Arc<[u8]> = bytes.into();
        let shown = found.file.display().to_string();
        let file = TextFile::any(shown, found.file, Arc::clone(&bytes));
        self.files.insert(path.to_owned(), file);
        Ok(bytes)
    }

    fn charge(&mut self, bytes: usize) -> Result<(), String> {
        self.gate.account().charge(bytes).map_err(|why| why.to_string())
    }
}

impl GateDoor<'_> {
    /// The file of a layer, which may be in a package.
    pub fn file(&self, layer: &str) -> Option<&TextFile> {
        let path = layer.split_once('[').map_or(layer, |(package, _)| package);
        self.files.get(path)
    }
}
