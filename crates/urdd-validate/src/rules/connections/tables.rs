use super::paths::Ancestors;
use crate::rules::prelude::*;
use urdd_document::tree::Tree;

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
