use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::ModuleKind;

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
    phase References, needs [
        Module(Kind::Urdf),
        AnyModule(&[
            Kind::OriginalMeshes,
            Kind::PlainMeshes,
            Kind::ConvexHullMeshes,
            Kind::ConvexDecompositionMeshes,
        ]),
        LINKS_NAMED,
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some(robot) = context.robot() else {
        return;
    };
    let links = robot.links.len();
    for kind in [
        ModuleKind::OriginalMeshes,
        ModuleKind::PlainMeshes,
        ModuleKind::ConvexHullMeshes,
        ModuleKind::ConvexDecompositionMeshes,
    ] {
        let (Some(meshes), Some(module)) = (context.meshes(kind), context.module(kind)) else {
            continue;
        };
        let lists = meshes.lists.iter().map(|list| (list.key, list.links.len()));
        let wrong: Vec<(&str, usize)> = lists.filter(|(_, length)| *length != links).collect();
        let Some((first, length)) = wrong.first() else {
            continue;
        };
        // A stale module is one mistake, though it shows in the lists of all formats.
        let names: Vec<String> = wrong
            .iter()
            .map(|(name, length)| format!("`{name}` has {length}"))
            .collect();
        findings.report(
            Finding::at(
                module.file("module.json"),
                format!("/{first}"),
                format!(
                    "one entry per link is needed, and urdf_module has {links} links: {}; write the module again",
                    names.join(", ")
                ),
            )
            .expected(format!("{links} entries (links of urdf_module)"))
            .actual(format!("{length} entries")),
        );
    }
}
