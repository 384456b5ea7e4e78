use crate::rules::prelude::*;
use urdd_document::pose::rotation_of_quaternion;

declare_rule! {
    /// A joint's quaternion is not of length 1, or is the negative of the one to write.
    ///
    /// Most programs take a quaternion to be a unit one without looking: any other scales whatever it
    /// turns. q and -q are the same rotation, so the sign is settled, and documents can be compared.
    ///
    /// Divide the quaternion by its length. Then negate it if w is negative, or if w is 0 and the first of
    /// x, y, z that is not 0 is negative.
    CHN010 "quaternion-not-canonical", Error, clause "6.3.4", since "0.1.0",
    phase References, consequence Format, needs [Version1, ModuleV1(Kind::Chain)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let chain = document!(context, Chain)?;
    for (index, joint) in chain.joints_in_chain.iter().enumerate() {
        let quaternion = joint.origin.quaternion_wxyz;
        let at = |message: &str| {
            let pointer = format!("/joints_in_chain/{index}/origin/quaternion_wxyz");
            finding_in(Kind::Chain, pointer, message).actual(format!("{quaternion:?}"))
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
    Some(())
}

/// Whether it differs from the rotation of the joint's origin: CHN008 reports that, and negating it would not help.
fn is_other_rotation(context: &Context, index: usize, quaternion: [f64; 4]) -> bool {
    let joint = context.robot().and_then(|robot| robot.joints.get(index));
    joint.is_some_and(|joint| {
        let expected = joint.origin.rotation();
        rotation_distance(&expected, &rotation_of_quaternion(quaternion)) > ROTATION
    })
}

/// Whether the first non-zero number is negative.
pub fn is_negative(quaternion: &[f64]) -> bool {
    quaternion.iter().find(|x| **x != 0.0).is_some_and(|x| *x < 0.0)
}
