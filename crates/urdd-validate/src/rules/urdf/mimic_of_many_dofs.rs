use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;

declare_rule! {
    /// A mimic joint, or the joint that it follows, has more than one DOF.
    ///
    /// `multiplier * position + offset` says how one number follows from one number. For a planar,
    /// floating or spherical joint it has no meaning.
    ///
    /// Take the `<mimic>` out of the joint, or write the joint as several joints of one DOF, in the
    /// URDF, and write the URDD again.
    URD012 "mimic-of-many-dofs", Error, clause "6.1.5", since "0.1.0",
    phase References, judges Robot, needs [Module(Kind::Urdf), Passed(URD008)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(mimic) = joint.active_mimic() else {
            continue;
        };
        let driver = robot
            .joint(&mimic.joint)
            .and_then(|driver| robot.joints.get(driver));
        let (message, culprit) = match driver {
            _ if joint.num_dofs() > 1 => (
                format!("joint `{}` is a mimic, but has several DOFs", joint.name),
                joint,
            ),
            Some(driver) if driver.num_dofs() > 1 && driver.active_mimic().is_none() => (
                format!(
                    "joint `{}` follows joint `{}`, which has several DOFs",
                    joint.name, driver.name
                ),
                driver,
            ),
            _ => continue,
        };
        findings.report(
            Finding::at(file.clone(), format!("/joints/{index}/mimic"), message)
                .expected("a joint of one DOF, or a fixed one")
                .actual(format!(
                    "{}, with {} DOFs",
                    culprit.joint_type,
                    culprit.num_dofs()
                )),
        );
    }
}
