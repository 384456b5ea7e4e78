use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// `root_idx` is not the root link.
    ///
    /// Forward kinematics starts at the root with the identity. From another link, only what is below
    /// that link is ever reached.
    ///
    /// The root is the one link that is not the child of a joint.
    CHN006 "root-wrong", Error, clause "6.3.3", since "0.1.0",
    phase References, needs [Passed(CHN002)],
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
    if chain.root.get() == tree.root {
        return;
    }
    let name = robot.links.get(tree.root).map(|link| link.name.as_str());
    findings.report(
        Finding::at(
            module.file("module.json"),
            "/root_idx",
            format!(
                "the root is link {} ({:?}), which no joint of urdf_module has as its child",
                tree.root,
                name.unwrap_or_default()
            ),
        )
        .expected(tree.root)
        .actual(chain.root),
    );
}
