//! Whether spheres cover a convex piece (SPEC 8.9.4): the piece is cut into one part for each sphere, and a part is covered
//! where its corners are.

use nalgebra::Vector3;

use super::fit::{Ball, Solid};
use crate::reference::samples::Budget;
use urdd_findings::part::SkipReason;

/// A point of a piece that is outside of all spheres.
#[derive(Debug, Clone, Copy)]
pub struct Outside {
    /// In the link's frame, m.
    pub point: Vector3<f64>,
    /// How far outside it is, m; infinite without spheres.
    pub distance: f64,
}

/// How far a point is outside of all spheres; negative inside.
fn outside(point: &Vector3<f64>, balls: &[Ball]) -> f64 {
    balls.iter().map(|ball| ball.height(point)).fold(f64::INFINITY, f64::min)
}

/// A corner of the piece's parts that is outside of all spheres by more than the tolerance, of these the farthest; `None` if
/// all of the piece is in spheres. The spheres are made larger by the tolerance: then a point may be nowhere outside.
///
/// # Errors
/// If it takes too much work.
pub fn uncovered(
    solid: &Solid,
    balls: &[Ball],
    tolerance: f64,
    budget: &Budget,
) -> Result<Option<Outside>, SkipReason> {
    budget.spend((balls.len() + 3 * solid.vertices.len() + 20) as u64)?;
    // In a frame at the piece's middle, so that numbers are small.
    let moved =
        |ball: &Ball| Ball { centre: ball.centre - solid.centre, radius: ball.radius + tolerance };
    let meets = |ball: &Ball| ball.height(&Vector3::zeros()) <= solid.radius;
    let near: Vec<Ball> = balls.iter().map(moved).filter(meets).collect();
    let vertices: Vec<Vector3<f64>> = solid.vertices.iter().map(|v| v - solid.centre).collect();
    let mut worst: Option<Outside> = None;
    let mut judge = |point: &Vector3<f64>| {
        let point = point + solid.centre;
        let distance = outside(&point, balls);
        if distance > tolerance && worst.is_none_or(|worst| distance > worst.distance) {
            worst = Some(Outside { point, distance });
        }
    };
    let holds_all = |ball: &Ball| {
        let mut all = vertices.iter();
        ball.height(&Vector3::zeros()) <= 0.0 && all.all(|vertex| ball.height(vertex) <= 0.0)
    };
    budget.spend((near.len() * 10) as u64)?;
    if near.iter().any(holds_all) {
        return Ok(None);
    }
    if near.is_empty() {
        budget.spend((vertices.len() * balls.len()) as u64)?;
        vertices.iter().for_each(&mut judge);
        return Ok(worst);
    }
    let whole =
        Polyhedron::new(solid.triangles().map(|of| of.map(|v| v - solid.centre)), solid.radius);
    for place in 0..near.len() {
        for corner in part(&whole, &near, place, budget)? {
            budget.spend(balls.len() as u64)?;
            judge(&corner);
        }
    }
    Ok(worst)
}

/// The corners, outside of a sphere, of the part where no other sphere has a smaller power.
fn part(
    whole: &Polyhedron,
    balls: &[Ball],
    place: usize,
    budget: &Budget,
) -> Result<Vec<Vector3<f64>>, SkipReason> {
    let own = balls[place];
    // Planes, each by how far it is from the centre along its normal.
    let mut planes: Vec<(f64, Vector3<f64>)> = Vec::with_capacity(balls.len());
    for (other, ball) in balls.iter().enumerate() {
        let way = ball.centre - own.centre;
        let apart = way.norm();
        if apart > CONCENTRIC {
            let squares = (own.radius - ball.radius) * (own.radius + ball.radius);
            planes.push(((apart * apart + squares) / (2.0 * apart), way / apart));
        } else if ball.radius > own.radius || (ball.radius == own.radius && other < place) {
            // One that is larger, or the first of equal ones, has all of it.
            return Ok(Vec::new());
        }
    }
    planes.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    budget.spend((planes.len() as u64 + 1) * 30)?;
    let mut part = whole.clone();
    let mut planes = planes.into_iter();
    loop {
        budget.spend(10 * part.size() as u64)?;
        let farthest = part.corners().map(|corner| (corner - own.centre).norm());
        let farthest = farthest.fold(0.0, f64::max);
        if farthest <= own.radius {
            return Ok(Vec::new());
        }
        match planes.next() {
            Some((offset, normal)) if offset < farthest => {
                part.cut(&normal, offset + normal.dot(&own.centre));
            }
            _ => break,
        }
    }
    Ok(part.corners().filter(|corner| own.height(corner) > 0.0).copied().collect())
}

/// Centres that are no farther apart, m, are one: the square of a smaller number is rounded to 0.
const CONCENTRIC: f64 = 1e-140;

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
