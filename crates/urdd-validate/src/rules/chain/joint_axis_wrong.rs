use nalgebra::Vector3;

use crate::rules::prelude::*;
use urdd_document::pose::unit;

declare_rule! {
    /// `axis` of a joint is not the URDF's axis made a unit vector.
    ///
    /// The joint turns about it or slides along it. Were it longer than 1, a sliding joint would go too
    /// far and a rotation would not be one; were it reversed, the joint would move backwards.
    ///
    /// Divide the URDF's axis by its length; it is (1, 0, 0) where the URDF has none. Fixed, floating and
    /// spherical joints have no axis: write null.
    CHN009 "joint-axis-wrong", Error, clause "6.3.4", since "0.1.0",
    phase References, needs [Version1, Passed(CHN002), ModuleV1(Kind::Chain)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let chain = document!(context, Chain)?;
    for (index, (joint, right)) in chain.joints_in_chain.iter().zip(&robot.joints).enumerate() {
        let expected = match right.has_axis() {
            false => None,
            true => match unit(right.axis) {
                Some(axis) => Some(axis),
                // A zero axis has no direction; URD010 reports it.
                None => continue,
            },
        };
        let compared = expected.zip(joint.axis);
        let agree = match compared {
            Some((expected, axis)) => (expected - Vector3::from(axis)).norm() <= UNIT_NORM,
            None => expected.is_none() && joint.axis.is_none(),
        };
        if agree {
            continue;
        }
        let message = match expected {
            Some(_) => "does not have this axis: write that of urdf_module, as a unit vector",
            None => "has a type without an axis; write null",
        };
        let (name, kind) = (&right.name, right.joint_type);
        let message = format!("joint {index} ({name:?}, {kind}) {message}");
        let mut finding =
            finding_in(Kind::Chain, format!("/joints_in_chain/{index}/axis"), message)
                .values(or_null(expected.map(<[f64; 3]>::from)), or_null(joint.axis));
        finding.tolerance = compared.map(|_| UNIT_NORM);
        findings.report(finding);
    }
    Some(())
}
