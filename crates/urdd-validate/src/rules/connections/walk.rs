//! Walks the kinematic tree: computes common ancestors row by row, and checks paths without building them.

use crate::rules::prelude::*;
use urdd_document::tree::Tree;
use urdd_format::connections::LinkPath;

/// Where a value of a table is wrong, as a pointer below it; what is expected there, and what is found.
pub(super) type Fault = (String, String, String);

/// Reports every faulty entry of the table `name`, which has a row for each link. `fault` and `message` are given the
/// entry's link of the row, the lowest common ancestor of its two links, and the link of the column.
pub(super) fn report_pairs<T>(
    context: &Context,
    findings: &mut Findings,
    (name, table): (&str, &[Vec<T>]),
    fault: impl Fn(&Tree, [usize; 3], &T) -> Option<Fault>,
    message: impl Fn([usize; 3]) -> String,
) -> Option<()> {
    let tree = context.tree()?;
    let mut fold = Fold::new(findings);
    let mut ancestors = Ancestors::new(tree);
    for (i, row) in table.iter().enumerate() {
        for (j, (entry, top)) in row.iter().zip(ancestors.row(i)).enumerate() {
            let links = [i, *top, j];
            if let Some((place, right, written)) = fault(tree, links, entry) {
                fold.add(|| {
                    let pointer = format!("/{name}/{i}/{j}{place}");
                    finding_in(Kind::Connections, pointer, message(links)).values(right, written)
                });
            }
        }
    }
    Some(())
}

/// Rows of the table of lowest common ancestors, each computed in time proportional to its length.
pub struct Ancestors<'a> {
    tree: &'a Tree,
    above: Vec<bool>,
    row: Vec<usize>,
}

impl<'a> Ancestors<'a> {
    pub fn new(tree: &'a Tree) -> Self {
        let links = tree.parent_link.len();
        Ancestors { tree, above: vec![false; links], row: vec![tree.root; links] }
    }

    /// The lowest common ancestor of `link` with every link.
    pub fn row(&mut self, link: usize) -> &[usize] {
        self.above.fill(false);
        let mut next = Some(link);
        while let Some(above) = next {
            self.above[above] = true;
            next = self.tree.parent_link[above];
        }
        // From the root downwards: an ancestor of `link` is its own answer, any other link has its parent's.
        for &other in &self.tree.order {
            self.row[other] = match self.tree.parent_link[other] {
                Some(parent) if !self.above[other] => self.row[parent],
                _ => other,
            };
        }
        &self.row
    }
}

/// The first difference of a path from the tree's path from link `from` up to link `top` and down to link `to`: pointer
/// below the path, expected and actual value.
pub fn path_fault(tree: &Tree, [from, top, to]: [usize; 3], path: &LinkPath) -> Option<Fault> {
    let up = tree.depth[from] - tree.depth[top];
    let down = tree.depth[to] - tree.depth[top];
    let length = up + down;
    for (key, right, written) in
        [("links", length + 1, path.links.len()), ("joints", length, path.joints.len())]
    {
        if right != written {
            return Some((format!("/{key}"), count(right, key), count(written, key)));
        }
    }
    let fault = |key: &str, place: usize, right: usize, written: usize| {
        (right != written)
            .then(|| (format!("/{key}/{place}"), right.to_string(), written.to_string()))
    };
    // Up from the one end, then up from the other: which end, and the places of the link and of the joint above it.
    let ups = (0..up).map(|place| (0, place, place));
    let downs = (up..length).rev().map(|place| (1, place + 1, place));
    let mut links = [from, to];
    for (end, at, place) in ups.chain(downs) {
        let link = links[end];
        let joint = tree.parent_joint[link]?;
        let faulty = fault("links", at, link, path.links[at].get())
            .or_else(|| fault("joints", place, joint, path.joints[place].get()));
        if faulty.is_some() {
            return faulty;
        }
        links[end] = tree.parent_link[link]?;
    }
    fault("links", up, top, path.links[up].get())
}

/// A number of `links` or `joints`, in words.
pub fn count(number: usize, what: &str) -> String {
    match number {
        1 => format!("1 {}", what.trim_end_matches('s')),
        _ => format!("{number} {what}"),
    }
}

/// A path for messages: all links if they are few, otherwise the first and last, and their number.
pub fn show_path(links: &[usize]) -> String {
    const SHOWN: usize = 8;
    match links {
        [first, second, .., last] if links.len() > SHOWN => {
            format!("[{first}, {second}, ..., {last}] ({} links)", links.len())
        }
        _ => format!("{links:?}"),
    }
}
