use super::cycle::circles;
use crate::rules::prelude::*;
use crate::urdf_text::compare::first_names;

declare_rule! {
    /// Mimic joints follow each other in a circle.
    ///
    /// A mimic joint must lead, directly or through other mimic joints, to a joint that follows
    /// nothing. In a circle, no joint has a position of its own. A joint that follows itself is one too.
    ///
    /// Remove the `<mimic>` of the joint that is driven, in the URDF, and write the URDD again.
    URD009 "mimics-in-a-circle", Error, clause "6.1.5", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD008)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    let joints = robot.joints.iter();
    let follows = joints.map(|joint| robot.joint(&joint.active_mimic()?.joint));
    for circle in circles(&follows.collect::<Vec<_>>()) {
        let joints = circle.iter().filter_map(|joint| robot.joints.get(*joint));
        let names: Vec<&str> = joints.map(|joint| joint.name.as_str()).collect();
        let message = match names.as_slice() {
            [name] => format!("joint `{name}` follows itself"),
            _ => format!(
                "joints {} follow each other in a cycle, each the next",
                first_names(&names)
            ),
        };
        Finding::at(&file, format!("/joints/{}/mimic/joint", circle.first()?), message)
            .expected("a joint that leads to one that follows nothing")
            .actual(format!("a circle of {}", names.len()))
            .report(findings);
    }
    Some(())
}
