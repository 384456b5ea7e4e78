//! The mesh files that an export references.

use std::collections::HashMap;

use super::error::{ExportError, Note};
use super::names::FileNames;
use super::simplify::simplify_all;
use super::subject::Subject;
use urdd_geometry::Mesh;
use urdd_geometry::read::Part;
use urdd_geometry::write::{WriteError, obj, stl};

/// A mesh file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MeshFormat {
    Stl,
    Obj,
}

impl MeshFormat {
    fn ending(self) -> &'static str {
        match self {
            MeshFormat::Stl => "stl",
            MeshFormat::Obj => "obj",
        }
    }

    fn write(self, mesh: Mesh) -> Result<Vec<u8>, WriteError> {
        let part = [Part::from(mesh)];
        match self {
            MeshFormat::Stl => stl(&part),
            MeshFormat::Obj => obj(&part),
        }
    }
}

/// Files by path. Equal content shares one file.
pub(super) struct MeshFiles<'a> {
    subject: &'a Subject<'a>,
    names: FileNames,
    by_content: HashMap<Vec<u8>, String>,
}

impl<'a> MeshFiles<'a> {
    pub fn new(subject: &'a Subject<'a>) -> Self {
        MeshFiles { subject, names: FileNames::default(), by_content: HashMap::new() }
    }

    /// Adds a mesh and returns its file's path, relative to the text.
    pub fn add(
        &mut self,
        link: usize,
        what: &str,
        mesh: Mesh,
        format: MeshFormat,
    ) -> Result<String, ExportError> {
        let bytes = format
            .write(mesh)
            .map_err(|error| ExportError::Mesh { link: self.subject.links[link].clone(), error })?;
        if let Some(path) = self.by_content.get(&bytes) {
            return Ok(path.clone());
        }
        let name = self.names.of(&format!("{}_{what}", self.subject.links[link]));
        let folder = &self.subject.options.mesh_folder;
        let slash = if folder.is_empty() { "" } else { "/" };
        let path = format!("{folder}{slash}{name}.{}", format.ending());
        self.by_content.insert(bytes, path.clone());
        Ok(path)
    }

    /// All files, sorted by path.
    pub fn into_files(self) -> Vec<(String, Vec<u8>)> {
        let files = self.by_content.into_iter();
        let mut files: Vec<_> = files.map(|(bytes, path)| (path, bytes)).collect();
        files.sort();
        files
    }
}

/// Visual geometry of one colour.
pub(super) struct Look {
    pub mesh: Mesh,
    pub rgba: Option<[f64; 4]>,
}

/// The visual geometry of all links, by link, simplified where that is asked for.
pub(super) fn looks(
    subject: &Subject,
    notes: &mut Vec<Note>,
) -> Result<Vec<Vec<Look>>, ExportError> {
    let mut looks: Vec<Vec<Look>> = subject.links.iter().map(|_| Vec::new()).collect();
    if !subject.options.visuals {
        return Ok(looks);
    }
    for visual in subject.robot.visuals()? {
        let Some(of_link) = looks.get_mut(visual.link) else {
            continue;
        };
        for part in visual.parts {
            match of_link.iter_mut().find(|look| look.rgba == part.color) {
                Some(look) => look.mesh.append(&part.mesh),
                None => of_link.push(Look { mesh: part.mesh, rgba: part.color }),
            }
        }
    }
    let meshes = looks.iter_mut().flatten().map(|look| &mut look.mesh);
    notes.extend(simplify_all(meshes.collect(), subject.options.detail));
    Ok(looks)
}
