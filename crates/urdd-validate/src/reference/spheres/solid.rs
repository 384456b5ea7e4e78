//! A convex piece as its triangles, for distances of points.

use nalgebra::Vector3;

use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::surface::distinct;

/// A triangle and its plane.
#[derive(Debug, Clone)]
struct Face {
    corners: [Vector3<f64>; 3],
    /// Outward, of unit length.
    normal: Vector3<f64>,
    offset: f64,
}

/// The hull of a piece's vertices.
#[derive(Debug, Clone)]
pub struct Solid {
    faces: Vec<Face>,
    /// The vertices of the piece.
    pub vertices: Vec<Vector3<f64>>,
    /// The middle of the box around the vertices, and the distance of the farthest of them from it, m.
    pub centre: Vector3<f64>,
    pub radius: f64,
    is_flat: bool,
}

impl Solid {
    /// For a mesh; `None` if its vertices have no hull.
    pub fn new(mesh: &Mesh) -> Option<Self> {
        let vertices = distinct(mesh);
        let hull = ConvexHull::new(&vertices).ok()?;
        let of_hull = hull.mesh();
        let faces = of_hull.triangles.iter().filter_map(|triangle| {
            let corners = of_hull.corners(*triangle).map(Vector3::from);
            let normal = normal(&corners)?;
            Some(Face { corners, normal, offset: normal.dot(&corners[0]) })
        });
        let faces: Vec<Face> = faces.collect();
        let vertices: Vec<Vector3<f64>> = vertices.into_iter().map(Vector3::from).collect();
        let first = *vertices.first()?;
        let low = vertices.iter().fold(first, |low, vertex| low.inf(vertex));
        let high = vertices.iter().fold(first, |high, vertex| high.sup(vertex));
        let centre = (low + high) / 2.0;
        let radius = vertices.iter().map(|vertex| (vertex - centre).norm()).fold(0.0, f64::max);
        Some(Solid { faces, vertices, centre, radius, is_flat: hull.is_flat() })
    }

    /// The corners of its triangles.
    pub fn triangles(&self) -> impl Iterator<Item = [Vector3<f64>; 3]> {
        self.faces.iter().map(|face| face.corners)
    }

    /// Number of triangles.
    pub fn num_triangles(&self) -> usize {
        self.faces.len()
    }

    /// The distance of a point, 0 inside, where it is less than `limit`; otherwise `limit` or more. Only faces that the point
    /// is before can be nearest, and no point of a face is nearer than its plane.
    pub fn distance(&self, point: &Vector3<f64>, limit: f64) -> f64 {
        if (point - self.centre).norm() - self.radius >= limit {
            return limit;
        }
        let height = |face: &Face| face.normal.dot(point) - face.offset;
        let highest = self.faces.iter().map(height).fold(f64::NEG_INFINITY, f64::max);
        if highest >= limit {
            return limit;
        }
        if highest <= 0.0 && !self.is_flat {
            return 0.0;
        }
        let mut nearest = limit;
        for face in &self.faces {
            let height = height(face);
            if self.is_flat || (height > 0.0 && height < nearest) {
                nearest = nearest.min(to_triangle(point, &face.corners));
            }
        }
        nearest
    }
}

/// The unit normal of a triangle; `None` without an area.
pub fn normal([a, b, c]: &[Vector3<f64>; 3]) -> Option<Vector3<f64>> {
    (b - a).cross(&(c - a)).try_normalize(0.0)
}

/// The distance of a point from a triangle.
pub fn to_triangle(point: &Vector3<f64>, corners: &[Vector3<f64>; 3]) -> f64 {
    let [a, b, c] = corners;
    let edges = [(a, b), (b, c), (c, a)];
    if let Some(normal) = normal(corners) {
        let is_inside = |(from, to): &(&Vector3<f64>, &Vector3<f64>)| {
            normal.dot(&(*to - *from).cross(&(point - *from))) >= 0.0
        };
        if edges.iter().all(is_inside) {
            return normal.dot(&(point - a)).abs();
        }
    }
    let to_edge = |(from, to): (&Vector3<f64>, &Vector3<f64>)| {
        let way = to - from;
        let along = (point - from).dot(&way) / way.norm_squared();
        let along = if along > 0.0 { along.min(1.0) } else { 0.0 };
        (point - from - way * along).norm()
    };
    edges.into_iter().map(to_edge).fold(f64::INFINITY, f64::min)
}
