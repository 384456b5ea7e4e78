//! The stage that trains `self_collision_model_module`: SPEC 8.8.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use sha2::{Digest, Sha256 as Hash};

use super::context::Context;
use super::error::GenerateError;
use super::made::{Digests, Made, made};
use super::meshes::written::WrittenMesh;
use crate::train::{self, MOST_PAIRS, NoModel, Subject, Useless};
use urdd_directory::writer::sha256;
use urdd_format::chain::ChainModule;
use urdd_format::dof::Quantity;
use urdd_format::index::DofIdx;
use urdd_format::link_shapes_distance_statistics::LinkShapesDistanceStatisticsModule;
use urdd_format::link_shapes_skips::LinkShapesSkipsModule;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::Sha256;
use urdd_format::self_collision_model::{AngleInput, LengthInput, ModelInput, RotationVectorInput};
use urdd_format::urdf::JointType;
use urdd_geometry::convex::BodyPairs;
use urdd_kinematics::{ConfigurationSpace, ForwardKinematics};
use urdd_source::note::NoteKind;

/// Distances are clipped at this fraction of the largest distance between two hulls.
const CLIP: f64 = 1.0 / 16.0;

/// Version of the training; changed whenever the trained model changes.
pub(super) const TRAINING: &str = "2";

/// Trains the model. Without a document, but with a note, if a model would be of no use.
pub(super) fn self_collision_model(
    context: &Context,
    pieces: &[Vec<WrittenMesh>],
    skips: &LinkShapesSkipsModule,
    statistics: &LinkShapesDistanceStatisticsModule,
    digests: &Digests,
) -> Result<Made, GenerateError> {
    let unusable = |error: &dyn std::fmt::Display| context.unmeasurable(error.to_string());
    let (dof, chain, bounds) = context.kinematics();
    let space = ConfigurationSpace::new(dof, chain, &bounds.bounds).map_err(|e| unusable(&e))?;
    let kinematics = ForwardKinematics::new(chain, dof).map_err(|e| unusable(&e))?;
    let pairs = pairs(pieces, skips).map_err(|e| unusable(&e))?;
    let trained_on = trained_on(context, skips, digests);
    let model = match pairs.bodies().len() > MOST_PAIRS {
        true => Err(Useless::ManyPairs { most: MOST_PAIRS }),
        false => inputs(context, &pairs),
    };
    let model = model.map_err(NoModel::OfNoUse);
    let model = model.and_then(|inputs| {
        let subject = Subject {
            kinematics: &kinematics,
            space: &space,
            inputs,
            pairs: &pairs,
            clip_distance: clip_distance(statistics),
            trained_on,
            effort: context.settings.model_effort,
        };
        let progress = |done: usize, total: usize| {
            let kind = ModuleKind::SelfCollisionModel;
            context.progress.part(kind, done, total);
        };
        train::train(subject, &context.settings.cancellation, &progress)
    });
    match model {
        Ok(module) => made(&module),
        Err(NoModel::OfNoUse(useless)) => {
            let problem = format!("a self-collision model would be of no use: {useless}");
            let assumed = "self_collision_model_module is left out";
            Ok(Made {
                document: None,
                files: Vec::new(),
                notes: vec![context.note(NoteKind::OfNoUse, problem, assumed)],
                product: (),
            })
        }
        Err(NoModel::Cancelled(cancelled)) => Err(cancelled.into()),
        Err(NoModel::Configuration(error)) => Err(unusable(&error)),
    }
}

