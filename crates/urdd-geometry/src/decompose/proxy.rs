//! A small proxy of the surface, on which cuts are tried.
//!
//! Vertex clustering (Rossignac and Borrel, "Multi-resolution 3D approximations for rendering complex scenes", 1993):
//! the vertices in a grid cell become one of them, the one nearest to their mean. Only the search uses the proxy;
//! pieces are made from the surface itself.

use super::clean::Surface;
use super::part::Part;
use super::vector::{dot, sub};
use crate::mesh::from_lowest;

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
