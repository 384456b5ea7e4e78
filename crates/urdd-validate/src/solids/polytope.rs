//! A mesh as the half-spaces of its faces: whether it is the closed surface of a convex body, what is outside it,
//! and where it is dented.

use nalgebra::Vector3;

use crate::tolerance::mesh_resolution;
use urdd_geometry::Mesh;
use urdd_geometry::half_spaces::{HalfSpace, HalfSpaces};
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::mesh::Bounds;
use urdd_geometry::surface::{distinct, is_thin, open_edge};

/// The half-spaces of a mesh's faces.
#[derive(Debug)]
pub struct Polytope {
    planes: HalfSpaces,
    bounds: Bounds,
    /// Resolution of its vertices, m.
    pub resolution: f64,
}

/// Why a mesh is not the surface of a convex body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NotConvex {
    /// It has no face with an area.
    Nothing,
    /// An edge is not shared by two faces of the same winding; its middle, m.
    Open([f64; 3]),
    /// The faces are oriented inward.
    Inward,
    /// A vertex is outside a face; the vertex and its distance, m.
    Vertex([f64; 3], f64),
}

/// The length of the diagonal of a box, m.
pub fn diagonal(bounds: &Bounds) -> f64 {
    (Vector3::from(bounds.max) - Vector3::from(bounds.min)).norm()
}

/// Maximum number of plane and point products for a body; beyond it, evenly spread points are used.
const MOST_PRODUCTS: usize = 400_000_000;

impl Polytope {
    /// For a mesh; `None` if no face has an area.
    pub fn new(mesh: &Mesh) -> Option<Self> {
        let bounds = mesh.bounds()?;
        let ends = bounds.min.into_iter().chain(bounds.max);
        let resolution = mesh_resolution(ends.fold(0.0, |most: f64, x| most.max(x.abs())));
        let size = diagonal(&bounds);
        let mut planes = Vec::with_capacity(mesh.triangles.len());
        for triangle in &mesh.triangles {
            let corners = mesh.corners(*triangle);
            if is_thin(corners, resolution) {
                continue;
            }
            let [a, b, c] = corners.map(Vector3::from);
            let cross = (b - a).cross(&(c - a));
            let sides = [(b - a).norm(), (c - b).norm(), (a - c).norm()];
            let height = cross.norm() / sides.into_iter().fold(0.0, f64::max);
            let normal = cross.normalize();
            planes.push(HalfSpace {
                normal: normal.into(),
                offset: normal.dot(&a).max(normal.dot(&b)).max(normal.dot(&c)),
                slack: resolution * (1.0 + size / height),
            });
        }
        Some(Polytope { planes: HalfSpaces::new(&planes)?, bounds, resolution })
    }

    /// How far outside a point is, m, by the plane that it is farthest beyond. Not positive inside, nor where it may be
    /// inside within the precision of the faces. The true distance is at least this.
    pub fn outside(&self, point: [f64; 3]) -> f64 {
        self.planes.beyond(point).max(0.0)
    }

    /// The depth of a point inside, m: its distance from the nearest face's plane. Not positive outside.
    pub fn depth(&self, point: [f64; 3]) -> f64 {
        self.planes.depth(point)
    }

    /// Whether a point is within a distance of every face's inner side.
    pub fn holds(&self, point: [f64; 3], distance: f64) -> bool {
        let near = (0..3).all(|i| {
            point[i] >= self.bounds.min[i] - distance && point[i] <= self.bounds.max[i] + distance
        });
        near && self.planes.hold(point, distance, self.resolution)
    }

    /// Number of faces.
    pub fn num_faces(&self) -> usize {
        self.planes.len()
    }
}

/// The step `n` at which every `n`th of `points` points is used, so that work with `faces` planes is bounded.
pub fn step(points: usize, faces: usize) -> usize {
    points.saturating_mul(faces).div_ceil(MOST_PRODUCTS).max(1)
}

/// Why a mesh is not the closed, outward-wound surface of a convex body; `None` if it is.
pub fn not_convex(mesh: &Mesh) -> Option<NotConvex> {
    let Some(polytope) = Polytope::new(mesh) else { return Some(NotConvex::Nothing) };
    if let Some(edge) = open_edge(mesh) {
        return Some(NotConvex::Open(edge));
    }
    let inward = mesh.signed_volume() < 0.0;
    let vertices = distinct(mesh);
    let every = step(vertices.len(), polytope.planes.len());
    let worst = vertices
        .iter()
        .step_by(every)
        .map(|vertex| (*vertex, polytope.outside(*vertex)))
        .reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    match worst {
        (_, distance) if distance <= 0.0 => None,
        _ if inward => Some(NotConvex::Inward),
        (vertex, distance) => Some(NotConvex::Vertex(vertex, distance)),
    }
}

/// How a closed surface differs from that of a convex body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dents {
    /// Number of faces towards the middle of the vertices.
    pub inward: usize,
    pub faces: usize,
    /// Largest depth of the surface inside the hull of its vertices, m.
    pub depth: f64,
    /// Its place: a vertex or the centroid of a face, m.
    pub place: [f64; 3],
}

/// The dents of a surface; `None` if its vertices have no hull. Of very many points, only some are measured.
pub fn dents(mesh: &Mesh) -> Option<Dents> {
    let vertices = distinct(mesh);
    let hull = ConvexHull::new(&vertices).ok()?.into_mesh();
    let polytope = Polytope::new(&hull)?;
    let sum: Vector3<f64> = vertices.iter().map(|p| Vector3::from(*p)).sum();
    let middle = sum / vertices.len() as f64;
    let mut dents =
        Dents { inward: 0, faces: mesh.triangles.len(), depth: 0.0, place: middle.into() };
    let mut centres = Vec::with_capacity(mesh.triangles.len());
    for triangle in &mesh.triangles {
        let [a, b, c] = mesh.corners(*triangle).map(Vector3::from);
        let centre = (a + b + c) / 3.0;
        dents.inward += usize::from((b - a).cross(&(c - a)).dot(&(centre - middle)) < 0.0);
        centres.push(centre.into());
    }
    let every = step(vertices.len() + centres.len(), polytope.num_faces());
    for place in vertices.into_iter().chain(centres).step_by(every) {
        let depth = polytope.depth(place);
        if depth > dents.depth {
            (dents.depth, dents.place) = (depth, place);
        }
    }
    Some(dents)
}
