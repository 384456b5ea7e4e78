use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;

declare_rule! {
    /// A link is the child of two joints.
    ///
    /// A URDF is a tree. A link with two parents would have two poses; readers take one of them, or
    /// refuse. Closed chains (parallel grippers, delta robots) cannot be written this way.
    ///
    /// Keep one of the joints in the URDF. Write the other as a constraint, in an element for the
    /// program that solves it (`<gazebo>`, `<loop_joint>`). Then write the URDD again.
    URD005 "link-with-two-parents", Error, clause "6.1.4", since "0.1.0",
    phase References, judges Robot, needs [Module(Kind::Urdf), Passed(URD003), Passed(URD007)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    let mut held_by: Vec<Option<usize>> = vec![None; robot.links.len()];
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(holder) = robot
            .link(&joint.child)
            .and_then(|child| held_by.get_mut(child))
        else {
            continue;
        };
        let first = *holder.get_or_insert(index);
        if first == index {
            continue;
        }
        let other = robot.joints.get(first).map_or("", |joint| &joint.name);
        findings.report(
            Finding::at(
                file.clone(),
                format!("/joints/{index}/child/link"),
                format!(
                    "link `{}` is the child of joint `{}` and of joint `{other}`; a link has one parent",
                    joint.child, joint.name
                ),
            )
            .expected("a link that no other joint has as its child")
            .actual(format!("`{}`, child of /joints/{first} too", joint.child)),
        );
    }
}
