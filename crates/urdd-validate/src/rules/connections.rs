//! CON: `connections_module`.
//!
//! Every table is compared with the tree that follows from `urdf_module`, in time proportional to
//! what is written in it: the table of lowest common ancestors is made row by row, and paths are
//! walked without being made.

use crate::rules::prelude::*;
use urdd_document::tree::Tree;
use urdd_format::connections::LinkPath;
use urdd_format::index::LinkIdx;

declare_rule! {
    /// A table of `connections_module` does not have one row per link, or a row not one entry per link.
    ///
    /// The tables are indexed by link, twice where they are about pairs: with n links, `root_paths` has
    /// n entries, the others n rows of n. A program that looks up a pair in a smaller table fails, or
    /// finds the path between two other links.
    ///
    /// Write the module again from the robot as it is now.
    CON001 "connection-table-size", Error, clause "6.4.1", since "0.1.0",
    phase References, needs [Module(Kind::Connections), ROBOT_SOUND], check connection_table_size,

    /// `link_to_link_paths` or `link_connection_paths` is null, though the robot is not so large that it
    /// may be.
    ///
    /// Consumers may count on these tables for robots of usual size, and need no way to make paths of
    /// their own. They are left out only where they would be very large.
    ///
    /// Write both tables. They may be null above 300 links, and where the paths of all pairs hold more
    /// than 2,000,000 links together, as those of a line of 181 links do.
    CON006 "explicit-paths-missing", Error, clause "6.4.6", since "0.1.0",
    phase References, needs [Version1, ModuleV1(Kind::Connections), ROBOT_SOUND], check explicit_paths_missing,

    /// A path of `root_paths` is not the path from the root to its link.
    ///
    /// Every other path is cut from these, and they say which joints move a link: a wrong one gives wrong
    /// Jacobians and wrong paths for every pair that the link belongs to.
    ///
    /// `links` begins with the root and ends with the link itself; `joints` are those between them, one
    /// fewer. For the root: itself alone, and no joint.
    CON002 "root-path-wrong", Error, clause "6.4.2", since "0.1.0",
    phase References, needs [Version1, Passed(CON001), ModuleV1(Kind::Connections)], check root_path_wrong,

    /// A path of `link_to_link_paths` is not the path between its two links.
    ///
    /// Programs take relative poses and Jacobians of two links along it. A wrong path leaves out joints
    /// that move one link against the other, or counts joints that do not.
    ///
    /// Element (i, j) begins with link i and ends with link j, and climbs no further than their lowest
    /// common ancestor; `joints` are those between the links, one fewer. Element (j, i) is the same
    /// backwards.
    CON004 "link-to-link-path-wrong", Error, clause "6.4.4", since "0.1.0",
    phase References, needs [Version1, Passed(CON001), ModuleV1(Kind::Connections)], check link_to_link_path_wrong,

    /// An entry of `link_connection_paths` is not the way down from one link to another.
    ///
    /// Programs read from this table whether link j is below link i in the tree, and through which
    /// links. With a path that does not exist, a link that does not move seems to move; with a
    /// missing path, the reverse.
    ///
    /// Element (i, j) is `[i]` where i is j. Where j is below i, it is the links from i (not included) to
    /// j (included). Otherwise it is null.
    CON005 "descendant-path-wrong", Error, clause "6.4.5", since "0.1.0",
    phase References, needs [Passed(CON001)], check descendant_path_wrong,

    /// An entry of `lowest_common_ancestors` is not the last link that two root paths share.
    ///
    /// It is where the path between two links turns from climbing to descending. With a wrong one, a
    /// program that cuts the path out of `root_paths` leaves links out, or takes in links that no path
    /// between the two passes.
    ///
    /// Compare the root paths of the two links from the front; the last link in which they agree is the
    /// entry. The table is symmetric, and has every link itself on its diagonal.
    CON003 "common-ancestor-wrong", Error, clause "6.4.3", since "0.1.0",
    phase References, needs [Version1, Passed(CON001), ModuleV1(Kind::Connections)], check common_ancestor_wrong,
}

fn connection_table_size(context: &Context, findings: &mut Findings) -> Option<()> {
    let links = context.robot()?.links.len();
    let connections = context.connections()?;
    let mut tables: Vec<(&str, Vec<usize>)> = Vec::new();
    let mut lists: Vec<(&str, usize)> = Vec::new();
    if let Some(v1) = document!(context, Connections) {
        lists.push(("root_paths", v1.root_paths.len()));
        let ancestors = lengths(&v1.lowest_common_ancestors);
        tables.push(("lowest_common_ancestors", ancestors));
        if let Some(paths) = &v1.link_to_link_paths {
            tables.push(("link_to_link_paths", lengths(paths)));
        }
    }
    if let Some(paths) = &connections.link_connection_paths {
        tables.push(("link_connection_paths", lengths(paths)));
    }
    lists.extend(tables.iter().map(|(name, rows)| (*name, rows.len())));
    let mut report = |pointer: String, message: String, size: usize| {
        finding_in(Kind::Connections, pointer, message)
            .counts(links, size, "entries")
            .report(findings);
    };
    if let Some(wrong) = wrong_lengths(&lists, links) {
        let all = wrong.in_words;
        let message = format!("one entry per link of urdf_module is needed: {all}");
        report(wrong.pointer, message, wrong.length);
        return Some(());
    }
    for (name, rows) in &tables {
        for (row, size) in rows.iter().enumerate() {
            if *size != links {
                let message = format!("row {row} does not have one entry per link");
                report(format!("/{name}/{row}"), message, *size);
            }
        }
    }
    Some(())
}

