use crate::rules::prelude::*;

declare_rule! {
    /// A joint names a parent or child link that does not exist.
    ///
    /// The joint connects nothing: no tree can be built, and nothing that is derived from the tree has
    /// a meaning. Most often a link was renamed and its joints were not, or a part of the robot was
    /// left out.
    ///
    /// Correct the name, or add the link, in the URDF, and write the URDD again.
    URD007 "unknown-link", Error, clause "6.1.4", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD002)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        for (end, link) in [("parent", &joint.parent), ("child", &joint.child)] {
            if robot.link(link).is_none() {
                let message = format!("{end} of joint `{}` is not a link of the robot", joint.name);
                Finding::at(&file, format!("/joints/{index}/{end}/link"), message)
                    .values("the name of a link", format!("`{link}`"))
                    .report(findings);
            }
        }
    }
    Some(())
}
