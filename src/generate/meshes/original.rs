//! `original_meshes_module` from the robot: SPEC 7.5.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::inspect;
use super::layout::lay_out;
use super::package::Packages;
use super::resolve::{FoundMesh, Home, NotFound, resolve};
use crate::format::index::{ElementIdx, LinkIdx};
use crate::format::meshes::GeometryKind;
use crate::format::original_meshes::{MeshReference, OriginalMesh, OriginalMeshesModule};
use crate::format::registry::ModuleKind;
use crate::format::urdf::{Geometry, UrdfModule};
use crate::generate::note::{Note, NoteKind};

/// The module, and the files that go with it.
#[derive(Debug)]
pub(crate) struct OriginalMeshes {
    pub module: OriginalMeshesModule,
    /// Each file that is carried: its path in the URDD, and where it is now.
    pub files: BTreeMap<String, PathBuf>,
    pub notes: Vec<Note>,
}

/// A mesh that the URDF names.
struct Named<'a> {
    link: usize,
    geometry: GeometryKind,
    element: usize,
    filename: &'a str,
}

/// Makes the module. `places` says where in the file each mesh is named.
pub(crate) fn original_meshes(
    robot: &UrdfModule,
    urdf_folder: &Path,
    packages: &Packages,
    shown: &str,
    places: &[(u32, u32)],
) -> OriginalMeshes {
    let named = named(robot);
    let mut notes = Vec::new();
    let mut known: BTreeMap<&str, Option<PathBuf>> = BTreeMap::new();
    let mut homes: BTreeMap<PathBuf, Home> = BTreeMap::new();
    let mut side_files: BTreeMap<PathBuf, Vec<PathBuf>> = BTreeMap::new();
    for (mesh, place) in named.iter().zip(places) {
        if known.contains_key(mesh.filename) {
            continue;
        }
        let mut note = |problem: String, assumed: &str| {
            notes.push(Note {
                kind: NoteKind::Mesh,
                file: shown.to_owned(),
                line: place.0,
                column: place.1,
                problem,
                assumed: assumed.to_owned(),
            });
        };
        let found = find(mesh.filename, urdf_folder, packages);
        let file = match found {
            Ok((found, beside)) => {
                if let Some(assumed) = &found.assumed {
                    let problem = format!("mesh `{}` is not written as files are", mesh.filename);
                    note(problem, assumed);
                }
                for file in &beside {
                    homes
                        .entry(file.clone())
                        .or_insert_with(|| found.home.clone());
                }
                // The first name that a file has decides what it belongs to.
                homes.entry(found.file.clone()).or_insert(found.home);
                side_files.insert(found.file.clone(), beside);
                Some(found.file)
            }
            Err(why) => {
                let what = format!("mesh `{}` {why}", mesh.filename);
                note(what, "not carried; the element has no geometry");
                None
            }
        };
        known.insert(mesh.filename, file);
    }
    let folder = ModuleKind::OriginalMeshes.folder();
    let paths: BTreeMap<PathBuf, String> = lay_out(&homes)
        .into_iter()
        .map(|(file, name)| (file, format!("{folder}/meshes/{name}")))
        .collect();
    let carried: BTreeSet<&PathBuf> = known.values().flatten().collect();
    let mut files: Vec<OriginalMesh> = carried
        .into_iter()
        .map(|file| {
            let beside = side_files[file].iter();
            let beside: BTreeSet<String> = beside.map(|file| paths[file].clone()).collect();
            OriginalMesh {
                path: paths[file].clone(),
                side_files: beside.into_iter().collect(),
            }
        })
        .collect();
    files.sort_by(|a, b| a.path.cmp(&b.path));
    let references = named.iter().map(|mesh| MeshReference {
        link_idx: LinkIdx(mesh.link as u32),
        geometry: mesh.geometry,
        element_idx: ElementIdx(mesh.element as u32),
        filename: mesh.filename.to_owned(),
        path: known[mesh.filename]
            .as_ref()
            .map(|file| paths[file].clone()),
    });
    OriginalMeshes {
        module: OriginalMeshesModule {
            references: references.collect(),
            files,
        },
        files: paths.into_iter().map(|(file, path)| (path, file)).collect(),
        notes,
    }
}

/// The file of a mesh, and its side files.
fn find(
    filename: &str,
    urdf_folder: &Path,
    packages: &Packages,
) -> Result<(FoundMesh, Vec<PathBuf>), String> {
    let not_found = |why: NotFound| format!("was not found ({})", why.in_words());
    let found = resolve(filename, urdf_folder, packages).map_err(not_found)?;
    let beside = inspect::side_files(&found.file)
        .map_err(|why| format!("cannot be read ({}: {why})", found.file.display()))?;
    let beside = beside.into_iter().map(|side| side.file);
    let beside = beside.filter(|file| *file != found.file).collect();
    Ok((found, beside))
}

/// Every mesh of the URDF: links ascending, visual before collision, elements ascending.
fn named(robot: &UrdfModule) -> Vec<Named<'_>> {
    let mut named = Vec::new();
    for (link, of) in robot.links.iter().enumerate() {
        let visual = of.visual.iter().map(|visual| visual.geometry.as_ref());
        let collision = of
            .collision
            .iter()
            .map(|collision| collision.geometry.as_ref());
        let visual = visual
            .enumerate()
            .map(|found| (GeometryKind::Visual, found));
        let collision = collision
            .enumerate()
            .map(|found| (GeometryKind::Collision, found));
        for (geometry, (element, found)) in visual.chain(collision) {
            if let Some(Geometry::Mesh(mesh)) = found {
                named.push(Named {
                    link,
                    geometry,
                    element,
                    filename: &mesh.filename,
                });
            }
        }
    }
    named
}
