//! Points on the surface of a link, the target of its spheres' surface.

use super::frame::{Point, add, cross, dot, norm, scaled, sub};
use urdd_geometry::Mesh;

/// Minimum depth below the faces of another piece for a point to count as inside, in metres.
const INSIDE: f64 = 1e-7;

/// Steps of the two-dimensional additive sequence from the root of x^3 = x + 1, which fills a square evenly.
const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];

/// The faces of a piece: outward normals, and offsets along them.
type Faces = Vec<(Point, f64)>;

/// About `count` points, evenly distributed on the pieces of a link outside other pieces. Fewer if pieces overlap; the
/// vertices themselves if the pieces have no area.
pub fn points(pieces: &[Mesh], count: usize) -> Vec<Point> {
    let mut triangles: Vec<(f64, usize, [Point; 3])> = Vec::new();
    let mut area = 0.0;
    let mut faces: Vec<Faces> = Vec::new();
    for (piece, mesh) in pieces.iter().enumerate() {
        let mut own = Faces::new();
        for triangle in &mesh.triangles {
            let corners = mesh.corners(*triangle);
            let normal = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]));
            let twice = norm(normal);
            if twice > 0.0 {
                area += 0.5 * twice;
                triangles.push((area, piece, corners));
                let normal = scaled(normal, 1.0 / twice);
                own.push((normal, dot(normal, corners[0])));
            }
        }
        faces.push(own);
    }
    let is_inside = |piece: usize, p: Point| {
        let holds = |faces: &Faces| faces.iter().all(|(n, at)| dot(*n, p) < at - INSIDE);
        let mut others = faces.iter().enumerate();
        others.any(|(other, faces)| other != piece && !faces.is_empty() && holds(faces))
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
