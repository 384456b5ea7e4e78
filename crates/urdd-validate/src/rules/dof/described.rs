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
    phase References, needs [Version1, Passed(DOF005), ModuleV1(Kind::Dof)], check dof_misdescribed,

    /// A mimic joint is resolved to the wrong DOF, factor or offset.
    ///
    /// Programs place a mimic joint at `multiplier * q[dof_idx] + offset` and never look at the URDF
    /// again. SPEC 5.10 says how to compute them when a mimic names another mimic: multiply the
    /// factors, carry the offsets. Common mistakes are to name the next joint instead of the last one,
    /// to add offsets without their factors, and to write an entry for a joint that follows nothing.
    ///
    /// Resolve the mimics of `urdf_module` again. Joints that are fixed or have no mimic get null;
    /// where a chain of mimics ends in a fixed joint, `dof_idx` is null and the joint's position is
    /// `offset`.
    DOF007 "mimic-resolved-wrong", Error, clause "6.2.6", since "0.1.0",
    phase References, needs [Version1, Passed(URD012), Passed(DOF005), ModuleV1(Kind::Dof)], check mimic_resolved_wrong,
}

fn dof_misdescribed(context: &Context, findings: &mut Findings) -> Option<()> {
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

fn mimic_resolved_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let mimics = context.mimics()?;
    let layout = context.dof_layout()?;
    let dofs = document!(context, Dof)?;
    let joints = robot.joints.iter().zip(&mimics.by_joint);
    let written = dofs.joint_idx_to_mimic_mapping.iter();
    for (index, ((joint, right), written)) in joints.zip(written).enumerate() {
        let pointer = format!("/joint_idx_to_mimic_mapping/{index}");
        let joint = format!("joint {index} ({:?})", joint.name);
        let (right, written) = match (right, written) {
            (Some(right), Some(written)) => (right, written),
            (None, None) => continue,
            (right, _) => {
                let (message, expected, actual) = match right {
                    None => ("follows no other joint; write null", "null", "a mimic"),
                    Some(_) => ("is a mimic joint; write what it follows", "a mimic", "null"),
                };
                let finding = finding_in(Kind::Dof, pointer, format!("{joint} {message}"));
                findings.report(finding.values(expected, actual));
                continue;
            }
        };
        let driver = layout.dofs_of_joint.get(right.driver).cloned();
        let dof = driver.and_then(|mut dofs| dofs.next());
        let written_dof = written.dof_idx.map(|dof| dof.get());
        if dof != written_dof {
            let message = format!(
                "{joint} follows joint {} ({:?}) through its mimics, and this is not that joint's DOF",
                right.driver,
                robot.joints.get(right.driver)?.name
            );
            finding_in(Kind::Dof, format!("{pointer}/dof_idx"), message)
                .values(or_null(dof), or_null(written_dof))
                .report(findings);
        }
        for (key, right, written) in [
            ("multiplier", right.multiplier, written.multiplier),
            ("offset", right.offset, written.offset),
        ] {
            if !numbers_agree(right, written) {
                let message =
                    format!("this is not the {key} with which {joint} follows its driver");
                finding_in(Kind::Dof, format!("{pointer}/{key}"), message)
                    .numbers(right, written, number_tolerance(right, written))
                    .report(findings);
            }
        }
    }
    Some(())
}
