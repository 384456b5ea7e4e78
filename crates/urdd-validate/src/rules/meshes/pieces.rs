use std::sync::OnceLock;

use crate::rules::prelude::*;
use crate::solids::derived::Derived;
use crate::solids::polytope::{Polytope, diagonal, step};
use urdd_geometry::surface::{distinct, extent};

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

    /// The convex pieces of a link leave out a part of its surface.
    ///
    /// Together the pieces cover the link: no point of the plain mesh is farther outside of all of them
    /// than `surface_tolerance` promises, or, without a promise, than 5 % of the diagonal of the box
    /// around the link. Here a part of it sticks out, which a program that checks collisions with the
    /// pieces does not see. Often a piece was lost, or belongs to another link.
    ///
    /// Decompose the link's plain mesh again, or promise less.
    MSH022 "pieces-leave-surface", Error, clause "7.10", since "0.1.0",
    phase Geometry, consequence Collisions, needs [
        Module(Kind::PlainMeshes), Module(Kind::ConvexDecompositionMeshes), NoneFailed(&[MSH003, MSH004, MSH007]), CONVEX_PIECE,
    ], check pieces_leave_surface,
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
            .map(|fraction| (SPLINTER * out.tolerance).max(fraction * hull.diagonal));
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
        Some(Hull { mesh, diagonal: diagonal(&mesh.bounds()?), polytope: OnceLock::new() })
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

fn pieces_leave_surface(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::ConvexDecompositionMeshes;
    let meshes = context.meshes(kind)?;
    let promised = match context.document(kind) {
        Some(ModuleDocument::ConvexDecompositionMeshes(module)) => module.method.surface_tolerance,
        _ => None,
    };
    // Computed before the threads start, so that the computation itself can use all of them.
    context.placed();
    let pieces_of = |link: usize| -> Vec<Part> {
        let pieces = 0..meshes.count(link);
        pieces.map(|piece| Part::Piece { link, piece }).collect()
    };
    let mut links: Vec<usize> = (0..meshes.num_links()).collect();
    links.retain(|link| {
        let pieces = pieces_of(*link);
        let mut by = pieces.clone();
        by.push(Part::Plain(*link));
        let judged = pieces.iter().filter(|piece| judged(context, findings, **piece, &by));
        judged.count() == pieces.len()
    });
    let bare: Vec<Option<Farthest>> = links
        .par_iter()
        .map(|link| {
            let compute = || bare(context, *link, meshes.count(*link), promised);
            let solids = context.solids();
            let pieces = (0..meshes.count(*link)).map(|piece| solids.content(kind, *link, piece));
            let contents = std::iter::once(solids.content(Kind::PlainMeshes, *link, 0));
            let contents: Option<Vec<usize>> = contents.chain(pieces).collect();
            context.memos.farthest.get((Code::MSH022, contents?), compute)
        })
        .collect();
    for (link, bare) in links.into_iter().zip(bare) {
        let Some(bare) = bare else { continue };
        let distance = metres(bare.distance);
        let message = format!(
            "the pieces of {} leave out its surface at {}, {distance} outside of all of them",
            context.link_label(link),
            point(bare.place)
        );
        let mut finding = finding_in(kind, meshes.pointer(link), message)
            .expected("the whole surface of the plain mesh inside the pieces")
            .actual(format!("{distance} outside"))
            .tolerance(bare.tolerance)
            .off_by(bare.distance, "m");
        finding.parts = pieces_of(link);
        findings.report(finding);
    }
    Some(())
}

/// Where a link's surface is farthest outside its pieces, if that exceeds the tolerance.
fn bare(context: &Context, link: usize, pieces: usize, promised: Option<f64>) -> Option<Farthest> {
    let solids = context.solids();
    let mesh = solids.sound(Kind::PlainMeshes, link, 0)?;
    let kind = Kind::ConvexDecompositionMeshes;
    let pieces: Option<Vec<Polytope>> =
        (0..pieces).map(|piece| Polytope::new(solids.sound(kind, link, piece)?)).collect();
    let pieces = pieces.filter(|pieces| !pieces.is_empty())?;
    let most = diagonal(&mesh.bounds()?) * COVER_WITHOUT_PROMISE;
    let tolerance =
        promised.map_or(most, |promised| promised.clamp(0.0, most)) + mesh_resolution(extent(mesh));
    let faces: usize = pieces.iter().map(Polytope::num_faces).sum();
    let points = mesh.vertices.len() + mesh.triangles.len();
    let points = points_of(mesh).step_by(step(points, faces));
    let bare = points.filter(|point| !pieces.iter().any(|piece| piece.holds(*point, tolerance)));
    let off = bare.map(|point| {
        let outside = pieces.iter().map(|piece| piece.outside(point));
        (point, outside.fold(f64::INFINITY, f64::min))
    });
    Farthest::of(off, tolerance).filter(Farthest::is_off)
}

/// Points of a surface: corners and centroids of triangles.
fn points_of(mesh: &Mesh) -> impl Iterator<Item = [f64; 3]> {
    let mut used = vec![false; mesh.vertices.len()];
    for corner in mesh.triangles.iter().flatten() {
        used[*corner as usize] = true;
    }
    let vertices = mesh.vertices.iter().zip(used);
    let corners = vertices.filter_map(|(vertex, used)| used.then_some(*vertex));
    let middles = mesh.triangles.iter().map(|triangle| {
        let [a, b, c] = mesh.corners(*triangle);
        std::array::from_fn(|i| (a[i] + b[i] + c[i]) / 3.0)
    });
    corners.chain(middles)
}
