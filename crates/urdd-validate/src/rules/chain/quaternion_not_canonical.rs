use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use crate::tolerance::{ROTATION, UNIT_NORM, rotation_distance};
use urdd_document::pose::rotation_of_quaternion;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// A joint's quaternion is not of length 1, or is the negative of the one to write.
    ///
    /// Most programs take a quaternion to be a unit one without looking: any other scales whatever it
    /// turns. q and -q are the same rotation, so the sign is settled, and documents can be compared.
    ///
    /// Divide the quaternion by its length. Then negate it if w is negative, or if w is 0 and the first of
    /// x, y, z that is not 0 is negative.
    CHN010 "quaternion-not-canonical", Error, clause "6.3.4", since "0.1.0",
    phase References, consequence Format, needs [Version1, Module(Kind::Chain)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(chain), Some(module)) = (
        context.chain().and_then(|chain| chain.v1),
        context.module(ModuleKind::Chain),
    ) else {
        return findings.skip(SkipReason::NotInThisVersion(ModuleKind::Chain));
    };
    for (index, joint) in chain.joints_in_chain.iter().enumerate() {
        let quaternion = joint.origin.quaternion_wxyz;
        let at = |message: &str| {
            Finding::at(
                module.file("module.json"),
                format!("/joints_in_chain/{index}/origin/quaternion_wxyz"),
                message,
            )
            .actual(format!("{quaternion:?}"))
        };
        let norm = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (norm - 1.0).abs() > UNIT_NORM {
            let message = format!("this quaternion has length {norm:?}; divide it by that");
            findings.report(at(&message).expected("length 1").tolerance(UNIT_NORM));
        } else if is_negative(&quaternion) && !is_other_rotation(context, index, quaternion) {
            let message =
                "this is the negative of the quaternion to write; negate all four numbers";
            let negated = quaternion.map(|x| if x == 0.0 { 0.0 } else { -x });
            findings.report(at(message).expected(format!("{negated:?}")));
        }
    }
}

/// Whether it is not the rotation of the joint's origin: CHN008 reports that, and negating the
/// numbers would not help.
fn is_other_rotation(context: &Context, index: usize, quaternion: [f64; 4]) -> bool {
    let joint = context.robot().and_then(|robot| robot.joints.get(index));
    joint.is_some_and(|joint| {
        let expected = joint.origin.rotation();
        rotation_distance(&expected, &rotation_of_quaternion(quaternion)) > ROTATION
    })
}

/// Whether the first number that is not 0 is negative.
fn is_negative(quaternion: &[f64]) -> bool {
    quaternion
        .iter()
        .find(|x| **x != 0.0)
        .is_some_and(|x| *x < 0.0)
}

#[cfg(test)]
mod tests {
    use super::is_negative;

    #[test]
    fn w_counts_first_and_zeros_do_not() {
        assert!(!is_negative(&[0.5, -0.5, -0.5, -0.5]));
        assert!(is_negative(&[-0.5, 0.5, 0.5, 0.5]));
        assert!(is_negative(&[-0.0, 0.0, -1.0, 0.0]));
        assert!(!is_negative(&[-0.0, 1.0, 0.0, 0.0]));
        assert!(is_negative(&[-1e-17, 1.0, 0.0, 0.0]));
    }
}
