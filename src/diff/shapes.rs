//! The shapes of a robot's visual and collision elements: what their meshes hold, and the boxes around them.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::{Matrix3, Matrix4};

use super::mesh::{Triangles, placed_bounds, triangles, union};
use urdd_document::robot::{Element, Robot};
use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::Geometry;
use urdd_geometry::mesh::{Bounds, placement};
use urdd_geometry::read::Scene;

/// An element's place: link, kind, index among the link's elements of that kind.
pub(super) type Place = (usize, GeometryKind, usize);

/// Maximum number of vertices that are placed to find bounding boxes: a URDF may name one large mesh very often.
const MAX_PLACED_VERTICES: usize = 50_000_000;

/// The meshes and bounding boxes of a robot's elements.
#[derive(Debug, Default)]
pub(super) struct Shapes {
    /// The triangles of each mesh element, or why they could not be read.
    pub meshes: HashMap<Place, Result<Triangles, String>>,
    bounds: HashMap<Place, Bounds>,
    /// Whether some boxes were left out, because there are too many vertices.
    pub is_cut: bool,
}

impl Shapes {
    /// Says how many mesh elements could not be read, and why the first one could not; `None` if all were read.
    pub fn unread(&self) -> Option<String> {
        let unread = self.meshes.iter();
        let unread = unread.filter_map(|(place, mesh)| Some((place, mesh.as_ref().err()?)));
        let count = unread.clone().count();
        let key = |((link, kind, index), _): &(&Place, &String)| (*link, *kind, *index);
        let (_, why) = unread.min_by_key(key)?;
        Some(match count {
            1 => format!("a mesh could not be read and is compared by its name: {why}"),
            count => format!(
                "{count} meshes could not be read and are compared by their names; the first: {why}"
            ),
        })
    }

    /// The bounding box of all elements of a link of one kind, in the link's frame; `None` without shapes, or where the
    /// box of one is not known.
    pub fn bounds(&self, robot: &Robot, link: usize, kind: GeometryKind) -> Option<Bounds> {
        let elements = robot.links.get(link)?.elements(kind).iter().enumerate();
        let elements = elements.filter(|(_, element)| element.geometry.is_some());
        let boxes = elements.map(|(index, _)| self.bounds.get(&(link, kind, index)).copied());
        boxes
            .collect::<Option<Vec<Bounds>>>()?
            .into_iter()
            .reduce(union)
    }
}

/// Reads the shapes of a robot. `files` says for each mesh element which file it names, or why there is none; `read`
/// reads a file. Each file is read once, one after the other.
pub(super) fn shapes<File: Clone + Eq + std::hash::Hash>(
    robot: &Robot,
    files: Vec<(Place, Result<File, String>)>,
    read: impl Fn(&File) -> Result<Arc<Scene>, String>,
) -> Shapes {
    let mut shapes = Shapes::default();
    for (link, of) in robot.links.iter().enumerate() {
        for kind in [GeometryKind::Visual, GeometryKind::Collision] {
            for (index, element) in of.elements(kind).iter().enumerate() {
                if let Some(bounds) = primitive(element) {
                    shapes.bounds.insert((link, kind, index), bounds);
                }
            }
        }
    }
    let mut order: Vec<File> = Vec::new();
    let mut places: HashMap<File, Vec<Place>> = HashMap::new();
    for (place, file) in files {
        match file {
            Err(why) => {
                shapes.meshes.insert(place, Err(why));
            }
            Ok(file) => {
                let places = places.entry(file.clone()).or_default();
                if places.is_empty() {
                    order.push(file);
                }
                places.push(place);
            }
        }
    }
    let mut left = MAX_PLACED_VERTICES;
    for file in &order {
        let scene = read(file);
        let found = scene
            .as_ref()
            .map(|scene| triangles(scene))
            .map_err(Clone::clone);
        for place in places.remove(file).unwrap_or_default() {
            shapes.meshes.insert(place, found.clone());
            let (Ok(scene), Some(matrix)) = (&scene, mesh_placement(robot, place)) else {
                continue;
            };
            let vertices = scene.parts.iter().map(|part| part.mesh.vertices.len());
            match left.checked_sub(vertices.sum()) {
                Some(rest) => left = rest,
                None => {
                    shapes.is_cut = true;
                    continue;
                }
            }
            if let Some(bounds) = placed_bounds(scene, &matrix) {
                shapes.bounds.insert(place, bounds);
            }
        }
    }
    shapes
}

