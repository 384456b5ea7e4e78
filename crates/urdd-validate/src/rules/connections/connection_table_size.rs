use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::ModuleKind;

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
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(connections), Some(module)) = (
        context.robot(),
        context.connections(),
        context.module(ModuleKind::Connections),
    ) else {
        return;
    };
    let links = robot.links.len();
    let mut tables: Vec<(&str, Vec<usize>)> = Vec::new();
    let mut lists: Vec<(&str, usize)> = Vec::new();
    if let Some(v1) = connections.v1 {
        lists.push(("root_paths", v1.root_paths.len()));
        tables.push((
            "lowest_common_ancestors",
            lengths(&v1.lowest_common_ancestors),
        ));
        if let Some(paths) = &v1.link_to_link_paths {
            tables.push(("link_to_link_paths", lengths(paths)));
        }
    }
    if let Some(paths) = connections.descendant_paths {
        tables.push(("link_connection_paths", lengths(paths)));
    }
    lists.extend(tables.iter().map(|(name, rows)| (*name, rows.len())));

    let file = module.file("module.json");
    let wrong: Vec<&(&str, usize)> = lists.iter().filter(|(_, size)| *size != links).collect();
    // A stale module is one mistake, though it shows in every table.
    if let Some((first, size)) = wrong.first() {
        let names: Vec<String> = wrong
            .iter()
            .map(|(name, size)| format!("`{name}` has {size}"))
            .collect();
        findings.report(
            Finding::at(
                &file,
                format!("/{first}"),
                format!(
                    "one entry per link of urdf_module is needed: {}",
                    names.join(", ")
                ),
            )
            .expected(format!("{links} entries"))
            .actual(format!("{size} entries")),
        );
        return;
    }
    for (name, rows) in &tables {
        for (row, size) in rows.iter().enumerate() {
            if *size != links {
                findings.report(
                    Finding::at(
                        &file,
                        format!("/{name}/{row}"),
                        format!("row {row} does not have one entry per link"),
                    )
                    .expected(format!("{links} entries"))
                    .actual(format!("{size} entries")),
                );
            }
        }
    }
}

fn lengths<T>(rows: &[Vec<T>]) -> Vec<usize> {
    rows.iter().map(Vec::len).collect()
}
