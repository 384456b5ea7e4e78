use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::urdf_text::compare::first_names;

declare_rule! {
    /// The robot has several roots, or no link at all.
    ///
    /// The root is the one link that is not the child of a joint; all poses are in its frame. With two
    /// such links the robot is in parts that no joint connects: readers keep one part, or refuse.
    ///
    /// Connect the parts by joints (a fixed one will do) in the URDF, or make each a robot of its
    /// own. Then write the URDD again.
    URD004 "not-one-root", Error, clause "6.1.4", since "0.1.0",
    phase References, judges Robot, needs [Module(Kind::Urdf), Passed(URD005)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    let mut is_child = vec![false; robot.links.len()];
    for joint in &robot.joints {
        if let Some(child) = robot
            .link(&joint.child)
            .and_then(|child| is_child.get_mut(child))
        {
            *child = true;
        }
    }
    let roots: Vec<&str> = robot
        .links
        .iter()
        .zip(&is_child)
        .filter(|(_, is_child)| !**is_child)
        .map(|(link, _)| link.name.as_str())
        .collect();
    let message = match roots.len() {
        0 if robot.links.is_empty() => "the robot has no link".to_owned(),
        // Without any root all links are in circles: URD006 reports these.
        0 | 1 => return,
        _ => "the links are not one tree: connect these links by joints".to_owned(),
    };
    findings.report(
        Finding::at(file, "/links", message)
            .expected("one link that is not the child of a joint")
            .actual(match roots.len() {
                0 => "no link".to_owned(),
                count => format!("{count}: {}", first_names(&roots)),
            }),
    );
}
