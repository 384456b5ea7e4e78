use crate::rules::prelude::*;

declare_rule! {
    /// `joint_type` of a joint is not the URDF's.
    ///
    /// The type says how many numbers the joint takes from a configuration and what they do. A consumer
    /// of `chain_module` sees no URDF: it moves the joint in the wrong way, and may read the DOFs of
    /// the next joints for this one's.
    ///
    /// Copy the type from `urdf_module`. (A joint without limits that turns is still `Revolute` if the
    /// URDF says so.)
    CHN007 "joint-type-differs", Error, clause "6.3.4", since "0.1.0",
    phase References, needs [Version1, Passed(CHN002), ModuleV1(Kind::Chain)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let chain = document!(context, Chain)?;
    for (index, (joint, right)) in chain.joints_in_chain.iter().zip(&robot.joints).enumerate() {
        if joint.joint_type != right.joint_type {
            let name = &right.name;
            let message = format!("joint {index} ({name:?}) is of another type in urdf_module");
            finding_in(Kind::Chain, format!("/joints_in_chain/{index}/joint_type"), message)
                .values(right.joint_type, joint.joint_type)
                .report(findings);
        }
    }
    Some(())
}
