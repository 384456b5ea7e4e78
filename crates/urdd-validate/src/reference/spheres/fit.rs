//! The spheres of a link and its convex pieces, and how far the ones are from the others (SPEC 8.9.5).

use std::f64::consts::TAU;

use nalgebra::Vector3;

use crate::reference::samples::Budget;
use crate::solids::Solids;
use urdd_findings::part::SkipReason;
use urdd_format::link_shapes_spheres::{LinkSphere, SphereLevel};
use urdd_format::registry::ModuleKind;
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::surface::distinct;

/// A sphere, m.
#[derive(Debug, Clone, Copy)]
pub struct Ball {
    pub centre: Vector3<f64>,
    pub radius: f64,
}

impl Ball {
    /// How far outside a point is; negative inside.
    pub fn height(&self, point: &Vector3<f64>) -> f64 {
        (point - self.centre).norm() - self.radius
    }
}

impl From<&LinkSphere> for Ball {
    fn from(sphere: &LinkSphere) -> Self {
        Ball { centre: sphere.offset_xyz.into(), radius: sphere.radius }
    }
}

/// The spheres of a link in a level.
pub fn balls(level: &SphereLevel, link: usize) -> Vec<Ball> {
    let spheres = level.spheres.get(link).map_or(&[][..], Vec::as_slice);
    spheres.iter().map(Ball::from).collect()
}

/// The sound pieces of a link.
pub struct LinkPieces<'a> {
    pub meshes: Vec<&'a Mesh>,
    pub solids: Vec<Solid>,
    /// The diagonal of the box around all vertices (SPEC 8.9.5), m.
    pub diagonal: f64,
}

impl<'a> LinkPieces<'a> {
    /// Of a link with this many pieces; `None` without pieces, or if one has no hull, which other rules report.
    pub fn new(solids: &'a Solids, link: usize, count: usize) -> Option<Self> {
        let kind = ModuleKind::ConvexDecompositionMeshes;
        let meshes = (0..count).map(|piece| solids.sound(kind, link, piece));
        Self::of(meshes.collect::<Option<_>>()?)
    }

    /// The same, of their meshes.
    pub fn of(meshes: Vec<&'a Mesh>) -> Option<Self> {
        let solids: Vec<Solid> = meshes.iter().copied().map(Solid::new).collect::<Option<_>>()?;
        let vertices = || solids.iter().flat_map(|solid| &solid.vertices);
        let first = *vertices().next()?;
        let low = vertices().fold(first, |low, vertex| low.inf(vertex));
        let high = vertices().fold(first, |high, vertex| high.sup(vertex));
        Some(LinkPieces { meshes, solids, diagonal: (high - low).norm() })
    }

    /// The distance of the farthest vertex from the link's origin, m.
    pub fn farthest(&self) -> f64 {
        let vertices = self.solids.iter().flat_map(|solid| &solid.vertices);
        vertices.map(Vector3::norm).fold(0.0, f64::max)
    }
}

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

/// Number of points on a sphere.
const POINTS: u32 = 64;
/// Turns from one of them to the next.
const TURN: f64 = 0.6180339887498949;
/// A point is inside of another sphere where its distance from the centre is less than this part of the radius.
const INSIDE: f64 = 1.0 - 1e-6;
/// A triangle's longest edge is cut into parts of about this part of the diagonal.
const PARTS: f64 = 15.7;
/// Outside of the spheres, or beneath planes of another piece, by more than this part of the diagonal.
const BEYOND: f64 = 1e-6;
/// What is decided by less than this part of the diagonal may be decided otherwise.
const UNDECIDED: f64 = 1e-10;

/// The largest and the mean distance of points on spheres from the pieces, m: least and most, by what is undecided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standoff {
    pub max: [f64; 2],
    pub mean: [f64; 2],
}

/// The part of the surface that is outside of the spheres, and how far, m: least and most, by what is undecided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uncovered {
    pub fraction: [f64; 2],
    pub max: [f64; 2],
}

