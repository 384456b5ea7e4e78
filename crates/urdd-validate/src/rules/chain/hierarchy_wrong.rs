use super::list;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::{ModuleKind, Profile};

declare_rule! {
    /// `kinematic_hierarchy` is not the links by their distance from the root.
    ///
    /// Programs compute poses level by level, so that every parent is done before its children, and
    /// the links of one level at once. A link on the wrong level is computed from a pose that is not
    /// there yet; one that is missing is never computed.
    ///
    /// Level d holds the links that d joints separate from the root, ascending (in legacy modules
    /// in any order); level 0 is the root alone, and every link is on exactly one level.
    CHN005 "hierarchy-wrong", Error, clause "6.3.3", since "0.1.0",
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
    let file = module.file("module.json");
    let levels = tree.levels();
    if levels.len() != chain.hierarchy.len() {
        findings.report(
            Finding::at(
                &file,
                "/kinematic_hierarchy",
                "the tree of urdf_module has another number of levels",
            )
            .expected(format!("{} levels", levels.len()))
            .actual(format!("{} levels", chain.hierarchy.len())),
        );
        return;
    }
    for (depth, (right, written)) in levels.iter().zip(chain.hierarchy).enumerate() {
        let mut written: Vec<usize> = written.iter().map(|link| link.get()).collect();
        if any_order {
            written.sort_unstable();
        }
        if *right != written {
            findings.report(
                Finding::at(
                    &file,
                    format!("/kinematic_hierarchy/{depth}"),
                    format!("these are not the links of level {depth} (so many joints from the root), ascending"),
                )
                .expected(list(right))
                .actual(list(&written)),
            );
        }
    }
}
