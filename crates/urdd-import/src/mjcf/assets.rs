//! The files that a model names: where they are, what the URDF gets of them, and MuJoCo's own mesh files (MSH).

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use urdd_directory::account::Charged;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::path::file_name;
use urdd_geometry::Mesh;
use urdd_source::FoundMesh;
use urdd_source::gate::Gate;

use super::compiler::{Compiler, Compilers};
use super::document::first;
use crate::fault::{ImportFault, Unreachable};
use crate::model::Asset;
use crate::place::{Fallible, Place, Placing, TextFile};
use crate::tree::Names;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Folder {
    Meshes,
    Textures,
}

/// The places in which a file may be: below the folder of the description, or of the file that names it.
fn places(
    file: &str,
    compiler: &Compiler,
    folder: Folder,
    base: &Path,
    own: &Path,
) -> Vec<PathBuf> {
    let file = match compiler.strips_paths {
        true => file.rsplit(['/', '\\']).next().unwrap_or(file),
        false => file,
    };
    let file = file.replace('\\', "/");
    let inside = Path::new(match folder {
        Folder::Meshes => &compiler.mesh_folder,
        Folder::Textures => &compiler.texture_folder,
    });
    let between = own.strip_prefix(base).unwrap_or(Path::new(""));
    vec![
        base.join(inside).join(&file),
        own.join(&file),
        base.join(inside).join(between).join(&file),
        own.join(inside).join(&file),
    ]
}

/// What asking for a path costs for each of its bytes.
const LOOKED_AT: usize = 20;

/// The files that the URDF names, and where they are read.
pub struct Assets<'f> {
    gate: &'f Gate,
    compilers: &'f Compilers,
    files: &'f [TextFile],
    by_key: HashMap<String, usize>,
    /// In lower case.
    names: Names,
    pub all: Charged<Asset>,
}

impl<'f> Assets<'f> {
    pub fn new(gate: &'f Gate, compilers: &'f Compilers, files: &'f [TextFile]) -> Fallible<Self> {
        let mut names = Names::new(gate.account());
        // That of the mesh of ellipsoids.
        names.take("meshes/unit_sphere").at(Place::default())?;
        let (by_key, all) = (HashMap::new(), Charged::default());
        Ok(Assets { gate, compilers, files, by_key, names, all })
    }

    pub fn find(&self, file: &str, folder: Folder, place: Place) -> Fallible<FoundMesh> {
        let folder_of = |file: Option<&'f TextFile>| {
            file.and_then(|file| file.path.parent()).unwrap_or(Path::new("/"))
        };
        let first_file = self.compilers.first_file(place);
        let [base, own] = [first_file, place.file].map(|of| folder_of(self.files.get(of)));
        let places = places(file, self.compilers.at(place), folder, base, own);
        let bytes: usize = places.iter().map(|place| place.as_os_str().len()).sum();
        self.charge(LOOKED_AT * bytes, place)?;
        first(self.gate, places, file).at(place)
    }

    /// Reads a file that was found, for what is made of it.
    pub fn bytes(&self, found: &FoundMesh, place: Place) -> Fallible<Vec<u8>> {
        let unread = |why| Unreachable::unread(&found.file.display().to_string(), &why);
        self.gate.bytes(found, MAX_DOCUMENT_BYTES).map_err(unread).at(place)
    }

    /// Reads an image that was found and that begins with these bytes; `None` if it is not one.
    pub fn image(
        &self,
        found: &FoundMesh,
        start: &[u8],
        place: Place,
    ) -> Fallible<Option<Vec<u8>>> {
        let unread = |why| ImportFault::of_image(&found.file.display().to_string(), why);
        self.gate.image(found, start).map_err(unread).at(place)
    }

    pub fn charge(&self, bytes: usize, place: Place) -> Fallible<()> {
        self.gate.account().charge(bytes).at(place)
    }

    /// The index of a file that was added.
    pub fn known(&self, key: &str) -> Option<usize> {
        self.by_key.get(key).copied()
    }

    /// The index of a file, which is added unless it is there. `key` tells files apart.
    pub fn add(
        &mut self,
        key: &str,
        path: &str,
        bytes: Arc<[u8]>,
        place: Place,
    ) -> Fallible<usize> {
        if let Some(known) = self.known(key) {
            return Ok(known);
        }
        let (folder, file) = path.split_once('/').unwrap_or(("", path));
        let (stem, extension) = file.rsplit_once('.').unwrap_or((file, ""));
        let stem = file_name(stem, "");
        let free = self.names.free(&format!("{folder}/{}", stem.to_lowercase())).at(place)?;
        // The number that makes it free, behind the stem as it is written.
        let number = &free[folder.len() + 1 + stem.to_lowercase().len()..];
        let path = format!("{folder}/{stem}{number}.{extension}");
        self.all.push(Asset { path, bytes }, self.gate.account()).at(place)?;
        self.by_key.insert(key.to_owned(), self.all.len() - 1);
        Ok(self.all.len() - 1)
    }
}

