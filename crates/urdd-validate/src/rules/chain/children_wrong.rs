use super::list;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::{ModuleKind, Profile};

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
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(tree), Some(chain), Some(module)) = (
        context.tree(),
        context.chain(),
        context.module(ModuleKind::Chain),
    ) else {
        return;
    };
    let any_order = module
        .spec
        .is_some_and(|spec| spec.profile == Profile::Legacy);
    for (index, (link, joints)) in chain.links.iter().zip(&tree.child_joints).enumerate() {
        let mut links: Vec<usize> = joints
            .iter()
            .filter_map(|joint| tree.joint_links.get(*joint))
            .map(|(_, child)| *child)
            .collect();
        links.sort_unstable();
        let written_joints = link.children_joint_idxs.iter().map(|joint| joint.get());
        let written_links = link.children_link_idxs.iter().map(|link| link.get());
        for (key, right, mut written) in [
            (
                "children_joint_idxs",
                joints.as_slice(),
                written_joints.collect::<Vec<_>>(),
            ),
            ("children_link_idxs", &links, written_links.collect()),
        ] {
            if any_order {
                written.sort_unstable();
            }
            if right != written {
                let place = right.iter().zip(&written).position(|(a, b)| a != b);
                let pointer = match place {
                    Some(place) if right.len() == written.len() && !any_order => {
                        format!("/links_in_chain/{index}/{key}/{place}")
                    }
                    _ => format!("/links_in_chain/{index}/{key}"),
                };
                findings.report(
                    Finding::at(
                        module.file("module.json"),
                        pointer,
                        format!(
                            "these are not the children of link {index} ({:?}) by the joints of urdf_module",
                            link.name
                        ),
                    )
                    .expected(list(right))
                    .actual(list(&written)),
                );
            }
        }
    }
}
