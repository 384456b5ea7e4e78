use crate::rules::prelude::*;

declare_rule! {
    /// A joint that was made fixed, as `composition_module` says, moves, is of another part, or is listed twice.
    ///
    /// A program that reads that a joint was frozen expects no DOF of it. One that frees the joint again puts it at
    /// `position`, a value for each DOF that it had.
    ///
    /// List the part's own joints that moved in it and are fixed here, each once and in ascending order, and no others.
    /// A joint of one DOF has one value, a planar or spherical one three, a floating one six.
    CMP006 "composition-frozen-joint-moves", Error, clause "6.6.6", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND, Passed(CMP001), Passed(CMP003)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let composition = document!(context, Composition)?;
    let robot = context.robot()?;
    for (place, part) in composition.parts.iter().enumerate() {
        let mut before = None;
        for (idx, frozen) in part.frozen_joints.iter().enumerate() {
            let joint = &robot.joints[frozen.joint_idx.get()];
            let mut own = part.joints.iter().map(|of| of.joint_idx);
            let is_own = own.any(|own| own == frozen.joint_idx);
            let ascends = before < Some(frozen.joint_idx);
            before = Some(frozen.joint_idx);
            let message = match (is_own, joint.joint_type, ascends) {
                (true, JointType::Fixed, true) => None,
                (false, _, _) => Some("the joint is not one of the part's"),
                (true, JointType::Fixed, false) => {
                    Some("the frozen joints are not in ascending order")
                }
                (true, _, _) => Some("the joint moves"),
            };
            let at = |key: &str| format!("/parts/{place}/frozen_joints/{idx}/{key}");
            if let Some(message) = message {
                finding_in(Kind::Composition, at("joint_idx"), message)
                    .expected("a fixed joint of the part, after the one before")
                    .actual(format!("joint `{}`, {}", joint.name, joint.joint_type))
                    .report(findings);
            }
            let values = frozen.position.len();
            if !matches!(values, 1 | 3 | 6) {
                let finding =
                    finding_in(Kind::Composition, at("position"), "no joint has so many DOFs");
                findings.report(finding.values("1, 3 or 6 values", values));
            }
        }
    }
    Some(())
}
