//! Points on the surface of a link, the target of its spheres' surface.

use super::frame::{Point, add, dot, norm, scaled, sub};
use urdd_geometry::Mesh;
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
