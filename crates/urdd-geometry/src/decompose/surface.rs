//! The surface as the decomposition uses it: valid triangles over welded vertices, in unit coordinates; and a small proxy
//! of it, on which cuts are tried.
//!
//! The proxy is made by vertex clustering (Rossignac and Borrel, "Multi-resolution 3D approximations for rendering complex
//! scenes", 1993): the vertices in a grid cell become one of them, the one nearest to their mean. Only the search uses it;
//! pieces are made from the surface itself.

use super::part::{Bounds, Part, cross, dot, normal, sub};
use crate::Mesh;
use crate::mesh::{from_lowest, welded};

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
        let (vertices, index) = welded(&mesh.vertices, |p| {
            // The range of the hull's exact arithmetic: no robot is that large. Values below that range become 0, and -0
            // becomes 0.
            let is_near = p.iter().all(|x| x.abs() < 1e60);
            is_near.then(|| p.map(|x| if x.abs() < 1e-59 { 0.0 } else { x }))
        });
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

/// Target number of clusters.
const TARGET: f64 = 1500.0;

/// Maximum number of triangles of the proxy. Surfaces with so few points have half as many. A tangled mesh with more is
/// sampled evenly.
const MAX_TRIANGLES: usize = 8000;

/// Maximum number of cells along one axis, to bound the grid's memory.
const MAX_CELLS: f64 = 96.0;

/// The proxy, and its cell size (0 if the surface is small enough to be used whole).
pub(super) fn proxy(surface: &Surface) -> (Part, f64) {
    if surface.vertices.len() as f64 <= TARGET {
        let cluster: Vec<u32> = (0..surface.vertices.len() as u32).collect();
        let (points, triangles) = (surface.unit.clone(), surface.triangles.clone());
        return (stand_in(surface, points, &cluster, triangles), 0.0);
    }
    // A surface intersects about 1.5 cells per cell's area.
    let cell = (1.5 * surface.area() / TARGET).sqrt().max(2.0 / MAX_CELLS);
    let cells = (2.0 / cell).ceil() as usize + 1;
    let place = |p: [f64; 3]| {
        let i = p.map(|x| ((x + 1.0) / cell) as usize);
        (i[2].min(cells - 1) * cells + i[1].min(cells - 1)) * cells + i[0].min(cells - 1)
    };
    let mut grid = vec![u32::MAX; cells * cells * cells];
    let mut sums: Vec<([f64; 3], f64)> = Vec::new();
    let cluster: Vec<u32> = surface
        .unit
        .iter()
        .map(|&p| {
            let slot = &mut grid[place(p)];
            if *slot == u32::MAX {
                *slot = sums.len() as u32;
                sums.push(([0.0; 3], 0.0));
            }
            let (sum, n) = &mut sums[*slot as usize];
            for a in 0..3 {
                sum[a] += p[a];
            }
            *n += 1.0;
            *slot
        })
        .collect();
    let mut nearest = vec![(f64::INFINITY, 0_usize); sums.len()];
    for (v, &c) in cluster.iter().enumerate() {
        let (sum, n) = sums[c as usize];
        let e = sub(surface.unit[v], sum.map(|x| x / n));
        if dot(e, e) < nearest[c as usize].0 {
            nearest[c as usize] = (dot(e, e), v);
        }
    }
    let points: Vec<[f64; 3]> = nearest.iter().map(|&(_, v)| surface.unit[v]).collect();
    let mut triangles: Vec<[u32; 3]> = surface
        .triangles
        .iter()
        .map(|t| t.map(|i| cluster[i as usize]))
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .map(from_lowest)
        .collect();
    triangles.sort_unstable();
    triangles.dedup();
    (stand_in(surface, points, &cluster, triangles), cell)
}

/// The proxy of these points and triangles. `cluster` maps each vertex to its point.
fn stand_in(
    surface: &Surface,
    points: Vec<[f64; 3]>,
    cluster: &[u32],
    triangles: Vec<[u32; 3]>,
) -> Part {
    let every = triangles.len().div_ceil(MAX_TRIANGLES).max(1);
    let mut triangles: Vec<[u32; 3]> = triangles.into_iter().step_by(every).collect();
    // Keep points that have lost all their triangles, as loose points.
    let mut used = vec![false; points.len()];
    triangles.as_flattened().iter().for_each(|&i| used[i as usize] = true);
    for &c in surface.triangles.as_flattened().iter().map(|&i| &cluster[i as usize]) {
        if !used[c as usize] {
            used[c as usize] = true;
            triangles.push([c, c, c]);
        }
    }
    Part { points, triangles, ..Part::default() }
}

/// Coordinates along each axis at which much of the surface is flat and perpendicular to it. CAD parts change their
/// section there, so these are the best places to cut. At most `most` per axis, those with the largest area.
pub(super) fn flat_coordinates(surface: &Surface, most: usize) -> [Vec<f64>; 3] {
    const BINS: usize = 2048;
    // Area, and the largest triangle with its coordinate, per bin.
    let mut bins = vec![[(0.0_f64, 0.0_f64, 0.0_f64); BINS]; 3];
    for &t in &surface.triangles {
        let n = surface.normal(t);
        let length = dot(n, n).sqrt();
        for a in 0..3 {
            if n[a].abs() > 0.9999 * length && length > 0.0 {
                let x = surface.unit[t[0] as usize][a];
                let bin = &mut bins[a][(((x + 1.0) / 2.0 * BINS as f64) as usize).min(BINS - 1)];
                bin.0 += length;
                if length > bin.1 {
                    (bin.1, bin.2) = (length, x);
                }
            }
        }
    }
    [0, 1, 2].map(|a| {
        let total: f64 = bins[a].iter().map(|b| b.0).sum();
        let mut found: Vec<(f64, f64)> =
            bins[a].iter().filter(|b| b.0 > 0.01 * total).map(|b| (b.0, b.2)).collect();
        found.sort_by(|p, q| q.0.total_cmp(&p.0).then(p.1.total_cmp(&q.1)));
        found.truncate(most);
        let mut out: Vec<f64> = found.into_iter().map(|f| f.1).collect();
        out.sort_by(f64::total_cmp);
        out
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_vertices_are_one_and_bad_triangles_go() {
        let nan = f64::NAN;
        let mesh = Mesh {
            vertices: vec![
                [0.0; 3],
                [-0.0, 0.0, 0.0],
                [1.0, 0.0, 0.0],
                [0.0, 3.0, 0.0],
                [nan, 0.0, 0.0],
            ],
            triangles: vec![[0, 2, 3], [1, 2, 3], [2, 3, 0], [0, 3, 2], [0, 2, 9], [0, 2, 4]],
        };
        let s = Surface::new(&mesh).unwrap();
        assert_eq!(s.vertices.len(), 3);
        // Three times the same triangle, and once flipped.
        assert_eq!(s.triangles, vec![[0, 1, 2], [0, 2, 1]]);
        assert_eq!(s.ignored, 2);
        assert_eq!(s.scale, 1.5);
        assert!(Surface::new(&Mesh { triangles: vec![[0, 1, 9]], ..mesh }).is_none());
    }
}