pub fn read_msh(bytes: &[u8]) -> Result<Mesh, &'static str> {
    let (words, rest_of_word) = bytes.as_chunks::<4>();
    let head: Option<&[[u8; 4]; 4]> = words.first_chunk();
    let counts = head.ok_or("has no header of an MSH file")?.map(i32::from_le_bytes);
    let counts = counts.map(|count| usize::try_from(count).ok());
    let [Some(vertices), Some(normals), Some(places), Some(faces)] = counts else {
        return Err("has a negative count in its MSH file");
    };
    let sizes = [(vertices, 3), (normals, 3), (places, 2), (faces, 3)];
    // In a browser, a product of these is more than a `usize` has.
    let length: u64 = sizes.iter().map(|(count, each)| *count as u64 * each).sum();
    if words.len() as u64 != 4 + length || !rest_of_word.is_empty() || vertices < 4 {
        return Err("is of another length than its MSH file says");
    }
    let (coordinates, rest) = words[4..].split_at(vertices * 3);
    let indices = &rest[normals * 3 + places * 2..];
    let points = coordinates.as_chunks().0.iter();
    let points = points.map(|point: &[[u8; 4]; 3]| point.map(|x| f64::from(f32::from_le_bytes(x))));
    let triangles = indices.as_chunks().0.iter();
    let triangles: Vec<[u32; 3]> =
        triangles.map(|face: &[[u8; 4]; 3]| face.map(u32::from_le_bytes)).collect();
    let mesh = Mesh { vertices: points.collect(), triangles };
    if mesh.triangles.as_flattened().iter().any(|index| *index as usize >= vertices) {
        return Err("has a face of a vertex that its MSH file does not have");
    }
    if !mesh.vertices.as_flattened().iter().all(|x| x.is_finite()) {
        return Err("has a vertex that is not finite");
    }
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_those_of_the_length() {
        let file = |counts: [i32; 4], words: usize| -> Vec<u8> {
            let body = vec![0; 4 * words];
            counts.iter().flat_map(|count| count.to_le_bytes()).chain(body).collect()
        };
        assert!(read_msh(&file([4, 0, 0, 1], 15)).is_ok());
        for (counts, words) in [
            ([4, 0, 0, 1], 14),
            ([4, 0, 0, i32::MAX], 15),
            // Three times that is 2 more than 32 bits have.
            ([0x5555_5556, 0, 0, 0], 2),
            ([0x5555_5556, 0x5555_5556, 0, 1], 7),
            ([-1, 0, 0, 0], 0),
        ] {
            assert!(read_msh(&file(counts, words)).is_err(), "{counts:?}");
        }
    }

    #[test]
    fn faces_are_of_vertices_that_are_there_and_finite() {
        let with = |place: usize, word: u32| {
            let mut words = [4, 0, 0, 1].into_iter().chain([0; 15]).collect::<Vec<u32>>();
            words[4 + place] = word;
            read_msh(&words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>())
        };
        assert!(with(14, 3).is_ok() && with(11, 1.0_f32.to_bits()).is_ok());
        assert!(with(14, 4).is_err() && with(14, u32::MAX).is_err());
        assert!(with(11, f32::NAN.to_bits()).is_err() && with(0, f32::INFINITY.to_bits()).is_err());
    }
}
