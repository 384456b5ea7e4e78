//! How far convex shapes overlap.
//!
//! The expanding polytope algorithm (G. van den Bergen, Proximity Queries and Penetration Depth Computation on 3D Game
//! Objects, Game Developers Conference 2001): a polytope of vertices of the Minkowski difference grows by the farthest
//! vertex beyond its face that is nearest to the origin. Here it is the exact hull of these vertices, computed anew in
//! each step, so that thin shapes and parallel faces need no tolerances.

use nalgebra::{Matrix3, Vector3};

use super::across::PlacedPair;
use super::gjk::TOLERANCE;
use crate::hull::ConvexHull;

/// The least translation that separates two shapes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration {
    /// Its length, metres; 0 if the shapes touch.
    pub depth: f64,
    /// The unit vector along which the second shape moves, in the frame of the first.
    pub direction: [f64; 3],
    /// The points of the first and of the second shape that then touch, before the second moves, in the frame of the
    /// first.
    pub points: [[f64; 3]; 2],
}

/// The difference between the bounds of the depth at which a search ends, metres, and its most steps.
const EXACT: f64 = 1e-10;
const STEPS: usize = 200;

/// A vertex of the Minkowski difference, and its vertex of the first shape.
type Vertex = [Vector3<f64>; 2];

/// How far two shapes overlap; `None` if they are more than [`TOLERANCE`] apart. The depth is accurate to
/// 1e-9 m.
pub fn penetration(pair: &PlacedPair) -> Option<Penetration> {
    let [x, y, z, shift] = pair.b_in_a.map(Vector3::from);
    let turn = Matrix3::from_columns(&[x, y, z]);
    let support = |d: Vector3<f64>| -> Vertex {
        let a = pair.a.farthest(d);
        let b = turn * pair.b.farthest(turn.tr_mul(&-d)) + shift;
        [a - b, a]
    };
    let signs = [-1.0, 0.0, 1.0];
    let directions = signs.map(|x| signs.map(|y| signs.map(|z| Vector3::new(x, y, z))));
    let directions = directions.into_iter().flatten().flatten();
    let mut vertices: Vec<Vertex> =
        directions.filter(|d| *d != Vector3::zeros()).map(support).collect();
    let mut best: Option<Penetration> = None;
    for _ in 0..STEPS {
        let all: Vec<[f64; 3]> = vertices.iter().map(|[v, _]| (*v).into()).collect();
        let Ok(hull) = ConvexHull::new(&all) else {
            // A point or a segment: nothing that is inside.
            return touching(&vertices);
        };
        let face = nearest_face(&hull)?;
        let (normal, least) = (face.normal, face.distance);
        let next = support(normal);
        let depth = normal.dot(&next[0]);
        if depth < -TOLERANCE {
            return None;
        }
        let depth = depth.max(0.0);
        // The last face of those that are as near has the points.
        if best.is_none_or(|best| depth <= best.depth + EXACT) {
            let of_a = face.of_first(&vertices);
            best = Some(Penetration {
                depth,
                direction: normal.into(),
                points: [of_a, of_a - normal * depth].map(Into::into),
            });
        }
        if depth - least <= EXACT || vertices.iter().any(|[v, _]| *v == next[0]) {
            break;
        }
        vertices.push(next);
    }
    best
}

/// A triangle of the polytope.
struct Face {
    normal: Vector3<f64>,
    /// Of its plane from the origin, negative if the origin is outside.
    distance: f64,
    corners: [Vector3<f64>; 3],
}

impl Face {
    /// The shares of its corners in the point of its plane that is nearest to the origin; one is negative if the point is
    /// outside the triangle.
    fn shares(&self) -> [f64; 3] {
        let [a, b, c] = self.corners;
        let point = self.normal * self.distance;
        let area = (b - a).cross(&(c - a));
        [(b, c), (c, a), (a, b)]
            .map(|(p, q)| (p - point).cross(&(q - point)).dot(&area) / area.norm_squared())
    }

    /// The least share.
    fn inside(&self) -> f64 {
        self.shares().into_iter().fold(f64::INFINITY, f64::min)
    }

    /// The point of the first shape for the point that is nearest to the origin.
    fn of_first(&self, vertices: &[Vertex]) -> Vector3<f64> {
        let shares = self.shares().map(|share| share.max(0.0));
        let sum: f64 = shares.iter().sum();
        let each = self.corners.iter().zip(shares).map(|(corner, share)| {
            let known = vertices.iter().find(|[v, _]| v == corner);
            known.map_or(Vector3::zeros(), |[_, a]| *a) * (share / sum)
        });
        each.sum()
    }
}

/// The face whose plane is nearest to the origin, or farthest on the wrong side of it. Of the triangles of one plane, the
/// one with the point that is nearest.
fn nearest_face(hull: &ConvexHull) -> Option<Face> {
    let mesh = hull.mesh();
    let faces = mesh.triangles.iter().filter_map(|triangle| {
        let corners = triangle.map(|k| Vector3::from(mesh.vertices[k as usize]));
        let [a, b, c] = corners;
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
        Some(Face { normal, distance: normal.dot(&a), corners })
    });
    let faces: Vec<Face> = faces.collect();
    let least = faces.iter().map(|face| face.distance);
    let most = least.fold(f64::INFINITY, f64::min) + 0.1 * EXACT;
    let nearest = faces.into_iter().filter(|face| face.distance <= most);
    nearest.max_by(|a, b| a.inside().total_cmp(&b.inside()))
}

/// Shapes whose Minkowski difference is a point or a segment, which has no inside: they touch, and come apart along any
/// normal of it. `None` if they are apart.
fn touching(vertices: &[Vertex]) -> Option<Penetration> {
    let [first, of_a] = *vertices.first()?;
    let along = vertices.iter().map(|[v, _]| v - first);
    let along = along.max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))?;
    let part = match along.norm_squared() {
        0.0 => 0.0,
        square => (-first.dot(&along) / square).clamp(0.0, 1.0),
    };
    if (first + along * part).norm() > TOLERANCE {
        return None;
    }
    let axis = Vector3::ith(along.iamin(), 1.0);
    let normal = along.cross(&axis).try_normalize(0.0);
    let other = vertices.iter().find(|[v, _]| *v == first + along);
    let on_a = of_a + (other.map_or(of_a, |[_, a]| *a) - of_a) * part;
    Some(Penetration {
        depth: 0.0,
        direction: normal.unwrap_or(Vector3::x()).into(),
        points: [on_a.into(); 2],
    })
}
