use std::collections::HashMap;

use urdd_findings::finding::point;

use super::prelude::*;
use crate::geometry::slide_only;

declare_lint! {
    /// The centre of mass of a link is outside of its shapes.
    ///
    /// No mass inside the convex hull of the shapes has its centre there. Gravity then turns the joints before the link otherwise
    /// than on the robot, and a legged robot falls. Common causes: a sign, millimetres, the frame of the CAD assembly, a missing
    /// `<origin>`.
    ///
    /// Write the centre of mass in the link's frame, in metres, as the `<origin>` of `<inertial>`.
    LNT002 "centre-of-mass-outside", Warning, WrongMotion, since "1.1.0" => center_of_mass_outside;

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
    LNT001 "inertia-beyond-geometry", Warning, WrongMotion, since "1.1.0" => inertia_beyond_geometry
}

/// How far outside the centre of mass may be in a rough model, as a part of the body's size.
const PART_OUTSIDE: f64 = 0.1;
/// And in m, of both.
const MARGIN: f64 = 0.005;
/// Frames with a token mass do no harm, kg.
const LIGHT: f64 = 0.01;
/// A denser body than this, kg/m³, has parts that its shapes leave out.
const DENSE: f64 = 4000.0;

fn center_of_mass_outside(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    if !urdf.moves() {
        return Some(());
    }
    // A body at a time: it has one hull.
    let mut order: Vec<usize> = (0..robot.links.len()).collect();
    order.sort_by_key(|link| bodies.top[*link]);
    let mut last = None;
    let mut found = BTreeMap::new();
    for index in order {
        let (link, top) = (&robot.links[index], bodies.top[index]);
        let body = &geometry.bodies.get(&top).filter(|body| !body.is_partial && !body.is_turned);
        let Some((inertial, body)) = Inertial::of(link).zip(*body) else {
            continue;
        };
        let has_shapes = !link.visual.is_empty() || !link.collision.is_empty();
        if !has_shapes || inertial.mass <= LIGHT {
            continue;
        }
        let (_, hull) =
            last.take().filter(|(of, _)| *of == top).unwrap_or_else(|| (top, body.hull()));
        let (_, Some(hull)) = last.insert((top, hull)) else { continue };
        let points = body.in_frame(&bodies.pose[index]);
        let size = diagonal(points);
        let center = bodies.pose[index].transform_point(&Point3::from(inertial.center));
        let beyond = hull.outside(&center.coords);
        if inertial.mass > DENSE * hull.volume || beyond <= PART_OUTSIDE * size + MARGIN {
            continue;
        }
        let message = format!(
            "the centre of mass is {} outside of the link's shapes, which are {} long; write it in the link's frame, in metres",
            metres(beyond),
            metres(size)
        );
        let node = urdf.inertial(index, "origin");
        let center = point(inertial.center.into());
        found.insert(index, urdf.at(node, message).actual(center).off_by(beyond, "m"));
    }
    found.into_values().for_each(|finding| finding.report(findings));
    Some(())
}

/// How much wider than the shapes the mass may be, as a part of the size. They leave out cables and screws.
const PART_WIDER: f64 = 0.05;
/// Links with less than this part of their body's inertia do no harm.
const LEAST: f64 = 0.01;

fn inertia_beyond_geometry(urdf: &Subject, findings: &mut Findings) -> Option<()> {
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
        if slides[link] || body.is_partial || body.is_turned || body.shapes.is_empty() || is_little
        {
            continue;
        }
        let points: Vec<Vector3<f64>> = body.in_frame(&bodies.pose[link]).collect();
        let margin = PART_WIDER * diagonal(points.iter().copied()) + MARGIN;
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
