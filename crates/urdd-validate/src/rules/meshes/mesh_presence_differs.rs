use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::meshes::DERIVED;
use urdd_document::meshes::Meshes;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// A link has a mesh in one mesh module and none in another.
    ///
    /// Hulls and convex pieces are made from the plain mesh: a link has all three or none. Where one is
    /// missing, a program that checks collisions passes over a link that another program sees.
    ///
    /// Write the mesh modules again, all from the same plain meshes.
    MSH007 "mesh-presence-differs", Error, clause "7.2", since "0.1.0",
    phase References, needs [
        AnyModule(&[Kind::PlainMeshes, Kind::ConvexHullMeshes, Kind::ConvexDecompositionMeshes]),
        NotFailed(MSH001),
        NotFailed(MSH003),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let modules: Vec<(ModuleKind, Meshes)> = DERIVED
        .iter()
        .filter_map(|kind| Some((*kind, context.meshes(*kind)?)))
        .collect();
    let links = modules.iter().map(|(_, meshes)| meshes.num_links()).max();
    for link in 0..links.unwrap_or(0) {
        let with = modules
            .iter()
            .filter(|(_, meshes)| meshes.count(link) > 0)
            .count();
        if with == 0 || with == modules.len() {
            continue;
        }
        // Told at the one module that is not as the others; of two, at the one that has none.
        let odd_has = with * 2 < modules.len();
        let odd = modules
            .iter()
            .find(|(_, meshes)| (meshes.count(link) > 0) == odd_has);
        let Some((kind, meshes)) = odd else {
            continue;
        };
        let Some(module) = context.module(*kind) else {
            continue;
        };
        let others: Vec<&str> = modules
            .iter()
            .filter(|(_, meshes)| (meshes.count(link) > 0) != odd_has)
            .map(|(kind, _)| kind.name())
            .collect();
        let label = context.link_label(link);
        let others = others.join(" and ");
        let message = match odd_has {
            true => format!("{label} has a mesh here, but none in {others}"),
            false => format!("{label} has no mesh here, but one in {others}"),
        };
        findings.report(
            Finding::at(module.file("module.json"), meshes.pointer(link), message)
                .expected(if odd_has { "no mesh" } else { "a mesh" })
                .actual(if odd_has { "a mesh" } else { "none" }),
        );
    }
}
