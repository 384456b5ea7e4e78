use crate::rules::prelude::*;
use urdd_document::robot::{Link, Robot};
use urdd_document::tree::RigidGroup;

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
pub(super) fn links_of<'a>(
    robot: &'a Robot,
    group: &'a RigidGroup,
) -> impl Iterator<Item = (usize, &'a Link)> + Clone {
    let links = group.links.iter();
    links.filter_map(|index| Some((*index, robot.links.get(*index)?)))
}
