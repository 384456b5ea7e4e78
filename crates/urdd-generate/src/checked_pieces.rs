//! The modules that are made of the pieces of links and the pairs of pieces that are not skipped (SPEC 8.8.5):
//! `self_collision_model_module` (8.8) and `link_shapes_spheres_module` (8.9).

use std::cmp::Ordering;

use nalgebra::Isometry3;
use sha2::{Digest, Sha256 as Hash};

use crate::context::Context;
use crate::error::{Result, first_names};
use crate::made::{Digests, Made, made};
use crate::meshes::WrittenMesh;
use urdd_directory::account::Account;
use urdd_directory::writer::sha256;
use urdd_format::link_shapes_distance_statistics::LinkShapesDistanceStatisticsModule;
use urdd_format::link_shapes_skips::LinkShapesSkipsModule;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::Sha256;
use urdd_format::short::Short;
use urdd_geometry::Mesh;
use urdd_geometry::convex::{BodyPairs, ShapeError};
use urdd_kinematics::ConfigurationError;
use urdd_learned::train::{MAX_PAIRS, NoModel, Subject, train};
use urdd_source::note::NoteKind;
use urdd_spheres::model::SphereList;
use urdd_spheres::module::{self, Given, NoSpheres};
use urdd_spheres::samples::{Moves, Pairs};

struct CheckedPieces<'a> {
    pieces: &'a [Vec<WrittenMesh>],
    skips: &'a LinkShapesSkipsModule,
    /// The place of each link in the matrix over full shapes.
    full: Vec<Option<usize>>,
    links: Vec<usize>,
}

impl<'a> CheckedPieces<'a> {
    fn new(pieces: &'a [Vec<WrittenMesh>], skips: &'a LinkShapesSkipsModule) -> Self {
        let mut full = vec![None; pieces.len()];
        for (place, link) in skips.full_shapes.iter().enumerate() {
            if let Some(full) = full.get_mut(link.get()) {
                *full = Some(place);
            }
        }
        let links = pieces.iter().enumerate();
        let links = links.flat_map(|(link, pieces)| pieces.iter().map(move |_| link)).collect();
        CheckedPieces { pieces, skips, full, links }
    }

    /// Whether contacts of two pieces, by their numbers among those of all links, count.
    fn is_checked(&self, a: usize, b: usize) -> bool {
        match &self.skips.decomposition_convex_hulls_skips {
            Some(rows) => !rows[a][b],
            None => match [a, b].map(|piece| self.full[self.links[piece]]) {
                [Some(a), Some(b)] => !self.skips.full_convex_hulls_skips[a][b],
                _ => false,
            },
        }
    }

    /// Each piece, with its link, in an order that its file does not decide: pieces of an earlier run are read from their
    /// files, with vertices in another order, and the last digits of what is computed depend on that.
    fn in_order(&self) -> Vec<(usize, Mesh)> {
        let pieces = self.pieces.iter().flatten().zip(&self.links);
        pieces.map(|(piece, link)| (*link, in_order(&piece.mesh))).collect()
    }

    /// What is said of a piece that cannot be measured.
    fn fault(&self, (piece, error): (usize, ShapeError)) -> String {
        let of = self.skips.decomposition_shapes.get(piece);
        let of = of.map_or_else(String::new, |of| {
            format!(" piece {} of link {}", of.piece_idx, of.link_idx)
        });
        format!("distances cannot be computed for{of}: {error}")
    }
}

