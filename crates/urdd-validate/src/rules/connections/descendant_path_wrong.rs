use super::walk::{Fault, report_pairs, show_path};
use crate::rules::prelude::*;
use urdd_document::tree::Tree;
use urdd_format::index::LinkIdx;

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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let table = context.connections()?.link_connection_paths.as_deref();
    report_pairs(
        context,
        findings,
        ("link_connection_paths", table.unwrap_or_default()),
        fault,
        |[i, top, j]| match top == i {
            true if i == j => "the path of a link to itself is that link alone".to_owned(),
            true => format!("this is not the path from link {i} down to link {j}"),
            false => format!("link {j} is not below link {i}; write null"),
        },
    )
}

/// The first difference of an entry from the path down from link `i` to link `j`: pointer below the entry, expected and
/// actual value.
fn fault(tree: &Tree, [i, top, j]: [usize; 3], path: &Option<Vec<LinkIdx>>) -> Option<Fault> {
    let show =
        |path: &[LinkIdx]| show_path(&path.iter().map(|link| link.get()).collect::<Vec<_>>());
    let path = path.as_deref();
    let right = match (top == i, path) {
        (false, None) => return None,
        (false, Some(path)) => return Some((String::new(), "null".to_owned(), show(path))),
        (true, _) => way_down(tree, i, j),
    };
    let path = match path {
        Some(path) if path.len() == right.len() => path,
        Some(path) => return Some((String::new(), show_path(&right), show(path))),
        None => return Some((String::new(), show_path(&right), "null".to_owned())),
    };
    let differ = right.iter().zip(path).enumerate().rev();
    let mut differ = differ.filter(|(_, (right, written))| **right != written.get());
    differ.next().map(|(place, (right, written))| {
        (format!("/{place}"), right.to_string(), written.get().to_string())
    })
}

/// The links from link `i` (not included, unless it is `j`) down to link `j`.
fn way_down(tree: &Tree, i: usize, j: usize) -> Vec<usize> {
    let mut links = vec![j];
    let mut link = j;
    while let Some(parent) = tree.parent_link[link].filter(|parent| *parent != i && link != i) {
        links.push(parent);
        link = parent;
    }
    links.reverse();
    links
}
