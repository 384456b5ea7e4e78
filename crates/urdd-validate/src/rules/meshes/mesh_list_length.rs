use super::MODULES;
use crate::rules::prelude::*;

declare_rule! {
    /// A list of a mesh module does not hold one entry per link.
    ///
    /// The place in the list is the link index: where an entry is missing or too many, every later
    /// link gets another link's mesh. Most often the module is stale: it was written before a link
    /// was added or removed.
    ///
    /// Write the mesh modules again from the same URDF as `urdf_module`, with null (or an empty list)
    /// for links without a mesh.
    MSH001 "mesh-list-length", Error, clause "7.1", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), MESHES, LINKS_NAMED],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let links = context.robot()?.links.len();
    for (_, module, meshes) in context.mesh_modules(MODULES) {
        let lists = meshes.lists.iter().map(|list| (list.key, list.links.len()));
        if let Some(wrong) = wrong_lengths(&lists.collect::<Vec<_>>(), links) {
            let message = format!(
                "one entry per link is needed, and urdf_module has {links} links: {}; write the module again",
                wrong.in_words
            );
            finding_in(module, wrong.pointer, message)
                .expected(format!("{links} entries (links of urdf_module)"))
                .actual(format!("{} entries", wrong.length))
                .report(findings);
        }
    }
    Some(())
}
