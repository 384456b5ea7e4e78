use super::prelude::*;
use urdd_format::readable::number;

declare_lint! {
    /// The inertia of a link is less than a thousandth of what its mass and shapes give.
    ///
    /// All of the mass would be in a ball of 3 % of the link's size. Joints answer to forces a thousand times more than
    /// the real ones, and MuJoCo refuses the smallest. Where it is 0, SRC004 says so.
    ///
    /// Compute the tensor from the link's geometry, in kg m²: `1e-6` is often a default.
    LNT005 "inertia-far-below-geometry", Warning, WrongMotion, since "1.1.0"
}

/// A motor in a shell has a tenth of the inertia of the evenly filled hull.
const LEAST: f64 = 1e-3;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
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
        let Some(hull) = shapes.hull() else {
            continue;
        };
        let (trace, even) = (inertial.trace(), inertial.mass * hull.even_trace());
        let is_huge = diagonal(shapes.corners()) > longest;
        if trace <= 0.0 || trace >= LEAST * even || is_huge {
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
