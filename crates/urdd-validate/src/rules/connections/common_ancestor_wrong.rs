use super::walk::Ancestors;
use crate::rules::prelude::*;

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
    phase References, needs [Version1, Passed(CON001), ModuleV1(Kind::Connections)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let tree = context.tree()?;
    let connections = context.connections()?.v1?;
    let module = context.module(ModuleKind::Connections)?;
    let mut fold = Fold::new(findings);
    let mut ancestors = Ancestors::new(tree);
    for (i, row) in connections.lowest_common_ancestors.iter().enumerate() {
        for (j, (written, right)) in row.iter().zip(ancestors.row(i)).enumerate() {
            if written.get() != *right {
                fold.add(|| {
                    let pointer = format!("/lowest_common_ancestors/{i}/{j}");
                    let message = format!(
                        "this is not the lowest common ancestor of links {i} and {j}, the last link that their root paths share"
                    );
                    let finding = Finding::of(module, pointer, message);
                    finding.expected(right).actual(written)
                });
            }
        }
    }
    Some(())
}
