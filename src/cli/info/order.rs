//! The joints in the order of each program.

use std::fmt::{self, Write};

use serde::Serialize;

use super::names::{safe, widest};
use urdd_export::JointOrder;

/// The joints of a robot in the order of a program.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OrderInfo {
    /// The program; `urdf` for the order of the URDD itself.
    pub program: &'static str,
    /// The export that the program loads.
    pub export: &'static str,
    /// How the program orders joints.
    pub rule: &'static str,
    /// The joints that move, in the order of their positions, as they are called there.
    pub joints: Vec<String>,
    /// The actuators of the export, if it has any beside joints.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub actuators: Vec<String>,
}

impl From<JointOrder> for OrderInfo {
    fn from(order: JointOrder) -> Self {
        let JointOrder { program, format, rule, joints, actuators, .. } = order;
        OrderInfo { program, export: format.word(), rule, joints, actuators }
    }
}

/// Writes the joints for people: a column for each order, with the programs that have it.
pub(super) fn write(orders: &[OrderInfo], out: &mut impl Write) -> fmt::Result {
    columns("order", "of joints that move", orders, |order| &order.joints, out)?;
    columns("actuators", "of exports that have them", orders, |order| &order.actuators, out)
}

fn columns(
    what: &str,
    of: &str,
    orders: &[OrderInfo],
    list: fn(&OrderInfo) -> &Vec<String>,
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
