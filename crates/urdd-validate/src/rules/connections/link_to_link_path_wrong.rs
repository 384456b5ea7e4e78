use super::walk::{path_fault, report_pairs};
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
    let table = document!(context, Connections)?.link_to_link_paths.as_deref();
    report_pairs(
        context,
        findings,
        ("link_to_link_paths", table.unwrap_or_default()),
        path_fault,
        |[i, _, j]| format!("this is not the path from link {i} to link {j}"),
    )
}