/// A part of a whole; 0 where there is nothing.
fn part(of: f64, whole: f64) -> f64 {
    if whole > 0.0 { of / whole } else { 0.0 }
}

/// The directions in which there are points on a sphere.
fn directions() -> Vec<Vector3<f64>> {
    let direction = |k: u32| {
        let k = f64::from(k);
        let z = 1.0 - (2.0 * k + 1.0) / f64::from(POINTS);
        let s = (1.0 - z * z).sqrt();
        let a = TAU * (TURN * k).fract();
        Vector3::new(s * a.cos(), s * a.sin(), z)
    };
    (0..POINTS).map(direction).collect()
}

/// The standoff of the spheres of a link.
///
/// # Errors
/// If it takes too much work.
pub fn standoff(
    pieces: &LinkPieces,
    balls: &[Ball],
    budget: &Budget,
) -> Result<Standoff, SkipReason> {
    let directions = directions();
    let triangles: usize = pieces.solids.iter().map(|solid| solid.faces.len()).sum();
    let undecided = UNDECIDED * pieces.diagonal;
    // Of the points that count, and of those that may.
    let (mut max, mut sum, mut weights) = ([0.0_f64; 2], [0.0; 2], [0.0; 2]);
    for (place, ball) in balls.iter().enumerate() {
        let reaches = |(other, of): (usize, &Ball)| {
            let near = (of.centre - ball.centre).norm() < of.radius + ball.radius;
            (near && other != place).then_some(*of)
        };
        let others: Vec<Ball> = balls.iter().enumerate().filter_map(reaches).collect();
        let point = 3 * others.len() + 2 * triangles + 5 * pieces.solids.len() + 10;
        budget.spend((balls.len() + POINTS as usize * point) as u64)?;
        for direction in &directions {
            let point = ball.centre + direction * ball.radius;
            let depth = |of: &Ball| INSIDE * of.radius - (point - of.centre).norm();
            let depth = others.iter().map(depth).fold(f64::NEG_INFINITY, f64::max);
            if depth >= undecided {
                continue;
            }
            let solids = pieces.solids.iter();
            let nearest = solids.fold(f64::INFINITY, |limit, solid| solid.distance(&point, limit));
            for kind in usize::from(depth > -undecided)..2 {
                max[kind] = max[kind].max(nearest);
                sum[kind] += ball.radius * ball.radius * nearest;
                weights[kind] += ball.radius * ball.radius;
            }
        }
    }
    // A part of the mean may come and go, of any standoff up to the largest.
    let free = part(weights[1] - weights[0], weights[1]) * max[1];
    let means = [0, 1].map(|kind| part(sum[kind], weights[kind]));
    let mean = [means[0].min(means[1]) - free, means[0].max(means[1]) + free];
    Ok(Standoff { max, mean })
}

/// The corners of a triangle, and its unit normal.
type Triangle = ([Vector3<f64>; 3], Vector3<f64>);

