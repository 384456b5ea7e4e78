use crate::rules::prelude::*;
use crate::solids::polytope::{Polytope, step};
use urdd_geometry::surface::extent;

declare_rule! {
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
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
    let bounds = mesh.bounds()?;
    let diagonal = (Vector3::from(bounds.max) - Vector3::from(bounds.min)).norm();
    let most = diagonal * COVER_WITHOUT_PROMISE;
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
