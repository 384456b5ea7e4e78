use crate::rules::prelude::*;

declare_rule! {
    /// `links_in_chain` does not hold the links of `urdf_module`, in their order.
    ///
    /// Everything in a URDD that is indexed by link counts on this one order. An entry that is
    /// missing or out of place gives every link after it the neighbours and meshes of another.
    ///
    /// Write one entry for every link of `urdf_module`, in its order, with its name and its index. If
    /// the robot has changed since, write `chain_module` and what depends on it again.
    CHN001 "chain-link-wrong", Error, clause "6.3.1", since "0.1.0",
    phase References, needs [Module(Kind::Chain), ROBOT_SOUND], check chain_link_wrong,

    /// A link's parent joint or parent link is not the one that the robot's joints give it.
    ///
    /// Programs climb the tree by `parent_joint_idx` and `parent_link_idx`: a wrong one leads to poses,
    /// paths and Jacobians of another robot, a wrong null to a second root.
    ///
    /// The parent joint is the joint that has the link as its child, the parent link that joint's parent;
    /// both are null for the root, and only for it.
    CHN003 "parent-wrong", Error, clause "6.3.2", since "0.1.0",
    phase References, needs [Passed(CHN002)], check parent_wrong,

    /// A link's child joints or child links are not those that the robot's joints give it.
    ///
    /// Programs go down the tree by `children_joint_idxs` and `children_link_idxs`. A child that is
    /// missing is never visited: it has no pose, and is left out of collision checks.
    ///
    /// List every joint that sits on the link, ascending, and the links that these joints move, ascending
    /// too (so that entries of the two lists need not belong together). In legacy modules any order will
    /// do.
    CHN004 "children-wrong", Error, clause "6.3.2", since "0.1.0",
    phase References, needs [Passed(CHN002)], check children_wrong,

    /// `kinematic_hierarchy` is not the links by their distance from the root.
    ///
    /// Programs compute poses level by level, so that every parent is done before its children, and
    /// the links of one level at once. A link on the wrong level is computed from a pose that is not
    /// there yet; one that is missing is never computed.
    ///
    /// Level d holds the links that d joints separate from the root, ascending (in legacy modules
    /// in any order); level 0 is the root alone, and every link is on exactly one level.
    CHN005 "hierarchy-wrong", Error, clause "6.3.3", since "0.1.0",
    phase References, needs [Passed(CHN002)], check hierarchy_wrong,

    /// `root_idx` is not the root link.
    ///
    /// Forward kinematics starts at the root with the identity. From another link, only what is below
    /// that link is ever reached.
    ///
    /// The root is the one link that is not the child of a joint.
    CHN006 "root-wrong", Error, clause "6.3.3", since "0.1.0",
    phase References, needs [Passed(CHN002)], check root_wrong,
}

fn chain_link_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let chain = context.chain()?;
    let (right, written) = (robot.links.len(), chain.links_in_chain.len());
    if right != written {
        finding_in(Kind::Chain, "/links_in_chain", "one entry per link of urdf_module is needed")
            .counts(right, written, "links")
            .report(findings);
        return Some(());
    }
    for (index, (link, right)) in chain.links_in_chain.iter().zip(&robot.links).enumerate() {
        if link.name != right.name {
            let message = format!("this is not the name of link {index} of urdf_module");
            finding_in(Kind::Chain, format!("/links_in_chain/{index}/name"), message)
                .literals(&right.name, &link.name)
                .report(findings);
        }
        if link.link_idx.get() != index {
            let pointer = format!("/links_in_chain/{index}/link_idx");
            let message = "`link_idx` is not the link's place in this list";
            finding_in(Kind::Chain, pointer, message).values(index, link.link_idx).report(findings);
        }
    }
    Some(())
}

fn parent_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
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

fn children_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let tree = context.tree()?;
    let chain = context.chain()?;
    let any_order = context.is_legacy(Kind::Chain);
    for (index, (link, joints)) in chain.links_in_chain.iter().zip(&tree.child_joints).enumerate() {
        let links = joints.iter().filter_map(|joint| tree.joint_links.get(*joint));
        let mut links: Vec<usize> = links.map(|(_, child)| *child).collect();
        links.sort_unstable();
        let written_joints = link.children_joint_idxs.iter().map(|joint| joint.get());
        let written_links = link.children_link_idxs.iter().map(|link| link.get());
        let lists: [(&str, &Vec<usize>, Vec<usize>); 2] = [
            ("children_joint_idxs", joints, written_joints.collect()),
            ("children_link_idxs", &links, written_links.collect()),
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

fn hierarchy_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let tree = context.tree()?;
    let chain = context.chain()?;
    let levels = tree.levels();
    if levels.len() != chain.kinematic_hierarchy.len() {
        let message = "the tree of urdf_module has another number of levels";
        finding_in(Kind::Chain, "/kinematic_hierarchy", message)
            .counts(levels.len(), chain.kinematic_hierarchy.len(), "levels")
            .report(findings);
        return Some(());
    }
    for (depth, (right, written)) in levels.iter().zip(&chain.kinematic_hierarchy).enumerate() {
        let mut written: Vec<usize> = written.iter().map(|link| link.get()).collect();
        if context.is_legacy(Kind::Chain) {
            written.sort_unstable();
        }
        if *right != written {
            let pointer = format!("/kinematic_hierarchy/{depth}");
            let message = format!(
                "these are not the links of level {depth} (so many joints from the root), ascending"
            );
            let finding = finding_in(Kind::Chain, pointer, message);
            findings.report(finding.values(list(right), list(&written)));
        }
    }
    Some(())
}

fn root_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let root = context.tree()?.root;
    let written = context.chain()?.root_idx;
    if written.get() != root {
        let name = &robot.links.get(root)?.name;
        let message = format!(
            "the root is link {root} ({name:?}), which no joint of urdf_module has as its child"
        );
        finding_in(Kind::Chain, "/root_idx", message).values(root, written).report(findings);
    }
    Some(())
}

/// A list of indices, as a report has it: cut where it is long.
fn list(indices: &[usize]) -> String {
    const LONGEST: usize = 12;
    let shown: Vec<String> = indices.iter().take(LONGEST).map(usize::to_string).collect();
    match indices.len() {
        0..=LONGEST => format!("[{}]", shown.join(", ")),
        all => format!("[{}, … {all} in all]", shown.join(", ")),
    }
}
