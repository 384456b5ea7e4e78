//! Minimum-area rectangles of points in a plane.
//!
//! One side of the rectangle contains an edge of the convex hull (H. Freeman, R. Shapira, Determining the Minimum-Area
//! Encasing Rectangle for an Arbitrary Closed Curve, Communications of the ACM 18, 1975). Rotating calipers try all
//! edges in one turn (G. Toussaint, Solving Geometric Problems with the Rotating Calipers, MELECON 1983).

use std::cmp::Ordering;

use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};

use crate::hull::monotone_chain;

type Point2 = [f64; 2];

/// A rectangle. In a search, half perimeter and side are scaled by the length of an edge of the polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    pub area: f64,
    /// The sum of two adjacent side lengths.
    pub half_perimeter: f64,
    /// The unit direction of a side.
    pub side: Point2,
}

fn cross(u: Point2, v: Point2) -> f64 {
    u[0] * v[1] - u[1] * v[0]
}

fn dot(u: Point2, v: Point2) -> f64 {
    u[0] * v[0] + u[1] * v[1]
}

fn minus(u: Point2, v: Point2) -> Point2 {
    [u[0] - v[0], u[1] - v[1]]
}

fn by_value(p: &Point2, q: &Point2) -> Ordering {
    p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]))
}

/// The minimum-area rectangle of a counterclockwise convex polygon. The polygon may deviate from convexity by rounding,
/// and may repeat points. `None` if it has no area.
pub fn smallest_rectangle(polygon: &mut Vec<Point2>) -> Option<Rectangle> {
    straighten(polygon);
    let n = polygon.len();
    if n < 3 {
        return None;
    }
    // Close the polygon: append its first corner.
    polygon.push(polygon[0]);
    let Rectangle { area, half_perimeter, side } =
        if n <= MAX_AT_ONCE { at_once(Level::new(), polygon) } else { one_by_one(polygon) };
    let length = dot(side, side).sqrt();
    (length > 0.0).then(|| Rectangle {
        area,
        half_perimeter: half_perimeter / length,
        side: side.map(|x| x / length),
    })
}

impl Rectangle {
    const NOTHING: Self = Self { area: f64::INFINITY, half_perimeter: 0.0, side: [0.0; 2] };

    /// Considers the rectangle along an edge, given the corners farthest ahead, across and behind.
    #[inline(always)]
    fn take(&mut self, polygon: &[Point2], i: usize, [ahead, across, behind]: [usize; 3]) {
        let along = minus(polygon[i + 1], polygon[i]);
        let normal = [-along[1], along[0]];
        let length = dot(minus(polygon[ahead], polygon[behind]), along);
        let height = dot(minus(polygon[across], polygon[i]), normal);
        // Both are scaled by the length of the edge.
        let area = length * height / dot(along, along);
        if area < self.area {
            *self = Self { area, half_perimeter: length + height, side: along };
        }
    }
}

/// Tries each edge of a closed polygon, whose last corner repeats the first. The search for the farthest corner in a
/// direction continues from its position for the previous edge.
fn one_by_one(polygon: &[Point2]) -> Rectangle {
    let n = polygon.len() - 1;
    let edge = |i: usize| minus(polygon[i + 1], polygon[i]);
    let walk = |from: &mut usize, towards: Point2| {
        for _ in 0..n {
            if dot(edge(*from), towards) <= 0.0 {
                break;
            }
            *from = if *from + 1 == n { 0 } else { *from + 1 };
        }
    };
    let (mut ahead, mut across, mut behind) = (0, 0, 0);
    let mut best = Rectangle::NOTHING;
    for i in 0..n {
        let along = edge(i);
        walk(&mut ahead, along);
        if i == 0 {
            across = ahead;
        }
        walk(&mut across, [-along[1], along[0]]);
        if i == 0 {
            behind = across;
        }
        walk(&mut behind, [-along[0], -along[1]]);
        best.take(polygon, i, [ahead, across, behind]);
    }
    best
}

/// Maximum number of edges for a bit set in one word.
const MAX_AT_ONCE: usize = 64;

/// Edges per block.
const WIDTH: usize = 8;

/// The same as [`one_by_one`], bit for bit, for at most [`MAX_AT_ONCE`] edges. Tests all edges at once where a walk
/// ends, which avoids unpredictable branches.
fn at_once(level: Level, polygon: &[Point2]) -> Rectangle {
    dispatch!(level, simd => at_once_in(simd, polygon))
}

