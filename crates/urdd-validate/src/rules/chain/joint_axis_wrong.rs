use nalgebra::Vector3;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use crate::tolerance::UNIT_NORM;
use urdd_document::pose::unit;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// `axis` of a joint is not the URDF's axis made a unit vector.
    ///
    /// The joint turns about it or slides along it. Were it longer than 1, a sliding joint would go too
    /// far and a rotation would not be one; were it reversed, the joint would move backwards.
    ///
    /// Divide the URDF's axis by its length; it is (1, 0, 0) where the URDF has none. Fixed, floating and
    /// spherical joints have no axis: write null.
    CHN009 "joint-axis-wrong", Error, clause "6.3.4", since "0.1.0",
    phase References, needs [Version1, Passed(CHN002)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(chain), Some(module)) = (
        context.robot(),
        context.chain().and_then(|chain| chain.v1),
        context.module(ModuleKind::Chain),
    ) else {
        return findings.skip(SkipReason::NotInThisVersion(ModuleKind::Chain));
    };
    for (index, (joint, right)) in chain.joints_in_chain.iter().zip(&robot.joints).enumerate() {
        let expected = match right.has_axis() {
            false => None,
            true => match unit(right.axis) {
                Some(axis) => Some(axis),
                // An axis of zero has no direction to compare with; URD010 reports it.
                None => continue,
            },
        };
        let agree = match (expected, joint.axis) {
            (None, None) => true,
            (Some(expected), Some(axis)) => (expected - Vector3::from(axis)).norm() <= UNIT_NORM,
            _ => false,
        };
        if !agree {
            let text = |axis: Option<[f64; 3]>| match axis {
                Some(axis) => format!("{axis:?}"),
                None => "null".to_owned(),
            };
            let message = match expected {
                Some(_) => "does not have this axis: write that of urdf_module, as a unit vector",
                None => "has a type without an axis; write null",
            };
            let finding = Finding::at(
                module.file("module.json"),
                format!("/joints_in_chain/{index}/axis"),
                format!(
                    "joint {index} ({:?}, {}) {message}",
                    right.name, right.joint_type
                ),
            )
            .expected(text(expected.map(Into::into)))
            .actual(text(joint.axis));
            findings.report(match joint.axis {
                Some(_) if expected.is_some() => finding.tolerance(UNIT_NORM),
                _ => finding,
            });
        }
    }
}
