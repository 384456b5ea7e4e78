use super::walk::report_pairs;
use crate::rules::prelude::*;

declare_rule! {
    /// An entry of `lowest_common_ancestors` is not the last link that two root paths share.
    ///
    /// It is where the path between two links turns from climbing to descending. With a wrong one, a
    /// program that cuts the path out of `root_paths` leaves links out, or takes in links that no path
    /// between the two passes.
    ///
    /// Compare the root paths of the two links from the front; the last link in which they agree is the
    /// entry. The table is symmetric, and has every link itself on its diagonal.
    CON003 "common-ancestor-wrong", Error, clause "6.4.3", since "0.1.0",
    phase References, needs [Version1, Passed(CON001), ModuleV1(Kind::Connections)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
