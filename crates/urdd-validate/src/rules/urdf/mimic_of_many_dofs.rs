use crate::rules::prelude::*;

declare_rule! {
    /// A mimic joint, or the joint that it follows, has more than one DOF.
    ///
    /// `multiplier * position + offset` says how one number follows from one number. For a planar,
    /// floating or spherical joint it has no meaning.
    ///
    /// Take the `<mimic>` out of the joint, or write the joint as several joints of one DOF, in the
    /// URDF, and write the URDD again.
    URD012 "mimic-of-many-dofs", Error, clause "6.1.5", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD008)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(mimic) = joint.active_mimic() else {
            continue;
        };
        let name = &joint.name;
        let driver = robot.joints.get(robot.joint(&mimic.joint)?)?;
        let (message, culprit) = if joint.num_dofs() > 1 {
            let message = format!("joint `{name}` is a mimic, but has several DOFs");
            (message, joint)
        } else if driver.num_dofs() > 1 && driver.active_mimic().is_none() {
            let followed = &driver.name;
            let message =
                format!("joint `{name}` follows joint `{followed}`, which has several DOFs");
            (message, driver)
        } else {
            continue;
        };
        let (kind, dofs) = (culprit.joint_type, culprit.num_dofs());
        Finding::at(&file, format!("/joints/{index}/mimic"), message)
            .values("a joint of one DOF, or a fixed one", format!("{kind}, with {dofs} DOFs"))
            .report(findings);
    }
    Some(())
}
