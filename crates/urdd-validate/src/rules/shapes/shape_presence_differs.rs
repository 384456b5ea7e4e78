use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::shapes::{LIST_MODULES, entry_counts};
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// A link with a hull has no box, sphere or distance here, or one without a hull has one.
    ///
    /// Boxes, spheres and distances are those of the link's convex hull: a link has all of them or
    /// none. Where one is missing, a collision check that uses it passes over the link.
    ///
    /// Write the link shape modules again from the hulls that are there.
    SHP002 "shape-presence-differs", Error, clause "8.2", since "0.1.0",
    phase References, needs [
        Module(Kind::ConvexHullMeshes),
        AnyModule(&[Kind::LinkShapesApproximations, Kind::LinkShapesMaxDistanceFromOrigin]),
        MESHES_LISTED,
        NotFailed(SHP001),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some(hulls) = context.meshes(ModuleKind::ConvexHullMeshes) else {
        return;
    };
    for kind in LIST_MODULES {
        let (Some(document), Some(module)) = (context.document(*kind), context.module(*kind))
        else {
            continue;
        };
        let mut lists = entry_counts(document);
        lists.retain(|list| list.kind.is_of_links());
        for link in 0..hulls.num_links() {
            let hull = hulls.count(link) > 0;
            let wrong: Vec<_> = lists
                .iter()
                .filter(|list| {
                    list.links
                        .get(link)
                        .is_some_and(|entry| entry.is_empty() == hull)
                })
                .collect();
            // A link is one mistake, though it shows in every list of the module.
            let Some(first) = wrong.first() else {
                continue;
            };
            let also = match wrong.len() - 1 {
                0 => String::new(),
                n => format!(", nor as it should be in {n} more lists of this module"),
            };
            let label = context.link_label(link);
            let message = match hull {
                true => format!(
                    "{label} has a hull in convex_hull_meshes_module, but no entry here{also}"
                ),
                false => format!(
                    "{label} has no hull in convex_hull_meshes_module, but an entry here{also}"
                ),
            };
            findings.report(
                Finding::at(module.file("module.json"), first.pointer(link, 0), message)
                    .expected(if hull { "an entry" } else { "null" })
                    .actual(if hull { "null" } else { "an entry" }),
            );
        }
    }
}
