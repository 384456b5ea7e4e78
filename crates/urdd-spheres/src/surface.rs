//! The surface of a link: points on it, the target of its spheres' surface; and how far spheres are from it, by the points of
//! SPEC 8.9.5.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::f64::consts::TAU;

use nalgebra::Isometry3;

use crate::frame::{Point, add, dot, norm, scaled, sub};
use crate::model::Sphere;
use crate::tree::{SphereTree, bits};
use urdd_directory::account::{Account, AccountError};
use urdd_format::link_shapes_spheres::SphereFit;
use urdd_geometry::Mesh;
use urdd_geometry::bounding_sphere::{BoundingSphere, about};
use urdd_geometry::convex::{ConvexShape, ShapeError, distance as apart};
use urdd_geometry::mesh::Bounds;
use urdd_geometry::vector::normal;

/// Minimum depth below the faces of another piece for a point to count as inside, in metres.
const INSIDE: f64 = 1e-7;

/// Steps of the two-dimensional additive sequence from the root of x^3 = x + 1, which fills a square evenly.
const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];

/// The planes of a piece's faces: outward normals, and offsets along them.
#[derive(Debug)]
pub struct Planes(Vec<(Point, f64)>);

impl Planes {
    /// Without those of triangles that have no area.
    pub fn of(mesh: &Mesh) -> Self {
        let planes = mesh.triangles.iter().filter_map(|triangle| {
            let corners = mesh.corners(*triangle);
            let normal = normal(corners);
            let twice = norm(normal);
            let normal = scaled(normal, 1.0 / twice);
            (twice > 0.0).then(|| (normal, dot(normal, corners[0])))
        });
        Planes(planes.collect())
    }

    /// Whether a point is beneath all planes by more than a distance.
    pub fn hold(&self, point: Point, by: f64) -> bool {
        !self.0.is_empty() && self.0.iter().all(|(n, at)| dot(*n, point) < at - by)
    }
}

/// About `count` points, evenly distributed on the pieces of a link outside other pieces. Fewer if pieces overlap; the
/// vertices themselves if the pieces have no area.
pub fn points(pieces: &[Mesh], count: usize) -> Vec<Point> {
    let mut triangles: Vec<(f64, usize, [Point; 3])> = Vec::new();
    let mut area = 0.0;
    for (piece, mesh) in pieces.iter().enumerate() {
        for corners in mesh.triangles.iter().map(|triangle| mesh.corners(*triangle)) {
            let twice = norm(normal(corners));
            if twice > 0.0 {
                area += 0.5 * twice;
                triangles.push((area, piece, corners));
            }
        }
    }
    let planes: Vec<Planes> = pieces.iter().map(Planes::of).collect();
    let is_inside = |piece: usize, p: Point| {
        let mut others = planes.iter().enumerate();
        others.any(|(other, planes)| other != piece && planes.hold(p, INSIDE))
    };
    let point = |k: usize| {
        let at = (k as f64 + 0.5) / count as f64 * area;
        let last = triangles.len().checked_sub(1)?;
        let place = triangles.partition_point(|triangle| triangle.0 < at);
        let (_, piece, corners) = triangles[place.min(last)];
        let [mut u, mut v] = STEPS.map(|step| (0.5 + step * k as f64) % 1.0);
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        let along =
            add(scaled(sub(corners[1], corners[0]), u), scaled(sub(corners[2], corners[0]), v));
        let p = add(corners[0], along);
        (!is_inside(piece, p)).then_some(p)
    };
    let found: Vec<Point> = (0..count).filter_map(point).collect();
    if found.is_empty() {
        pieces.iter().flat_map(|mesh| mesh.vertices.clone()).collect()
    } else {
        found
    }
}

/// Points on each sphere.
const DIRECTIONS: usize = 64;
/// The fractional part of the golden ratio.
const STEP: f64 = 0.618_033_988_749_894_9;
/// A point within another sphere by this part of its radius, or within another piece or outside of spheres by this part of
/// the size, is.
const WITHIN: f64 = 1e-6;
/// The number of parts that an edge as long as the size is cut into.
const PARTS: f64 = 15.7;

/// Spheres that are looked at for nothing: it takes as long as to measure the distance of a piece.
const FREE: usize = 128;

/// Charges the spheres that were looked at for a point.
fn charge(steps: usize, account: &Account) -> Result<(), AccountError> {
    account.charge(steps.saturating_sub(FREE))
}

/// The directions of the points on each sphere.
fn directions() -> impl Iterator<Item = Point> {
    (0..DIRECTIONS).map(|k| {
        let z = 1.0 - (2 * k + 1) as f64 / DIRECTIONS as f64;
        let (sin, cos) = (TAU * (STEP * k as f64).fract()).sin_cos();
        let across = (1.0 - z * z).sqrt();
        [across * cos, across * sin, z]
    })
}

/// A convex piece: to measure distances, and the planes of its triangles.
#[derive(Debug)]
struct Piece {
    shape: ConvexShape,
    about: BoundingSphere,
    planes: Planes,
}

