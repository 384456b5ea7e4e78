use super::list;
use crate::rules::prelude::*;

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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