/// The surface outside of the spheres, for the spheres of several levels.
///
/// # Errors
/// If it takes too much work.
pub fn uncovered(
    pieces: &LinkPieces,
    levels: &[Vec<Ball>],
    budget: &Budget,
) -> Result<Vec<Uncovered>, SkipReason> {
    let [beyond, undecided] = [BEYOND, UNDECIDED].map(|part| part * pieces.diagonal);
    let triangles = pieces.meshes.iter().map(|mesh| {
        let triangles = mesh.triangles.iter();
        let triangles = triangles.map(|triangle| mesh.corners(*triangle).map(Vector3::from));
        triangles.filter_map(|corners| Some((corners, normal(&corners)?)))
    });
    let triangles: Vec<Vec<Triangle>> = triangles.map(Iterator::collect).collect();
    // Of each plane, the normal, and how far along it what is beneath reaches.
    let beneath = |(corners, normal): &Triangle| (*normal, normal.dot(&corners[0]) - beyond);
    let planes = triangles.iter().map(|of| of.iter().map(beneath).collect());
    let planes: Vec<Vec<(Vector3<f64>, f64)>> = planes.collect();
    let mut found = vec![Uncovered { fraction: [0.0; 2], max: [0.0; 2] }; levels.len()];
    let mut last = vec![0; levels.len()];
    // The weight of the centroids that count, and of those that may.
    let mut all = [0.0; 2];
    for (own, triangles) in triangles.iter().enumerate() {
        for (corners, _) in triangles {
            let [a, b, c] = corners;
            let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
            let n = (PARTS * longest / pieces.diagonal).ceil().max(1.0);
            let weight = (b - a).cross(&(c - a)).norm() / (n * n);
            budget.spend((n * n) as u64 * (10 + 10 * planes.len() as u64))?;
            let mut work = 0;
            for point in centroids(corners, n as u32) {
                // How deep the point is in a piece, as far as that decides whether it counts.
                let mut depth = f64::NEG_INFINITY;
                for (piece, planes) in planes.iter().enumerate() {
                    let solid = &pieces.solids[piece];
                    let far = (point - solid.centre).norm() > solid.radius;
                    if piece == own || far || planes.is_empty() {
                        continue;
                    }
                    let depths = planes.iter().map(|(normal, offset)| offset - normal.dot(&point));
                    let mut least = f64::INFINITY;
                    for of_plane in depths {
                        work += 2;
                        least = least.min(of_plane);
                        if least <= depth.max(-undecided) {
                            break;
                        }
                    }
                    depth = depth.max(least);
                }
                if depth >= undecided {
                    continue;
                }
                let counts = usize::from(depth > -undecided);
                all[1] += weight;
                all[0] += if counts == 0 { weight } else { 0.0 };
                for ((balls, found), last) in levels.iter().zip(&mut found).zip(&mut last) {
                    let (height, looked) = lowest(&point, balls, last, beyond - undecided);
                    work += 3 * looked;
                    if height > beyond - undecided {
                        let from = counts.max(usize::from(height <= beyond + undecided));
                        for kind in from..2 {
                            found.fraction[kind] += weight;
                            found.max[kind] = found.max[kind].max(height);
                        }
                    }
                }
            }
            budget.spend(work as u64)?;
        }
    }
    for Uncovered { fraction: [least, most], .. } in &mut found {
        *least = part(*least, all[1]);
        *most = if *most > 0.0 { (*most / all[0]).min(1.0) } else { 0.0 };
    }
    Ok(found)
}

/// How far a point is outside of all spheres, and how many were looked at. Stops at one that it is outside of by no more than
/// `enough`, and looks at that first the next time.
fn lowest(point: &Vector3<f64>, balls: &[Ball], last: &mut usize, enough: f64) -> (f64, usize) {
    if let Some(ball) = balls.get(*last)
        && ball.height(point) <= enough
    {
        return (enough, 1);
    }
    let mut lowest = f64::INFINITY;
    for (place, ball) in balls.iter().enumerate() {
        lowest = lowest.min(ball.height(point));
        if lowest <= enough {
            *last = place;
            return (enough, place + 1);
        }
    }
    (lowest, balls.len())
}

/// The centroids of n^2 triangles of equal area that lines parallel to its edges cut a triangle into.
fn centroids([a, b, c]: &[Vector3<f64>; 3], n: u32) -> impl Iterator<Item = Vector3<f64>> {
    let (a, u, v) = (*a, (b - a) / f64::from(n), (c - a) / f64::from(n));
    let at = move |i: f64, j: f64| a + u * i + v * j;
    (0..n).flat_map(move |i| {
        (0..n - i).flat_map(move |j| {
            let [x, y] = [i, j].map(f64::from);
            let upright = at(x + 1.0 / 3.0, y + 1.0 / 3.0);
            let turned = (i + j + 1 < n).then(|| at(x + 2.0 / 3.0, y + 2.0 / 3.0));
            std::iter::once(upright).chain(turned)
        })
    })
}