fn lengths<T>(rows: &[Vec<T>]) -> Vec<usize> {
    rows.iter().map(Vec::len).collect()
}

/// Up to this many links, the explicit tables are required (SPEC 6.4.6): some 90,000 paths.
const EXPLICIT_UP_TO: usize = 300;

/// Unless the paths of all pairs have more links than this in total.
const LINKS_IN_PATHS_UP_TO: usize = 2_000_000;

fn explicit_paths_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    let tree = context.tree()?;
    let connections = document!(context, Connections)?;
    let links = tree.parent_link.len();
    if links > EXPLICIT_UP_TO {
        return Some(());
    }
    let in_paths = links_in_paths(tree);
    if in_paths > LINKS_IN_PATHS_UP_TO {
        return Some(());
    }
    let missing = connections.link_to_link_paths.is_none();
    let descendants_missing = connections.link_connection_paths.is_none();
    for (name, missing) in
        [("link_to_link_paths", missing), ("link_connection_paths", descendants_missing)]
    {
        if missing {
            let message = format!(
                "this table may be null only above {EXPLICIT_UP_TO} links, or where the paths of all pairs have more than {LINKS_IN_PATHS_UP_TO} links; this robot has {links}, and {in_paths} in the paths"
            );
            finding_in(Kind::Connections, format!("/{name}"), message)
                .values(format!("{links} x {links} paths"), "null")
                .report(findings);
        }
    }
    Some(())
}

/// Total number of links in the paths of all pairs, each up to the common ancestor and down from it.
pub fn links_in_paths(tree: &Tree) -> usize {
    let depth = &tree.depth;
    let mut ancestors = Ancestors::new(tree);
    let of_link = |from: usize| {
        let pairs = ancestors.row(from).iter().enumerate();
        let lengths = pairs.map(|(to, top)| depth[from] + depth[to] - 2 * depth[*top] + 1);
        lengths.sum::<usize>()
    };
    (0..depth.len()).map(of_link).sum()
}

fn root_path_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let tree = context.tree()?;
    let connections = document!(context, Connections)?;
    let mut fold = Fold::new(findings);
    let paths = connections.root_paths.iter().zip(&robot.links);
    for (to, (path, link)) in paths.enumerate() {
        if let Some((place, right, written)) = path_fault(tree, [tree.root, tree.root, to], path) {
            fold.add(|| {
                let pointer = format!("/root_paths/{to}{place}");
                let message =
                    format!("this is not the path from the root to link {to} ({:?})", link.name);
                finding_in(Kind::Connections, pointer, message).values(right, written)
            });
        }
    }
    Some(())
}

fn link_to_link_path_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let table = document!(context, Connections)?.link_to_link_paths.as_deref();
    let table = ("link_to_link_paths", table.unwrap_or_default());
    report_pairs(context, findings, table, path_fault, |[i, _, j]| {
        format!("this is not the path from link {i} to link {j}")
    })
}

fn descendant_path_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let table = context.connections()?.link_connection_paths.as_deref();
    let table = ("link_connection_paths", table.unwrap_or_default());
    report_pairs(context, findings, table, fault, |[i, top, j]| match top == i {
        true if i == j => "the path of a link to itself is that link alone".to_owned(),
        true => format!("this is not the path from link {i} down to link {j}"),
        false => format!("link {j} is not below link {i}; write null"),
    })
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

fn common_ancestor_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let table = &document!(context, Connections)?.lowest_common_ancestors;
    report_pairs(
        context,
        findings,
        ("lowest_common_ancestors", table.as_slice()),
        |_, [_, top, _], written| {
            let fault = || (String::new(), top.to_string(), written.to_string());
            (written.get() != top).then(fault)
        },
        |[i, _, j]| {
            format!(
                "this is not the lowest common ancestor of links {i} and {j}, the last link that their root paths share"
            )
        },
    )
}

/// Where a value of a table is wrong, as a pointer below it; what is expected there, and what is found.
type Fault = (String, String, String);

/// Reports every faulty entry of the table `name`, which has a row for each link. `fault` and `message` are given the
/// entry's link of the row, the lowest common ancestor of its two links, and the link of the column.
fn report_pairs<T>(
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
