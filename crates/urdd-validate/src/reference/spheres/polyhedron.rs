//! A convex polyhedron as its faces, cut by planes.

use nalgebra::Vector3;

/// Heights below this fraction of the polyhedron's size are none.
const ON_PLANE: f64 = 1e-12;

/// The faces of a convex polyhedron, each as its corners in turn. Either winding; a flat one has its polygon, twice or more.
#[derive(Debug, Clone)]
pub struct Polyhedron {
    faces: Vec<Vec<Vector3<f64>>>,
    resolution: f64,
}

impl Polyhedron {
    /// Of triangles whose corners are at most `size` from the origin.
    pub fn new(triangles: impl IntoIterator<Item = [Vector3<f64>; 3]>, size: f64) -> Self {
        let faces = triangles.into_iter().map(|corners| corners.to_vec());
        Polyhedron { faces: faces.collect(), resolution: ON_PLANE * size }
    }

    /// Its corners, each as often as there are faces with it.
    pub fn corners(&self) -> impl Iterator<Item = &Vector3<f64>> {
        self.faces.iter().flatten()
    }

    /// Number of corners of all faces.
    pub fn size(&self) -> usize {
        self.faces.iter().map(Vec::len).sum()
    }

    /// Keeps the part whose coordinate along a unit normal is at most `offset`.
    pub fn cut(&mut self, normal: &Vector3<f64>, offset: f64) {
        let height = |corner: &Vector3<f64>| normal.dot(corner) - offset;
        if !self.corners().any(|corner| height(corner) > self.resolution) {
            return;
        }
        let mut section = Vec::new();
        let faces = std::mem::take(&mut self.faces);
        for face in faces {
            let heights: Vec<f64> = face.iter().map(height).collect();
            let mut kept = Vec::with_capacity(face.len() + 1);
            for (at, corner) in face.iter().enumerate() {
                let next = (at + 1) % face.len();
                let [here, there] = [heights[at], heights[next]];
                if here <= self.resolution {
                    kept.push(*corner);
                }
                if here.abs() <= self.resolution {
                    section.push(*corner);
                }
                let crosses = here.abs() > self.resolution && there.abs() > self.resolution;
                if crosses && (here > 0.0) != (there > 0.0) {
                    let crossing = corner + (face[next] - corner) * (here / (here - there));
                    kept.push(crossing);
                    section.push(crossing);
                }
            }
            if kept.len() >= 3 {
                self.faces.push(kept);
            }
        }
        self.faces.extend(around(section, normal));
    }
}

/// The convex polygon around points on a plane with this normal; `None` where it has no area.
fn around(points: Vec<Vector3<f64>>, normal: &Vector3<f64>) -> Option<Vec<Vector3<f64>>> {
    let aside = if normal.x.abs() < 0.6 { Vector3::x() } else { Vector3::y() };
    let u = normal.cross(&aside).normalize();
    let v = normal.cross(&u);
    let mut flat: Vec<([f64; 2], Vector3<f64>)> =
        points.into_iter().map(|point| ([u.dot(&point), v.dot(&point)], point)).collect();
    flat.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    flat.dedup_by(|(a, _), (b, _)| a == b);
    let turns_left = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
    };
    let mut polygon: Vec<([f64; 2], Vector3<f64>)> = Vec::with_capacity(flat.len() + 1);
    // The lower side, then the upper one.
    for pass in 0..2 {
        let start = polygon.len();
        for &(place, point) in &flat {
            while let [.., (a, _), (b, _)] = &polygon[start..]
                && !turns_left(*a, *b, place)
            {
                polygon.pop();
            }
            polygon.push((place, point));
        }
        polygon.pop();
        if pass == 0 {
            flat.reverse();
        }
    }
    (polygon.len() >= 3).then(|| polygon.into_iter().map(|(_, point)| point).collect())
}
