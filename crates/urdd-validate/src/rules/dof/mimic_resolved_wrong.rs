use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use crate::tolerance::{number_tolerance, numbers_agree};
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// A mimic joint is resolved to the wrong DOF, factor or offset.
    ///
    /// Programs place a mimic joint at `multiplier * q[dof_idx] + offset` and never look at the URDF
    /// again. SPEC 5.10 says how to come there when a mimic names another mimic: multiply the factors,
    /// carry the offsets. Common mistakes are to name the next joint instead of the last one, to add
    /// offsets without their factors, and to write an entry for a joint that follows nothing.
    ///
    /// Resolve the mimics of `urdf_module` again. Joints that are fixed or have no mimic get null;
    /// where a chain of mimics ends in a fixed joint, `dof_idx` is null and the joint's position is
    /// `offset`.
    DOF007 "mimic-resolved-wrong", Error, clause "6.2.6", since "0.1.0",
    phase References, needs [Version1, Passed(URD012), Passed(DOF005)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(mimics), Some(layout), Some(dofs), Some(module)) = (
        context.robot(),
        context.mimics(),
        context.dof_layout(),
        context.dofs().and_then(|dofs| dofs.v1),
        context.module(ModuleKind::Dof),
    ) else {
        return findings.skip(SkipReason::NotInThisVersion(ModuleKind::Dof));
    };
    let file = module.file("module.json");
    let joints = robot.joints.iter().zip(&mimics.by_joint);
    let written = dofs.joint_idx_to_mimic_mapping.iter();
    for (index, ((joint, right), written)) in joints.zip(written).enumerate() {
        let pointer = format!("/joint_idx_to_mimic_mapping/{index}");
        let (right, written) = match (right, written) {
            (None, None) => continue,
            (Some(right), Some(written)) => (right, written),
            (None, Some(_)) => {
                let message = format!(
                    "joint {index} ({:?}) follows no other joint; write null",
                    joint.name
                );
                findings.report(
                    Finding::at(&file, pointer, message)
                        .expected("null")
                        .actual("a mimic"),
                );
                continue;
            }
            (Some(_), None) => {
                let message = format!(
                    "joint {index} ({:?}) is a mimic joint; write what it follows",
                    joint.name
                );
                findings.report(
                    Finding::at(&file, pointer, message)
                        .expected("a mimic")
                        .actual("null"),
                );
                continue;
            }
        };
        let driver = layout.dofs_of_joint.get(right.driver).cloned();
        let dof = driver.and_then(|mut dofs| dofs.next());
        let written_dof = written.dof_idx.map(|dof| dof.get());
        if dof != written_dof {
            let end = robot
                .joints
                .get(right.driver)
                .map(|joint| joint.name.as_str());
            let message = format!(
                "joint {index} ({:?}) follows joint {} ({:?}) through its mimics, and this is not that joint's DOF",
                joint.name,
                right.driver,
                end.unwrap_or_default()
            );
            findings.report(
                Finding::at(&file, format!("{pointer}/dof_idx"), message)
                    .expected(or_null(dof))
                    .actual(or_null(written_dof)),
            );
        }
        for (key, right, written) in [
            ("multiplier", right.multiplier, written.multiplier),
            ("offset", right.offset, written.offset),
        ] {
            if !numbers_agree(right, written) {
                let message = format!(
                    "this is not the {key} with which joint {index} ({:?}) follows its driver",
                    joint.name
                );
                findings.report(
                    Finding::at(&file, format!("{pointer}/{key}"), message)
                        .expected(format!("{right:?}"))
                        .actual(format!("{written:?}"))
                        .tolerance(number_tolerance(right, written))
                        .off_by(right - written, ""),
                );
            }
        }
    }
}

fn or_null(dof: Option<usize>) -> String {
    dof.map_or_else(|| "null".to_owned(), |dof| dof.to_string())
}
