use std::collections::HashSet;

use rayon::prelude::*;

use crate::context::Context;
use crate::finding::{Finding, Findings, point};
use crate::part::Part;
use crate::rule::declare_rule;
use crate::solids::derived::Derived;
use crate::solids::polytope::{Polytope, bits, distinct, step};
use crate::views::judged::judged;
use urdd_format::readable::metres;
use urdd_format::registry::ModuleKind;
use urdd_geometry::hull::ConvexHull;

declare_rule! {
    /// A convex hull leaves out a part of its link.
    ///
    /// A hull holds the whole plain mesh. Here a vertex of the mesh is outside: a program that checks
    /// collisions with the hull does not see that part of the robot. Often the hull is of another link,
    /// or of an earlier mesh, or was simplified.
    ///
    /// Compute the hull of the link's plain mesh again.
    MSH018 "hull-leaves-out-mesh", Error, clause "7.9", since "0.1.0",
    phase Geometry, consequence Collisions, needs [
        Module(Kind::PlainMeshes), Module(Kind::ConvexHullMeshes), NotFailed(MSH003), NotFailed(MSH007),
        CONVEX_HULL,
    ],
    check check,
}

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
    let left_out: Vec<_> = hulls
        .par_iter()
        .map(|hull| farthest_outside(context, hull.link))
        .collect();
    for (hull, left_out) in hulls.iter().zip(left_out) {
        let Some((place, distance, tolerance)) = left_out else {
            continue;
        };
        findings.report(
            Finding::at(
                module.file("module.json"),
                hull.pointer(),
                format!(
                    "the hull of {} leaves out its mesh: the vertex at {} is {} outside",
                    context.link_label(hull.link),
                    point(place),
                    metres(distance)
                ),
            )
            .expected("every vertex of the plain mesh inside")
            .actual(format!("{} outside", metres(distance)))
            .tolerance(tolerance)
            .off_by(distance, "m")
            .part(Part::Hull(hull.link)),
        );
    }
}

/// The vertex of a link's mesh that is farthest outside of its hull, how far, and the tolerance.
fn farthest_outside(context: &Context, link: usize) -> Option<([f64; 3], f64, f64)> {
    let solids = context.solids();
    let mesh = solids.sound(ModuleKind::PlainMeshes, link, 0)?;
    let hull = solids.sound(ModuleKind::ConvexHullMeshes, link, 0)?;
    let polytope = Polytope::new(hull)?;
    let known: HashSet<[u64; 3]> = hull.vertices.iter().copied().map(bits).collect();
    // Of the mesh the corners of its own hull are enough, and of these most are vertices of the hull.
    let corners = match ConvexHull::new(&distinct(mesh)) {
        Ok(own) => own.into_mesh().vertices,
        Err(_) => mesh.vertices.clone(),
    };
    let unknown: Vec<[f64; 3]> = corners
        .into_iter()
        .filter(|corner| !known.contains(&bits(*corner)))
        .collect();
    let every = step(unknown.len(), polytope.num_faces());
    let worst = unknown
        .into_iter()
        .step_by(every)
        .map(|corner| (corner, polytope.outside(corner)))
        .reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    (worst.1 > polytope.resolution).then_some((worst.0, worst.1, polytope.resolution))
}
