use super::subject;
use crate::format::urdf::JointType;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::rule::declare_rule;

declare_rule! {
    /// A joint that was made fixed, as `composition_module` says, moves, or is of another part.
    ///
    /// Who reads that a joint was frozen does not expect a DOF of it, and looks for none.
    ///
    /// List the part's own joints that moved in it and are fixed here, and no others.
    CMP006 "composition-frozen-joint-moves", Error, clause "6.6.6", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND, Passed(CMP001), Passed(CMP003)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some((module, composition, robot)) = subject(context) else {
        return;
    };
    for (place, part) in composition.parts.iter().enumerate() {
        for (idx, frozen) in part.frozen_joints.iter().enumerate() {
            let joint = &robot.joints[frozen.joint_idx.get()];
            let is_own = part
                .joints
                .iter()
                .any(|of| of.joint_idx == frozen.joint_idx);
            let message = match (is_own, joint.joint_type) {
                (true, JointType::Fixed) => continue,
                (false, _) => "the joint is not one of the part's",
                (true, _) => "the joint moves",
            };
            let pointer = format!("/parts/{place}/frozen_joints/{idx}/joint_idx");
            findings.report(
                Finding::at(module.file("module.json"), pointer, message)
                    .expected("a fixed joint of the part")
                    .actual(format!("joint `{}`, {}", joint.name, joint.joint_type)),
            );
        }
    }
}
