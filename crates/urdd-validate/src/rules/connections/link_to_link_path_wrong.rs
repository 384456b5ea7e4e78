use super::walk::{Ancestors, path_fault};
use crate::rules::prelude::*;

declare_rule! {
    /// A path of `link_to_link_paths` is not the path between its two links.
    ///
    /// Programs take relative poses and Jacobians of two links along it. A wrong path leaves out joints
    /// that move one link against the other, or counts joints that do not.
    ///
    /// Element (i, j) begins with link i and ends with link j, and climbs no further than their lowest
    /// common ancestor; `joints` are those between the links, one fewer. Element (j, i) is the same
    /// backwards.
    CON004 "link-to-link-path-wrong", Error, clause "6.4.4", since "0.1.0",
    phase References, needs [Version1, Passed(CON001), ModuleV1(Kind::Connections)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let tree = context.tree()?;
    let connections = context.connections()?.v1?;
    let module = context.module(ModuleKind::Connections)?;
    let mut fold = Fold::new(findings);
    let mut ancestors = Ancestors::new(tree);
    let table = connections.link_to_link_paths.iter().flatten();
    for (i, row) in table.enumerate() {
        for (j, (path, top)) in row.iter().zip(ancestors.row(i)).enumerate() {
            if let Some((place, right, written)) = path_fault(tree, (i, *top, j), path) {
                fold.add(|| {
                    let pointer = format!("/link_to_link_paths/{i}/{j}{place}");
                    let message = format!("this is not the path from link {i} to link {j}");
                    let finding = Finding::of(module, pointer, message);
                    finding.expected(right).actual(written)
                });
            }
        }
    }
    Some(())
}
