use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::shapes::{LIST_MODULES, entry_counts};

declare_rule! {
    /// A list of boxes, spheres or distances does not hold one entry per link.
    ///
    /// The place in the list is the link index: where an entry is missing or too many, every later link
    /// gets another link's shape. Most often the module is stale: it was written before a link was
    /// added or removed.
    ///
    /// Write the link shape modules again from the same URDF as `urdf_module`, with null (or an empty
    /// list) for links without a hull.
    SHP001 "shape-list-length", Error, clause "8.2", since "0.1.0",
    phase References, needs [
        Module(Kind::Urdf),
        AnyModule(&[Kind::LinkShapesApproximations, Kind::LinkShapesMaxDistanceFromOrigin]),
        LINKS_NAMED,
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some(robot) = context.robot() else {
        return;
    };
    let links = robot.links.len();
    for kind in LIST_MODULES {
        let (Some(document), Some(module)) = (context.document(*kind), context.module(*kind))
        else {
            continue;
        };
        let lists = entry_counts(document);
        let wrong: Vec<(&str, usize)> = lists
            .iter()
            .map(|list| (list.key, list.links.len()))
            .filter(|(_, length)| *length != links)
            .collect();
        let Some((first, length)) = wrong.first() else {
            continue;
        };
        // A stale module is one mistake, though it shows in every list.
        let message = if wrong.len() == lists.len() {
            format!(
                "the lists here have {length} entries, but urdf_module has {links} links: the module is stale; write it again from the same robot"
            )
        } else {
            let names: Vec<String> = wrong
                .iter()
                .map(|(name, length)| format!("`{name}` has {length}"))
                .collect();
            format!("one entry per link is needed: {}", names.join(", "))
        };
        findings.report(
            Finding::at(module.file("module.json"), format!("/{first}"), message)
                .expected(format!("{links} entries (links of urdf_module)"))
                .actual(format!("{length} entries")),
        );
    }
}
