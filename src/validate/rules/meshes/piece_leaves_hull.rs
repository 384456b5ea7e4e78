use rayon::prelude::*;

use crate::format::registry::ModuleKind;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings, metres, point};
use crate::validate::part::Part;
use crate::validate::rule::declare_rule;
use crate::validate::solids::derived::Derived;
use crate::validate::solids::polytope::{Polytope, distinct};
use crate::validate::views::judged::judged;

declare_rule! {
    /// A convex piece reaches out of the hull of its link.
    ///
    /// Pieces stand for parts of the link, so that all of them are inside its hull. A piece that is not
    /// is of another link, in another place, or larger than what it stands for: then programs see
    /// collisions that are none.
    ///
    /// Decompose the link's plain mesh, and cut the pieces to its hull.
    MSH021 "piece-leaves-hull", Error, clause "7.10", since "0.1.0",
    phase Geometry, consequence Collisions, needs [
        Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes),
        NotFailed(MSH003), NotFailed(MSH007), SOUND_HULL,
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::ConvexDecompositionMeshes;
    let Some(module) = context.module(kind) else {
        return;
    };
    let part = |piece: &Derived| Part::Piece {
        link: piece.link,
        piece: piece.piece,
    };
    let pieces: Vec<&Derived> = context
        .solids()
        .derived(kind)
        .iter()
        .filter(|piece| judged(context, findings, part(piece), &[Part::Hull(piece.link)]))
        .collect();
    let outside: Vec<_> = pieces
        .par_iter()
        .map(|piece| farthest_outside(context, piece))
        .collect();
    for (piece, outside) in pieces.iter().zip(outside) {
        let Some((place, distance, tolerance)) = outside else {
            continue;
        };
        findings.report(
            Finding::at(
                module.file("module.json"),
                piece.pointer(),
                format!(
                    "piece {} of {} reaches out of its hull: the vertex at {} is {} outside",
                    piece.piece,
                    context.link_label(piece.link),
                    point(place),
                    metres(distance)
                ),
            )
            .expected("every vertex inside the hull")
            .actual(format!("{} outside", metres(distance)))
            .tolerance(tolerance)
            .off_by(distance, "m")
            .part(part(piece)),
        );
    }
}

/// The vertex of a piece that is farthest outside of its link's hull, how far, and the tolerance.
fn farthest_outside(context: &Context, piece: &Derived) -> Option<([f64; 3], f64, f64)> {
    let hull = context
        .solids()
        .sound(ModuleKind::ConvexHullMeshes, piece.link, 0)?;
    let polytope = Polytope::new(hull)?;
    let worst = distinct(piece.sound()?)
        .into_iter()
        .map(|vertex| (vertex, polytope.outside(vertex)))
        .reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    (worst.1 > polytope.resolution).then_some((worst.0, worst.1, polytope.resolution))
}
