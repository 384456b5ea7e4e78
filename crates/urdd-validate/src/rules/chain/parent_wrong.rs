use super::or_null;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::ModuleKind;

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
    let parents = tree.parent_joint.iter().zip(&tree.parent_link);
    for (index, (link, (joint, parent))) in chain.links.iter().zip(parents).enumerate() {
        for (key, right, written) in [
            (
                "parent_joint_idx",
                *joint,
                link.parent_joint_idx.map(|joint| joint.get()),
            ),
            (
                "parent_link_idx",
                *parent,
                link.parent_link_idx.map(|link| link.get()),
            ),
        ] {
            if right != written {
                findings.report(
                    Finding::at(
                        module.file("module.json"),
                        format!("/links_in_chain/{index}/{key}"),
                        format!(
                            "this is not the parent of link {index} ({:?}) by the joints of urdf_module",
                            link.name
                        ),
                    )
                    .expected(or_null(right))
                    .actual(or_null(written)),
                );
            }
        }
    }
}
