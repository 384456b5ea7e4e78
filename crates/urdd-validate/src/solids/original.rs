//! The carried meshes that the URDF names.

use std::collections::{BTreeSet, HashMap};

use rayon::prelude::*;

use super::file::{self, MeshFault};
use urdd_directory::path::beside;
use urdd_document::mesh_files::MeshFiles;
use urdd_document::urdd::Urdd;
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};
use urdd_geometry::Mesh;
use urdd_geometry::read::{Format, Options, read, read_with};

/// A mesh that the URDF names.
#[derive(Debug)]
pub struct Original {
    /// Its content in the axes of the URDF's mesh element, metres; or why it cannot be read as a mesh with a surface.
    pub mesh: Result<Mesh, MeshFault>,
    /// The existing files that it names, sorted; `None` if it cannot be read.
    pub side_files: Option<Vec<String>>,
}

/// Reads every mesh of `original_meshes_module`, by its path as written.
pub fn read_all(urdd: &Urdd) -> HashMap<String, Original> {
    let (profile, paths) = paths(urdd);
    paths
        .into_par_iter()
        .map_init(
            || MeshFiles::new(urdd),
            |files, path| (path.to_owned(), read_one(files, profile, path)),
        )
        .collect()
}

/// A mesh that the URDF names, with its faces uncut (see [`Options`]); `None` if it cannot be read.
pub fn uncut(urdd: &Urdd, path: &str) -> Option<Mesh> {
    let (profile, _) = paths(urdd);
    let bytes = file::bytes(&mut MeshFiles::new(urdd), profile, path).ok()?;
    let options = Options { uncut: true, ..Options::default() };
    let scene = read_with(&bytes, path, &mut |_| None, &options).ok()?;
    matches!(scene.format, Format::Obj | Format::Collada).then(|| scene.merged())
}

fn paths(urdd: &Urdd) -> (Profile, BTreeSet<&str>) {
    match urdd.document(ModuleKind::OriginalMeshes) {
        Some(ModuleDocument::OriginalMeshes(module)) => {
            let paths = module.files.iter().map(|file| file.path.as_str());
            (Profile::V1, paths.collect())
        }
        _ => {
            let meshes = urdd.meshes(ModuleKind::OriginalMeshes);
            let paths = meshes.iter().flat_map(|meshes| meshes.paths());
            (Profile::Legacy, paths.map(|(_, path)| path.path).collect())
        }
    }
}

fn read_one(files: &mut MeshFiles, profile: Profile, path: &str) -> Original {
    let mut scene = || {
        let bytes = file::bytes(files, profile, path)?;
        let mut fetch = |side: &str| file::bytes(files, profile, &beside(path, side)?).ok();
        read(&bytes, path, &mut fetch)
            .map_err(|error| MeshFault::Broken(file::without_name(&error)))
    };
    let scene = match scene() {
        Ok(scene) => scene,
        Err(fault) => return Original { mesh: Err(fault), side_files: None },
    };
    let named: BTreeSet<String> = scene
        .side_files
        .iter()
        .filter_map(|side| beside(path, side))
        .filter(|side| side != path && files.find(profile, side).is_ok())
        .collect();
    let mesh = scene.merged();
    let nothing = || MeshFault::Broken("it holds no triangle with an area".to_owned());
    Original {
        mesh: if mesh.area() > 0.0 { Ok(mesh) } else { Err(nothing()) },
        side_files: Some(named.into_iter().collect()),
    }
}
