use super::Tally;
use super::walk::Ancestors;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// An entry of `lowest_common_ancestors` is not the last link that two root paths share.
    ///
    /// It is where the path between two links turns from climbing to descending. With a wrong one, a
    /// program that cuts the path out of `root_paths` leaves links out, or takes in links that no path
    /// between the two passes.
    ///
    /// Compare the root paths of the two links from the front; the last link in which they agree is the
    /// entry. The table is symmetric, and has every link itself on its diagonal.
    CON003 "common-ancestor-wrong", Error, clause "6.4.3", since "0.1.0",
    phase References, needs [Version1, Passed(CON001)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(tree), Some(connections), Some(module)) = (
        context.tree(),
        context.connections().and_then(|connections| connections.v1),
        context.module(ModuleKind::Connections),
    ) else {
        return findings.skip(SkipReason::NotInThisVersion(ModuleKind::Connections));
    };
    let mut tally = Tally::default();
    let mut ancestors = Ancestors::new(tree);
    for (i, row) in connections.lowest_common_ancestors.iter().enumerate() {
        for (j, (written, right)) in row.iter().zip(ancestors.row(i)).enumerate() {
            if written.get() != *right {
                tally.wrong(|| {
                    Finding::at(
                        module.file("module.json"),
                        format!("/lowest_common_ancestors/{i}/{j}"),
                        format!("this is not the lowest common ancestor of links {i} and {j}, the last link that their root paths share"),
                    )
                    .expected(right)
                    .actual(written)
                });
            }
        }
    }
    tally.report(findings);
}