#[inline(always)]
fn at_once_in<S: Simd>(simd: S, polygon: &[Point2]) -> Rectangle {
    let n = polygon.len() - 1;
    let blocks = n.div_ceil(WIDTH);
    let (mut x, mut y) = ([[0.0; WIDTH]; WIDTH], [[0.0; WIDTH]; WIDTH]);
    for (i, (from, to)) in polygon.iter().zip(&polygon[1..]).enumerate() {
        let [along_x, along_y] = minus(*to, *from);
        x[i / WIDTH][i % WIDTH] = along_x;
        y[i / WIDTH][i % WIDTH] = along_y;
    }
    let zero = f64x8::splat(simd, 0.0);
    let all = u64::MAX >> (MAX_AT_ONCE - n);
    let (mut ahead, mut across, mut behind) = (0, 0, 0);
    let mut best = Rectangle::NOTHING;
    for i in 0..n {
        let along_x = f64x8::splat(simd, x[i / WIDTH][i % WIDTH]);
        let along_y = f64x8::splat(simd, y[i / WIDTH][i % WIDTH]);
        // The edges at which the walks ahead, across and behind end.
        let mut ends = [0, 0, 0];
        for b in (0..blocks).rev() {
            let edge_x = f64x8::load_array_ref(simd, &x[b]);
            let edge_y = f64x8::load_array_ref(simd, &y[b]);
            let along = edge_x * along_x + edge_y * along_y;
            let across = edge_x * -along_y + edge_y * along_x;
            ends[0] = ends[0] << WIDTH | along.simd_le(zero).to_bitmask();
            ends[1] = ends[1] << WIDTH | across.simd_le(zero).to_bitmask();
            ends[2] = ends[2] << WIDTH | along.simd_ge(zero).to_bitmask();
        }
        ahead = next_of(ends[0] & all, ahead);
        if i == 0 {
            across = ahead;
        }
        across = next_of(ends[1] & all, across);
        if i == 0 {
            behind = across;
        }
        behind = next_of(ends[2] & all, behind);
        best.take(polygon, i, [ahead, across, behind]);
    }
    best
}

/// The first member of a set from `from` on, otherwise the first member of the set, otherwise `from`.
#[inline(always)]
fn next_of(set: u64, from: usize) -> usize {
    let later = set >> from << from;
    match if later == 0 { set } else { later } {
        0 => from,
        set => set.trailing_zeros() as usize,
    }
}

/// Removes corners that do not turn left from a closed polygon that is nearly convex.
fn straighten(polygon: &mut Vec<Point2>) {
    let Some((first, &start)) = polygon.iter().enumerate().min_by(|(_, p), (_, q)| by_value(p, q))
    else {
        return;
    };
    polygon.rotate_left(first);
    let mut kept = 1;
    for i in 1..=polygon.len() {
        // The lexicographically lowest corner stays, and closes the polygon.
        let p = polygon.get(i).copied().unwrap_or(start);
        while kept >= 2 {
            let (u, v) = (polygon[kept - 2], polygon[kept - 1]);
            if cross(minus(v, u), minus(p, v)) > 0.0 {
                break;
            }
            kept -= 1;
        }
        if i < polygon.len() && p != polygon[kept - 1] {
            polygon[kept] = p;
            kept += 1;
        }
    }
    polygon.truncate(kept);
}

/// The convex hull of points in place, counterclockwise, in doubles. The error of its area is within rounding.
pub fn outline(points: &mut Vec<Point2>) {
    points.sort_unstable_by(by_value);
    *points = monotone_chain(points, |u, v, p| cross(minus(v, u), minus(p, v)) > 0.0);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::levels::levels;

    #[test]
    fn each_instruction_set_finds_what_walking_finds() {
        for n in [3, 4, 6, 7, 8, 9, 12, 31, 40, 63, 64] {
            for turn in 0..20 {
                // On an ellipse, so that opposite edges of even polygons are parallel up to rounding, and unrotated
                // rectangles and hexagons have edges at right angles. Every fourth polygon has a corner that turns
                // right.
                let turned = 0.3 * f64::from(turn / 2);
                let mut polygon: Vec<Point2> = (0..n)
                    .map(|k| (2.0 * f64::from(k) + 1.0) * std::f64::consts::PI / f64::from(n))
                    .map(|angle| [2.0 * (angle + turned).cos(), (angle + turned).sin()])
                    .collect();
                if turn % 4 == 3 {
                    polygon[1] = polygon[1].map(|x| 0.2 * x);
                }
                if turn % 2 == 1 {
                    let on_grid = |x: f64| (16.0 * x).round() / 16.0;
                    polygon = polygon.iter().map(|p| p.map(on_grid)).collect();
                }
                polygon.push(polygon[0]);
                let plain = one_by_one(&polygon);
                for level in levels() {
                    assert_eq!(at_once(level, &polygon), plain, "{level:?} {n} {turn}");
                }
            }
        }
    }
}
