use crate::rule::declare_lint;
use crate::subject::Subject;
use urdd_format::urdf::JointType;
use urdd_validate::finding::Findings;

declare_lint! {
    /// The limits of a joint leave out 0.
    ///
    /// Most programs begin with every joint at 0: RViz, MoveIt's and MuJoCo's initial state, PyBullet's `loadURDF`,
    /// `joint_state_publisher`. They show a position that the joint cannot take, and planners refuse it as a start. A
    /// simulator that enforces limits throws the joint into them in the first step.
    ///
    /// Turn the joint's `<origin>` so that 0 is a position that it can take, or know that programs need a start of
    /// yours.
    LNT011 "zero-outside-limits", Info, WrongMotion, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let robot = urdf.robot(findings)?;
    for (index, joint) in robot.joints.iter().enumerate() {
        let limits = joint.limit.as_ref().filter(|_| {
            matches!(joint.joint_type, JointType::Revolute | JointType::Prismatic)
                && joint.mimic.is_none()
        });
        let Some(limit) = limits else {
            continue;
        };
        let (lower, upper) = (limit.lower.unwrap_or(0.0), limit.upper.unwrap_or(0.0));
        // SRC001 finds crossed limits.
        if lower > upper || (lower <= 0.0 && 0.0 <= upper) {
            continue;
        }
        let node = urdf.joints[index];
        let element = node.children().find(|child| child.has_tag_name("limit"));
        let message = format!(
            "0 is not between {lower} and {upper}: programs that start with every joint at 0 show a position that this \
            one cannot take"
        );
        urdf.at(element.unwrap_or(node), message).report(findings);
    }
    Some(())
}
