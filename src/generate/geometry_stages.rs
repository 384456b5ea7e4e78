//! The stages that make meshes and link shapes.

use std::sync::Arc;

use rayon::prelude::*;

use super::distinct::for_each_content;
use super::edits::Edits;
use super::error::GenerateError;
use super::made::{Made, MadeFile, document, streamed};
use super::meshes::names::mesh_files;
use super::meshes::plain::link_geometries;
use super::meshes::written::{Shading, WrittenMesh, files_of};
use super::shape_documents;
use super::shapes::MOST_PIECES_WITH_MATRICES;
use super::shapes::approximations::approximations;
use super::shapes::max_distances::max_distances;
use super::shapes::simple_skips::simple_skips;
use super::shapes::statistics::{at_default_configuration, statistics};
use super::work::Work;
use crate::format::convex_decomposition_meshes::{
    ConvexDecompositionMeshesModule, DecompositionMethod,
};
use crate::format::convex_hull_meshes::ConvexHullMeshesModule;
use crate::format::link_shapes_skips::SkippedReason;
use crate::format::meshes::{GeometryKind, MeshFiles};
use crate::format::plain_meshes::{PlainMesh, PlainMeshesModule};
use crate::format::registry::ModuleKind;
use crate::geometry::Mesh;
use crate::geometry::decompose;
use crate::geometry::hull::{ConvexHull, HullError};
use crate::geometry::read::Part;
use crate::skips::skips_module;

pub(super) fn plain_settings(work: &Work) -> String {
    let geometry = match work.settings.preferred_geometry {
        GeometryKind::Visual => "visual",
        GeometryKind::Collision => "collision",
    };
    format!("{geometry}; smooth normals{}", formats_settings(work))
}

/// Part of the settings of each stage that writes meshes.
fn formats_settings(work: &Work) -> &'static str {
    let formats = work.settings.mesh_formats;
    match (formats.stl, formats.obj) {
        (true, true) => "",
        (true, false) => "; no obj",
        (false, true) => "; no stl",
        (false, false) => "; glb only",
    }
}

pub(super) fn plain(work: &mut Work) -> Result<Made, GenerateError> {
    let kind = ModuleKind::PlainMeshes;
    let formats = work.settings.mesh_formats;
    let robot = &work.source.reading.robot;
    let preferred = work.settings.preferred_geometry;
    let geometries = match &work.original {
        Some(original) => link_geometries(robot, &original.module, &original.scenes, preferred)
            .map_err(|fault| work.source.refused(fault))?,
        None => Vec::new(),
    };
    let name = |link: usize| robot.links[link].name.as_str();
    let written: Vec<_> = geometries
        .into_par_iter()
        .enumerate()
        .map(|(link, geometry)| {
            let Some(geometry) = geometry else {
                return Ok(None);
            };
            let files = mesh_files(kind, link, name(link), None, formats);
            let contents = files_of(&geometry.parts, &files, Shading::Smooth)?;
            let mesh = WrittenMesh::of(&geometry.parts);
            let geometry = geometry.geometry;
            Ok(Some((PlainMesh { geometry, files }, contents, mesh)))
        })
        .collect::<Result<_, GenerateError>>()?;
    let (mut link_meshes, mut files, mut meshes) = (Vec::new(), Vec::new(), Vec::new());
    for link in written {
        let (plain, contents, mesh) = match link {
            None => (None, None, None),
            Some((plain, contents, mesh)) => (Some(plain), Some(contents), Some(mesh)),
        };
        link_meshes.push(plain);
        files.extend(contents.into_iter().flatten());
        meshes.push(mesh);
    }
    work.artifacts.plain = Some(Arc::new(meshes));
    made(
        &PlainMeshesModule {
            preferred_geometry: preferred,
            link_meshes,
        },
        files,
    )
}

/// The meshes that are there, in order.
fn meshes_of(plain: &[Option<WrittenMesh>]) -> Vec<&Mesh> {
    plain.iter().flatten().map(|plain| &plain.mesh).collect()
}

pub(super) fn hulls_settings(work: &Work) -> String {
    formats_settings(work).to_owned()
}

