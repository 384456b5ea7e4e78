use crate::rules::prelude::*;

declare_rule! {
    /// A table of `connections_module` does not have one row per link, or a row not one entry per link.
    ///
    /// The tables are indexed by link, twice where they are about pairs: with n links, `root_paths` has
    /// n entries, the others n rows of n. A program that looks up a pair in a smaller table fails, or
    /// finds the path between two other links.
    ///
    /// Write the module again from the robot as it is now.
    CON001 "connection-table-size", Error, clause "6.4.1", since "0.1.0",
    phase References, needs [Module(Kind::Connections), ROBOT_SOUND],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
