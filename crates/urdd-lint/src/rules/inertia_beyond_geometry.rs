use nalgebra::Vector3;

use crate::rule::declare_lint;
use crate::subject::Subject;
use urdd_format::readable::metres;
use urdd_validate::finding::Findings;

declare_lint! {
    /// The inertia of a link is larger than any mass inside its shapes could have.
    ///
    /// The moment about an axis is at most the mass times the square of the largest distance of the link's shapes from
    /// that axis. A larger one is a fault of the tensor: of its unit, of the axes that it was computed about, or of the
    /// link that it was copied from. Simulators take it as it is: the joint moves as if it carried a much larger
    /// body, controllers that were tuned on it are too strong on the robot.
    ///
    /// Compute the tensor again, about the centre of mass, from the link's own geometry, in kg m².
    LNT001 "inertia-beyond-geometry", Warning, WrongMotion, since "1.1.0"
}

/// How far beyond the shapes the mass would have to be: they leave out cables, screws and what is inside of a housing
/// that is drawn too small.
const MARGIN: f64 = 1.25;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (index, body) in urdf.bodies(findings)?.iter().enumerate() {
        let (Some(inertial), false) = (body.inertial, body.geometry.is_partial) else {
            continue;
        };
        let from_axis = |axis: Vector3<f64>| {
            let points = body.geometry.points();
            let distance = |point| (Vector3::from(point) - inertial.center).cross(&axis).norm();
            points.map(distance).reduce(f64::max)
        };
        let axes = inertial.gyrations();
        let worst = axes
            .filter_map(|(axis, radius)| Some((radius, from_axis(axis)?)))
            .filter(|(radius, reach)| *radius > MARGIN * reach)
            .max_by(|(a, _), (b, _)| a.total_cmp(b));
        let Some((radius, reach)) = worst else {
            continue;
        };
        let message = format!(
            "the inertia is that of the whole mass at {} from an axis, but the link's shapes reach {} from it; compute \
            the tensor from the link's own geometry",
            metres(radius),
            metres(reach)
        );
        urdf.at(urdf.links[index], message)
            .expected(format!("at most {}", metres(reach)))
            .actual(metres(radius))
            .off_by(radius - reach, "m")
            .report(findings);
    }
    Some(())
}