fn mesh_placement(robot: &Robot, (link, kind, index): Place) -> Option<Matrix4<f64>> {
    let element = robot.links.get(link)?.elements(kind).get(index)?;
    let Some(Geometry::Mesh(mesh)) = &element.geometry else {
        return None;
    };
    let rotation = element.origin.rotation();
    let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| rotation[(row, column)]));
    Some(placement(
        mesh.scale.unwrap_or([1.0; 3]),
        rows,
        element.origin.xyz,
    ))
}

/// The box around a primitive, in the link's frame.
fn primitive(element: &Element) -> Option<Bounds> {
    let rotation = element.origin.rotation();
    let round = |radius: f64, half: f64| {
        // A disk with normal n reaches radius * sqrt(1 - n_i²) along axis i.
        let normal = rotation.column(2).into_owned();
        [0, 1, 2].map(|axis| {
            let n: f64 = normal[axis];
            (n * half).abs() + radius * (1.0 - n * n).max(0.0).sqrt()
        })
    };
    let half = match element.geometry.as_ref()? {
        Geometry::Mesh(_) => return None,
        Geometry::Box(of) => of_box(&rotation, of.size.map(|side| side.abs() / 2.0)),
        Geometry::Sphere(of) => [of.radius; 3],
        Geometry::Cylinder(of) => round(of.radius, of.length / 2.0),
        Geometry::Capsule(of) => {
            let along = [0, 1, 2].map(|axis: usize| (rotation[(axis, 2)] * of.length / 2.0).abs());
            along.map(|along| along + of.radius)
        }
    };
    let centre = element.origin.xyz;
    let bounds = Bounds {
        min: [0, 1, 2].map(|axis| centre[axis] - half[axis]),
        max: [0, 1, 2].map(|axis| centre[axis] + half[axis]),
    };
    let finite = bounds.min.iter().chain(&bounds.max).all(|x| x.is_finite());
    finite.then_some(bounds)
}

fn of_box(rotation: &Matrix3<f64>, half: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|row| {
        let reach = |column: usize| (rotation[(row, column)] * half[column]).abs();
        reach(0) + reach(1) + reach(2)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use urdd_document::robot::Origin;
    use urdd_format::urdf::{Capsule, Cuboid, Cylinder, Sphere};
    use urdd_geometry::primitives;

    /// The boxes agree with those of tessellated shapes, up to the tessellation.
    #[test]
    fn boxes_of_primitives_hold_their_surfaces() {
        for (geometry, mesh) in [
            (
                Geometry::Box(Cuboid {
                    size: [0.2, 0.4, 0.6],
                }),
                primitives::cuboid([0.2, 0.4, 0.6]),
            ),
            (
                Geometry::Cylinder(Cylinder {
                    radius: 0.3,
                    length: 0.5,
                }),
                primitives::cylinder(0.3, 0.5),
            ),
            (
                Geometry::Capsule(Capsule {
                    radius: 0.3,
                    length: 0.5,
                }),
                primitives::capsule(0.3, 0.5),
            ),
            (
                Geometry::Sphere(Sphere { radius: 0.3 }),
                primitives::sphere(0.3),
            ),
        ] {
            let element = Element {
                geometry: Some(geometry),
                origin: Origin {
                    xyz: [1.0, -2.0, 3.0],
                    rpy: [0.3, -1.1, 2.0],
                    quat_xyzw: None,
                },
            };
            let rotation = element.origin.rotation();
            let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| rotation[(row, column)]));
            let mut placed = mesh;
            placed.transform(&placement([1.0; 3], rows, element.origin.xyz));
            let (found, expected) = (primitive(&element).unwrap(), placed.bounds().unwrap());
            for axis in 0..3 {
                let below = expected.min[axis] - found.min[axis];
                let above = found.max[axis] - expected.max[axis];
                assert!((-1e-12..0.004).contains(&below), "{found:?} {expected:?}");
                assert!((-1e-12..0.004).contains(&above), "{found:?} {expected:?}");
            }
        }
    }
}
