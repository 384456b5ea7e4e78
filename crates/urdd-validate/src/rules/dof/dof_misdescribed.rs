use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use urdd_document::dof_layout::describe;
use urdd_format::registry::ModuleKind;

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
    phase References, needs [Version1, Passed(DOF005)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(layout), Some(dofs), Some(module)) = (
        context.robot(),
        context.dof_layout(),
        context.dofs().and_then(|dofs| dofs.v1),
        context.module(ModuleKind::Dof),
    ) else {
        return findings.skip(SkipReason::NotInThisVersion(ModuleKind::Dof));
    };
    for (index, dof) in dofs.dofs.iter().enumerate() {
        let Some((joint_idx, place)) = layout.place(index) else {
            continue;
        };
        let Some(joint) = robot.joints.get(joint_idx) else {
            continue;
        };
        let Some((suffix, quantity)) = describe(joint.joint_type, place) else {
            continue;
        };
        let name = format!("{}{suffix}", joint.name);
        let mut expect = |key: &str, right: String, written: String| {
            if right != written {
                findings.report(
                    Finding::at(
                        module.file("module.json"),
                        format!("/dofs/{index}/{key}"),
                        format!(
                            "this does not describe DOF {index}, which moves joint {joint_idx}"
                        ),
                    )
                    .expected(right)
                    .actual(written),
                );
            }
        };
        expect(
            "joint_idx",
            joint_idx.to_string(),
            dof.joint_idx.to_string(),
        );
        expect(
            "joint_name",
            format!("{:?}", joint.name),
            format!("{:?}", dof.joint_name),
        );
        expect("name", format!("{name:?}"), format!("{:?}", dof.name));
        expect("quantity", quantity.to_string(), dof.quantity.to_string());
    }
}