pub(super) fn hulls(work: &mut Work) -> Result<Made, GenerateError> {
    let plain = work.artifacts.plain()?;
    // A plain mesh has a triangle with an area, and so a hull.
    let hull = |mesh: &Mesh| {
        ConvexHull::new(&mesh.vertices)
            .ok()
            .map(ConvexHull::into_mesh)
    };
    let mut made_of =
        for_each_content(&meshes_of(&plain), &work.settings.cancellation, hull)?.into_iter();
    let hulls: Vec<Option<WrittenMesh>> = plain
        .iter()
        .map(|plain| {
            let plain = plain.as_ref()?;
            Some(WrittenMesh {
                mesh: made_of.next()??,
                color: plain.color,
            })
        })
        .collect();
    let links = hulls.iter().enumerate().map(|(link, hull)| {
        let hull = hull.as_ref().into_iter();
        hull.map(|hull| (link, None, hull)).collect::<Vec<_>>()
    });
    let (link_hulls, files) = write(work, ModuleKind::ConvexHullMeshes, links)?;
    let module = ConvexHullMeshesModule {
        link_hulls: link_hulls
            .into_iter()
            .map(|hull| hull.into_iter().next())
            .collect(),
    };
    work.artifacts.hulls = Some(Arc::new(hulls));
    made(&module, files)
}

/// The name of our way to decompose; another one where it comes out differently.
const DECOMPOSITION: &str = "urdd cut and merge 2";

fn decomposition(work: &Work) -> decompose::Settings {
    let asked = work.settings.pieces;
    decompose::Settings {
        max_pieces: usize::from(asked.most.clamp(1, 64)),
        standoff_tolerance: asked.tolerance.unwrap_or(0.0),
        ..decompose::Settings::default()
    }
}

pub(super) fn decomposition_settings(work: &Work) -> String {
    let settings = decomposition(work);
    format!("{DECOMPOSITION} {settings:?}{}", formats_settings(work))
}

pub(super) fn pieces(work: &mut Work) -> Result<Made, GenerateError> {
    let plain = work.artifacts.plain()?;
    let settings = decomposition(work);
    let decompose = |mesh: &Mesh| decompose::decompose(mesh, &settings);
    let mut made_of =
        for_each_content(&meshes_of(&plain), &work.settings.cancellation, decompose)?.into_iter();
    let decomposed: Vec<(Vec<WrittenMesh>, f64)> = plain
        .iter()
        .map(|plain| {
            let Some(plain) = plain else {
                return (Vec::new(), 0.0);
            };
            let made = made_of.next().unwrap_or_default();
            let piece = |mesh| WrittenMesh {
                mesh,
                color: plain.color,
            };
            let pieces = made.pieces.into_iter().map(piece).collect();
            (pieces, made.surface_tolerance)
        })
        .collect();
    let tolerance = decomposed.iter().map(|(_, t)| *t).fold(0.0, f64::max);
    let pieces: Vec<Vec<WrittenMesh>> = decomposed.into_iter().map(|(pieces, _)| pieces).collect();
    let links = pieces.iter().enumerate().map(|(link, pieces)| {
        let pieces = pieces.iter().enumerate();
        pieces
            .map(|(idx, piece)| (link, Some(idx), piece))
            .collect()
    });
    let (link_pieces, files) = write(work, ModuleKind::ConvexDecompositionMeshes, links)?;
    let module = ConvexDecompositionMeshesModule {
        method: DecompositionMethod {
            name: DECOMPOSITION.to_owned(),
            surface_tolerance: Some(tolerance),
        },
        link_pieces,
    };
    work.artifacts.pieces = Some(Arc::new(pieces));
    made(&module, files)
}

pub(super) fn boxes_and_spheres(work: &mut Work) -> Result<Made, GenerateError> {
    let solids = work.artifacts.solids()?;
    let internal = |error: HullError| GenerateError::Internal {
        file: work.source.shown.clone(),
        reason: error.to_string(),
    };
    let module = approximations(&solids, &work.settings.cancellation)?.map_err(internal)?;
    let document = document(&module)?;
    work.artifacts.approximations = Some(Arc::new(module));
    Ok(document)
}

pub(super) fn distances_from_origin(work: &mut Work) -> Result<Made, GenerateError> {
    let solids = work.artifacts.solids()?;
    let approximations = work.artifacts.approximations()?;
    document(&max_distances(&solids, &approximations))
}

pub(super) fn statistics_settings(work: &Work) -> String {
    format!("{} samples, 7 digits", work.settings.num_samples)
}

