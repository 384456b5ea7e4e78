use super::prelude::*;
use crate::geometry::Shape;
use crate::inertial::mass;
use urdd_format::readable::number;

declare_lint! {
    /// The inertia of a link is less than a thousandth of what its mass and shapes give.
    ///
    /// All of the mass would be in a ball of 3 % of the link's size. Joints answer to forces a thousand times more than
    /// the real ones, and MuJoCo refuses the smallest. Where it is 0, SRC004 says so.
    ///
    /// Compute the tensor from the link's geometry, in kg m²: `1e-6` is often a default.
    LNT005 "inertia-far-below-geometry", Warning, WrongMotion, since "1.1.0" => inertia_far_below_geometry;

    /// The mass and the shapes of a body make no density of a thing that is built.
    ///
    /// Above 20,000 kg/m³, unless it is the base, it is heavier than solid tungsten, although the convex hull is larger than the part. Below 10 kg/m³ it is
    /// lighter than foam. The mass is in grams, the shapes are in other units, or the mass was never filled in. Where a
    /// heavy part touches a far too light one, simulators need tiny steps, or explode.
    ///
    /// Write the mass in kilograms, and scale meshes to metres (`scale="0.001 0.001 0.001"`).
    LNT003 "odd-density", Warning, WrongMotion, since "1.1.0" => odd_density
}

/// A motor in a shell has a tenth of the inertia of the evenly filled hull.
const LEAST_PART: f64 = 1e-3;

fn inertia_far_below_geometry(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, _) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    if !urdf.moves() {
        return Some(());
    }
    // LNT022 finds larger ones.
    let longest = urdf.longest_part(findings)?;
    for (index, link) in robot.links.iter().enumerate() {
        let shapes = &geometry.links[index];
        let Some(inertial) = Inertial::of(link).filter(|_| !shapes.is_partial) else {
            continue;
        };
        let Some(hull) = shapes.hull() else { continue };
        let (trace, even) = (inertial.trace(), inertial.mass * hull.even_trace());
        let is_huge = diagonal(shapes.corners()) > longest;
        if trace <= 0.0 || trace >= LEAST_PART * even || is_huge {
            continue;
        }
        let message = format!(
            "the principal moments sum up to {} kg m²; the link's mass and shapes give {}, {} times as much. Compute the \
            inertia from the link's geometry, in kg m²",
            number(trace, 3),
            number(even, 3),
            number(even / trace, 2)
        );
        urdf.at(urdf.inertial(index, "inertia"), message).report(findings);
    }
    Some(())
}

/// The least and the greatest density, kg/m³.
const LEAST: f64 = 10.0;
const GREATEST: f64 = 20_000.0;
/// Dummies of a gram in a box of a millimetre are not meant to be dense, kg.
const DUMMY: f64 = 0.05;

fn odd_density(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    // LNT022 finds larger ones.
    let longest = urdf.longest_part(findings)?;
    for (&top, body) in geometry.bodies.iter().filter(|(_, body)| !body.is_partial) {
        let mass_of = |link: usize| mass(&robot.links[link]);
        let mass: f64 = bodies.members(top).filter_map(mass_of).sum();
        let Some(hull) = (mass > 0.0).then(|| body.hull()).flatten() else {
            continue;
        };
        // Each shape by itself, so that an L is not filled; the smaller of what is seen and what collides.
        let sum = |kind: GeometryKind| -> f64 {
            let shapes = body.shapes.iter().filter(|shape| shape.kind == kind);
            shapes.map(Shape::volume).sum()
        };
        let sums = [GeometryKind::Visual, GeometryKind::Collision].map(sum);
        let least = sums.into_iter().filter(|sum| *sum > 0.0).fold(f64::INFINITY, f64::min);
        let least = if least.is_finite() { least } else { hull.volume };
        // A heavy base holds the robot in place.
        let is_dense = bodies.tree.parent_joint[top].is_some() && mass > DUMMY;
        let (volume, wrong) = if mass / hull.volume > GREATEST && is_dense {
            (hull.volume, "denser than any metal")
        } else if mass / least < LEAST
            && urdf.moves()
            && diagonal(hull.corners.iter().copied()) <= longest
        {
            (least, "lighter than foam")
        } else {
            continue;
        };
        let message = format!(
            "{} kg in {} litres are {} kg/m³, {wrong}; write the mass that the part has, in kilograms, and its shapes in \
            metres",
            number(mass, 3),
            number(volume * 1000.0, 3),
            number(mass / volume, 3)
        );
        let size = |link: &usize| mass_of(*link).unwrap_or(0.0);
        let heaviest = bodies.members(top).max_by(|a, b| size(a).total_cmp(&size(b)));
        urdf.at(urdf.inertial(heaviest.unwrap_or(top), "mass"), message).report(findings);
    }
    Some(())
}
