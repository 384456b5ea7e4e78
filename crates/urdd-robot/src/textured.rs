//! The textured parts of the meshes that the URDF names.

use rayon::prelude::*;

use super::Robot;
use super::error::RobotError;
use super::mesh::LinkVisual;
use urdd_directory::path::beside;
use urdd_directory::read_error::ReadError;
use urdd_document::mesh_files::{Absence, MeshFiles};
use urdd_document::robot::Element;
use urdd_document::urdd::Urdd;
use urdd_format::meshes::GeometryKind;
use urdd_format::original_meshes::MeshReference;
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};
use urdd_format::urdf::Geometry;
use urdd_geometry::mesh::placement;
use urdd_geometry::read::{Options, Part, read_with};

impl Robot {
    /// The parts with a texture of each visual element whose mesh has some, in its link's frame; [`Robot::visuals`] has the
    /// same triangles without it. The name of a texture is its path in the URDD, or that of its mesh and what is in it.
    /// Every call reads the files. Empty for a legacy URDD, and without `original_meshes_module`.
    ///
    /// # Errors
    /// If the files cannot be listed, or one changed on disk.
    pub fn textured_visuals(&self) -> Result<Vec<LinkVisual>, RobotError> {
        let kinds = [ModuleKind::OriginalMeshes, ModuleKind::Urdf];
        let part = self.part_as_it_is(&kinds)?;
        let (Some(ModuleDocument::OriginalMeshes(original)), Some(robot)) =
            (part.document(kinds[0]), part.robot())
        else {
            return Ok(Vec::new());
        };
        let visual = |reference: &MeshReference| {
            let path = reference.path.as_ref()?;
            let link = reference.link_idx.get();
            let element = robot.links.get(link)?.visual.get(reference.element_idx.get())?;
            let parts = read(&part, path).map(|parts| in_link(parts, element));
            Some(parts.transpose()?.map(|parts| LinkVisual { link, parts }))
        };
        let references = original.references.par_iter();
        let references = references.filter(|of| of.geometry == GeometryKind::Visual);
        let is_textured = |visual: &Result<LinkVisual, RobotError>| {
            visual.as_ref().map_or(true, |visual| !visual.parts.is_empty())
        };
        references.filter_map(visual).filter(is_textured).collect()
    }

    /// The bytes of a file of the URDD, if it lists it.
    ///
    /// # Errors
    /// If the files cannot be listed, or this one changed on disk.
    pub fn listed_file(&self, path: &str) -> Result<Option<Vec<u8>>, RobotError> {
        bytes(&self.part_as_it_is(&[])?, path)
    }
}

pub(super) fn bytes(part: &Urdd, path: &str) -> Result<Option<Vec<u8>>, RobotError> {
    if !part.listing().has_file(path) {
        return Ok(None);
    }
    match MeshFiles::new(part).read(Profile::V1, path) {
        Err(Absence::Other(ReadError::Changed)) => {
            Err(RobotError::Changed(part.root().folder_name()))
        }
        read => Ok(read.ok()),
    }
}

/// The parts of a mesh that have a texture.
fn read(part: &Urdd, mesh: &str) -> Result<Vec<Part>, RobotError> {
    let content = bytes(part, mesh)?.unwrap_or_default();
    // Without what names a library or an image, there is none: OBJ, COLLADA, glTF.
    let names: [&[u8]; 3] = [b"mtllib", b"init_from", b"\"images\""];
    if !names.iter().any(|name| content.windows(name.len()).any(|bytes| bytes == *name)) {
        return Ok(Vec::new());
    }
    let mut changed = None;
    let mut fetch = |named: &str| {
        let read = bytes(part, &beside(mesh, named)?);
        read.unwrap_or_else(|error| {
            changed = Some(error);
            None
        })
    };
    let options = Options { textures: true, ..Options::default() };
    let scene = read_with(&content, mesh, &mut fetch, &options);
    if let Some(error) = changed {
        return Err(error);
    }
    let mut parts = scene.map_or_else(|_| Vec::new(), |scene| scene.parts);
    parts.retain(|part| part.texture.is_some());
    for texture in parts.iter_mut().filter_map(|part| part.texture.as_mut()) {
        texture.name = match beside(mesh, &texture.name) {
            Some(path) if texture.embedded.is_none() => path,
            _ => format!("{mesh}: {}", texture.name),
        };
    }
    Ok(parts)
}

/// Puts the parts of an element's mesh into its link's frame, with coordinates of binary32.
pub(super) fn in_link(mut parts: Vec<Part>, element: &Element) -> Option<Vec<Part>> {
    let Some(Geometry::Mesh(mesh)) = &element.geometry else {
        return None;
    };
    let rotation = element.origin.rotation();
    let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| rotation[(row, column)]));
    let place = placement(mesh.scale.unwrap_or([1.0; 3]), rows, element.origin.xyz);
    for part in &mut parts {
        part.mesh.transform(&place);
        let coordinates = part.mesh.vertices.as_flattened_mut();
        coordinates.iter_mut().for_each(|of| *of = f64::from(*of as f32));
    }
    Some(parts)
}
