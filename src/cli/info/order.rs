//! The joints in the order of each program.

use std::fmt::{self, Write};

use super::names::{safe, widest};
use urdd_export::JointOrder;

/// Writes the joints for people: a column for each order, with the programs that have it.
pub(super) fn write(orders: &[JointOrder], out: &mut impl Write) -> fmt::Result {
    columns("order", "of joints that move", orders, |order| &order.joints, out)?;
    columns("actuators", "of exports that have them", orders, |order| &order.actuators, out)
}

fn columns(
    what: &str,
    of: &str,
    orders: &[JointOrder],
    list: fn(&JointOrder) -> &Vec<String>,
    out: &mut impl Write,
) -> fmt::Result {
    let mut columns: Vec<(&Vec<String>, Vec<&str>)> = Vec::new();
    for order in orders.iter().filter(|order| !list(order).is_empty()) {
        match columns.iter_mut().find(|(known, _)| *known == list(order)) {
            Some((_, programs)) => programs.push(order.program),
            None => columns.push((list(order), vec![order.program])),
        }
    }
    if columns.is_empty() {
        return Ok(());
    }
    writeln!(out, "  {what:9} {of}")?;
    let heads: Vec<String> = columns.iter().map(|(_, programs)| programs.join(", ")).collect();
    let widths =
        columns.iter().zip(&heads).map(|((names, _), head)| widest(names.iter()).max(head.len()));
    let widths: Vec<usize> = widths.collect();
    let mut line = |first: String, cell: &dyn Fn(usize) -> String| {
        let cells = widths.iter().enumerate().map(|(k, width)| format!("  {:width$}", cell(k)));
        writeln!(out, "{}", format!("    {first:>3}{}", cells.collect::<String>()).trim_end())
    };
    line(String::new(), &|column| heads[column].clone())?;
    let longest = columns.iter().map(|(names, _)| names.len()).max().unwrap_or(0);
    for row in 0..longest {
        line(row.to_string(), &|column| {
            columns[column].0.get(row).map_or(String::new(), |name| safe(name))
        })?;
    }
    Ok(())
}
