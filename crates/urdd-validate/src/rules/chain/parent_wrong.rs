use crate::rules::prelude::*;

declare_rule! {
    /// A link's parent joint or parent link is not the one that the robot's joints give it.
    ///
    /// Programs climb the tree by `parent_joint_idx` and `parent_link_idx`: a wrong one leads to poses,
    /// paths and Jacobians of another robot, a wrong null to a second root.
    ///
    /// The parent joint is the joint that has the link as its child, the parent link that joint's parent;
    /// both are null for the root, and only for it.
    CHN003 "parent-wrong", Error, clause "6.3.2", since "0.1.0",
    phase References, needs [Passed(CHN002)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let tree = context.tree()?;
    let chain = context.chain()?;
    let parents = tree.parent_joint.iter().zip(&tree.parent_link);
    for (index, (link, (joint, parent))) in chain.links_in_chain.iter().zip(parents).enumerate() {
        let written_joint = link.parent_joint_idx.map(|joint| joint.get());
        let written_link = link.parent_link_idx.map(|link| link.get());
        for (key, right, written) in [
            ("parent_joint_idx", *joint, written_joint),
            ("parent_link_idx", *parent, written_link),
        ] {
            if right != written {
                let pointer = format!("/links_in_chain/{index}/{key}");
                let message = format!(
                    "this is not the parent of link {index} ({:?}) by the joints of urdf_module",
                    link.name
                );
                let finding = finding_in(Kind::Chain, pointer, message);
                findings.report(finding.values(or_null(right), or_null(written)));
            }
        }
    }
    Some(())
}
