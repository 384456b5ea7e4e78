use std::sync::OnceLock;

use crate::rules::prelude::*;
use crate::solids::derived::Derived;
use crate::solids::polytope::{Polytope, step};
use urdd_geometry::surface::distinct;

declare_rule! {
    /// A convex piece reaches far out of the hull of its link.
    ///
    /// Pieces stand for parts of the link, so all of them are inside its hull. This one reaches out by more
    /// than 2 % of the hull's diagonal: it is of another link, in another place, or larger than what it
    /// stands for. Programs then report collisions that do not happen.
    ///
    /// Decompose the link's plain mesh, and cut the pieces to its hull.
    MSH021 "piece-leaves-hull", Error, clause "7.10", since "0.1.0",
    phase Geometry, consequence Collisions, needs [
        Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes), NotFailed(MSH003),
        NotFailed(MSH007), SOUND_HULL,
    ],
    check |context, findings| report(context, How::Far, findings),

    /// A convex piece reaches a little out of the hull of its link.
    ///
    /// Pieces stand for parts of the link, so all of them are inside its hull. Programs that simplify pieces, or
    /// fit them to voxels (V-HACD, CoACD), make them reach out of it by up to some 1 % of its diagonal. Distances of
    /// pieces are then smaller than those of the link.
    ///
    /// Cut the pieces to the hull, or decompose the link's plain mesh more finely.
    MSH023 "piece-barely-leaves-hull", Warning, clause "7.10", since "0.2.0",
    phase Geometry, consequence Collisions, needs [
        Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes), NotFailed(MSH003),
        NotFailed(MSH007), SOUND_HULL,
    ],
    check |context, findings| report(context, How::Barely, findings),
}

/// Which pieces to report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum How {
    /// Those that reach out farther than allowed.
    Far,
    /// Those that reach out within the allowance.
    Barely,
}

/// Reports the pieces that reach out of the hulls of their links.
fn report(context: &Context, how: How, findings: &mut Findings) -> Option<()> {
    let kind = Kind::ConvexDecompositionMeshes;
    let module = context.module(kind)?;
    let part = |piece: &Derived| Part::Piece { link: piece.link, piece: piece.piece };
    let pieces: Vec<&Derived> = context
        .solids()
        .derived(kind)
        .iter()
        .filter(|piece| judged(context, findings, part(piece), &[Part::Hull(piece.link)]))
        .collect();
    let mut links: Vec<usize> = pieces.iter().map(|piece| piece.link).collect();
    links.dedup();
    let hull_of = |link: usize| Some((link, Hull::of(context, link)?));
    let hulls: HashMap<usize, Hull> = links.into_iter().filter_map(hull_of).collect();
    let outside: Vec<_> = pieces
        .par_iter()
        .map(|piece| farthest_outside(context, piece, hulls.get(&piece.link)?))
        .collect();
    for (piece, outside) in pieces.iter().zip(outside) {
        let (Some(out), Some(hull)) = (outside, hulls.get(&piece.link)) else { continue };
        let [least, most] = [PIECE_BARELY_OUT_OF_HULL, PIECE_OUT_OF_HULL]
            .map(|fraction| out.tolerance.max(fraction * hull.diagonal));
        let tolerance = match how {
            How::Far if out.distance > most => most,
            How::Barely if out.distance > least && out.distance <= most => least,
            _ => continue,
        };
        let distance = format!(
            "{} outside, {:.2} % of the hull's diagonal",
            metres(out.distance),
            100.0 * out.distance / hull.diagonal
        );
        let message = format!(
            "piece {} of {} extends beyond its hull: the vertex at {} is {distance}",
            piece.piece,
            context.link_label(piece.link),
            point(out.place),
        );
        finding_in(module, piece.pointer(), message)
            .values("every vertex inside the hull", distance)
            .tolerance(tolerance)
            .off_by(out.distance, "m")
            .part(part(piece))
            .report(findings);
    }
    Some(())
}

struct Hull<'a> {
    mesh: &'a Mesh,
    diagonal: f64,
    polytope: OnceLock<Option<Polytope>>,
}

impl<'a> Hull<'a> {
    fn of(context: &'a Context, link: usize) -> Option<Self> {
        let solids = context.solids();
        let mesh = solids.sound(Kind::ConvexHullMeshes, link, 0)?;
        let bounds = mesh.bounds()?;
        Some(Hull {
            mesh,
            diagonal: (Vector3::from(bounds.max) - Vector3::from(bounds.min)).norm(),
            polytope: OnceLock::new(),
        })
    }
}

/// The vertex of a piece that is farthest outside its link's hull, with the resolution of the hull.
fn farthest_outside(context: &Context, piece: &Derived, hull: &Hull) -> Option<Farthest> {
    let solids = context.solids();
    let (link, kind) = (piece.link, Kind::ConvexDecompositionMeshes);
    // MSH021 and MSH023 measure the same.
    let contents = [
        solids.content(Kind::ConvexHullMeshes, link, 0)?,
        solids.content(kind, link, piece.piece)?,
    ];
    let key = (Code::MSH021, contents.to_vec());
    context.memos.farthest.get(key, || {
        let polytope = hull.polytope.get_or_init(|| Polytope::new(hull.mesh)).as_ref()?;
        let vertices = distinct(piece.sound()?);
        let every = step(vertices.len(), polytope.num_faces());
        let vertices = vertices.into_iter().step_by(every);
        let outside = vertices.map(|vertex| (vertex, polytope.outside(vertex)));
        Farthest::of(outside, polytope.resolution)
    })
}
