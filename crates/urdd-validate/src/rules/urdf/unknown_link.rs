use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;

declare_rule! {
    /// A joint names a parent or child link that does not exist.
    ///
    /// The joint connects nothing: no tree can be built, and nothing that is derived from the tree has
    /// a meaning. Most often a link was renamed and its joints were not, or a part of the robot was
    /// left out.
    ///
    /// Correct the name, or add the link, in the URDF, and write the URDD again.
    URD007 "unknown-link", Error, clause "6.1.4", since "0.1.0",
    phase References, judges Robot, needs [Module(Kind::Urdf), Passed(URD002)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    for (index, joint) in robot.joints.iter().enumerate() {
        for (end, link) in [("parent", &joint.parent), ("child", &joint.child)] {
            if robot.link(link).is_none() {
                findings.report(
                    Finding::at(
                        file.clone(),
                        format!("/joints/{index}/{end}/link"),
                        format!("{end} of joint `{}` is not a link of the robot", joint.name),
                    )
                    .expected("the name of a link")
                    .actual(format!("`{link}`")),
                );
            }
        }
    }
}
