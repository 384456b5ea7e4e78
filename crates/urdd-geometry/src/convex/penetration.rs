//! How far convex shapes overlap.
//!
//! The expanding polytope algorithm (G. van den Bergen, Proximity Queries and Penetration Depth Computation on 3D Game
//! Objects, Game Developers Conference 2001): a polytope of vertices of the Minkowski difference grows by the farthest
//! vertex beyond its face that is nearest to the origin. Here it is the exact hull of these vertices, so that thin shapes
//! and parallel faces need no tolerances.

use fearless_simd::Level;
use nalgebra::{Matrix3, Vector3};

use super::across::PlacedPair;
use super::gjk::TOLERANCE;
use crate::hull::quickhull::{self, Growing, Point, Start, in_range};
use crate::hull::{ConvexHull, HullError, triangulate_flat};

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
    let level = Level::new();
    let support = |d: Vector3<f64>| -> Vertex {
        let a = pair.a.farthest(level, d);
        let b = turn * pair.b.farthest(level, turn.tr_mul(&-d)) + shift;
        // Adding 0 turns -0.0 into 0.0.
        [(a - b).add_scalar(0.0), a]
    };
    // Their box is that of all vertices.
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let mut vertices: Vec<Vertex> = axes.into_iter().flat_map(|d| [d, -d]).map(support).collect();
    let num_first = vertices.len();
    let mut polytope: Option<Growing> = None;
    let mut faces: Vec<Option<Face>> = Vec::new();
    let mut changed = Vec::new();
    let mut best: Option<Penetration> = None;
    for _ in 0..STEPS {
        if polytope.is_none() {
            let points: Vec<Point> = vertices.iter().map(|[v, _]| (*v).into()).collect();
            let is_exact = points.iter().flatten().all(|x| in_range(*x));
            match quickhull::start(&points) {
                Ok(Start::Tetrahedron(corners)) if is_exact => {
                    let grown = quickhull::grow(&points, corners);
                    let corners = (0..grown.num_slots()).map(|slot| grown.triangle(slot));
                    faces = corners.map(|of| Face::new(of?, &vertices)).collect();
                    polytope = Some(grown);
                }
                Ok(Start::Plane(triangle)) if is_exact => {
                    let corners = triangulate_flat(&points, triangle).into_iter();
                    faces = corners.map(|of| Face::new(of, &vertices)).collect();
                }
                // All on a line: the rest is beside it, if there is any.
                Err(HullError::Line) if vertices.len() == num_first => {
                    let across = across(&vertices);
                    vertices.extend(across.into_iter().flat_map(|d| [d, -d]).map(support));
                    continue;
                }
                // A point or a segment: nothing that is inside.
                _ => return touching(&vertices),
            }
        }
        let (slot, face) = nearest(&faces, &vertices)?;
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
        let point: Point = next[0].into();
        vertices.push(next);
        polytope = polytope.filter(|of| of.holds(point));
        if let Some(polytope) = &mut polytope {
            // Not beyond the face: what is rounded is all that is left.
            if !polytope.insert(point, slot, &mut changed) {
                break;
            }
            faces.resize_with(polytope.num_slots() as usize, || None);
            for slot in &changed {
                let corners = polytope.triangle(*slot);
                faces[*slot as usize] = corners.and_then(|of| Face::new(of, &vertices));
            }
        }
    }
    best
}

struct Face {
    normal: Vector3<f64>,
    /// Of its plane from the origin, negative if the origin is outside.
    distance: f64,
    corners: [u32; 3],
}

impl Face {
    /// `None` for a triangle so thin that doubles do not tell its normal. Those beside it are as near.
    fn new(corners: [u32; 3], vertices: &[Vertex]) -> Option<Self> {
        let [a, b, c] = corners.map(|k| vertices[k as usize][0]);
        let squares = [b - a, c - b, a - c].map(|of| of.norm_squared());
        let longest = squares.into_iter().fold(0.0, f64::max);
        let area = (b - a).cross(&(c - a));
        let twice = area.norm();
        let normal = area / twice;
        let is_wide = twice > ConvexHull::THINNEST * longest;
        is_wide.then(|| Face { normal, distance: normal.dot(&a), corners })
    }

    /// The shares of its corners in the point of its plane that is nearest to the origin; one is negative if the point is
    /// outside the triangle.
    fn shares(&self, vertices: &[Vertex]) -> [f64; 3] {
        let [a, b, c] = self.corners.map(|k| vertices[k as usize][0]);
        let point = self.normal * self.distance;
        let area = (b - a).cross(&(c - a));
        [(b, c), (c, a), (a, b)]
            .map(|(p, q)| (p - point).cross(&(q - point)).dot(&area) / area.norm_squared())
    }

    /// The point of the first shape for the point that is nearest to the origin.
    fn of_first(&self, vertices: &[Vertex]) -> Vector3<f64> {
        let shares = self.shares(vertices).map(|share| share.max(0.0));
        let sum: f64 = shares.iter().sum();
        let of_first = self.corners.map(|k| vertices[k as usize][1]);
        of_first.iter().zip(shares).map(|(of_first, share)| of_first * (share / sum)).sum()
    }
}

/// The face whose plane is nearest to the origin, or farthest on the wrong side of it, with its slot. Of the triangles of
/// one plane, the one with the point that is nearest.
fn nearest<'f>(faces: &'f [Option<Face>], vertices: &[Vertex]) -> Option<(u32, &'f Face)> {
    let faces = (0..).zip(faces).filter_map(|(slot, face)| Some((slot, face.as_ref()?)));
    let least = faces.clone().map(|(_, face)| face.distance);
    let most = least.fold(f64::INFINITY, f64::min) + 0.1 * EXACT;
    let nearest = faces.filter(|(_, face)| face.distance <= most);
    let inside = |face: &Face| face.shares(vertices).into_iter().fold(f64::INFINITY, f64::min);
    nearest.max_by(|a, b| inside(a.1).total_cmp(&inside(b.1)))
}

/// The vector from the first vertex to the one that is farthest from it.
fn along(vertices: &[Vertex]) -> Vector3<f64> {
    let from_first = vertices.iter().map(|[v, _]| v - vertices[0][0]);
    let longest = from_first.max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
    longest.unwrap_or_default()
}

/// Two unit vectors across the line of vertices, and across each other.
fn across(vertices: &[Vertex]) -> [Vector3<f64>; 2] {
    let along = along(vertices);
    let first = along.cross(&Vector3::ith(along.iamin(), 1.0)).normalize();
    [first, along.cross(&first).normalize()]
}

/// Shapes whose Minkowski difference is a point or a segment, which has no inside: they touch, and come apart along any
/// normal of it. `None` if they are apart.
fn touching(vertices: &[Vertex]) -> Option<Penetration> {
    let [first, of_a] = *vertices.first()?;
    let along = along(vertices);
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
