//! The stage that trains `self_collision_model_module`: SPEC 8.8.

use sha2::{Digest, Sha256 as Hash};

use super::checked_pieces::CheckedPieces;
use super::context::Context;
use super::error::Result;
use super::made::{Digests, Made, made};
use super::meshes::written::WrittenMesh;
use urdd_directory::writer::sha256;
use urdd_format::link_shapes_distance_statistics::LinkShapesDistanceStatisticsModule;
use urdd_format::link_shapes_skips::LinkShapesSkipsModule;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::Sha256;
use urdd_geometry::convex::BodyPairs;
use urdd_learned::train::{MAX_PAIRS, NoModel, Subject, train};

/// Trains the model. Without a document, but with a note, if a model would be of no use.
pub(super) fn self_collision_model(
    context: &Context,
    pieces: &[Vec<WrittenMesh>],
    skips: &LinkShapesSkipsModule,
    statistics: &LinkShapesDistanceStatisticsModule,
    digests: &Digests,
) -> Result<Made> {
    let pairs = pairs(pieces, skips).map_err(|error| context.unmeasurable(error))?;
    let trained_on = trained_on(context, skips, digests);
    let distances = statistics.full_convex_hulls.max_distances.iter().flatten();
    let subject = Subject {
        chain: &context.chain,
        dof: &context.dof,
        kinematics: &context.kinematics,
        space: &context.space,
        pairs: &pairs,
        largest_distance: distances.copied().fold(0.0, f64::max),
        trained_on,
        effort: context.settings.model_effort,
    };
    let progress = |done: usize, total: usize| {
        context.progress.part(ModuleKind::SelfCollisionModel, done, total);
    };
    match train(subject, &context.settings.cancellation, &progress) {
        Ok(module) => made(&module),
        Err(NoModel::OfNoUse(useless)) => {
            let problem = format!("a self-collision model would be of no use: {useless}");
            Ok(context.of_no_use(ModuleKind::SelfCollisionModel, problem))
        }
        Err(NoModel::Cancelled(cancelled)) => Err(cancelled.into()),
        Err(NoModel::Configuration(error)) => Err(context.unmeasurable(error)),
    }
}

/// The pairs of links to check: those with two pieces whose pair is not skipped or, without matrices over pieces, those
/// whose hulls are not skipped.
fn pairs(pieces: &[Vec<WrittenMesh>], skips: &LinkShapesSkipsModule) -> Result<BodyPairs, String> {
    let pieces = CheckedPieces::new(pieces, skips);
    let shapes = pieces.in_order();
    let each = shapes.iter().map(|(link, mesh)| (*link, mesh.vertices.as_slice()));
    let mut pairs = BodyPairs::new(each).map_err(|error| pieces.fault(error))?;
    let links = &skips.full_shapes;
    for (i, a) in links.iter().enumerate() {
        for b in links.iter().skip(i + 1) {
            // Beyond this number no model is trained, so the exact number does not matter.
            if pairs.bodies().len() > MAX_PAIRS {
                return Ok(pairs);
            }
            pairs.add([a.get(), b.get()], |a, b| pieces.is_checked(a, b));
        }
    }
    Ok(pairs)
}

/// SHA-256 over the concatenated hashes of all files that the model depends on: SPEC 8.8.7.
fn trained_on(context: &Context, skips: &LinkShapesSkipsModule, digests: &Digests) -> Sha256 {
    let kinds =
        [ModuleKind::Dof, ModuleKind::Chain, ModuleKind::Bounds, ModuleKind::LinkShapesSkips];
    let documents = kinds.map(|kind| format!("{}/module.json", kind.folder()));
    let kind = ModuleKind::ConvexDecompositionMeshes;
    let pieces = skips.decomposition_shapes.iter().map(|piece| {
        let (link, piece) = (piece.link_idx.get(), piece.piece_idx.get());
        context.mesh_files(kind, link, Some(piece)).glb
    });
    let mut text = String::new();
    for path in documents.into_iter().chain(pieces) {
        // Each of these files was written or kept by an earlier stage.
        text += digests.get(&path).map_or("", String::as_str);
        text.push('\n');
    }
    sha256(&Hash::digest(text))
}
