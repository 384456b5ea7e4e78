use std::collections::HashSet;

use rayon::prelude::*;

use crate::context::Context;
use crate::finding::{Finding, Findings, point};
use crate::part::Part;
use crate::rule::declare_rule;
use crate::solids::derived::Derived;
use crate::solids::polytope::{bits, distinct};
use crate::solids::surface::{extent, nearest};
use crate::tolerance::mesh_resolution;
use crate::views::judged::judged;
use urdd_format::readable::metres;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// A vertex of a convex hull is not a vertex of its link's mesh.
    ///
    /// The hull of a mesh has some of the mesh's vertices and no others. Here one is somewhere
    /// else: the hull is larger than its link (then programs report false collisions), or it was
    /// computed from another mesh, in other coordinates, or from rounded ones.
    ///
    /// Compute the hull from the vertices of the plain mesh as its files have them.
    MSH019 "hull-vertex-off-mesh", Error, clause "7.9", since "0.1.0",
    phase Geometry, consequence Collisions, needs [
        Module(Kind::PlainMeshes), Module(Kind::ConvexHullMeshes), NotFailed(MSH003), NotFailed(MSH007),
        HULL_ABOUT_MESH,
    ],
    check check,
}

/// So many vertices of a hull that are not exactly the mesh's are looked for near by.
const MOST_LOOKED_FOR: usize = 2_000;

fn check(context: &Context, findings: &mut Findings) {
    let Some(module) = context.module(ModuleKind::ConvexHullMeshes) else {
        return;
    };
    // Before threads ask for it: who works it out shares the work with them.
    context.misplaced();
    let hulls = context
        .solids()
        .derived(ModuleKind::ConvexHullMeshes)
        .iter();
    let hulls: Vec<&Derived> = hulls
        .filter(|hull| {
            let by = [Part::Plain(hull.link)];
            judged(context, findings, Part::Hull(hull.link), &by)
        })
        .collect();
    let off: Vec<_> = hulls
        .par_iter()
        .map(|hull| farthest_off(context, hull.link))
        .collect();
    for (hull, off) in hulls.iter().zip(off) {
        let Some((place, distance, tolerance)) = off else {
            continue;
        };
        findings.report(
            Finding::at(
                module.file("module.json"),
                hull.pointer(),
                format!(
                    "the hull of {} has a vertex at {} that is not a vertex of its mesh: the nearest one is {} away",
                    context.link_label(hull.link),
                    point(place),
                    metres(distance)
                ),
            )
            .expected("vertices of the plain mesh only")
            .actual(format!("a vertex {} off", metres(distance)))
            .tolerance(tolerance)
            .off_by(distance, "m")
            .part(Part::Hull(hull.link)),
        );
    }
}

/// The vertex of a link's hull that is farthest from the vertices of its mesh, how far, and the
/// tolerance.
fn farthest_off(context: &Context, link: usize) -> Option<([f64; 3], f64, f64)> {
    let solids = context.solids();
    let mesh = solids.sound(ModuleKind::PlainMeshes, link, 0)?;
    let hull = solids.sound(ModuleKind::ConvexHullMeshes, link, 0)?;
    let known: HashSet<[u64; 3]> = mesh.vertices.iter().copied().map(bits).collect();
    let unknown = distinct(hull)
        .into_iter()
        .filter(|vertex| !known.contains(&bits(*vertex)));
    let worst = unknown
        .take(MOST_LOOKED_FOR)
        .map(|vertex| (vertex, nearest(mesh, vertex)))
        .reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    let tolerance = mesh_resolution(extent(mesh));
    (worst.1 > tolerance).then_some((worst.0, worst.1, tolerance))
}
