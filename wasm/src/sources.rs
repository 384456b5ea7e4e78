//! The visual and collision elements of the URDF, with their files.

use serde_json::{Value, json};
use urdd_document::robot::Element;
use urdd_format::colors::Colors;
use urdd_format::meshes::GeometryKind;
use urdd_format::original_meshes::{MeshReference, OriginalMeshesModule};
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::urdf::Geometry;
use urdd_robot::Robot;

use crate::about::quaternion;

/// The visual and collision elements, links ascending, visual first: `link`, `geometry` (`Visual` or `Collision`),
/// `element`, `position` (m) and `quaternion_wxyz` in the link's frame, `shape` (an object of one key as in
/// `urdf_module`; null without one), `path` (of the mesh file in the URDD, or null), its `side_files`, and `rgba` of
/// the URDF's material, or null.
pub fn sources(robot: &Robot) -> Result<Value, String> {
    let read = [ModuleKind::Urdf, ModuleKind::OriginalMeshes];
    let part = robot.part_as_it_is(&read).map_err(|error| error.to_string())?;
    let Some(known) = part.robot() else {
        return Err("urdf_module is missing or cannot be read".to_owned());
    };
    let originals = match part.document(ModuleKind::OriginalMeshes) {
        Some(ModuleDocument::OriginalMeshes(module)) => Some(&**module),
        _ => None,
    };
    let description = robot.description().ok();
    let colors = description.as_ref().map(Colors::of);
    let mut found = Vec::new();
    for (link, of) in known.links.iter().enumerate() {
        let visual = of.visual.iter().enumerate();
        for (k, element) in visual {
            let mut value = one(link, GeometryKind::Visual, k, element, originals);
            let visual = description.as_ref().and_then(|urdf| urdf.links.get(link)?.visual.get(k));
            let material = visual.and_then(|visual| visual.material.as_ref());
            value["rgba"] = json!(colors.as_ref().and_then(|colors| colors.get(material)));
            found.push(value);
        }
        let collision = of.collision.iter().enumerate();
        found.extend(collision.map(|(k, e)| one(link, GeometryKind::Collision, k, e, originals)));
    }
    Ok(Value::from(found))
}

fn one(
    link: usize,
    kind: GeometryKind,
    index: usize,
    element: &Element,
    originals: Option<&OriginalMeshesModule>,
) -> Value {
    let is_own = |reference: &&MeshReference| {
        reference.link_idx.get() == link
            && reference.geometry == kind
            && reference.element_idx.get() == index
    };
    let is_mesh = matches!(element.geometry, Some(Geometry::Mesh(_)));
    let path = originals
        .filter(|_| is_mesh)
        .and_then(|module| module.references.iter().find(is_own)?.path.as_ref());
    let file = originals
        .zip(path)
        .and_then(|(module, path)| module.files.iter().find(|file| file.path == *path));
    json!({
        "link": link,
        "geometry": kind,
        "element": index,
        "position": element.origin.xyz,
        "quaternion_wxyz": quaternion(&element.origin),
        "shape": element.geometry,
        "path": path,
        "side_files": file.map_or(&[][..], |file| &file.side_files),
        "rgba": null,
    })
}
