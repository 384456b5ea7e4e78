use super::Tally;
use super::walk::Ancestors;
use crate::document::tree::Tree;
use crate::format::index::LinkIdx;
use crate::format::registry::ModuleKind;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::rule::declare_rule;

declare_rule! {
    /// An entry of `link_connection_paths` is not the way down from one link to another.
    ///
    /// Programs read from this table whether link j is below link i in the tree, and through which
    /// links. With a path that does not exist, a link that does not move seems to move; with a
    /// missing path, the reverse.
    ///
    /// Element (i, j) is `[i]` where i is j. Where j is below i, it is the links from i (not included) to
    /// j (included). Otherwise it is null.
    CON005 "descendant-path-wrong", Error, clause "6.4.5", since "0.1.0",
    phase References, needs [Passed(CON001)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(tree), Some(connections), Some(module)) = (
        context.tree(),
        context.connections(),
        context.module(ModuleKind::Connections),
    ) else {
        return;
    };
    let mut tally = Tally::default();
    let mut ancestors = Ancestors::new(tree);
    let table = connections.descendant_paths.into_iter().flatten();
    for (i, row) in table.enumerate() {
        for (j, (path, top)) in row.iter().zip(ancestors.row(i)).enumerate() {
            let below = *top == i;
            let Some((place, right, written)) = fault(tree, i, j, below, path.as_deref()) else {
                continue;
            };
            tally.wrong(|| {
                let message = match below {
                    true if i == j => "the path of a link to itself is that link alone".to_owned(),
                    true => format!("link {j} is below link {i}, by another path"),
                    false => format!("link {j} is not below link {i}; write null"),
                };
                let pointer = format!("/link_connection_paths/{i}/{j}{place}");
                Finding::at(module.file("module.json"), pointer, message)
                    .expected(right)
                    .actual(written)
            });
        }
    }
    tally.report(findings);
}

/// Where the entry differs from the way down from link `i` to link `j`: the place below it, and what
/// should be and is there.
fn fault(
    tree: &Tree,
    i: usize,
    j: usize,
    below: bool,
    path: Option<&[LinkIdx]>,
) -> Option<(String, String, String)> {
    let count = |links: usize| format!("{links} links");
    let length = match i == j {
        true => 1,
        false => tree.depth[j].saturating_sub(tree.depth[i]),
    };
    let path = match (below, path) {
        (false, None) => return None,
        (true, Some(path)) if path.len() == length => path,
        (true, Some(path)) => return Some((String::new(), count(length), count(path.len()))),
        (true, None) => return Some((String::new(), count(length), "null".to_owned())),
        (false, Some(path)) => return Some((String::new(), "null".to_owned(), count(path.len()))),
    };
    let mut link = j;
    for (place, written) in path.iter().enumerate().rev() {
        if written.get() != link {
            return Some((format!("/{place}"), link.to_string(), written.to_string()));
        }
        link = tree.parent_link[link].unwrap_or(link);
    }
    None
}
