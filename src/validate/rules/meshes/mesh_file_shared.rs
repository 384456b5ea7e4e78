use std::collections::{BTreeSet, HashMap};

use crate::format::legacy::urdf as legacy;
use crate::format::registry::{ModuleDocument, ModuleKind, Profile};
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::rule::declare_rule;
use crate::validate::views::meshes::DERIVED;

declare_rule! {
    /// Two entries of a mesh module name the same file, which can be right for one of them only.
    ///
    /// A derived mesh is in its link's own frame: the origin and scale of the link's geometry are
    /// applied. When two links are given one file, the mesh of the second overwrote that of the first,
    /// and hulls, pieces, boxes and distances of the first were then made from the wrong shape.
    ///
    /// Name derived files by link (SPEC 7.3), and write the mesh and link shape modules again. In
    /// legacy modules, links that place the very same mesh at the very same origin and scale may
    /// share a file: then it is right for both.
    MSH005 "mesh-file-shared", Error, clause "7.3", since "0.1.0",
    phase References, needs [
        Module(Kind::Urdf),
        AnyModule(&[Kind::PlainMeshes, Kind::ConvexHullMeshes, Kind::ConvexDecompositionMeshes]),
        NotFailed(URD001),
        NotFailed(MSH001),
        NotFailed(MSH003),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    for kind in DERIVED {
        let (Some(meshes), Some(module)) = (context.meshes(*kind), context.module(*kind)) else {
            continue;
        };
        let mut first_use: HashMap<&str, (usize, &str)> = HashMap::new();
        // One finding per pair of links, however many formats and pieces they share.
        let mut told: BTreeSet<(usize, usize)> = BTreeSet::new();
        for (link, mesh) in meshes.paths() {
            let Some((first, first_pointer)) = first_use.get(mesh.path).copied() else {
                first_use.insert(mesh.path, (link, &mesh.pointer));
                continue;
            };
            let shared_rightly = meshes.profile == Profile::Legacy
                && first != link
                && same_piece(*kind, first_pointer, &mesh.pointer)
                && placed_alike(context, first, link);
            if shared_rightly || !told.insert((first, link)) {
                continue;
            }
            let message = if first == link {
                format!("{} names one file twice", context.link_label(link))
            } else {
                format!(
                    "{} and {} name the same file, and it can be right for one of them only: write each link's own",
                    context.link_label(first),
                    context.link_label(link)
                )
            };
            findings.report(
                Finding::at(module.file("module.json"), &mesh.pointer, message)
                    .expected("a file of its own")
                    .actual(format!("`{}` (also {first_pointer})", mesh.path)),
            );
        }
    }
}

/// Whether two places stand for the same piece of two links.
fn same_piece(kind: ModuleKind, a: &str, b: &str) -> bool {
    kind != ModuleKind::ConvexDecompositionMeshes || a.rsplit('/').next() == b.rsplit('/').next()
}

/// Whether two links of a legacy URDD place the same meshes in the same way.
fn placed_alike(context: &Context, a: usize, b: usize) -> bool {
    let Some(ModuleDocument::LegacyUrdf(urdf)) = context.document(ModuleKind::Urdf) else {
        return false;
    };
    let (Some(a), Some(b)) = (urdf.links.get(a), urdf.links.get(b)) else {
        return false;
    };
    let (a, b) = (placements(a), placements(b));
    !a.is_empty() && a == b
}

/// The meshes that a link shows: origin, file, scale.
fn placements(link: &legacy::Link) -> Vec<(&legacy::Origin, &str, [f64; 3])> {
    let meshes = link
        .visual
        .iter()
        .filter_map(|visual| match &visual.geometry {
            legacy::Geometry::Mesh(mesh) => Some((
                &visual.origin,
                mesh.filename.as_str(),
                mesh.scale.unwrap_or([1.0; 3]),
            )),
            _ => None,
        });
    meshes.collect()
}
