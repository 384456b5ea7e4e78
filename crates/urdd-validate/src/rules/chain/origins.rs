use crate::rules::prelude::*;
use urdd_document::pose::rotation_of_quaternion;

declare_rule! {
    /// `origin` of a joint is not the URDF's.
    ///
    /// The origin is where the joint sits on its parent link: a wrong one displaces or turns everything
    /// that the joint carries, in every configuration.
    ///
    /// The position is `xyz`; the rotation is R = Rz(yaw) Ry(pitch) Rx(roll) of `rpy`, as a quaternion
    /// with w first, or from URDF 1.1 on that of `quat_xyzw` (w last). Common mistakes: x, y, z, w instead of w, x, y, z; the inverse rotation; roll,
    /// pitch and yaw taken about moving axes; numbers that went through 32-bit floats.
    CHN008 "joint-origin-differs", Error, clause "6.3.4", since "0.1.0",
    phase References, needs [Version1, Passed(CHN002), ModuleV1(Kind::Chain)], check joint_origin_differs,

    /// A joint's quaternion is not of length 1, or is the negative of the one to write.
    ///
    /// Most programs take a quaternion to be a unit one without looking: any other scales whatever it
    /// turns. q and -q are the same rotation, so the sign is settled, and documents can be compared.
    ///
    /// Divide the quaternion by its length. Then negate it if w is negative, or if w is 0 and the first of
    /// x, y, z that is not 0 is negative.
    CHN010 "quaternion-not-canonical", Error, clause "6.3.4", since "0.1.0",
    phase References, consequence Format, needs [Version1, ModuleV1(Kind::Chain)], check quaternion_not_canonical,
}

fn joint_origin_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let tree = context.tree()?;
    let chain = document!(context, Chain)?;
    let position_tolerance = POSITION_OF_REACH * reach(robot, tree);
    for (index, (joint, right)) in chain.joints_in_chain.iter().zip(&robot.joints).enumerate() {
        let origin = &joint.origin;
        let offset = (Vector3::from(origin.position) - Vector3::from(right.origin.xyz)).norm();
        if !within(offset, position_tolerance) {
            let pointer = format!("/joints_in_chain/{index}/origin/position");
            let message = format!(
                "joint {index} ({:?}) is {} m from its position in urdf_module",
                right.name,
                number(offset, 4)
            );
            finding_in(Kind::Chain, pointer, message)
                .literals(right.origin.xyz, origin.position)
                .tolerance(position_tolerance)
                .off_by(offset, "m")
                .report(findings);
        }
        // CHN010 reports a quaternion of another length.
        let unit = origin.quaternion_wxyz;
        let length = unit.iter().map(|x| x * x).sum::<f64>().sqrt();
        if !within((length - 1.0).abs(), UNIT_NORM) {
            continue;
        }
        let turned = right.origin.rotation();
        let distance = rotation_distance(&turned, &rotation_of_quaternion(unit));
        if !within(distance, ROTATION) {
            let [x, y, z, w] = unit;
            let reordered = rotation_of_quaternion([w, x, y, z]);
            let message = match within(rotation_distance(&turned, &reordered), ROTATION) {
                true => format!(
                    "the quaternion of joint {index} ({:?}) is written x, y, z, w; write w first",
                    right.name
                ),
                false => format!(
                    "joint {index} ({:?}) is turned by {} rad from its rotation in urdf_module",
                    right.name,
                    number(angle_of_distance(distance), 4)
                ),
            };
            let pointer = format!("/joints_in_chain/{index}/origin/quaternion_wxyz");
            finding_in(Kind::Chain, pointer, message)
                .expected(match right.origin.quat_xyzw {
                    Some(xyzw) => format!("the rotation of quat_xyzw {xyzw:?}"),
                    None => format!("the rotation of rpy {:?}", right.origin.rpy),
                })
                .actual(format!("{:?}", origin.quaternion_wxyz))
                .tolerance(ROTATION)
                .off_by(angle_of_distance(distance), "rad")
                .report(findings);
        }
    }
    Some(())
}

/// Whether a distance is within a tolerance; NaN is not.
fn within(distance: f64, tolerance: f64) -> bool {
    distance <= tolerance
}

fn quaternion_not_canonical(context: &Context, findings: &mut Findings) -> Option<()> {
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
