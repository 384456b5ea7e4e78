//! The surface that a link must have by its source: the meshes and shapes of its elements, each with its origin and scale
//! (SPEC 7.8), and the true surfaces of shapes, to compare tessellated ones with.

use nalgebra::{Matrix3, Vector3};

use urdd_document::robot::{Element, Link};
use urdd_document::urdd::Urdd;
use urdd_document::usable_geometry::UsableGeometry;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::urdf::Geometry;
use urdd_geometry::Mesh;
use urdd_geometry::mesh::placement;
use urdd_geometry::primitives::Primitive as Shape;
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

/// A box, cylinder, capsule or sphere somewhere in a link's frame.
#[derive(Debug, Clone)]
pub struct Primitive {
    shape: Shape,
    rotation: Matrix3<f64>,
    position: Vector3<f64>,
}

impl Primitive {
    /// For a geometry that is not a mesh.
    pub fn new(geometry: &Geometry, rotation: Matrix3<f64>, position: [f64; 3]) -> Option<Self> {
        let shape = match geometry {
            Geometry::Mesh(_) => return None,
            Geometry::Box(of) => Shape::Box(of.size.map(|side| side / 2.0)),
            Geometry::Cylinder(of) => Shape::Cylinder { radius: of.radius, half: of.length / 2.0 },
            Geometry::Capsule(of) => Shape::Capsule { radius: of.radius, half: of.length / 2.0 },
            Geometry::Sphere(of) => Shape::Sphere { radius: of.radius },
        };
        Some(Primitive { shape, rotation, position: Vector3::from(position) })
    }

    /// Distance of a point in the link's frame from the surface, m; negative inside.
    pub fn distance(&self, point: [f64; 3]) -> f64 {
        let p = self.rotation.transpose() * (Vector3::from(point) - self.position);
        // A box; a cylinder is one too in the half-plane through its axis.
        let boxed = |q: &[f64]| {
            let outside = q.iter().map(|x| x.max(0.0).powi(2)).sum::<f64>().sqrt();
            outside + q.iter().copied().fold(f64::NEG_INFINITY, f64::max).min(0.0)
        };
        let radial = p.x.hypot(p.y);
        match self.shape {
            Shape::Box(half) => boxed((p.abs() - Vector3::from(half)).as_slice()),
            Shape::Cylinder { radius, half } => boxed(&[radial - radius, p.z.abs() - half]),
            Shape::Capsule { radius, half } => radial.hypot((p.z.abs() - half).max(0.0)) - radius,
            Shape::Sphere { radius } => p.norm() - radius,
        }
    }

    /// Whether a triangle with its corners on the surface, within `rounding` m, faces outward. True for flat shapes and
    /// for shapes without area.
    pub fn faces_outward(&self, [a, b, c]: [Vector3<f64>; 3], rounding: f64) -> bool {
        let normal = (b - a).cross(&(c - a));
        let doubled = normal.norm();
        if doubled == 0.0 {
            return true;
        }
        // All shapes are convex with their centre inside, which is behind each face.
        let lever = (a + b + c) / 3.0 - self.position;
        let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        // Corners within the rounding tilt the normal by at most the rounding over the smallest height.
        let turn = rounding * longest / doubled;
        normal.dot(&lever) / doubled >= -(rounding + turn * lever.norm())
    }

    /// The area of the true surface, m².
    pub fn area(&self) -> f64 {
        use std::f64::consts::PI;
        match self.shape {
            Shape::Box([x, y, z]) => 8.0 * (x * y + y * z + z * x),
            Shape::Cylinder { radius, half } => 2.0 * PI * radius * (radius + 2.0 * half),
            Shape::Capsule { radius, half } => 4.0 * PI * radius * (radius + half),
            Shape::Sphere { radius } => 4.0 * PI * radius * radius,
        }
    }

    /// Maximum distance of a flat face inside the true surface, m, given the allowed fraction of the radius.
    pub fn sag(&self, of_radius: f64) -> f64 {
        match self.shape {
            Shape::Box(_) => 0.0,
            Shape::Cylinder { radius, .. }
            | Shape::Capsule { radius, .. }
            | Shape::Sphere { radius } => radius * of_radius,
        }
    }

    /// The largest depth of a triangle inside the surface, m, if its corners are on the surface. Spheres are deepest
    /// nearest to their centre, which is inside the triangle or at the middle of an edge; sides of cylinders at the
    /// middle of an edge across them.
    pub fn depth(&self, [a, b, c]: [Vector3<f64>; 3]) -> f64 {
        let normal = (b - a).cross(&(c - a));
        let nearest = |p: Vector3<f64>| p - normal * ((p - a).dot(&normal) / normal.norm_squared());
        let mut places = vec![(a + b + c) / 3.0, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
        if let Shape::Sphere { .. } | Shape::Capsule { .. } = self.shape {
            let half = match self.shape {
                Shape::Capsule { half, .. } => self.rotation * Vector3::z() * half,
                _ => Vector3::zeros(),
            };
            let centres = [self.position - half, self.position + half].map(nearest);
            let is_inside = |p: &Vector3<f64>| {
                let edges = [(a, b), (b, c), (c, a)];
                let mut sides = edges.iter().map(|(u, v)| (v - u).cross(&(p - u)).dot(&normal));
                sides.all(|side| side >= 0.0)
            };
            places.extend(centres.into_iter().filter(is_inside));
        }
        let depths = places.into_iter().map(|place| -self.distance(place.into()));
        depths.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The distance of its position from the link's origin, plus its radius about its middle, m (SPEC 7.6.1).
    pub fn extent(&self) -> f64 {
        let size = match self.shape {
            Shape::Box(half) => Vector3::from(half).norm(),
            Shape::Cylinder { radius, half } => radius.hypot(half),
            Shape::Capsule { radius, half } => radius + half,
            Shape::Sphere { radius } => radius,
        };
        self.position.norm() + size
    }

    pub fn name(&self) -> &'static str {
        match self.shape {
            Shape::Box(_) => "box",
            Shape::Cylinder { .. } => "cylinder",
            Shape::Capsule { .. } => "capsule",
            Shape::Sphere { .. } => "sphere",
        }
    }
}
