//! Determines which elements of a link are usable for a mesh (SPEC 7.2).

use std::collections::HashSet;

use crate::robot::Element;
use crate::urdd::Urdd;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::urdf::Geometry;

/// The elements of a robot's links that are usable for a mesh: those with a surface. A mesh file that the URDD lacks
/// has none.
pub struct UsableGeometry<'a> {
    urdd: &'a Urdd,
    /// Link, kind and element index of meshes that are missing in the URDD or have no surface.
    lost: HashSet<(usize, GeometryKind, usize)>,
    /// Links whose visual meshes are missing in a legacy module.
    lost_legacy: HashSet<usize>,
}

impl<'a> UsableGeometry<'a> {
    /// For a URDD. Without `original_meshes_module`, all meshes count as present.
    pub fn new(urdd: &'a Urdd) -> Self {
        let mut usable = UsableGeometry { urdd, lost: HashSet::new(), lost_legacy: HashSet::new() };
        match urdd.document(ModuleKind::OriginalMeshes) {
            Some(ModuleDocument::OriginalMeshes(module)) => {
                let bare = module.files.iter().filter(|file| !file.usable);
                let bare: HashSet<&String> = bare.map(|file| &file.path).collect();
                let lost = module.references.iter().filter(|reference| {
                    reference.path.as_ref().is_none_or(|path| bare.contains(path))
                });
                usable.lost =
                    lost.map(|r| (r.link_idx.get(), r.geometry, r.element_idx.get())).collect();
            }
            _ => {
                if let Some(meshes) = urdd.meshes(ModuleKind::OriginalMeshes) {
                    let links = 0..meshes.num_links();
                    usable.lost_legacy = links.filter(|link| meshes.count(*link) == 0).collect();
                }
            }
        }
        usable
    }

    fn elements(&self, link: usize, kind: GeometryKind) -> &'a [Element] {
        let robot = self.urdd.robot();
        let link = robot.and_then(|robot| robot.links.get(link));
        link.map_or(&[], |link| link.elements(kind))
    }

    /// Whether a link has a usable element of a kind.
    pub fn has(&self, link: usize, kind: GeometryKind) -> bool {
        let count = self.elements(link, kind).len();
        (0..count).any(|element| self.is_usable(link, kind, element))
    }

    /// Whether an element of a link is usable.
    pub fn is_usable(&self, link: usize, kind: GeometryKind, element: usize) -> bool {
        let element_of = self.elements(link, kind).get(element);
        let Some(geometry) = element_of.and_then(|element| element.geometry.as_ref()) else {
            return false;
        };
        let lost = match (geometry, kind) {
            (Geometry::Mesh(_), GeometryKind::Visual) => {
                self.lost_legacy.contains(&link) || self.lost.contains(&(link, kind, element))
            }
            (Geometry::Mesh(_), _) => self.lost.contains(&(link, kind, element)),
            _ => false,
        };
        !lost && has_surface(geometry)
    }
}

/// Whether a geometry has a surface with nonzero area.
fn has_surface(geometry: &Geometry) -> bool {
    let two = |numbers: [f64; 3], extends: fn(f64) -> bool| {
        numbers.into_iter().filter(|number| extends(*number)).count() >= 2
    };
    match geometry {
        Geometry::Mesh(mesh) => two(mesh.scale.unwrap_or([1.0; 3]), |factor| factor != 0.0),
        Geometry::Box(cuboid) => {
            two(cuboid.size, |side| side > 0.0) && cuboid.size.iter().all(|side| *side >= 0.0)
        }
        Geometry::Cylinder(cylinder) => cylinder.radius > 0.0 && cylinder.length >= 0.0,
        Geometry::Capsule(capsule) => capsule.radius > 0.0 && capsule.length >= 0.0,
        Geometry::Sphere(sphere) => sphere.radius > 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use urdd_format::urdf::{Cuboid, Sphere};

    #[test]
    fn flat_is_enough_and_a_point_is_not() {
        let of = |size| has_surface(&Geometry::Box(Cuboid { size }));
        assert!(of([1.0, 2.0, 0.0]));
        assert!(!of([1.0, 0.0, 0.0]));
        assert!(!of([1.0, 2.0, -1.0]));
        assert!(!of([0.0; 3]));
        assert!(!has_surface(&Geometry::Sphere(Sphere { radius: 0.0 })));
    }
}
