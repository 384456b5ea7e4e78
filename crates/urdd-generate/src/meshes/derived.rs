//! The stages that build the meshes of links: plain meshes, hulls and pieces. `taken` are the meshes that a donor has.

use rayon::prelude::*;

use super::original::OriginalMeshes;
use super::plain::link_geometries;
use super::{Meshes, Pieces, Shading, WrittenMesh, files_of, for_each_content};
use crate::context::Context;
use crate::donor::links::LinkMesh;
use crate::error::Result;
use crate::made::{Made, MadeFile, made_with};
use crate::settings::Settings;
use urdd_format::convex_decomposition_meshes::{
    ConvexDecompositionMeshesModule, DecompositionMethod,
};
use urdd_format::convex_hull_meshes::ConvexHullMeshesModule;
use urdd_format::meshes::{GeometryKind, MeshFiles};
use urdd_format::plain_meshes::{PlainMesh, PlainMeshesModule};
use urdd_format::registry::ModuleKind;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::{Mesh, decompose};

/// The solids of each link for which a donor has some.
type Taken = Vec<Option<Vec<LinkMesh>>>;

pub(crate) fn plain(
    context: &Context,
    original: Option<&OriginalMeshes>,
    taken: &[Option<(GeometryKind, LinkMesh)>],
) -> Result<Made<Meshes>> {
    let preferred = context.settings.preferred_geometry;
    let robot = &context.source.reading.robot;
    let have = |link: usize| taken.get(link).is_some_and(Option::is_some);
    let geometries = match original {
        Some(original) => {
            let (module, scenes) = (&original.module, &original.scenes);
            link_geometries(robot, module, scenes, preferred, &have)
                .map_err(|fault| context.source.refused(fault))?
        }
        None => Vec::new(),
    };
    let written: Vec<_> = geometries
        .into_par_iter()
        .enumerate()
        .map(|(link, geometry)| {
            let files = context.mesh_files(ModuleKind::PlainMeshes, link, None);
            if let Some((geometry, taken)) = taken.get(link).and_then(Option::as_ref) {
                let contents = taken.files(&files, Shading::Smooth)?;
                let plain = PlainMesh { geometry: *geometry, files };
                return Ok((Some(plain), contents, Some(taken.mesh.clone())));
            }
            let Some(geometry) = geometry else { return Ok((None, Vec::new(), None)) };
            let contents = files_of(&geometry.parts, &files, Shading::Smooth)?;
            let mesh = WrittenMesh::of(&geometry.parts);
            let geometry = geometry.geometry;
            Ok((Some(PlainMesh { geometry, files }), contents, Some(mesh)))
        })
        .collect::<Result<_>>()?;
    let (link_meshes, files, meshes): (_, Vec<_>, _) = written.into_iter().collect();
    let module = PlainMeshesModule { preferred_geometry: preferred, link_meshes };
    made_with(&module, files.into_iter().flatten().collect(), meshes)
}

pub(crate) fn hulls(
    context: &Context,
    plain: &[Option<WrittenMesh>],
    taken: Taken,
) -> Result<Made<Meshes>> {
    // A plain mesh has a triangle with positive area. It therefore has a convex hull.
    let (links, meshes) = not_taken(plain, &taken);
    let hull = |at: usize, mesh: &Mesh| {
        let hull = ConvexHull::new(&mesh.vertices).ok();
        context.finished(ModuleKind::ConvexHullMeshes, links[at]);
        hull.map(ConvexHull::into_mesh)
    };
    let built = for_each_content(&meshes, &context.settings.source.cancellation, hull)?;
    let built = built.into_iter().map(Option::into_iter);
    let links = solids(plain, taken, built.map(Iterator::collect));
    let (names, files) = write(context, ModuleKind::ConvexHullMeshes, &links)?;
    let link_hulls = names.into_iter().map(|hull| hull.into_iter().next());
    let module = ConvexHullMeshesModule { link_hulls: link_hulls.collect() };
    let hulls = links.into_iter().map(|hull| hull.into_iter().next());
    let hulls = hulls.map(|hull| hull.map(|hull| hull.mesh));
    made_with(&module, files, hulls.collect())
}

