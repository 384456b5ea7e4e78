use crate::rules::prelude::*;
use urdd_document::pose::unit;

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
