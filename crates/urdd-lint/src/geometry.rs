//! The shapes of links.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use nalgebra::Matrix4;

use urdd_document::robot::{Element, Robot};
use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::Geometry;
use urdd_generate::{SourceMesh, SourceMeshes};
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::mesh::placement;
use urdd_geometry::primitives::{capsule, cuboid, cylinder, sphere};
use urdd_geometry::read::Scene;

/// Maximum number of vertices that are placed for one robot: it may name one large mesh very often.
const MAX_VERTICES: usize = 50_000_000;

/// The shapes of a link, each in the link's frame.
#[derive(Debug, Default)]
pub struct LinkGeometry {
    /// The shapes, visual before collision.
    pub shapes: Vec<Shape>,
    /// Whether a shape is missing: its mesh was not found or read, or there are too many vertices.
    pub is_partial: bool,
}

/// A visual or collision element's shape.
#[derive(Debug)]
pub struct Shape {
    /// Whether a visual or a collision element has it.
    pub kind: GeometryKind,
    /// Index of the element among the link's elements of that kind.
    pub element: usize,
    /// Its surface in the link's frame.
    pub mesh: Mesh,
    /// The file that it is from; `None` for a primitive.
    pub file: Option<PathBuf>,
}

impl LinkGeometry {
    /// The shapes of one kind.
    pub fn of(&self, kind: GeometryKind) -> impl Iterator<Item = &Shape> {
        self.shapes.iter().filter(move |shape| shape.kind == kind)
    }

    /// The corners of all shapes.
    pub fn points(&self) -> impl Iterator<Item = [f64; 3]> {
        let meshes = self.shapes.iter().map(|shape| &shape.mesh);
        let corners = |mesh: &Mesh| {
            mesh.triangles
                .iter()
                .flatten()
                .map(|index| *index as usize)
                .collect::<Vec<_>>()
        };
        meshes.flat_map(move |mesh| corners(mesh).into_iter().map(|index| mesh.vertices[index]))
    }

    /// The convex hull of all shapes; `None` if a shape is missing, or they span no volume.
    pub fn hull(&self) -> Option<ConvexHull> {
        if self.is_partial {
            return None;
        }
        let points: Vec<[f64; 3]> = self.points().collect();
        ConvexHull::new(&points).ok().filter(|hull| !hull.is_flat())
    }
}

/// The shapes of each link of a robot. Each mesh file is read once.
pub fn of_links(source: &SourceMeshes, robot: &Robot) -> Vec<LinkGeometry> {
    let meshes: HashMap<(usize, GeometryKind, usize), &SourceMesh> = source
        .meshes
        .iter()
        .map(|mesh| ((mesh.link, mesh.geometry, mesh.element), mesh))
        .collect();
    let mut read: HashMap<PathBuf, Option<Arc<Scene>>> = HashMap::new();
    let mut left = MAX_VERTICES;
    let mut links = Vec::with_capacity(robot.links.len());
    for (index, link) in robot.links.iter().enumerate() {
        let mut geometry = LinkGeometry::default();
        for kind in [GeometryKind::Visual, GeometryKind::Collision] {
            for (place, element) in link.elements(kind).iter().enumerate() {
                let Some(shape) = &element.geometry else {
                    continue;
                };
                let (mesh, file) = match shape {
                    Geometry::Box(of) => (Some(cuboid(of.size)), None),
                    Geometry::Cylinder(of) => (Some(cylinder(of.radius, of.length)), None),
                    Geometry::Capsule(of) => (Some(capsule(of.radius, of.length)), None),
                    Geometry::Sphere(of) => (Some(sphere(of.radius)), None),
                    Geometry::Mesh(_) => {
                        let named = meshes.get(&(index, kind, place));
                        let file = named.and_then(|mesh| mesh.file.as_ref().ok());
                        let scene = file.and_then(|file| {
                            let scene = read
                                .entry(file.clone())
                                .or_insert_with(|| source.read(file).ok());
                            scene.clone()
                        });
                        let merged = scene.and_then(|scene| {
                            let count = scene.parts.iter().map(|part| part.mesh.vertices.len());
                            left = left.checked_sub(count.sum())?;
                            Some(scene.merged())
                        });
                        (merged, file.cloned())
                    }
                };
                match mesh {
                    Some(mut mesh) => {
                        mesh.transform(&matrix(element));
                        geometry.shapes.push(Shape {
                            kind,
                            element: place,
                            mesh,
                            file,
                        });
                    }
                    None => geometry.is_partial = true,
                }
            }
        }
        links.push(geometry);
    }
    links
}

/// Places an element's shape in its link's frame.
fn matrix(element: &Element) -> Matrix4<f64> {
    let scale = match &element.geometry {
        Some(Geometry::Mesh(mesh)) => mesh.scale.unwrap_or([1.0; 3]),
        _ => [1.0; 3],
    };
    let rotation = element.origin.rotation();
    let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| rotation[(row, column)]));
    placement(scale, rows, element.origin.xyz)
}
