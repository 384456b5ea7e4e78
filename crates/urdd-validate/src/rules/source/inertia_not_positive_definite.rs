use super::{links_of, moments};
use crate::rules::prelude::*;
use urdd_document::robot::Link;

declare_rule! {
    /// An inertia tensor is not positive definite.
    ///
    /// The principal moments of a body are positive. Where one is negative or 0, dynamics cannot be
    /// solved about its axis: simulators refuse the link, or it spins without end. Most often a sign is
    /// wrong, products of inertia are larger than the moments, or a number was rounded to `0`.
    ///
    /// A link without mass may have a zero tensor, and so may a link with mass (a point mass) that
    /// is fixed to a link with inertia, or that no joint turns. A moment counts as positive when
    /// it is more than 1e-9 of the largest.
    ///
    /// Compute the tensor again (about the centre of mass, in the axes of the inertial's origin),
    /// correct the URDF, and write the URDD again.
    SRC004 "inertia-not-positive-definite", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [SourceRobot, ROBOT_SOUND],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let bodies = context.rigid_groups()?;
    let file = context.robot_file()?;
    let at = |index: usize, message: String, link: &Link, found: &str| {
        Finding::at(&file, format!("/links/{index}/inertial/inertia"), message)
            .values("three positive principal moments", format!("link `{}`: {found}", link.name))
    };
    for body in &bodies.groups {
        let mut links = links_of(robot, body);
        for (index, link) in links.clone() {
            let moments = tensor(link).map(moments::principal);
            let Some(moments) = moments.filter(|moments| !positive(*moments)) else {
                continue;
            };
            let message = format!("link `{}`: the inertia is not positive definite", link.name);
            at(index, message, link, &moments::show(moments))
                .tolerance(INERTIA_DEFINITE * moments[2].abs())
                .report(findings);
        }
        let moved_by = body.moved_by.and_then(|joint| robot.joints.get(joint));
        let turned_by = moved_by.filter(|joint| joint.joint_type != JointType::Prismatic);
        let point = links.clone().find(|(_, link)| is_point_mass(link));
        let no_inertia = links.all(|(_, link)| tensor(link).is_none());
        if let (Some(joint), Some((index, link)), true) = (turned_by, point, no_inertia) {
            let (joint, name) = (&joint.name, &link.name);
            let message =
                format!("joint `{joint}` turns link `{name}`, which has mass, but no inertia");
            at(index, message, link, "every moment is 0 or missing").report(findings);
        }
    }
    Some(())
}

/// A link's tensor, unless it is missing or zero.
fn tensor(link: &Link) -> Option<[f64; 6]> {
    link.inertial?.inertia.filter(|tensor| *tensor != [0.0; 6])
}

/// Whether a link has mass and states that it has no inertia.
fn is_point_mass(link: &Link) -> bool {
    link.inertial.is_some_and(|inertial| {
        inertial.mass.is_some_and(|mass| mass > 0.0) && inertial.inertia == Some([0.0; 6])
    })
}

/// Whether ascending principal moments are those of a positive definite tensor.
pub fn positive(moments: [f64; 3]) -> bool {
    moments[0] > INERTIA_DEFINITE * moments[2].abs()
}
