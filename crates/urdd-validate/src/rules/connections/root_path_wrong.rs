use super::Tally;
use super::walk::path_fault;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// A path of `root_paths` is not the path from the root to its link.
    ///
    /// Every other path is cut from these, and they say which joints move a link: a wrong one gives wrong
    /// Jacobians and wrong paths for every pair that the link belongs to.
    ///
    /// `links` begins with the root and ends with the link itself; `joints` are those between them, one
    /// fewer. For the root: itself alone, and no joint.
    CON002 "root-path-wrong", Error, clause "6.4.2", since "0.1.0",
    phase References, needs [Version1, Passed(CON001)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(tree), Some(connections), Some(module)) = (
        context.robot(),
        context.tree(),
        context.connections().and_then(|connections| connections.v1),
        context.module(ModuleKind::Connections),
    ) else {
        return findings.skip(SkipReason::NotInThisVersion(ModuleKind::Connections));
    };
    let mut tally = Tally::default();
    let paths = connections.root_paths.iter().zip(&robot.links);
    for (to, (path, link)) in paths.enumerate() {
        if let Some((place, right, written)) = path_fault(tree, (tree.root, tree.root, to), path) {
            tally.wrong(|| {
                Finding::at(
                    module.file("module.json"),
                    format!("/root_paths/{to}{place}"),
                    format!(
                        "this is not the path from the root to link {to} ({:?})",
                        link.name
                    ),
                )
                .expected(right)
                .actual(written)
            });
        }
    }
    tally.report(findings);
}
