//! How far the spheres of a link are from its pieces: SPEC 8.9.5.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::link_pieces::{Ball, LinkPieces};
use super::solid::normal;
use crate::reference::budget::Budget;
use urdd_findings::skip::SkipReason;

/// Number of points on a sphere.
const POINTS: u32 = 64;
/// Turns from one of them to the next.
const TURN: f64 = 0.6180339887498949;
/// A point is inside of another sphere where its distance from the centre is less than this part of the radius.
const INSIDE: f64 = 1.0 - 1e-6;
/// A triangle's longest edge is cut into parts of about this part of the diagonal.
const PARTS: f64 = 15.7;
/// Outside of the spheres, or beneath planes of another piece, by more than this part of the diagonal.
const BEYOND: f64 = 1e-6;

/// The largest and the mean distance of points on spheres from the pieces, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standoff {
    pub max: f64,
    pub mean: f64,
}

/// The part of the surface that is outside of the spheres, and how far, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uncovered {
    pub fraction: f64,
    pub max: f64,
}

/// The directions in which there are points on a sphere.
fn directions() -> Vec<Vector3<f64>> {
    let direction = |k: u32| {
        let k = f64::from(k);
        let z = 1.0 - (2.0 * k + 1.0) / f64::from(POINTS);
        let s = (1.0 - z * z).sqrt();
        let a = TAU * (TURN * k).fract();
        Vector3::new(s * a.cos(), s * a.sin(), z)
    };
    (0..POINTS).map(direction).collect()
}

/// The standoff of the spheres of a link.
///
/// # Errors
/// If it takes too much work.
pub fn standoff(
    pieces: &LinkPieces,
    balls: &[Ball],
    budget: &Budget,
) -> Result<Standoff, SkipReason> {
    let directions = directions();
    let triangles: usize = pieces.solids.iter().map(|solid| solid.num_triangles()).sum();
    let (mut max, mut sum, mut weights) = (0.0_f64, 0.0, 0.0);
    for (place, ball) in balls.iter().enumerate() {
        let reaches = |(other, of): (usize, &Ball)| {
            let near = (of.centre - ball.centre).norm() < of.radius + ball.radius;
            (near && other != place).then_some(*of)
        };
        let others: Vec<Ball> = balls.iter().enumerate().filter_map(reaches).collect();
        let point = 3 * others.len() + 2 * triangles + 5 * pieces.solids.len() + 10;
        budget.spend((balls.len() + POINTS as usize * point) as u64)?;
        for direction in &directions {
            let point = ball.centre + direction * ball.radius;
            if others.iter().any(|of| (point - of.centre).norm() < INSIDE * of.radius) {
                continue;
            }
            let solids = pieces.solids.iter();
            let nearest = solids.fold(f64::INFINITY, |limit, solid| solid.distance(&point, limit));
            max = max.max(nearest);
            sum += ball.radius * ball.radius * nearest;
            weights += ball.radius * ball.radius;
        }
    }
    Ok(Standoff { max, mean: if weights > 0.0 { sum / weights } else { 0.0 } })
}

/// The corners of a triangle, and its unit normal.
type Triangle = ([Vector3<f64>; 3], Vector3<f64>);

/// The inner side of a plane.
struct Beneath {
    normal: Vector3<f64>,
    offset: f64,
}

/// The surface outside of the spheres, for the spheres of several levels.
///
/// # Errors
/// If it takes too much work.
pub fn uncovered(
    pieces: &LinkPieces,
    levels: &[Vec<Ball>],
    budget: &Budget,
) -> Result<Vec<Uncovered>, SkipReason> {
    let beyond = BEYOND * pieces.diagonal;
    let triangles = pieces.meshes.iter().map(|mesh| {
        let triangles = mesh.triangles.iter();
        let triangles = triangles.map(|triangle| mesh.corners(*triangle).map(Vector3::from));
        triangles.filter_map(|corners| Some((corners, normal(&corners)?)))
    });
    let triangles: Vec<Vec<Triangle>> = triangles.map(Iterator::collect).collect();
    let planes = triangles.iter().map(|of| {
        let beneath = |(corners, normal): &Triangle| Beneath {
            normal: *normal,
            offset: normal.dot(&corners[0]) - beyond,
        };
        of.iter().map(beneath).collect()
    });
    let planes: Vec<Vec<Beneath>> = planes.collect();
    let mut found = vec![Uncovered { fraction: 0.0, max: 0.0 }; levels.len()];
    let mut last = vec![0; levels.len()];
    let mut all = 0.0;
    for (own, triangles) in triangles.iter().enumerate() {
        for (corners, _) in triangles {
            let [a, b, c] = corners;
            let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
            let n = (PARTS * longest / pieces.diagonal).ceil().max(1.0);
            let weight = (b - a).cross(&(c - a)).norm() / (n * n);
            budget.spend((n * n) as u64 * (10 + 10 * planes.len() as u64))?;
            let mut work = 0;
            for point in centroids(corners, n as u32) {
                let mut inside = |(piece, planes): (usize, &Vec<Beneath>)| {
                    let solid = &pieces.solids[piece];
                    let far = (point - solid.centre).norm() > solid.radius;
                    piece != own && !far && !planes.is_empty() && {
                        let above = |of: &Beneath| of.normal.dot(&point) >= of.offset;
                        let first = planes.iter().position(above);
                        work += 2 * first.unwrap_or(planes.len());
                        first.is_none()
                    }
                };
                let is_inside = planes.iter().enumerate().any(&mut inside);
                if is_inside {
                    continue;
                }
                all += weight;
                for ((balls, found), last) in levels.iter().zip(&mut found).zip(&mut last) {
                    let (height, looked) = lowest(&point, balls, last, beyond);
                    work += 3 * looked;
                    if height > beyond {
                        found.fraction += weight;
                        found.max = found.max.max(height);
                    }
                }
            }
            budget.spend(work as u64)?;
        }
    }
    for found in &mut found {
        found.fraction = if all > 0.0 { found.fraction / all } else { 0.0 };
    }
    Ok(found)
}

/// How far a point is outside of all spheres, and how many were looked at. Stops at one that it is outside of by no more than
/// `enough`, and looks at that first the next time.
fn lowest(point: &Vector3<f64>, balls: &[Ball], last: &mut usize, enough: f64) -> (f64, usize) {
    if let Some(ball) = balls.get(*last)
        && ball.height(point) <= enough
    {
        return (enough, 1);
    }
    let mut lowest = f64::INFINITY;
    for (place, ball) in balls.iter().enumerate() {
        lowest = lowest.min(ball.height(point));
        if lowest <= enough {
            *last = place;
            return (enough, place + 1);
        }
    }
    (lowest, balls.len())
}

/// The centroids of n^2 triangles of equal area that lines parallel to its edges cut a triangle into.
fn centroids([a, b, c]: &[Vector3<f64>; 3], n: u32) -> impl Iterator<Item = Vector3<f64>> {
    let (a, u, v) = (*a, (b - a) / f64::from(n), (c - a) / f64::from(n));
    let at = move |i: f64, j: f64| a + u * i + v * j;
    (0..n).flat_map(move |i| {
        (0..n - i).flat_map(move |j| {
            let [x, y] = [i, j].map(f64::from);
            let upright = at(x + 1.0 / 3.0, y + 1.0 / 3.0);
            let turned = (i + j + 1 < n).then(|| at(x + 2.0 / 3.0, y + 2.0 / 3.0));
            std::iter::once(upright).chain(turned)
        })
    })
}
