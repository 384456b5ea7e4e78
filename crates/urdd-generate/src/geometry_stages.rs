//! The stages that build meshes and link shapes.

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
use super::taken::{Solid, known_shapes, meshes_of, taken_of, taken_plain};
use super::work::Work;
use urdd_format::convex_decomposition_meshes::{
    ConvexDecompositionMeshesModule, DecompositionMethod,
};
use urdd_format::convex_hull_meshes::ConvexHullMeshesModule;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::meshes::{GeometryKind, MeshFiles};
use urdd_format::plain_meshes::{PlainMesh, PlainMeshesModule};
use urdd_format::registry::ModuleKind;
use urdd_format::skips::skips_module;
use urdd_geometry::Mesh;
use urdd_geometry::decompose;
use urdd_geometry::hull::{ConvexHull, HullError};

pub(super) fn plain_settings(work: &Work) -> String {
    let geometry = match work.settings.preferred_geometry {
        GeometryKind::Visual => "visual",
        GeometryKind::Collision => "collision",
    };
    format!("{geometry}; smooth normals{}", formats_settings(work))
}

/// The part of the settings common to all stages that write meshes.
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
    let taken = taken_plain(work);
    let have = |link: usize| taken.get(link).is_some_and(Option::is_some);
    let geometries = match &work.original {
        Some(original) => {
            let (module, scenes) = (&original.module, &original.scenes);
            link_geometries(robot, module, scenes, preferred, &have)
                .map_err(|fault| work.source.refused(fault))?
        }
        None => Vec::new(),
    };
    let name = |link: usize| robot.links[link].name.as_str();
    let written: Vec<_> = geometries
        .into_par_iter()
        .enumerate()
        .map(|(link, geometry)| {
            let files = mesh_files(kind, link, name(link), None, formats);
            if let Some((geometry, taken)) = taken.get(link).and_then(Option::as_ref) {
                let contents = taken.files.named(&files);
                let plain = PlainMesh {
                    geometry: *geometry,
                    files,
                };
                return Ok(Some((plain, contents, taken.mesh.clone())));
            }
            let Some(geometry) = geometry else {
                return Ok(None);
            };
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

pub(super) fn hulls_settings(work: &Work) -> String {
    formats_settings(work).to_owned()
}

pub(super) fn hulls(work: &mut Work) -> Result<Made, GenerateError> {
    let plain = work.artifacts.plain()?;
    let kind = ModuleKind::ConvexHullMeshes;
    let taken = taken_of(work, kind, &plain, |plain, wanted| {
        Some(vec![work.reusable.hull(plain, wanted)?])
    });
    // A plain mesh has a triangle with positive area. It therefore has a convex hull.
    let hull = |mesh: &Mesh| {
        ConvexHull::new(&mesh.vertices)
            .ok()
            .map(ConvexHull::into_mesh)
    };
    let meshes = meshes_of(&plain, &taken);
    let mut made_of = for_each_content(&meshes, &work.settings.cancellation, hull)?.into_iter();
    let solids = plain.iter().zip(taken).map(|(plain, taken)| {
        let Some(plain) = plain else {
            return Vec::new();
        };
        taken.unwrap_or_else(|| {
            let made = made_of.next().flatten();
            let solid = |mesh| Solid {
                mesh: WrittenMesh {
                    mesh,
                    color: plain.color,
                },
                files: None,
            };
            made.into_iter().map(solid).collect()
        })
    });
    let solids: Vec<Vec<Solid>> = solids.collect();
    let links = solids
        .iter()
        .map(|of_link| of_link.iter().map(|hull| (None, hull)).collect());
    let (link_hulls, files) = write(work, kind, links)?;
    let module = ConvexHullMeshesModule {
        link_hulls: link_hulls
            .into_iter()
            .map(|hull| hull.into_iter().next())
            .collect(),
    };
    let hulls = solids
        .into_iter()
        .map(|of_link| Some(of_link.into_iter().next()?.mesh));
    work.artifacts.hulls = Some(Arc::new(hulls.collect()));
    made(&module, files)
}

/// Name of the decomposition method; changed whenever its results change.
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
    let kind = ModuleKind::ConvexDecompositionMeshes;
    let settings = decomposition(work);
    let taken = taken_of(work, kind, &plain, |plain, wanted| {
        work.reusable.pieces(plain, wanted)
    });
    let decompose = |mesh: &Mesh| decompose::decompose(mesh, &settings);
    let meshes = meshes_of(&plain, &taken);
    let made_of = for_each_content(&meshes, &work.settings.cancellation, decompose)?;
    let mut made_of = made_of.into_iter();
    let mut tolerance: f64 = 0.0;
    let solids = plain.iter().zip(taken).map(|(plain, taken)| {
        let Some(plain) = plain else {
            return Vec::new();
        };
        if let Some(taken) = taken {
            tolerance = tolerance.max(settings.surface_tolerance_of(&plain.mesh));
            return taken;
        }
        let made = made_of.next().unwrap_or_default();
        tolerance = tolerance.max(made.surface_tolerance);
        let piece = |mesh| Solid {
            mesh: WrittenMesh {
                mesh,
                color: plain.color,
            },
            files: None,
        };
        made.pieces.into_iter().map(piece).collect()
    });
    let solids: Vec<Vec<Solid>> = solids.collect();
    let links = solids.iter().map(|pieces| {
        let pieces = pieces.iter().enumerate();
        pieces.map(|(idx, piece)| (Some(idx), piece)).collect()
    });
    let (link_pieces, files) = write(work, kind, links)?;
    let module = ConvexDecompositionMeshesModule {
        method: DecompositionMethod {
            name: DECOMPOSITION.to_owned(),
            surface_tolerance: Some(tolerance),
        },
        link_pieces,
    };
    let pieces = solids.into_iter().map(|pieces| {
        let pieces = pieces.into_iter().map(|piece| piece.mesh);
        pieces.collect()
    });
    work.artifacts.pieces = Some(Arc::new(pieces.collect()));
    made(&module, files)
}

pub(super) fn boxes_and_spheres(work: &mut Work) -> Result<Made, GenerateError> {
    let solids = work.artifacts.solids()?;
    let internal = |error: HullError| GenerateError::Internal {
        file: work.source.shown.clone(),
        reason: error.to_string(),
    };
    let known = known_shapes(work, &solids);
    let module = approximations(&solids, known, &work.settings.cancellation)?.map_err(internal)?;
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
    let kinematics = (dof, chain, bounds);
    let cancellation = &work.settings.cancellation;
    let module = statistics(
        &solids,
        &approximations,
        kinematics,
        num_samples,
        cancellation,
    )?;
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

pub(super) fn unmeasurable(work: &Work, reason: String) -> GenerateError {
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
    let module = Arc::new(skips_module(&simple, skipped_reasons, kept, &names));
    let document = shape_documents::skips(&module);
    work.artifacts.skips = Some(module);
    streamed(document)
}

/// The skip reasons of the settings, otherwise those of the old URDD; sorted, without duplicates.
fn skipped_reasons(work: &Work) -> Vec<SkippedReason> {
    let asked = work.settings.skipped_reasons.as_deref();
    let mut reasons = asked.unwrap_or(&work.edits.skipped_reasons).to_vec();
    reasons.sort();
    reasons.dedup();
    reasons
}

/// The index of a piece and its mesh; no index for a hull.
type Named<'a> = (Option<usize>, &'a Solid);

/// Names and writes the meshes of each link.
fn write<'a>(
    work: &Work,
    kind: ModuleKind,
    links: impl Iterator<Item = Vec<Named<'a>>>,
) -> Result<(Vec<Vec<MeshFiles>>, Vec<MadeFile>), GenerateError> {
    let links: Vec<Vec<Named>> = links.collect();
    let written: Vec<Vec<(MeshFiles, Vec<MadeFile>)>> = links
        .into_par_iter()
        .enumerate()
        .map(|(link, meshes)| {
            let meshes = meshes.into_iter().map(|(piece, solid)| {
                let files = work.mesh_files(kind, link, piece);
                let contents = match &solid.files {
                    Some(taken) => taken.named(&files),
                    None => files_of(&[solid.mesh.part()], &files, Shading::Flat)?,
                };
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
