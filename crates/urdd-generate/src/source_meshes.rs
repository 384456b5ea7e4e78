//! A URDF with its mesh files, without anything generated: for programs that compare or show URDFs.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::error::GenerateError;
use super::meshes::inspect::inspect;
use super::meshes::original::named;
use super::meshes::resolve::{FoundMesh, resolve};
use super::meshes::roots::{Place, Roots};
use super::settings::Settings;
use super::source;
use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::UrdfModule;
use urdd_geometry::read::Scene;

/// A URDF and the mesh files that it names.
#[derive(Debug)]
pub struct SourceMeshes {
    /// The content of its `urdf_module`.
    pub robot: UrdfModule,
    /// Its mesh references: links in order, visual before collision, elements in order.
    pub meshes: Vec<SourceMesh>,
    roots: Roots,
    places: BTreeMap<PathBuf, Place>,
}

/// A mesh reference of a URDF.
#[derive(Debug, Clone)]
pub struct SourceMesh {
    /// Index of the link.
    pub link: usize,
    /// Whether a visual or a collision element names it.
    pub geometry: GeometryKind,
    /// Index of the element among the link's elements of that kind.
    pub element: usize,
    /// The file with symbolic links resolved, or why there is none.
    pub file: Result<PathBuf, String>,
}

impl SourceMeshes {
    /// Reads a file of [`SourceMeshes::meshes`].
    ///
    /// # Errors
    /// The reason why it has no usable surface.
    pub fn read(&self, file: &Path) -> Result<Arc<Scene>, String> {
        let place = self.places.get(file).ok_or("the URDF does not name it")?;
        inspect(file, place, &self.roots).scene
    }
}

/// Opens a URDF and finds its mesh files, in the folders where [`generate`](super::generate) finds them.
///
/// # Errors
/// If the URDF cannot be read or is not a valid robot. A missing mesh is not an error.
pub fn open_source(path: &Path, settings: &Settings) -> Result<SourceMeshes, GenerateError> {
    let packages = &settings.packages;
    let source = source::load(path, &settings.xacro, packages, &settings.cancellation)?;
    let roots = Roots::new(&source.folder, packages, &settings.allowed_folders);
    let mut found: BTreeMap<&str, Result<FoundMesh, String>> = BTreeMap::new();
    let mut meshes = Vec::new();
    for mesh in named(&source.reading.robot) {
        let found = found.entry(mesh.filename).or_insert_with(|| {
            resolve(mesh.filename, &source.folder, packages, &roots).map_err(|why| {
                match &why.outside {
                    Some(path) => format!(
                        "{} is outside of the folders of the robot and its packages; `--allow-folder` allows its folder",
                        path.display()
                    ),
                    None => why.in_words(),
                }
            })
        });
        meshes.push(SourceMesh {
            link: mesh.link,
            geometry: mesh.geometry,
            element: mesh.element,
            file: found
                .as_ref()
                .map(|found| found.file.clone())
                .map_err(Clone::clone),
        });
    }
    let places = found.into_values().flatten();
    let places = places.map(|found| (found.file, found.place)).collect();
    Ok(SourceMeshes {
        robot: source.reading.robot,
        meshes,
        roots,
        places,
    })
}
