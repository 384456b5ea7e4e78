use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::ModuleKind;

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
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(tree), Some(chain), Some(module)) = (
        context.robot(),
        context.tree(),
        context.chain(),
        context.module(ModuleKind::Chain),
    ) else {
        return;
    };
    let file = module.file("module.json");
    if chain.joints.len() != robot.joints.len() {
        findings.report(
            Finding::at(
                &file,
                "/joints_in_chain",
                "one entry per joint of urdf_module is needed",
            )
            .expected(format!("{} joints", robot.joints.len()))
            .actual(format!("{} joints", chain.joints.len())),
        );
        return;
    }
    let right = robot.joints.iter().zip(&tree.joint_links);
    for (index, (joint, (right, (parent, child)))) in chain.joints.iter().zip(right).enumerate() {
        let mut expect = |key: &str, right: String, written: String| {
            if right != written {
                findings.report(
                    Finding::at(
                        &file,
                        format!("/joints_in_chain/{index}/{key}"),
                        format!("this is not what urdf_module says of joint {index}"),
                    )
                    .expected(right)
                    .actual(written),
                );
            }
        };
        let quoted = |name: &str| format!("{name:?}");
        expect("joint_name", quoted(&right.name), quoted(joint.joint_name));
        expect("joint_idx", index.to_string(), joint.joint_idx.to_string());
        for (keys, right_name, right_idx, name, idx) in [
            (
                ["parent_link_name", "parent_link_idx"],
                &right.parent,
                parent,
                joint.parent_link_name,
                joint.parent_link_idx,
            ),
            (
                ["child_link_name", "child_link_idx"],
                &right.child,
                child,
                joint.child_link_name,
                joint.child_link_idx,
            ),
        ] {
            expect(keys[0], quoted(right_name), quoted(name));
            expect(keys[1], right_idx.to_string(), idx.to_string());
        }
    }
}