/// The mesh with its vertices ascending, each once, and its triangles ascending, each from its least vertex on.
fn in_order(mesh: &Mesh) -> Mesh {
    let order = |a: &[f64; 3], b: &[f64; 3]| {
        a.iter().zip(b).map(|(a, b)| a.total_cmp(b)).fold(Ordering::Equal, Ordering::then)
    };
    let mut vertices = mesh.vertices.clone();
    vertices.sort_by(order);
    vertices.dedup();
    let place = |vertex: u32| {
        let point = &mesh.vertices[vertex as usize];
        let found = vertices.binary_search_by(|other| order(other, point));
        u32::try_from(found.unwrap_or_default()).unwrap_or(u32::MAX)
    };
    let from_least = |[a, b, c]: [u32; 3]| {
        [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap_or([a, b, c])
    };
    let triangles = mesh.triangles.iter().map(|of| from_least(of.map(place)));
    let mut triangles: Vec<[u32; 3]> = triangles.collect();
    triangles.sort_unstable();
    Mesh { vertices, triangles }
}

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
    match train(subject, &context.settings.source.cancellation, &progress) {
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

/// Fits and nests spheres, or takes those that a person gave.
pub(super) fn spheres(
    context: &Context,
    pieces: &[Vec<WrittenMesh>],
    skips: &LinkShapesSkipsModule,
) -> Result<Made> {
    let pieces = CheckedPieces::new(pieces, skips);
    let pairs = Pairs::new(pieces.in_order(), |a, b| pieces.is_checked(a, b))
        .map_err(|error| context.unmeasurable(pieces.fault(error)))?;
    if pairs.links.is_empty() {
        let problem = "no link has a shape, so there is nothing that spheres could stand for";
        return Ok(context.of_no_use(ModuleKind::LinkShapesSpheres, problem.to_owned()));
    }
    let names: Vec<&str> =
        context.chain.links_in_chain.iter().map(|link| link.name.as_str()).collect();
    let given: Vec<Given> = context.spheres.iter().map(|list| list.by_link(&names)).collect();
    let subject = module::Subject {
        robot: &Moving(context),
        pairs: &pairs,
        num_links: names.len(),
        given: &given,
    };
    let progress = |done: usize, total: usize| {
        context.progress.part(ModuleKind::LinkShapesSpheres, done, total);
    };
    let mut notes = Vec::new();
    for (name, spheres) in context.spheres.iter().flat_map(|list| &list.links) {
        let what = match names.iter().position(|link| link == name) {
            Some(link) if pairs.links.contains(&link) => continue,
            Some(_) => "which has no shape",
            None => "which the robot does not have",
        };
        let problem = format!("{} given spheres are of the link `{name}`, {what}", spheres.len());
        notes.push(context.note(NoteKind::LeftOut, problem, "these spheres are left out"));
    }
    let account = Account::new(&context.settings.source.cancellation);
    account.deposit(context.spheres.iter().map(SphereList::count).sum::<usize>() * GIVEN);
    match module::module(&subject, &account, &progress) {
        Ok(module) => Ok(Made { notes, ..made(&module)? }),
        Err(NoSpheres::Cancelled(cancelled)) => Err(cancelled.into()),
        Err(NoSpheres::Costly(links, error)) => {
            let links = links.iter().map(|link| Short::of(names[*link]));
            let reason = format!("the given spheres of {}: {error}", first_names(links));
            Err(context.unmeasurable(reason))
        }
        Err(NoSpheres::Robot(error)) => Err(context.unmeasurable(error)),
        Err(NoSpheres::Piece(link, error)) => Err(context.unmeasurable(format!(
            "distances cannot be computed for link `{}`: {error}",
            names[link]
        ))),
    }
}

/// What a given sphere adds to the account, bytes: about what the old module said of it.
const GIVEN: usize = 100;

/// The robot, as the modules that are made move it.
struct Moving<'a>(&'a Context<'a>);

impl Moves for Moving<'_> {
    type Error = ConfigurationError;

    fn start(&self) -> Result<Vec<f64>, ConfigurationError> {
        let reference = self.0.reference.as_ref().map(|one| one.configuration.clone());
        Ok(reference.unwrap_or_else(|| self.0.space.default_configuration()))
    }

    fn sampled(&self, k: u64) -> Result<Vec<f64>, ConfigurationError> {
        Ok(self.0.space.sampled(k))
    }

    fn link_poses(&self, configuration: &[f64]) -> Result<Vec<Isometry3<f64>>, ConfigurationError> {
        self.0.kinematics.link_poses(configuration)
    }
}
