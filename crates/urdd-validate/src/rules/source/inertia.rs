use nalgebra::Matrix3;

use crate::rules::prelude::*;
use urdd_document::robot::{Link, Robot};
use urdd_document::tree::RigidGroup;
use urdd_format::readable::number;

declare_rule! {
    /// A mass is negative, or 0 where something moves.
    ///
    /// Dynamics divide by mass. A body without mass that a joint moves makes simulators refuse the robot,
    /// or become unstable. Links that fixed joints connect are one body, so a frame without mass on a
    /// body with mass is fine. So is a frame that nothing moves, and a body without `<inertial>`. A link
    /// with inertia and without mass is reported too: no such body exists.
    ///
    /// Give the link its mass in the URDF, or remove the `<inertial>` of a link that is only a frame.
    /// Then write the URDD again.
    SRC003 "mass-not-positive", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [SourceRobot, ROBOT_SOUND], of Robot, check mass_not_positive,

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
    phase References, needs [SourceRobot, ROBOT_SOUND], of Robot, check inertia_not_positive_definite,

    /// A principal moment of inertia is larger than the sum of the other two.
    ///
    /// No body has such moments. For a flat plate the largest is the sum of the others; for every other
    /// body it is less. Some simulators refuse the robot (MuJoCo, Gazebo), others simulate an impossible
    /// body. Most often the numbers were made up, the axes mixed, or the units wrong in some of them
    /// (g mm² for kg m²).
    ///
    /// Compute the tensor again, correct the URDF, and write the URDD again.
    SRC005 "inertia-breaks-the-triangle-inequality", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [SourceRobot], of Robot, check inertia_breaks_triangle,
}

fn mass_not_positive(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    let bodies = described.rigid_groups()?;
    let at = |index: usize, message: String, expected: &str, link: &Link| {
        finding_in(described, format!("/links/{index}/inertial/mass"), message)
            .values(expected, found(link))
    };
    for body in &bodies.groups {
        let mut links = links_of(robot, body);
        let mut reported = false;
        for (index, link) in links.clone() {
            let Some((message, expected)) = fault(link) else { continue };
            reported = true;
            at(index, message, expected, link).report(findings);
        }
        let Some(joint) = body.moved_by.and_then(|joint| robot.joints.get(joint)) else { continue };
        let stated = links.clone().find(|(_, link)| link.inertial.is_some());
        let weightless = links.all(|(_, link)| mass(link) == 0.0);
        if let (Some((index, link)), true, false) = (stated, weightless, reported) {
            let (others, but) = match body.links.len() {
                1 => (String::new(), no_mass(link)),
                count => {
                    (format!(" and what is fixed to it ({count} links)"), "none of them has mass")
                }
            };
            let (joint, name) = (&joint.name, &link.name);
            let message = format!("joint `{joint}` moves link `{name}`{others}, but {but}");
            at(index, message, "a positive mass", link).report(findings);
        }
    }
    Some(())
}

fn no_mass(link: &Link) -> &'static str {
    match link.inertial.and_then(|inertial| inertial.mass) {
        Some(_) => "its mass is 0",
        None => "its mass is missing; an `<inertial>` without `<mass>` counts as 0 kg",
    }
}

fn found(link: &Link) -> String {
    match link.inertial.and_then(|inertial| inertial.mass) {
        Some(mass) => format!("link `{}`: {} kg", link.name, number(mass, 6)),
        None => format!("link `{}`: mass missing", link.name),
    }
}

fn mass(link: &Link) -> f64 {
    link.inertial.and_then(|inertial| inertial.mass).unwrap_or(0.0)
}

/// What is wrong with the mass of a link alone, and what is expected.
fn fault(link: &Link) -> Option<(String, &'static str)> {
    let inertia = link.inertial?.inertia.unwrap_or_default();
    let (name, mass) = (&link.name, mass(link));
    if mass < 0.0 {
        let message = format!("link `{name}`: mass is negative");
        Some((message, "a positive mass"))
    } else if mass == 0.0 && inertia != [0.0; 6] {
        let message = format!("link `{name}` has inertia, but {}", no_mass(link));
        Some((message, "a positive mass, or no `<inertial>`"))
    } else {
        None
    }
}

/// The links of a rigid group, with their indices.
fn links_of<'a>(
    robot: &'a Robot,
    group: &'a RigidGroup,
) -> impl Iterator<Item = (usize, &'a Link)> + Clone {
    let links = group.links.iter();
    links.filter_map(|index| Some((*index, robot.links.get(*index)?)))
}

fn inertia_not_positive_definite(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    let bodies = described.rigid_groups()?;
    let at = |index: usize, message: String, link: &Link, found: &str| {
        finding_in(described, format!("/links/{index}/inertial/inertia"), message)
            .values("three positive principal moments", format!("link `{}`: {found}", link.name))
    };
    for body in &bodies.groups {
        let mut links = links_of(robot, body);
        for (index, link) in links.clone() {
            let moments = tensor(link).map(principal);
            let Some(moments) = moments.filter(|moments| !positive(*moments)) else { continue };
            let message = format!("link `{}`: the inertia is not positive definite", link.name);
            at(index, message, link, &show(moments))
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

fn inertia_breaks_triangle(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    for (index, link) in robot.links.iter().enumerate() {
        let Some(tensor) = link.inertial.and_then(|inertial| inertial.inertia) else { continue };
        let moments = principal(tensor);
        // SRC004 reports tensors that are not positive definite.
        if !positive(moments) || excess(moments) <= INERTIA_TRIANGLE {
            continue;
        }
        let least = number(moments[0] + moments[1], 5);
        let pointer = format!("/links/{index}/inertial/inertia");
        let message = format!(
            "link `{}`: no body has this inertia; its largest principal moment is larger than the sum of the others by {:.2} %",
            link.name,
            100.0 * beyond(moments)
        );
        finding_in(described, pointer, message)
            .expected(format!("at most {least} kg m²"))
            .actual(format!("link `{}`: {}", link.name, show(moments)))
            .tolerance(INERTIA_TRIANGLE * moments[2])
            .report(findings);
    }
    Some(())
}

/// By what fraction of the sum of the others the largest of three ascending moments exceeds it.
pub fn beyond(moments: [f64; 3]) -> f64 {
    moments[2] / (moments[0] + moments[1]) - 1.0
}

/// By what fraction of itself the largest of three ascending moments exceeds the sum of the others.
pub fn excess(moments: [f64; 3]) -> f64 {
    1.0 - moments[0] / moments[2] - moments[1] / moments[2]
}

/// The principal moments of a tensor (xx, xy, xz, yy, yz, zz), ascending.
pub fn principal([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> [f64; 3] {
    // Scaled to 1 first: squaring numbers near the ends of binary64 would overflow or underflow.
    let scale = [xx, xy, xz, yy, yz, zz]
        .into_iter()
        .fold(0.0, |largest: f64, element| largest.max(element.abs()));
    if scale == 0.0 || !scale.is_finite() {
        return [0.0; 3];
    }
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz).map(|element| element / scale);
    let mut moments: [f64; 3] = tensor.symmetric_eigenvalues().into();
    moments.sort_by(f64::total_cmp);
    moments.map(|moment| moment * scale)
}

/// Moments for messages; those within rounding of 0 are shown as 0.
fn show(moments: [f64; 3]) -> String {
    let largest = moments.into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let shown = moments.map(|moment| match moment.abs() > 1e-14 * largest {
        true => number(moment, 5),
        false => "0".to_owned(),
    });
    format!("principal moments {} kg m²", shown.join(", "))
}
