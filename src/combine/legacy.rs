//! A URDD of before version 1 as a part: its URDF names meshes by packages that are nowhere, and its
//! `original_meshes_module` holds the files of those that links show.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::error::PartFault;
use super::names::mesh_edits;
use crate::format::registry::ModuleKind;
use crate::format::urdf::Geometry;
use crate::generate::read_urdf;
use crate::xml::element::apply;

/// The text of the URDF, with the meshes that the URDD holds named where they lie, relative to `folder`.
pub(super) fn with_carried_meshes(urdf: &Path, folder: &Path) -> Result<Vec<u8>, PartFault> {
    let unreadable = |reason: String| PartFault::Unreadable {
        file: urdf.display().to_string(),
        reason,
    };
    let bytes = fs::read(urdf).map_err(|error| unreadable(error.to_string()))?;
    let robot = read_urdf(&bytes, "robot").map_err(|error| unreadable(error.to_string()))?;
    let text = String::from_utf8(robot.carried).map_err(|error| unreadable(error.to_string()))?;
    let mut places = BTreeMap::new();
    for visual in robot.robot.links.iter().flat_map(|link| &link.visual) {
        let Some(Geometry::Mesh(mesh)) = &visual.geometry else {
            continue;
        };
        let name = mesh
            .filename
            .trim()
            .rsplit(['/', '\\'])
            .next()
            .unwrap_or_default();
        let place = format!("{}/meshes/{name}", ModuleKind::OriginalMeshes.folder());
        if !name.is_empty() && folder.join(&place).is_file() {
            places.insert(mesh.filename.clone(), place);
        }
    }
    let edits = mesh_edits(&text, &places).map_err(unreadable)?;
    Ok(apply(&text, edits).into_bytes())
}
