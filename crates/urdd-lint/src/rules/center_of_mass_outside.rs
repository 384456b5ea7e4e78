use nalgebra::Vector3;

use crate::rule::declare_lint;
use crate::subject::Subject;
use urdd_format::readable::metres;
use urdd_validate::finding::{Findings, point};

declare_lint! {
    /// The centre of mass of a link is outside of the convex hull of its shapes.
    ///
    /// No distribution of mass inside the shapes has its centre there. Gravity then turns the joints before it
    /// otherwise than on the robot. Common causes: the position is in millimetres, or in another link's frame, or its
    /// sign is wrong.
    ///
    /// Write the position of the centre of mass in the link's frame, in metres, as the `<origin>` of `<inertial>`.
    LNT002 "center-of-mass-outside", Warning, WrongMotion, since "1.1.0"
}

/// How far outside is still taken for a rough model: m, and a part of the hull's diagonal.
const MARGIN: f64 = 0.005;
const PART: f64 = 0.1;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (index, body) in urdf.bodies(findings)?.iter().enumerate() {
        let Some((inertial, hull)) = body.inertial.zip(body.geometry.hull()) else {
            continue;
        };
        let mesh = hull.mesh();
        let Some(bounds) = mesh.bounds() else {
            continue;
        };
        // The largest distance from the plane of a face is at most the distance from the hull.
        let beyond = mesh.triangles.iter().filter_map(|triangle| {
            let [a, b, c] = mesh.corners(*triangle).map(Vector3::from);
            let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
            Some((inertial.center - a).dot(&normal))
        });
        let beyond = beyond.fold(0.0, f64::max);
        let diagonal = (Vector3::from(bounds.max) - Vector3::from(bounds.min)).norm();
        if beyond <= MARGIN.max(PART * diagonal) {
            continue;
        }
        let message = format!(
            "the centre of mass is {} outside of the link's shapes; write it in the link's frame, in metres",
            metres(beyond)
        );
        urdf.at(urdf.links[index], message)
            .actual(point(inertial.center.into()))
            .off_by(beyond, "m")
            .report(findings);
    }
    Some(())
}
