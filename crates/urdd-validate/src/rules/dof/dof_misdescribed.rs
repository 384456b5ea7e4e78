use crate::rules::prelude::*;
use urdd_document::dof_layout::describe;

declare_rule! {
    /// An entry of `dofs` does not describe its DOF.
    ///
    /// `dofs[i]` says to people and programs what number i of a configuration is: its joint, its name
    /// (the joint's name, and for joints of several DOFs what SPEC 6.2.5 puts behind it), and whether
    /// it is an angle in radians or a length in metres. A user interface that labels its sliders by a
    /// wrong entry moves another joint than it says.
    ///
    /// Write `dofs` from `dof_idx_to_joint_idx_mapping` and the joints of `urdf_module`.
    DOF006 "dof-misdescribed", Error, clause "6.2.5", since "0.1.0",
    phase References, needs [Version1, Passed(DOF005), ModuleV1(Kind::Dof)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let layout = context.dof_layout()?;
    let dofs = document!(context, Dof)?;
    for (index, dof) in dofs.dofs.iter().enumerate() {
        let (joint_idx, place) = layout.place(index)?;
        let joint = robot.joints.get(joint_idx)?;
        let (suffix, quantity) = describe(joint.joint_type, place)?;
        let mut expect = |key: &str, right: String, written: String| {
            if right != written {
                let pointer = format!("/dofs/{index}/{key}");
                let message =
                    format!("this does not describe DOF {index}, which moves joint {joint_idx}");
                finding_in(Kind::Dof, pointer, message).values(right, written).report(findings);
            }
        };
        let quoted = |name: &str| format!("{name:?}");
        expect("joint_idx", joint_idx.to_string(), dof.joint_idx.to_string());
        expect("joint_name", quoted(&joint.name), quoted(&dof.joint_name));
        let name = format!("{}{suffix}", joint.name);
        expect("name", quoted(&name), quoted(&dof.name));
        expect("quantity", quantity.to_string(), dof.quantity.to_string());
    }
    Some(())
}
