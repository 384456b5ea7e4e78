//! `original_meshes_module` from the robot: SPEC 7.5.
//!
//! Files keep their relative positions, so that references in a mesh to other files remain valid. Files of a package
//! keep their paths, below `meshes/<package>/`. Files around the URDF are stored in `meshes/`, relative to their
//! deepest common folder. Files in other folders are stored in `meshes/outside_<n>/`. Nothing of a path above these
//! folders gets into a URDD.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use rayon::prelude::*;

use crate::context::Context;
use crate::error::{GenerateError, OutsideMesh, Result};
use crate::made::{Made, MadeFile, made_with};
use urdd_directory::path::portable;
use urdd_format::index::{ElementIdx, LinkIdx};
use urdd_format::original_meshes::{MeshReference, OriginalMesh, OriginalMeshesModule};
use urdd_format::registry::ModuleKind;
use urdd_geometry::read::Scene;
use urdd_source::gate::Gate;
use urdd_source::note::{Note, NoteKind, SourcePlace};
use urdd_source::{FoundMesh, Inspected, NotFound, Place, mesh_files, named};

/// The module, and what later stages use.
#[derive(Debug)]
pub(crate) struct OriginalMeshes {
    pub module: OriginalMeshesModule,
    /// The content of each usable mesh file, by its path in the URDD.
    pub scenes: BTreeMap<String, Arc<Scene>>,
    pub count: MeshCount,
}

/// How many different mesh files a URDF references, and how many of them have no usable surface.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct MeshCount {
    /// Number of different mesh file names.
    pub named: usize,
    /// Names for which no file was found, or whose file is not a mesh.
    pub not_found: usize,
    /// Of these, the names whose file is there, but is empty or not a mesh.
    pub not_a_mesh: usize,
    /// Names whose file is stored but not usable.
    pub not_usable: usize,
}

/// Builds the module.
/// Fails if the URDF references files that it must not make the user publish.
pub(crate) fn original_meshes(context: &Context) -> Result<Made<OriginalMeshes>> {
    let Context { source, settings, progress, .. } = *context;
    let named = named(&source.reading.robot);
    let gate = Gate::new(&source.folder, &settings.source);
    let found_files = mesh_files(source, &gate)?;
    // The distinct names in the order of the URDF, each with its first position.
    let mut names: Vec<(&str, &SourcePlace)> = Vec::new();
    let mut seen = BTreeSet::new();
    for (mesh, place) in named.iter().zip(&source.mesh_places) {
        if seen.insert(mesh.filename) {
            names.push((mesh.filename, place));
        }
    }
    refuse_outside(&source.shown, &names, &found_files)?;
    let found: BTreeMap<&PathBuf, &FoundMesh> =
        found_files.values().flatten().map(|found| (&found.file, found)).collect();
    let found: Vec<_> = found.into_iter().collect();
    let inspected: BTreeMap<PathBuf, Inspected> = found
        .into_par_iter()
        .map(|(file, found)| {
            progress.reads(file);
            let inside = gate.mesh(found);
            for side in inside.side_files.keys() {
                progress.reads(side);
            }
            (file.clone(), inside)
        })
        .collect();
    let missing = found_files.values().filter_map(|found| found.as_ref().err());
    for tried in missing.flat_map(|why| &why.tried) {
        progress.reads(Path::new(tried));
    }

    let mut notes = Notes { gate: &gate, said: BTreeSet::new(), notes: Vec::new() };
    let mut count = MeshCount { named: names.len(), ..MeshCount::default() };
    let mut carried = Vec::new();
    for (name, place) in &names {
        let found = match &found_files[name] {
            Ok(found) => found,
            Err(why) => {
                count.not_found += 1;
                notes.not_found(name, place, why);
                continue;
            }
        };
        let inside = &inspected[&found.file];
        match (&inside.bytes, &inside.scene) {
            (None, _) => {
                count.not_found += 1;
                count.not_a_mesh += 1;
            }
            (Some(_), Err(_)) => count.not_usable += 1,
            (Some(_), Ok(_)) => {}
        }
        notes.found(name, place, found, inside);
        if inside.bytes.is_some() {
            let side_files =
                inside.side_files.iter().map(|(path, side)| (path.as_path(), &side.place));
            let mesh = found.file.as_path();
            let files = side_files.chain([(mesh, &found.place)]);
            carried.extend(files.map(|(file, place)| (file, place, mesh)));
        }
    }
    let layout = Layout::new(carried.into_iter());
    let folder = ModuleKind::OriginalMeshes.folder();
    let path = |file: &Path| Some(format!("{folder}/meshes/{}", layout.name(file)?));

    let (mut meshes, mut files, mut scenes) = (Vec::new(), BTreeMap::new(), BTreeMap::new());
    for (file, inside) in &inspected {
        let (Some(bytes), Some(mesh_path)) = (&inside.bytes, path(file)) else { continue };
        let mut side_files = BTreeSet::new();
        for (side, content) in inside.side_files.iter().filter(|(side, _)| *side != file) {
            if let Some(path) = path(side) {
                files.insert(path.clone(), Arc::clone(&content.bytes));
                side_files.insert(path);
            }
        }
        files.insert(mesh_path.clone(), Arc::clone(bytes));
        if let Ok(scene) = &inside.scene {
            scenes.insert(mesh_path.clone(), Arc::clone(scene));
        }
        meshes.push(OriginalMesh {
            path: mesh_path,
            side_files: side_files.into_iter().collect(),
            usable: inside.scene.is_ok(),
        });
    }
    meshes.sort_by(|a, b| a.path.cmp(&b.path));
    let references = named.iter().map(|mesh| MeshReference {
        link_idx: LinkIdx(mesh.link as u32),
        geometry: mesh.geometry,
        element_idx: ElementIdx(mesh.element as u32),
        filename: mesh.filename.to_owned(),
        path: found_files[mesh.filename].as_ref().ok().and_then(|found| path(&found.file)),
    });
    let module = OriginalMeshesModule { references: references.collect(), files: meshes };
    let files = files.into_iter().map(|(path, bytes)| MadeFile { path, bytes }).collect();
    let Made { document, files, .. } = made_with(&module, files, ())?;
    let product = OriginalMeshes { module, scenes, count };
    Ok(Made { document, files, notes: notes.notes, product })
}

