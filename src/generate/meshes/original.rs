//! `original_meshes_module` from the robot: SPEC 7.5.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rayon::prelude::*;

use super::inspect::{Inspected, inspect};
use super::layout::lay_out;
use super::package::Packages;
use super::resolve::{FoundMesh, Home, NotFound, resolve};
use crate::format::index::{ElementIdx, LinkIdx};
use crate::format::meshes::GeometryKind;
use crate::format::original_meshes::{MeshReference, OriginalMesh, OriginalMeshesModule};
use crate::format::registry::ModuleKind;
use crate::format::urdf::{Geometry, UrdfModule};
use crate::generate::note::{Note, NoteKind};
use crate::geometry::read::Scene;

/// The module, and the files that go with it.
#[derive(Debug)]
pub(crate) struct OriginalMeshes {
    pub module: OriginalMeshesModule,
    /// Each file that is carried: its path in the URDD, and where it is now.
    pub files: BTreeMap<String, PathBuf>,
    /// What each usable mesh file holds, by its path in the URDD.
    pub scenes: BTreeMap<String, Arc<Scene>>,
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
    let mut found_files: BTreeMap<&str, Result<FoundMesh, NotFound>> = BTreeMap::new();
    for mesh in &named {
        found_files
            .entry(mesh.filename)
            .or_insert_with(|| resolve(mesh.filename, urdf_folder, packages));
    }
    let files: BTreeSet<&PathBuf> = found_files.values().flatten().map(|f| &f.file).collect();
    let files: Vec<&PathBuf> = files.into_iter().collect();
    let inspected: BTreeMap<PathBuf, Inspected> = files
        .into_par_iter()
        .map(|file| (file.clone(), inspect(file)))
        .collect();
    let mut told: BTreeSet<&PathBuf> = BTreeSet::new();
    for (mesh, place) in named.iter().zip(places) {
        if known.contains_key(mesh.filename) {
            continue;
        }
        let name = mesh.filename;
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
        let found = match &found_files[name] {
            Ok(found) => found,
            Err(why) => {
                let problem = format!("mesh `{name}` was not found ({})", why.in_words());
                note(problem, "not carried; the element has no surface");
                known.insert(name, None);
                continue;
            }
        };
        if let Some(assumed) = &found.assumed {
            note(format!("mesh `{name}` is not named as files are"), assumed);
        }
        known.insert(name, Some(found.file.clone()));
        if !told.insert(&found.file) {
            continue;
        }
        let inside = &inspected[&found.file];
        for remark in &inside.remarks {
            let problem = format!("mesh `{name}`: {remark}");
            note(problem, "the rest of it is used");
        }
        if let Err(why) = &inside.scene {
            let problem = format!(
                "mesh `{name}` is not usable ({}: {why})",
                found.file.display()
            );
            note(problem, "carried as it is; the element has no surface");
        }
        for missing in &inside.missing {
            let problem = format!("mesh `{name}` names `{missing}`, which is not there");
            note(problem, "the mesh is carried without it");
        }
        for file in inside.side_files.iter().chain([&found.file]) {
            // The first mesh that brings a file along decides what it belongs to.
            homes
                .entry(file.clone())
                .or_insert_with(|| found.home.clone());
        }
    }
    let folder = ModuleKind::OriginalMeshes.folder();
    let paths: BTreeMap<PathBuf, String> = lay_out(&homes)
        .into_iter()
        .map(|(file, name)| (file, format!("{folder}/meshes/{name}")))
        .collect();
    let mut files: Vec<OriginalMesh> = inspected
        .iter()
        .map(|(file, inside)| {
            let beside = inside.side_files.iter().filter(|side| *side != file);
            let beside: BTreeSet<String> = beside.map(|file| paths[file].clone()).collect();
            OriginalMesh {
                path: paths[file].clone(),
                side_files: beside.into_iter().collect(),
                usable: inside.scene.is_ok(),
            }
        })
        .collect();
    files.sort_by(|a, b| a.path.cmp(&b.path));
    let scenes = inspected.iter().filter_map(|(file, inside)| {
        let scene = inside.scene.as_ref().ok()?;
        Some((paths[file].clone(), Arc::clone(scene)))
    });
    let scenes = scenes.collect();
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
        scenes,
        notes,
    }
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
