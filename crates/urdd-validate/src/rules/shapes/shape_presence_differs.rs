use crate::rules::prelude::*;
use urdd_document::shapes::{LIST_MODULES, entry_counts};

declare_rule! {
    /// A link with a hull has no box, sphere or distance here, or one without a hull has one.
    ///
    /// Boxes, spheres and distances are those of the link's convex hull: a link has all of them or
    /// none. Where one is missing, a collision check that uses it passes over the link.
    ///
    /// Write the link shape modules again from the hulls that are there.
    SHP002 "shape-presence-differs", Error, clause "8.2", since "0.1.0",
    phase References, needs [Module(Kind::ConvexHullMeshes), SHAPE_LISTS, MESHES_LISTED, NotFailed(SHP001)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let hulls = context.meshes(Kind::ConvexHullMeshes)?;
    for (_, module, document) in context.documents(LIST_MODULES) {
        let mut lists = entry_counts(document);
        lists.retain(|list| list.kind.is_of_links());
        for link in 0..hulls.num_links() {
            let hull = hulls.count(link) > 0;
            let mut wrong = lists.iter().filter(|list| {
                let entry = list.links.get(link);
                entry.is_some_and(|entry| entry.is_empty() == hull)
            });
            // A link is one mistake, though it shows in every list of the module.
            let Some(first) = wrong.next() else {
                continue;
            };
            let also = match wrong.count() {
                0 => String::new(),
                n => format!(", nor as it should be in {n} more lists of this module"),
            };
            let (has, but, expected, actual) = match hull {
                true => ("a hull", "no entry", "an entry", "null"),
                false => ("no hull", "an entry", "null", "an entry"),
            };
            let label = context.link_label(link);
            let message =
                format!("{label} has {has} in convex_hull_meshes_module, but {but} here{also}");
            let finding = finding_in(module, first.pointer(link, 0), message);
            findings.report(finding.values(expected, actual));
        }
    }
    Some(())
}