/// Refuses a robot that references files outside the folders from which they may be read.
fn refuse_outside(
    file: &str,
    names: &[(&str, &SourcePlace)],
    found: &BTreeMap<&str, Result<FoundMesh, NotFound>>,
) -> Result<()> {
    let outside = names.iter().filter_map(|(name, place)| {
        let path = found[name].as_ref().err()?.outside.clone()?;
        Some(OutsideMesh { place: (*place).clone(), name: (*name).to_owned(), path })
    });
    let meshes: Vec<OutsideMesh> = outside.collect();
    if meshes.is_empty() {
        return Ok(());
    }
    Err(GenerateError::Outside { file: file.to_owned(), meshes })
}

struct Notes<'a> {
    gate: &'a Gate,
    /// Files whose notes are complete.
    said: BTreeSet<&'a Path>,
    notes: Vec<Note>,
}

impl<'a> Notes<'a> {
    fn note(&mut self, kind: NoteKind, place: &SourcePlace, problem: String, assumed: &str) {
        self.notes.push(Note {
            kind,
            file: place.file.clone(),
            line: place.line,
            column: place.column,
            problem,
            assumed: assumed.to_owned(),
        });
    }

    fn not_found(&mut self, name: &str, place: &SourcePlace, why: &NotFound) {
        let problem = format!("mesh `{name}` was not found ({})", why.in_words());
        let assumed = "not carried; the element has no surface";
        self.note(NoteKind::MeshNotFound, place, problem, assumed);
    }

    fn found(
        &mut self,
        name: &str,
        place: &SourcePlace,
        found: &'a FoundMesh,
        inside: &'a Inspected,
    ) {
        if let Some(assumed) = &found.assumed {
            let problem = format!("mesh `{name}` is not a plain file name");
            self.note(NoteKind::Mesh, place, problem, assumed);
        }
        if !self.said.insert(&found.file) {
            return;
        }
        for remark in &inside.remarks {
            let problem = format!("mesh `{name}`: {remark}");
            self.note(NoteKind::Mesh, place, problem, "the rest of it is used");
        }
        let path = found.file.display();
        match (&inside.bytes, &inside.scene) {
            (Some(_), Ok(_)) => {}
            (Some(_), Err(why)) => {
                let problem = format!("mesh `{name}` is not usable ({path}: {why})");
                let assumed = "carried as it is; the element has no surface";
                self.note(NoteKind::MeshNotUsable, place, problem, assumed);
            }
            (None, why) => {
                let why = why.as_ref().err().map_or("", String::as_str);
                let problem = format!("mesh `{name}` is not a mesh ({path}: {why})");
                let assumed = "not carried; the element has no surface";
                self.note(NoteKind::MeshNotFound, place, problem, assumed);
                return;
            }
        }
        for (side, why) in &inside.left_out {
            let problem = format!("mesh `{name}` refers to `{side}`, {why}");
            self.note(NoteKind::Mesh, place, problem, "the mesh is carried without it");
        }
        self.outside(format!("mesh `{name}`"), place, &found.file, &found.place);
        for (file, side) in &inside.side_files {
            let side_name = file.file_name().unwrap_or_default().to_string_lossy();
            let what = format!("`{side_name}`, which mesh `{name}` refers to,");
            self.outside(what, place, file, &side.place);
        }
    }

