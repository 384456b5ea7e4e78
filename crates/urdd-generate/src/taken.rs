//! Per link, the meshes and shapes that are reused from other URDDs.

use rayon::prelude::*;

use super::meshes::written::WrittenMesh;
use super::reuse::{Shape, Taken, TakenFiles, link_keys};
use super::shapes::ConvexMeshes;
use super::work::Work;
use urdd_format::meshes::{GeometryKind, MeshFiles};
use urdd_format::registry::ModuleKind;
use urdd_geometry::Mesh;

/// The plain mesh of each link, if another URDD has it. Empty without other URDDs.
pub(super) fn taken_plain(work: &Work) -> Vec<Option<(GeometryKind, Taken)>> {
    let (Some(original), false) = (&work.original, work.reusable.is_empty()) else {
        return Vec::new();
    };
    let digest = |path: &str| work.digests.get(path).cloned();
    let keys = link_keys(&work.source.reading.robot, &original.module, &digest);
    let taken = keys.into_par_iter().enumerate().map(|(link, key)| {
        let wanted = work.mesh_files(ModuleKind::PlainMeshes, link, None);
        let (plain, taken) = work.reusable.plain(&key?, &wanted)?;
        Some((plain.geometry, taken))
    });
    taken.collect()
}

/// A hull or a piece, with its files if it is reused.
pub(super) struct Solid {
    pub mesh: WrittenMesh,
    pub files: Option<TakenFiles>,
}

/// For each link with a plain mesh, the results that another URDD has for the same mesh.
pub(super) fn taken_of(
    work: &Work,
    kind: ModuleKind,
    plain: &[Option<WrittenMesh>],
    find: impl Fn(&str, &MeshFiles) -> Option<Vec<Taken>> + Sync,
) -> Vec<Option<Vec<Solid>>> {
    let taken = plain.par_iter().enumerate().map(|(link, plain)| {
        plain.as_ref().filter(|_| !work.reusable.is_empty())?;
        let plain = work.mesh_files(ModuleKind::PlainMeshes, link, None).glb;
        let wanted = work.mesh_files(kind, link, None);
        let taken = find(work.digests.get(&plain)?, &wanted)?;
        let solid = |taken: Taken| Solid {
            mesh: taken.mesh,
            files: Some(taken.files),
        };
        Some(taken.into_iter().map(solid).collect())
    });
    taken.collect()
}

/// The plain meshes for which nothing is reused, in order.
pub(super) fn meshes_of<'a>(
    plain: &'a [Option<WrittenMesh>],
    taken: &[Option<Vec<Solid>>],
) -> Vec<&'a Mesh> {
    let to_do = plain.iter().zip(taken).filter(|(_, taken)| taken.is_none());
    let to_do = to_do.filter_map(|(plain, _)| plain.as_ref());
    to_do.map(|plain| &plain.mesh).collect()
}

/// The reusable boxes and spheres: of all hulls, then of all pieces.
pub(super) fn known_shapes(work: &Work, solids: &ConvexMeshes) -> Vec<Option<Shape>> {
    let hull = |(link, hull): (usize, &Option<WrittenMesh>)| {
        let has = hull.is_some();
        has.then(|| work.mesh_files(ModuleKind::ConvexHullMeshes, link, None))
    };
    let hulls = solids.hulls.iter().enumerate().filter_map(hull);
    let pieces = solids.pieces.iter().enumerate();
    let pieces = pieces.flat_map(|(link, pieces)| {
        let files =
            move |piece| work.mesh_files(ModuleKind::ConvexDecompositionMeshes, link, Some(piece));
        (0..pieces.len()).map(files)
    });
    let all = hulls.chain(pieces);
    all.map(|files| work.reusable.shape(work.digests.get(&files.glb)?))
        .collect()
}
