//! The shapes of a robot's visual and collision elements: what their meshes hold, and the boxes around them.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::Matrix4;
use sha2::{Digest, Sha256};

use urdd_document::robot::{Element, Robot};
use urdd_format::hexadecimal::hexadecimal;
use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::{self, Geometry};
use urdd_geometry::Mesh;
use urdd_geometry::mesh::{Bounds, placement};
use urdd_geometry::primitives::Primitive;
use urdd_geometry::read::Scene;

/// An element's place: link, kind, index among the link's elements of that kind.
pub type Place = (usize, GeometryKind, usize);

/// Maximum number of vertices that are placed to find bounding boxes: a URDF may name one large mesh very often.
const MAX_PLACED_VERTICES: usize = 50_000_000;

#[derive(Debug, Default)]
pub struct Shapes {
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
        boxes.collect::<Option<Vec<Bounds>>>()?.into_iter().reduce(union)
    }
}

/// The visual and collision elements of all links, visual before collision in each.
pub fn elements(robot: &Robot) -> impl Iterator<Item = (Place, &Element)> {
    robot.links.iter().enumerate().flat_map(|(link, of)| {
        [GeometryKind::Visual, GeometryKind::Collision].into_iter().flat_map(move |kind| {
            let all = of.elements(kind).iter().enumerate();
            all.map(move |(index, element)| ((link, kind, index), element))
        })
    })
}

/// Reads the shapes of a robot. `files` says for each mesh element which file it names, or why there is none; `read`
/// reads a file. Each file is read once, one after the other.
pub fn shapes<File: Clone + Eq + std::hash::Hash>(
    robot: &Robot,
    files: Vec<(Place, Result<File, String>)>,
    read: impl Fn(&File) -> Result<Arc<Scene>, String>,
) -> Shapes {
    let mut shapes = Shapes::default();
    let primitives = elements(robot);
    let primitives = primitives.filter_map(|(place, element)| Some((place, primitive(element)?)));
    shapes.bounds.extend(primitives);
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
        let found = scene.as_ref().map(|scene| triangles(scene)).map_err(Clone::clone);
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

fn mesh_placement(robot: &Robot, place: Place) -> Option<Matrix4<f64>> {
    let (element, mesh) = mesh_at(robot, place)?;
    let rotation = element.origin.rotation();
    let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| rotation[(row, column)]));
    Some(placement(mesh.scale.unwrap_or([1.0; 3]), rows, element.origin.xyz))
}

/// The element at a place and its mesh; `None` if it has none.
pub fn mesh_at(robot: &Robot, (link, kind, index): Place) -> Option<(&Element, &urdf::Mesh)> {
    let element = robot.links.get(link)?.elements(kind).get(index)?;
    match &element.geometry {
        Some(Geometry::Mesh(mesh)) => Some((element, mesh)),
        _ => None,
    }
}

/// The box around a primitive, in the link's frame.
fn primitive(element: &Element) -> Option<Bounds> {
    let shape = match element.geometry.as_ref()? {
        Geometry::Mesh(_) => return None,
        Geometry::Box(of) => Primitive::Box(of.size.map(|side| side / 2.0)),
        Geometry::Cylinder(of) => Primitive::Cylinder { radius: of.radius, half: of.length / 2.0 },
        Geometry::Capsule(of) => Primitive::Capsule { radius: of.radius, half: of.length / 2.0 },
        Geometry::Sphere(of) => Primitive::Sphere { radius: of.radius },
    };
    let half = shape.half_extents(&element.origin.rotation());
    let centre = element.origin.xyz;
    let bounds = Bounds {
        min: [0, 1, 2].map(|axis| centre[axis] - half[axis]),
        max: [0, 1, 2].map(|axis| centre[axis] + half[axis]),
    };
    let finite = bounds.min.iter().chain(&bounds.max).all(|x| x.is_finite());
    finite.then_some(bounds)
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Triangles {
    /// SHA-256 of the sorted triangles.
    pub fingerprint: String,
    pub count: usize,
}

/// Corners rounded to binary32, as bits: STL and glTF hold no more.
type Corner = [u32; 3];

/// The triangles of a scene in the file's own frame. A triangle with two equal corners has no surface and is left out.
fn triangles(scene: &Scene) -> Triangles {
    let mut all: Vec<[Corner; 3]> = Vec::with_capacity(scene.triangle_count());
    for mesh in scene.parts.iter().map(|part| &part.mesh) {
        let corners = |triangle: [u32; 3]| mesh.corners(triangle).map(rounded);
        let triangles = mesh.triangles.iter().map(|triangle| corners(*triangle));
        all.extend(triangles.filter(|[a, b, c]| a != b && b != c && c != a).map(turned));
    }
    all.sort_unstable();
    let mut hash = Sha256::new();
    for triangle in &all {
        for number in triangle.as_flattened() {
            hash.update(number.to_le_bytes());
        }
    }
    Triangles { fingerprint: hexadecimal(&hash.finalize()), count: all.len() }
}

#[expect(clippy::cast_possible_truncation, reason = "files hold coordinates as binary32")]
fn rounded(corner: [f64; 3]) -> Corner {
    // Adding 0 turns -0 into 0.
    corner.map(|coordinate| (coordinate as f32 + 0.0).to_bits())
}

/// The triangle, beginning with its smallest corner. Which side is outside stays.
fn turned([a, b, c]: [Corner; 3]) -> [Corner; 3] {
    if a <= b && a <= c {
        [a, b, c]
    } else if b <= a && b <= c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// The bounding box of a scene that is placed by a matrix; `None` without triangles.
fn placed_bounds(scene: &Scene, place: &Matrix4<f64>) -> Option<Bounds> {
    let meshes = scene.parts.iter().map(|part| {
        let mut mesh =
            Mesh { vertices: part.mesh.vertices.clone(), triangles: part.mesh.triangles.clone() };
        mesh.transform(place);
        mesh.bounds()
    });
    meshes.flatten().reduce(union)
}

fn union(a: Bounds, b: Bounds) -> Bounds {
    Bounds::of([a.min, a.max, b.min, b.max])
}