    /// Notes a stored file that is outside the robot's own folder.
    fn outside(&mut self, what: String, place: &SourcePlace, file: &Path, of: &Place) {
        let Some(why) = self.gate.elsewhere(file, of) else { return };
        let assumed = format!("carried, {why}");
        let path = file.display();
        let problem = format!("{what} is outside of the URDF's folder and package, at {path}");
        self.note(NoteKind::Outside, place, problem, &assumed);
    }
}

/// File names relative to `meshes/`, with forward slashes.
struct Layout {
    names: BTreeMap<PathBuf, String>,
}

/// The group of files that are stored together.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    Package(String, PathBuf),
    Own,
    /// The n-th folder with a mesh among those that the user allowed, in the order of the URDF.
    Outside(usize),
}

impl Layout {
    /// Takes the files in the order of the URDF, each with its place and the mesh that it belongs to.
    pub(crate) fn new<'a>(files: impl Iterator<Item = (&'a Path, &'a Place, &'a Path)>) -> Self {
        let mut groups: BTreeMap<Group, Vec<&Path>> = BTreeMap::new();
        let mut outside: Vec<&Path> = Vec::new();
        let mut seen = BTreeSet::new();
        for (file, place, mesh) in files {
            // A file belongs to the group of the first mesh that references it.
            if !seen.insert(file) {
                continue;
            }
            let group = match place {
                Place::Package(name, folder) => Group::Package(name.clone(), folder.clone()),
                Place::Own => Group::Own,
                Place::Allowed => {
                    let folder = mesh.parent().unwrap_or(mesh);
                    let known = outside.iter().position(|known| *known == folder);
                    Group::Outside(known.unwrap_or_else(|| {
                        outside.push(folder);
                        outside.len() - 1
                    }))
                }
            };
            groups.entry(group).or_default().push(file);
        }
        let mut taken = BTreeSet::new();
        let mut names = BTreeMap::new();
        for (group, files) in groups {
            let (folder, base) = match group {
                Group::Package(name, base) => (Some(portable(&name)), base),
                Group::Own => (None, common_folder(&files)),
                Group::Outside(idx) => {
                    let meshes = outside[idx];
                    let common = common_folder(&files);
                    // The path may reveal the mesh's folder and its parent, but no more.
                    let near = meshes.parent().filter(|near| near.parent().is_some());
                    let is_near = near.is_some_and(|near| common.starts_with(near));
                    let base = if is_near { common } else { meshes.to_owned() };
                    (Some(format!("outside_{}", idx + 1)), base)
                }
            };
            for file in files {
                // A file outside the base folder keeps only its file name.
                let name = Path::new(file.file_name().unwrap_or_default());
                let inside = file.strip_prefix(&base).unwrap_or(name);
                let parts = inside.components().filter_map(|component| match component {
                    Component::Normal(name) => Some(portable(&name.to_string_lossy())),
                    _ => None,
                });
                let parts: Vec<String> = folder.iter().cloned().chain(parts).collect();
                names.insert(file.to_owned(), unique(parts, &mut taken));
            }
        }
        Layout { names }
    }

    pub(crate) fn name(&self, file: &Path) -> Option<&str> {
        self.names.get(file).map(String::as_str)
    }
}

/// The deepest folder that contains all of the files.
pub(crate) fn common_folder(files: &[&Path]) -> PathBuf {
    let mut folders = files.iter().filter_map(|file| file.parent());
    let mut common = folders.next().map(Path::to_owned).unwrap_or_default();
    for folder in folders {
        while !folder.starts_with(&common) && common.pop() {}
    }
    common
}

/// A path that is unique regardless of case: some file systems ignore case.
fn unique(parts: Vec<String>, taken: &mut BTreeSet<String>) -> String {
    let path = parts.join("/");
    let mut candidate = path.clone();
    let mut number = 2;
    while !taken.insert(candidate.to_lowercase()) {
        let (folder, name) = match path.rsplit_once('/') {
            Some((folder, name)) => (format!("{folder}/"), name),
            None => (String::new(), path.as_str()),
        };
        candidate = match name.rsplit_once('.') {
            Some((stem, extension)) => format!("{folder}{stem}_{number}.{extension}"),
            None => format!("{folder}{name}_{number}"),
        };
        number += 1;
    }
    candidate
}
