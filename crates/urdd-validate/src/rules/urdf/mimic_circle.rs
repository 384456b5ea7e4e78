use super::cycle::circles;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::urdf_text::compare::first_names;

declare_rule! {
    /// Mimic joints follow each other in a circle.
    ///
    /// A mimic joint must lead, directly or through other mimic joints, to a joint that follows
    /// nothing. In a circle, no joint has a position of its own. A joint that follows itself is one too.
    ///
    /// Remove the `<mimic>` of the joint that is driven, in the URDF, and write the URDD again.
    URD009 "mimics-in-a-circle", Error, clause "6.1.5", since "0.1.0",
    phase References, judges Robot, needs [Module(Kind::Urdf), Passed(URD008)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    let follows: Vec<Option<usize>> = robot
        .joints
        .iter()
        .map(|joint| robot.joint(&joint.active_mimic()?.joint))
        .collect();
    for circle in circles(&follows) {
        let names: Vec<&str> = circle
            .iter()
            .filter_map(|joint| robot.joints.get(*joint))
            .map(|joint| joint.name.as_str())
            .collect();
        let Some(first) = circle.first() else {
            continue;
        };
        let message = match names.as_slice() {
            [name] => format!("joint `{name}` follows itself"),
            _ => format!(
                "joints {} follow each other in a circle, each the next",
                first_names(&names)
            ),
        };
        findings.report(
            Finding::at(
                file.clone(),
                format!("/joints/{first}/mimic/joint"),
                message,
            )
            .expected("a joint that leads to one that follows nothing")
            .actual(format!("a circle of {}", names.len())),
        );
    }
}
