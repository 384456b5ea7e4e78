//! Measures of points and triangles.

use std::collections::HashSet;

use crate::space::{dot, less};

pub(super) type Triangle = [[f64; 3]; 3];

/// Measures of a mesh, in its own units. All are 0 without points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Measures {
    /// How many different points there are, up to 4.
    pub points: usize,
    /// Whether a coordinate is not finite.
    pub has_infinite: bool,
    /// The largest coordinate, without its sign.
    pub largest: f64,
    /// How far a point is from the first one at most, from the line of these two, and from the plane of these three; the
    /// latter in coordinates of single precision.
    pub spread: [f64; 3],
    /// The size of its box along each axis.
    pub size: [f64; 3],
    /// The sum of the volumes, each without its sign, between triangles and the mean of their centres; in coordinates of
    /// single precision.
    pub volume: f64,
}

impl Measures {
    /// Measures points and triangles, which are gone through several times.
    pub(super) fn of<P, T>(points: impl Fn() -> P, triangles: impl Fn() -> T) -> Measures
    where
        P: Iterator<Item = [f64; 3]>,
        T: Iterator<Item = Triangle>,
    {
        let mut measures = Measures::default();
        let Some(first) = points().next() else { return measures };
        let (mut low, mut high) = (first, first);
        let mut distinct: Vec<[f64; 3]> = Vec::new();
        for point in points() {
            for axis in 0..3 {
                measures.has_infinite |= !point[axis].is_finite();
                measures.largest = measures.largest.max(point[axis].abs());
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
            if distinct.len() < 4 && !distinct.contains(&point) {
                distinct.push(point);
            }
        }
        measures.points = distinct.len();
        measures.size = less(high, low);
        measures.spread = spread(&points, first);
        measures.volume = volume(|| triangles().map(|corners| corners.map(single)));
        measures
    }
}

fn spread<P: Iterator<Item = [f64; 3]>>(points: impl Fn() -> P, first: [f64; 3]) -> [f64; 3] {
    let flat = single(first);
    let (from_point, second) = farthest(points(), first, |point| length(less(point, first)));
    let line = unit(less(second, first));
    let off_line = |point| length(cross(less(point, first), line));
    let (from_line, third) = farthest(points(), first, off_line);
    let sides = [second, third].map(|point| less(single(point), flat));
    let normal = unit(cross(unit(sides[0]), sides[1]));
    let off_plane = |point| dot(less(single(point), flat), normal).abs();
    let (from_plane, _) = farthest(points(), first, off_plane);
    [from_point, from_line, from_plane]
}

/// The point of the largest distance, and that; `first` if all have none.
fn farthest(
    points: impl Iterator<Item = [f64; 3]>,
    first: [f64; 3],
    distance: impl Fn([f64; 3]) -> f64,
) -> (f64, [f64; 3]) {
    points
        .map(|point| (distance(point), point))
        .fold((0.0, first), |far, one| if one.0 > far.0 { one } else { far })
}

fn volume<T: Iterator<Item = Triangle>>(triangles: impl Fn() -> T) -> f64 {
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for triangle in triangles() {
        for corner in triangle {
            sum = [0, 1, 2].map(|axis| sum[axis] + corner[axis]);
            count += 1.0;
        }
    }
    let centre = sum.map(|sum| sum / f64::max(count, 1.0));
    triangles()
        .map(|[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|corner| less(corner, centre));
            dot(a, cross(b, c)).abs() / 6.0
        })
        .sum()
}

/// Whether two of the first points are one; too many are not looked at.
pub(super) fn has_repeated(points: impl Iterator<Item = [f64; 3]>) -> bool {
    const MOST: usize = 100_000;
    let mut seen = HashSet::new();
    points.take(MOST).any(|point| !seen.insert(point.map(|axis| (axis + 0.0).to_bits())))
}

/// A point in single precision.
#[allow(clippy::cast_possible_truncation)]
fn single(point: [f64; 3]) -> [f64; 3] {
    point.map(|axis| f64::from(axis as f32))
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// A vector of length 1; of length 0 if it has none.
fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = length(a);
    if length > 0.0 { a.map(|axis| axis / length) } else { [0.0; 3] }
}
