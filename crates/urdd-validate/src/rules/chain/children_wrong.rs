use super::list;
use crate::rules::prelude::*;

declare_rule! {
    /// A link's child joints or child links are not those that the robot's joints give it.
    ///
    /// Programs go down the tree by `children_joint_idxs` and `children_link_idxs`. A child that is
    /// missing is never visited: it has no pose, and is left out of collision checks.
    ///
    /// List every joint that sits on the link, ascending, and the links that these joints move, ascending
    /// too (so that entries of the two lists need not belong together). In legacy modules any order will
    /// do.
    CHN004 "children-wrong", Error, clause "6.3.2", since "0.1.0",
    phase References, needs [Passed(CHN002)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let tree = context.tree()?;
    let chain = context.chain()?;
    let any_order = context.is_legacy(Kind::Chain);
    for (index, (link, joints)) in chain.links_in_chain.iter().zip(&tree.child_joints).enumerate() {
        let links = joints.iter().filter_map(|joint| tree.joint_links.get(*joint));
        let mut links: Vec<usize> = links.map(|(_, child)| *child).collect();
        links.sort_unstable();
        let written_joints = link.children_joint_idxs.iter().map(|joint| joint.get());
        let written_links = link.children_link_idxs.iter().map(|link| link.get());
        let (written_joints, written_links) = (written_joints.collect(), written_links.collect());
        let lists: [(&str, &Vec<usize>, Vec<usize>); 2] = [
            ("children_joint_idxs", joints, written_joints),
            ("children_link_idxs", &links, written_links),
        ];
        for (key, right, mut written) in lists {
            if any_order {
                written.sort_unstable();
            }
            if *right == written {
                continue;
            }
            let mut pointer = format!("/links_in_chain/{index}/{key}");
            let place = right.iter().zip(&written).position(|(a, b)| a != b);
            if let Some(place) = place
                && right.len() == written.len()
                && !any_order
            {
                pointer += &format!("/{place}");
            }
            let message = format!(
                "these are not the children of link {index} ({:?}) by the joints of urdf_module",
                link.name
            );
            let finding = finding_in(Kind::Chain, pointer, message);
            findings.report(finding.values(list(right), list(&written)));
        }
    }
    Some(())
}