/// The pairs of links to check: those with two pieces whose pair is not skipped or, without matrices over pieces, those
/// whose hulls are not skipped.
fn pairs(pieces: &[Vec<WrittenMesh>], skips: &LinkShapesSkipsModule) -> Result<BodyPairs, String> {
    // Pieces of an earlier run are read from their files, with vertices in another order. The last digits of distances
    // depend on that order.
    let in_order = |vertices: &[[f64; 3]]| {
        let mut vertices = vertices.to_vec();
        vertices.sort_by(|a, b| {
            let keys = a.iter().zip(b).map(|(a, b)| a.total_cmp(b));
            keys.fold(Ordering::Equal, Ordering::then)
        });
        vertices.dedup();
        vertices
    };
    let shapes = pieces.iter().enumerate();
    let shapes: Vec<(usize, Vec<[f64; 3]>)> = shapes
        .flat_map(|(link, pieces)| {
            let vertices = pieces.iter().map(|piece| in_order(&piece.mesh.vertices));
            vertices.map(move |vertices| (link, vertices))
        })
        .collect();
    let each = shapes.iter().map(|(link, vertices)| (*link, vertices.as_slice()));
    let mut pairs = BodyPairs::new(each).map_err(|(piece, error)| {
        let of = skips.decomposition_shapes.get(piece);
        let of = of.map_or_else(String::new, |of| {
            format!(" piece {} of link {}", of.piece_idx, of.link_idx)
        });
        format!("distances cannot be computed for{of}: {error}")
    })?;
    let links = &skips.full_shapes;
    for (i, a) in links.iter().enumerate() {
        for (j, b) in links.iter().enumerate().skip(i + 1) {
            // Beyond this number no model is trained, so the exact number does not matter.
            if pairs.bodies().len() > MOST_PAIRS {
                return Ok(pairs);
            }
            let skipped = |a: usize, b: usize| match &skips.decomposition_convex_hulls_skips {
                Some(rows) => rows[a][b],
                None => skips.full_convex_hulls_skips[i][j],
            };
            pairs.add([a.get(), b.get()], |a, b| !skipped(a, b));
        }
    }
    Ok(pairs)
}

fn clip_distance(statistics: &LinkShapesDistanceStatisticsModule) -> f64 {
    let distances = &statistics.full_convex_hulls.max_distances;
    let largest = distances.iter().flatten().copied().fold(0.0, f64::max);
    train::rounded(CLIP * largest)
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

/// The network's inputs: the DOFs that move the links of a pair relative to each other.
fn inputs(context: &Context, pairs: &BodyPairs) -> Result<Vec<ModelInput>, Useless> {
    let dofs: BTreeSet<usize> = pairs
        .bodies()
        .flat_map(|links| between(&context.chain, links))
        .flat_map(|joint| {
            let own = context.dof.joint_idx_to_dof_idxs_mapping[joint].iter();
            let mimic = context.dof.joint_idx_to_mimic_mapping[joint].as_ref();
            let followed = mimic.and_then(|mimic| mimic.dof_idx.as_ref());
            own.chain(followed).map(|dof| dof.get())
        })
        .collect();
    let mut inputs = Vec::new();
    let mut turned: BTreeSet<usize> = BTreeSet::new();
    for dof in dofs {
        let of = &context.dof.dofs[dof];
        let joint = of.joint_idx.get();
        let joint_type = context.chain.joints_in_chain[joint].joint_type;
        let dofs = &context.dof.joint_idx_to_dof_idxs_mapping[joint];
        let index = |dof: usize| DofIdx(u32::try_from(dof).unwrap_or(u32::MAX));
        match (of.quantity, joint_type) {
            (Quantity::Length, JointType::Floating | JointType::Planar) => {
                let dof = of.name.clone();
                return Err(Useless::NoLimits { dof });
            }
            (Quantity::Length, _) => {
                let [lower, upper] = context.bounds.bounds[dof];
                let half_range = train::rounded(0.5 * (upper - lower).abs());
                inputs.push(ModelInput::Length(LengthInput {
                    dof_idx: index(dof),
                    middle: train::rounded(0.5 * lower + 0.5 * upper),
                    half_range: if half_range > 0.0 { half_range } else { 1.0 },
                }));
            }
            (Quantity::Angle, JointType::Floating | JointType::Spherical) => {
                if let (true, Some(dof_idxs)) = (turned.insert(joint), dofs.last_chunk()) {
                    let dof_idxs = *dof_idxs;
                    inputs.push(ModelInput::RotationVector(RotationVectorInput { dof_idxs }));
                }
            }
            (Quantity::Angle, _) => {
                let dof_idx = index(dof);
                inputs.push(ModelInput::Angle(AngleInput { dof_idx }));
            }
        }
    }
    Ok(inputs)
}

/// The joints on the path between two links.
fn between(chain: &ChainModule, [a, b]: [usize; 2]) -> Vec<usize> {
    let up = |link: usize| {
        let joint = move |link: &usize| {
            let joint = chain.links_in_chain[*link].parent_joint_idx?;
            Some(joint.get())
        };
        let above = move |link: &usize| {
            let link = chain.links_in_chain[*link].parent_link_idx?;
            Some(link.get())
        };
        std::iter::successors(Some(link), above).map_while(move |link| joint(&link))
    };
    let of_a: BTreeSet<usize> = up(a).collect();
    let of_b: BTreeSet<usize> = up(b).collect();
    of_a.symmetric_difference(&of_b).copied().collect()
}
