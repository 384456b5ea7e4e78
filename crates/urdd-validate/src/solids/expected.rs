//! The mesh that a link must have by its source: the meshes and shapes of its elements, each with its origin and scale
//! (SPEC 7.8).

use nalgebra::Vector3;

use super::primitive::Primitive;
use urdd_document::robot::{Element, Link};
use urdd_document::urdd::Urdd;
use urdd_document::usable_geometry::UsableGeometry;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::urdf::Geometry;
use urdd_geometry::Mesh;
use urdd_geometry::mesh::placement;
use urdd_geometry::surface::extent;

/// The surface of a link by its source.
#[derive(Debug, Default)]
pub struct Expected {
    /// The triangles of its meshes, placed, computed in binary64.
    pub mesh: Mesh,
    /// Its other shapes.
    pub primitives: Vec<Primitive>,
    /// The largest number used in placing, m, which determines rounding.
    pub extent: f64,
}

/// The surface of a link by its elements of a kind. `original` reads a carried mesh by its path; `None` if one of their meshes is not carried or cannot be read.
pub fn of_link(
    urdd: &Urdd,
    original: &dyn Fn(&str) -> Option<Mesh>,
    usable: &UsableGeometry,
    link: usize,
    kind: GeometryKind,
) -> Option<Expected> {
    let named = urdd.robot()?.links.get(link)?;
    let mut expected = Expected::default();
    for (at, element) in named.elements(kind).iter().enumerate() {
        if !usable.is_usable(link, kind, at) {
            continue;
        }
        let Some(geometry) = &element.geometry else { continue };
        let rotation = element.origin.rotation();
        if let Some(primitive) = Primitive::new(geometry, rotation, element.origin.xyz) {
            expected.extent = expected.extent.max(primitive.extent());
            expected.primitives.push(primitive);
        } else {
            let mesh = original(&carried(urdd, named, link, kind, at)?)?;
            expected.add(mesh, element, geometry);
        }
    }
    Some(expected)
}

impl Expected {
    /// Whether the link has no geometry.
    pub fn is_empty(&self) -> bool {
        self.mesh.triangles.is_empty() && self.primitives.is_empty()
    }

    /// Adds a mesh, placed.
    fn add(&mut self, mut mesh: Mesh, element: &Element, geometry: &Geometry) {
        let scale = match geometry {
            Geometry::Mesh(mesh) => mesh.scale.unwrap_or([1.0; 3]),
            _ => [1.0; 3],
        };
        let rotation = element.origin.rotation();
        let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| rotation[(row, column)]));
        let own = extent(&mesh);
        mesh.transform(&placement(scale, rows, element.origin.xyz));
        let largest = scale.into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        self.extent = self
            .extent
            .max(own * largest)
            .max(Vector3::from(element.origin.xyz).amax())
            .max(extent(&mesh));
        self.mesh.append(&mesh);
    }
}

fn carried(
    urdd: &Urdd,
    named: &Link,
    link: usize,
    kind: GeometryKind,
    element: usize,
) -> Option<String> {
    match urdd.document(ModuleKind::OriginalMeshes)? {
        ModuleDocument::OriginalMeshes(module) => {
            let here = |r: &&urdd_format::original_meshes::MeshReference| {
                (r.link_idx.get(), r.geometry, r.element_idx.get()) == (link, kind, element)
            };
            module.references.iter().find(here)?.path.clone()
        }
        // Legacy modules list the files of a link's visual meshes under their original names.
        _ => {
            let Some(Geometry::Mesh(mesh)) = &named.visual.get(element)?.geometry else {
                return None;
            };
            let name = |path: &str| path.rsplit('/').next().map(str::to_owned);
            let meshes = urdd.meshes(ModuleKind::OriginalMeshes)?;
            let mut paths = meshes.of_link(link).flat_map(|mesh| &mesh.paths);
            let found = paths.find(|path| name(path.path) == name(&mesh.filename));
            found.map(|path| path.path.to_owned())
        }
    }
}