pub(super) fn distance_statistics(work: &mut Work) -> Result<Made, GenerateError> {
    let solids = work.artifacts.solids()?;
    let approximations = work.artifacts.approximations()?;
    let num_samples = work.settings.num_samples;
    let (dof, chain, bounds) = (&work.dof, &work.chain, &work.bounds);
    let module = statistics(&solids, &approximations, (dof, chain, bounds), num_samples);
    let module = Arc::new(module.map_err(|reason| unmeasurable(work, reason))?);
    if module.decomposition_convex_hulls.is_none() {
        let pieces = module.decomposition_shapes.len();
        work.too_large(
            format!(
                "the robot has {pieces} convex pieces, and matrices over more than {MOST_PIECES_WITH_MATRICES} grow too large"
            ),
            "distances and skips between pieces are left out; those between links are there",
        );
    }
    let document = shape_documents::statistics(&module);
    work.artifacts.statistics = Some(module);
    streamed(document)
}

fn unmeasurable(work: &Work, reason: String) -> GenerateError {
    GenerateError::Geometry {
        file: work.source.shown.clone(),
        reason,
    }
}

pub(super) fn skips_by_distance(work: &mut Work) -> Result<Made, GenerateError> {
    let statistics = work.artifacts.statistics()?;
    let solids = work.artifacts.solids()?;
    let approximations = work.artifacts.approximations()?;
    let kinematics = (&work.dof, &work.chain, &work.bounds);
    let default = at_default_configuration(&solids, &approximations, kinematics)
        .map_err(|reason| unmeasurable(work, reason))?;
    let module = Arc::new(simple_skips(&statistics, &default, &work.chain));
    let document = shape_documents::simple_skips(&module);
    work.artifacts.simple_skips = Some(module);
    streamed(document)
}

pub(super) fn skips_settings(work: &Work) -> String {
    serde_json::json!((skipped_reasons(work), &work.edits.kept)).to_string()
}

pub(super) fn edited_skips(work: &mut Work) -> Result<Made, GenerateError> {
    let simple = work.artifacts.simple_skips()?;
    let skipped_reasons = skipped_reasons(work);
    let Edits { kept, lost, .. } = std::mem::take(&mut work.edits);
    for edit in lost {
        work.leave_out(
            format!(
                "the URDD that was there has an edit of the skips between `{}` and `{}`, and the robot has no longer both links",
                edit.link_a, edit.link_b
            ),
            "the edit is left out",
        );
    }
    let links = work.chain.links_in_chain.iter();
    let names: Vec<&str> = links.map(|link| link.name.as_str()).collect();
    let module = skips_module(&simple, skipped_reasons, kept, &names);
    streamed(shape_documents::skips(&Arc::new(module)))
}

/// The reasons for which pairs are skipped: as asked for, or else as before; each once, in order.
fn skipped_reasons(work: &Work) -> Vec<SkippedReason> {
    let asked = work.settings.skipped_reasons.as_deref();
    let mut reasons = asked.unwrap_or(&work.edits.skipped_reasons).to_vec();
    reasons.sort();
    reasons.dedup();
    reasons
}

/// A link, the index of a piece, and the mesh.
type Named<'a> = (usize, Option<usize>, &'a WrittenMesh);

/// Writes the meshes of each link.
fn write<'a>(
    work: &Work,
    kind: ModuleKind,
    links: impl Iterator<Item = Vec<Named<'a>>>,
) -> Result<(Vec<Vec<MeshFiles>>, Vec<MadeFile>), GenerateError> {
    let links: Vec<Vec<Named>> = links.collect();
    let written: Vec<Vec<(MeshFiles, Vec<MadeFile>)>> = links
        .into_par_iter()
        .map(|meshes| {
            let meshes = meshes.into_iter().map(|(link, piece, mesh)| {
                let name = &work.chain.links_in_chain[link].name;
                let files = mesh_files(kind, link, name, piece, work.settings.mesh_formats);
                let part: Part = mesh.part();
                let contents = files_of(&[part], &files, Shading::Flat)?;
                Ok((files, contents))
            });
            meshes.collect()
        })
        .collect::<Result<_, GenerateError>>()?;
    let (mut names, mut contents) = (Vec::new(), Vec::new());
    for link in written {
        let (of_link, files): (Vec<_>, Vec<_>) = link.into_iter().unzip();
        names.push(of_link);
        contents.extend(files.into_iter().flatten());
    }
    Ok((names, contents))
}

fn made(module: &impl serde::Serialize, files: Vec<MadeFile>) -> Result<Made, GenerateError> {
    let made = document(module)?;
    Ok(Made { files, ..made })
}
