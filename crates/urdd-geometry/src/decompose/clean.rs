//! The surface as the decomposition uses it: valid triangles over welded vertices, in unit coordinates.

use super::vector::{Bounds, cross, dot, normal, sub};
use crate::Mesh;
use crate::clean::PlaceTable;
use crate::mesh::from_lowest;

/// A welded surface. `unit` are the vertices moved and scaled so that the largest extent runs from -1 to 1; planes use
/// these coordinates.
pub(super) struct Surface {
    pub vertices: Vec<[f64; 3]>,
    pub unit: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// Length of one unit, metres.
    pub scale: f64,
    /// The origin of unit coordinates, in metres.
    pub centre: [f64; 3],
    /// Number of dropped triangles, with an index out of range or a non-finite coordinate.
    pub ignored: usize,
}

impl Surface {
    /// Welds equal vertices and drops invalid triangles; `None` if no triangle remains.
    pub fn new(mesh: &Mesh) -> Option<Self> {
        let (vertices, index) = weld(&mesh.vertices);
        let mut triangles = Vec::with_capacity(mesh.triangles.len());
        for t in &mesh.triangles {
            let corner = t.map(|i| index.get(i as usize).copied().unwrap_or(u32::MAX));
            if corner.iter().all(|&i| i != u32::MAX) {
                triangles.push(corner);
            }
        }
        let ignored = mesh.triangles.len() - triangles.len();
        let triangles = each_once(triangles);
        let corners = triangles.as_flattened().iter();
        let Bounds { min: low, max: high } = Bounds::of(corners.map(|i| vertices[*i as usize]));
        if triangles.is_empty() {
            return None;
        }
        let half = [0, 1, 2].map(|a| high[a] / 2.0 - low[a] / 2.0);
        let scale = half.iter().copied().fold(0.0, f64::max);
        let scale = if scale > f64::MIN_POSITIVE { scale } else { 1.0 };
        let centre = [0, 1, 2].map(|a| low[a] + half[a]);
        let unit = vertices.iter().map(|p| sub(*p, centre).map(|x| x / scale)).collect();
        let mut out = Surface { vertices, unit, triangles, scale, centre, ignored };
        // Flip a surface that is inside out as a whole, so that fronts face outward.
        if out.volume() < 0.0 {
            out.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        Some(out)
    }

    /// The enclosed volume of a closed surface, in unit coordinates.
    fn volume(&self) -> f64 {
        self.triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|i| self.unit[i as usize]);
                dot(cross(a, b), c) / 6.0
            })
            .sum()
    }

    /// Twice the area vector of a triangle, in unit coordinates.
    pub fn normal(&self, t: [u32; 3]) -> [f64; 3] {
        normal(t.map(|i| self.unit[i as usize]))
    }

    /// The sum of the triangles' areas, in unit coordinates.
    pub fn area(&self) -> f64 {
        self.triangles.iter().map(|&t| dot(self.normal(t), self.normal(t)).sqrt() / 2.0).sum()
    }
}

/// Removes duplicate triangles. Of those with the same corners and orientation, keeps the first. A small file can
/// repeat one triangle many thousand times.
fn each_once(triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    let mut numbered: Vec<([u32; 3], usize)> =
        triangles.iter().map(|t| from_lowest(*t)).zip(0..).collect();
    numbered.sort_unstable();
    numbered.dedup_by_key(|(t, _)| *t);
    let mut first: Vec<usize> = numbered.into_iter().map(|(_, at)| at).collect();
    first.sort_unstable();
    first.into_iter().map(|at| triangles[at]).collect()
}

/// The distinct vertices in order of first use, and the index of each given vertex among them (`u32::MAX` if it is out
/// of range).
fn weld(given: &[[f64; 3]]) -> (Vec<[f64; 3]>, Vec<u32>) {
    let mut table = PlaceTable::for_count(given.len());
    let mut out: Vec<[f64; 3]> = Vec::with_capacity(given.len() / 2);
    let index_of = |p: &[f64; 3]| {
        // The range of the hull's exact arithmetic: no robot is that large.
        if !p.iter().all(|x| x.abs() < 1e60) {
            return u32::MAX;
        }
        // Values below that range become 0, and -0 becomes 0.
        table.index(p.map(|x| if x.abs() < 1e-59 { 0.0 } else { x }), &mut out)
    };
    let index = given.iter().map(index_of).collect();
    (out, index)
}

#[cfg(test)]
#[path = "tests/clean.rs"]
mod tests;