/// The pieces of a link.
#[derive(Debug)]
pub struct Pieces {
    pieces: Vec<Piece>,
    /// The diagonal of the box around them, m.
    pub size: f64,
    /// Points of the surface, with the area that each stands for.
    surface: Vec<(Point, f64)>,
}

impl Pieces {
    /// Of the meshes of a link's pieces.
    ///
    /// # Errors
    /// If distances of one cannot be measured.
    pub fn new(meshes: &[Mesh]) -> Result<Self, ShapeError> {
        let bounds = Bounds::of(meshes.iter().flat_map(|mesh| mesh.vertices.iter().copied()));
        let size = norm(sub(bounds.max, bounds.min));
        let pieces: Vec<Piece> = meshes.iter().map(piece).collect::<Result<_, _>>()?;
        let mut surface = Vec::new();
        for (own, mesh) in meshes.iter().enumerate() {
            for triangle in &mesh.triangles {
                centroids(mesh.corners(*triangle), size, |point, area| {
                    let is_within = |(other, piece): (usize, &Piece)| {
                        other != own && piece.planes.hold(point, WITHIN * size)
                    };
                    if !pieces.iter().enumerate().any(is_within) {
                        surface.push((point, area));
                    }
                });
            }
        }
        Ok(Pieces { pieces, size, surface })
    }

    /// The figures of spheres of this link.
    ///
    /// # Errors
    /// If so many of them are around the same points that the account does not have what it takes.
    pub fn fit(&self, spheres: &[Sphere], account: &Account) -> Result<SphereFit, AccountError> {
        let (mut most, mut sum, mut weights) = (0.0f64, 0.0, 0.0);
        let tree = SphereTree::new(spheres);
        // Equal spheres are measured once.
        let mut measured: HashMap<[u64; 4], Vec<f64>> = HashMap::new();
        for sphere in spheres {
            let aways = match measured.entry(bits(sphere)) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(new) => {
                    let mut aways = Vec::new();
                    for direction in directions() {
                        let point = add(sphere.centre, scaled(direction, sphere.radius));
                        let (is_held, steps) = tree.holds(point, 1.0 - WITHIN, sphere);
                        charge(steps, account)?;
                        if !is_held {
                            aways.push(self.distance(point));
                        }
                    }
                    new.insert(aways)
                }
            };
            let weight = sphere.radius * sphere.radius;
            for away in aways {
                most = most.max(*away);
                sum += weight * *away;
                weights += weight;
            }
        }
        let (mut uncovered, mut area, mut farthest) = (0.0, 0.0, 0.0f64);
        for (point, weight) in &self.surface {
            let (off, steps) = tree.distance(*point);
            charge(steps, account)?;
            area += weight;
            if off > WITHIN * self.size {
                uncovered += weight;
                farthest = farthest.max(off);
            }
        }
        let part = |of: f64, all: f64| if all > 0.0 { of / all } else { 0.0 };
        Ok(SphereFit {
            max_standoff: most,
            mean_standoff: part(sum, weights),
            uncovered_fraction: part(uncovered, area),
            max_uncovered: farthest,
        })
    }

    /// The distance of a point from the nearest piece, m; 0 inside.
    fn distance(&self, point: Point) -> f64 {
        // A single point is a shape unless it is out of range, where the pieces would be, too.
        let Ok(own) = ConvexShape::of_points(&[point]) else { return 0.0 };
        let least = |piece: &Piece| norm(sub(point, piece.about.centre)) - piece.about.radius;
        let mut order: Vec<(f64, &Piece)> = self.pieces.iter().map(|p| (least(p), p)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut found = f64::INFINITY;
        for (least, piece) in order {
            if least >= found {
                break;
            }
            found = found.min(apart(&piece.shape, &own, &Isometry3::identity()));
        }
        if found.is_finite() { found } else { 0.0 }
    }
}

fn piece(mesh: &Mesh) -> Result<Piece, ShapeError> {
    let shape = ConvexShape::of_points(&mesh.vertices)?;
    Ok(Piece { about: about(shape.centre(), &mesh.vertices), shape, planes: Planes::of(mesh) })
}

/// The centroids of the equal parts of a triangle, with the area of each.
fn centroids(corners: [Point; 3], size: f64, mut each: impl FnMut(Point, f64)) {
    let [a, b, c] = corners;
    let (along, beside) = (sub(b, a), sub(c, a));
    let area = 0.5 * norm(normal(corners));
    let longest = [along, beside, sub(c, b)].map(norm).into_iter().fold(0.0, f64::max);
    let parts = (PARTS * longest / size).ceil().max(1.0);
    // No edge is longer than the size.
    if !(area > 0.0 && parts <= PARTS + 1.0) {
        return;
    }
    let count = parts as u32;
    let at = |u: f64, v: f64| add(a, add(scaled(along, u / parts), scaled(beside, v / parts)));
    let part = area / (parts * parts);
    for row in 0..count {
        for column in 0..count - row {
            let (u, v) = (f64::from(column), f64::from(row));
            each(at(u + 1.0 / 3.0, v + 1.0 / 3.0), part);
            if row + column + 1 < count {
                each(at(u + 2.0 / 3.0, v + 2.0 / 3.0), part);
            }
        }
    }
}
