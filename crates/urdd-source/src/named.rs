//! The mesh files that a robot names.

use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::{Geometry, UrdfModule};

/// A mesh reference in the URDF.
pub struct NamedMesh<'a> {
    /// Index of the link.
    pub link: usize,
    /// Whether a visual or a collision element names it.
    pub geometry: GeometryKind,
    /// Index of the element among the link's elements of that kind.
    pub element: usize,
    /// The name as the URDF has it.
    pub filename: &'a str,
}

/// The mesh references of a robot: links in order, visual before collision, elements in order.
pub fn named(robot: &UrdfModule) -> Vec<NamedMesh<'_>> {
    let mut named = Vec::new();
    for (link, of) in robot.links.iter().enumerate() {
        let visual = of.visual.iter().map(|visual| visual.geometry.as_ref());
        let collision = of.collision.iter().map(|collision| collision.geometry.as_ref());
        let visual = visual.enumerate().map(|found| (GeometryKind::Visual, found));
        let collision = collision.enumerate().map(|found| (GeometryKind::Collision, found));
        for (geometry, (element, found)) in visual.chain(collision) {
            if let Some(Geometry::Mesh(mesh)) = found {
                named.push(NamedMesh { link, geometry, element, filename: &mesh.filename });
            }
        }
    }
    named
}
