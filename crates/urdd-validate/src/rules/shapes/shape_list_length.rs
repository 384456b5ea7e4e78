use crate::rules::prelude::*;
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
    phase References, needs [Module(Kind::Urdf), SHAPE_LISTS, LINKS_NAMED],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let links = context.robot()?.links.len();
    for (_, module, document) in context.documents(LIST_MODULES) {
        let lists = entry_counts(document);
        let lists = lists.iter().map(|list| (list.key, list.links.len()));
        let Some(wrong) = wrong_lengths(&lists.collect::<Vec<_>>(), links) else {
            continue;
        };
        let length = wrong.length;
        let message = match wrong.are_all {
            true => format!(
                "the lists here have {length} entries, but urdf_module has {links} links: the module is stale; write it again from the same robot"
            ),
            false => format!("one entry per link is needed: {}", wrong.in_words),
        };
        finding_in(module, wrong.pointer, message)
            .values(format!("{links} entries (links of urdf_module)"), format!("{length} entries"))
            .report(findings);
    }
    Some(())
}
