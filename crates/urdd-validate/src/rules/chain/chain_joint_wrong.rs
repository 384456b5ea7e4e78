use crate::rules::prelude::*;

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
    phase References, needs [Passed(CHN001)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