/// Name of the decomposition method; changed whenever its results change.
pub(crate) const DECOMPOSITION: &str = "urdd cut and merge 2";

pub(crate) fn decomposition(settings: &Settings) -> decompose::Settings {
    decompose::Settings {
        max_pieces: usize::from(settings.pieces.most),
        standoff_tolerance: settings.pieces.tolerance.unwrap_or(0.0),
        ..decompose::Settings::default()
    }
}

pub(crate) fn pieces(
    context: &Context,
    plain: &[Option<WrittenMesh>],
    taken: Taken,
) -> Result<Made<Pieces>> {
    let settings = decomposition(context.settings);
    let (links, meshes) = not_taken(plain, &taken);
    let decompose = |at: usize, mesh: &Mesh| {
        let pieces = decompose::decompose(mesh, &settings);
        context.finished(ModuleKind::ConvexDecompositionMeshes, links[at]);
        pieces
    };
    let built = for_each_content(&meshes, &context.settings.source.cancellation, decompose)?;
    let of_taken = plain.iter().zip(&taken).filter(|(_, taken)| taken.is_some());
    let of_taken = of_taken.filter_map(|(plain, _)| plain.as_ref());
    let of_taken = of_taken.map(|plain| settings.surface_tolerance_of(&plain.mesh));
    let tolerances = built.iter().map(|built| built.surface_tolerance);
    let tolerance = tolerances.chain(of_taken).fold(0.0, f64::max);
    let links = solids(plain, taken, built.into_iter().map(|built| built.pieces));
    let (link_pieces, files) = write(context, ModuleKind::ConvexDecompositionMeshes, &links)?;
    let module = ConvexDecompositionMeshesModule {
        method: DecompositionMethod {
            name: DECOMPOSITION.to_owned(),
            surface_tolerance: Some(tolerance),
        },
        link_pieces,
    };
    let pieces = links.into_iter();
    let pieces = pieces.map(|pieces| pieces.into_iter().map(|piece| piece.mesh).collect());
    made_with(&module, files, pieces.collect())
}

/// The plain meshes for which nothing is taken, in order, and their links.
fn not_taken<'a>(
    plain: &'a [Option<WrittenMesh>],
    taken: &[Option<Vec<LinkMesh>>],
) -> (Vec<usize>, Vec<&'a Mesh>) {
    let to_do = plain.iter().zip(taken).enumerate().filter(|(_, (_, taken))| taken.is_none());
    to_do.filter_map(|(link, (plain, _))| Some((link, &plain.as_ref()?.mesh))).unzip()
}

/// The solids of each link: those that are taken, or the next of those that were built, in the colour of the link.
fn solids(
    plain: &[Option<WrittenMesh>],
    taken: Taken,
    mut built: impl Iterator<Item = Vec<Mesh>>,
) -> Vec<Vec<LinkMesh>> {
    let links = plain.iter().zip(taken).map(|(plain, taken)| {
        let Some(plain) = plain else { return Vec::new() };
        if let Some(taken) = taken {
            return taken;
        }
        let color = plain.color;
        let solid = |mesh| LinkMesh { mesh: WrittenMesh { mesh, color }, files: None };
        built.next().unwrap_or_default().into_iter().map(solid).collect()
    });
    links.collect()
}

fn write(
    context: &Context,
    kind: ModuleKind,
    links: &[Vec<LinkMesh>],
) -> Result<(Vec<Vec<MeshFiles>>, Vec<MadeFile>)> {
    let are_pieces = kind == ModuleKind::ConvexDecompositionMeshes;
    let written: Vec<Vec<(MeshFiles, Vec<MadeFile>)>> = links
        .par_iter()
        .enumerate()
        .map(|(link, solids)| {
            let solids = solids.iter().enumerate().map(|(idx, solid)| {
                let files = context.mesh_files(kind, link, are_pieces.then_some(idx));
                let contents = solid.files(&files, Shading::Flat)?;
                Ok((files, contents))
            });
            solids.collect()
        })
        .collect::<Result<_>>()?;
    let links = written.into_iter().map(|link| link.into_iter().unzip());
    let (names, contents): (_, Vec<Vec<Vec<MadeFile>>>) = links.unzip();
    Ok((names, contents.into_iter().flatten().flatten().collect()))
}
