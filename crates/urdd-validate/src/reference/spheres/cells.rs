//! Whether spheres cover a convex piece (SPEC 8.9.4): the piece is cut into one part for each sphere, and a part is covered
//! where its corners are.

use nalgebra::Vector3;

use super::link_pieces::Ball;
use super::polyhedron::Polyhedron;
use super::solid::Solid;
use crate::reference::budget::Budget;
use urdd_findings::skip::SkipReason;

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
