use std::collections::HashMap;

use super::prelude::*;
use crate::bodies::slide_only;

declare_lint! {
    /// The inertia of a link is larger than any mass inside its shapes can have.
    ///
    /// This is no guess about density: no distribution of the mass in the convex hull of the shapes, 5 % and 5 mm wider on all
    /// sides, has such a moment about the given centre of mass. Links that fixed joints hold together are one body.
    ///
    /// Simulators take it as it is. The joint then moves as if it carried something far larger, and a controller that was
    /// tuned on it is wrong for the robot. With the published inertias of UR5's wrists, these joints have 13, 53 and 187
    /// times the inertia that evenly filled wrists have (Pinocchio). Common causes: the identity matrix, `0.01 0 0 0.01 0
    /// 0.01`, a tensor in other units or about another point, another link's tensor.
    ///
    /// Links that only slide, on prismatic joints from a base that is fixed to the world, are left out: their inertia has no
    /// effect. A base is taken for fixed if it is called `world`, or has no mass.
    ///
    /// Compute the tensor from the link's geometry, about its centre of mass, in kg m². If the number stands for a
    /// rotor, write it as the joint's armature in the simulator.
    LNT001 "inertia-beyond-geometry", Warning, WrongMotion, since "1.1.0"
}

/// How much wider than the shapes the mass may be: a part of the size, and m. They leave out cables and screws.
const PART: f64 = 0.05;
const MARGIN: f64 = 0.005;
/// Links with less than this part of their body's inertia do no harm.
const LEAST: f64 = 0.01;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    let slides = slide_only(robot, bodies);
    let inertials: Vec<Option<Inertial>> = robot.links.iter().map(Inertial::of).collect();
    let mut of_body: HashMap<usize, f64> = HashMap::new();
    for (link, inertial) in inertials.iter().enumerate() {
        *of_body.entry(bodies.top[link]).or_default() +=
            inertial.map_or(0.0, |inertial| inertial.trace());
    }
    for (link, inertial) in inertials.iter().enumerate() {
        let top = bodies.top[link];
        let Some((inertial, body)) = inertial.as_ref().zip(geometry.bodies.get(&top)) else {
            continue;
        };
        let is_little = inertial.trace() <= 0.0 || inertial.trace() < LEAST * of_body[&top];
        if slides[link]
            || body.is_partial
            || body.is_turned()
            || body.shapes.is_empty()
            || is_little
        {
            continue;
        }
        let points: Vec<Vector3<f64>> = body.in_frame(&bodies.pose[link]).collect();
        let margin = PART * diagonal(points.iter().copied()) + MARGIN;
        let largest = largest_radii(inertial, &points, margin);
        let radii = inertial.moments.map(|moment| (moment / inertial.mass).max(0.0).sqrt());
        let worst = (0..3)
            .max_by(|a, b| (radii[*a] / largest[*a]).total_cmp(&(radii[*b] / largest[*b])))?;
        if radii[worst] > largest[worst] {
            let message = format!(
                "the radius of gyration, √(inertia / mass), is {}; the shapes of the link, and of what is fixed to it, allow \
                {} at most. Compute the inertia from the link's geometry, about the centre of mass, in kg m²",
                metres(radii[worst]),
                metres(largest[worst])
            );
            let node = urdf.inertial(link, "inertia");
            urdf.at(node, message).off_by(radii[worst] - largest[worst], "m").report(findings);
        }
    }
    Some(())
}

/// The largest radius of gyration, m, that mass in the points' hull, wider by the margin, can have about each principal axis
/// with this centre: by the farthest point from the axis, and by the largest variance of a distribution on an interval
/// whose mean is given, (high - mean)(mean - low) (Bhatia and Davis 2000).
pub fn largest_radii(inertial: &Inertial, points: &[Vector3<f64>], margin: f64) -> Vector3<f64> {
    let seen: Vec<Vector3<f64>> =
        points.iter().map(|point| inertial.axes.tr_mul(&(point - inertial.center))).collect();
    let variance = |axis: usize| {
        let low = seen.iter().map(|point| point[axis]).fold(f64::INFINITY, f64::min) - margin;
        let high = seen.iter().map(|point| point[axis]).fold(f64::NEG_INFINITY, f64::max) + margin;
        match low < 0.0 && high > 0.0 {
            true => -low * high,
            // The centre is outside: LNT002 says so.
            false => low.abs().max(high.abs()).powi(2),
        }
    };
    let variances = [0, 1, 2].map(variance);
    let radius = |axis: usize| {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let farthest =
            seen.iter().map(|point| point[j].hypot(point[k])).fold(0.0, f64::max) + margin;
        farthest.powi(2).min(variances[j] + variances[k]).sqrt()
    };
    Vector3::new(radius(0), radius(1), radius(2))
}
