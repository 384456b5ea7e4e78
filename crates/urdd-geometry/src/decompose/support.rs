//! Support points in a fixed set of directions: a bounded approximation of a point set's hull.
//!
//! A part may have thousands of points. For the *search*, the farthest point in each of [`COUNT`] directions describes
//! its hull well enough. Scaling along the axes does not change which points are hull corners, so flat sets are best
//! scaled to a cube first: then the directions find their rims.

use std::sync::LazyLock;

use fearless_simd::{Level, Simd, dispatch, f32x16, prelude::*, u32x16};

use crate::vector::{norm, spread};

/// Directions per row.
const WIDTH: usize = 16;

/// Number of rows.
const ROWS: usize = 3;

/// Number of directions.
const COUNT: usize = ROWS * WIDTH;

/// One value for each direction.
type Row<T> = [[T; WIDTH]; ROWS];

/// The x, y and z coordinates.
type Directions = [Row<f32>; 3];

/// The 26 directions of a cube's faces, corners and edges, and evenly spread ones for the rest.
static DIRECTIONS: LazyLock<Directions> = LazyLock::new(|| {
    let mut list: Vec<[f64; 3]> = Vec::with_capacity(COUNT);
    for kind in [1, 3, 2] {
        for code in 0..27_i32 {
            let d = [code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1];
            if d.iter().map(|c| c * c).sum::<i32>() == kind {
                list.push(d.map(f64::from));
            }
        }
    }
    list.extend(spread(COUNT - list.len()));
    let mut out = [[[0.0; WIDTH]; ROWS]; 3];
    for (i, d) in list.iter().enumerate() {
        for (row, x) in out.iter_mut().zip(d) {
            row[i / WIDTH][i % WIDTH] = (x / norm(*d)) as f32;
        }
    }
    out
});

/// A point and its index.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    at: [f32; 3],
    index: u32,
}

impl Candidate {
    pub fn new(at: [f64; 3], index: u32) -> Self {
        Candidate { at: at.map(|x| x as f32), index }
    }
}

/// The distinct support points, in the order of the directions; the first of equally far ones.
pub(super) fn support(candidates: &[Candidate]) -> Vec<u32> {
    let mut out: Vec<u32> = Vec::with_capacity(COUNT);
    if candidates.is_empty() {
        return out;
    }
    for &i in farthest_at(Level::new(), candidates).as_flattened() {
        if !out.contains(&i) {
            out.push(i);
        }
    }
    out
}

/// For each direction, the index of the farthest point, the first of equals. `candidates` must not be empty.
fn farthest_at(level: Level, candidates: &[Candidate]) -> Row<u32> {
    dispatch!(level, simd => farthest(simd, &DIRECTIONS, candidates))
}

#[inline(always)]
fn farthest<S: Simd>(simd: S, [x, y, z]: &Directions, candidates: &[Candidate]) -> Row<u32> {
    let mut rows = [[f32x16::splat(simd, 0.0); 3]; ROWS];
    for (k, row) in rows.iter_mut().enumerate() {
        *row = [&x[k], &y[k], &z[k]].map(|row| f32x16::load_array_ref(simd, row));
    }
    let first = candidates.first().map_or(0, |c| c.index);
    let mut value = [f32x16::splat(simd, f32::NEG_INFINITY); ROWS];
    let mut point = [u32x16::splat(simd, first); ROWS];
    for c in candidates {
        let x = f32x16::splat(simd, c.at[0]);
        let y = f32x16::splat(simd, c.at[1]);
        let z = f32x16::splat(simd, c.at[2]);
        let index = u32x16::splat(simd, c.index);
        for k in 0..ROWS {
            let [dx, dy, dz] = rows[k];
            let v = dx * x + dy * y + dz * z;
            let better = v.simd_gt(value[k]);
            value[k] = better.select(v, value[k]);
            point[k] = better.select(index, point[k]);
        }
    }
    [point[0].to_array(), point[1].to_array(), point[2].to_array()]
}

#[cfg(test)]
#[path = "tests/support.rs"]
mod tests;
