use crate::rules::prelude::*;
use urdd_document::pose::{rotation_of_quaternion, unit};

declare_rule! {
    /// `joints_in_chain` does not hold the joints of `urdf_module`, in their order, each with its links.
    ///
    /// Forward kinematics goes from joint to joint by this list. A joint with the wrong parent or child
    /// puts everything below it in the wrong place.
    ///
    /// Write one entry for every joint of `urdf_module`, in its order, with its name and index, and the
    /// names and indices of its parent and child link. If the robot has changed since, write
    /// `chain_module` and what depends on it again.
    CHN002 "chain-joint-wrong", Error, clause "6.3.1", since "0.1.0",
    phase References, needs [Passed(CHN001)], check chain_joint_wrong,

    /// `joint_type` of a joint is not the URDF's.
    ///
    /// The type says how many numbers the joint takes from a configuration and what they do. A consumer
    /// of `chain_module` sees no URDF: it moves the joint in the wrong way, and may read the DOFs of
    /// the next joints for this one's.
    ///
    /// Copy the type from `urdf_module`. (A joint without limits that turns is still `Revolute` if the
    /// URDF says so.)
    CHN007 "joint-type-differs", Error, clause "6.3.4", since "0.1.0",
    phase References, needs [Version1, Passed(CHN002), ModuleV1(Kind::Chain)], check joint_type_differs,

    /// `axis` of a joint is not the URDF's axis made a unit vector.
    ///
    /// The joint turns about it or slides along it. Were it longer than 1, a sliding joint would go too
    /// far and a rotation would not be one; were it reversed, the joint would move backwards.
    ///
    /// Divide the URDF's axis by its length; it is (1, 0, 0) where the URDF has none. Fixed, floating and
    /// spherical joints have no axis: write null.
    CHN009 "joint-axis-wrong", Error, clause "6.3.4", since "0.1.0",
    phase References, needs [Version1, Passed(CHN002), ModuleV1(Kind::Chain)], check joint_axis_wrong,

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

fn chain_joint_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let tree = context.tree()?;
    let chain = context.chain()?;
    let (right, written) = (robot.joints.len(), chain.joints_in_chain.len());
    if right != written {
        finding_in(Kind::Chain, "/joints_in_chain", "one entry per joint of urdf_module is needed")
            .counts(right, written, "joints")
            .report(findings);
        return Some(());
    }
    let right = robot.joints.iter().zip(&tree.joint_links);
    for (index, (joint, (right, (parent, child)))) in
        chain.joints_in_chain.iter().zip(right).enumerate()
    {
        let mut expect = |key: &str, right: String, written: String| {
            if right != written {
                let pointer = format!("/joints_in_chain/{index}/{key}");
                let message = format!("this is not what urdf_module says of joint {index}");
                finding_in(Kind::Chain, pointer, message).values(right, written).report(findings);
            }
        };
        let mut name = |key, right: &str, written: &str| {
            expect(key, format!("{right:?}"), format!("{written:?}"));
        };
        name("joint_name", &right.name, &joint.joint_name);
        name("parent_link_name", &right.parent, &joint.parent_link_name);
        name("child_link_name", &right.child, &joint.child_link_name);
        let mut idx = |key, right: usize, written: usize| {
            expect(key, right.to_string(), written.to_string());
        };
        idx("joint_idx", index, joint.joint_idx.get());
        idx("parent_link_idx", *parent, joint.parent_link_idx.get());
        idx("child_link_idx", *child, joint.child_link_idx.get());
    }
    Some(())
}

fn joint_type_differs(context: &Context, findings: &mut Findings) -> Option<()> {
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

fn joint_axis_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
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
        let pointer = format!("/joints_in_chain/{index}/origin/quaternion_wxyz");
        let is_right = || !is_other_rotation(context, index, quaternion);
        report_not_canonical(Kind::Chain, pointer, quaternion, is_right, findings);
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

/// Reports a quaternion that is not of length 1, or the negative of the one to write, if that `is_right`.
pub fn report_not_canonical(
    kind: Kind,
    pointer: String,
    quaternion: [f64; 4],
    is_right: impl FnOnce() -> bool,
    findings: &mut Findings,
) {
    let at = |message: &str| finding_in(kind, pointer, message).actual(format!("{quaternion:?}"));
    let norm = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
    if (norm - 1.0).abs() > UNIT_NORM {
        let message = format!("this quaternion has length {norm:?}; divide it by that");
        at(&message).expected("length 1").tolerance(UNIT_NORM).report(findings);
    } else if is_negative(&quaternion) && is_right() {
        let message = "this is the negative of the quaternion to write; negate all four numbers";
        let negated = quaternion.map(|x| if x == 0.0 { 0.0 } else { -x });
        at(message).expected(format!("{negated:?}")).report(findings);
    }
}

/// Whether the first non-zero number is negative.
pub fn is_negative(quaternion: &[f64]) -> bool {
    quaternion.iter().find(|x| **x != 0.0).is_some_and(|x| *x < 0.0)
}
