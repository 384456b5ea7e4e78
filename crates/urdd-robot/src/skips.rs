//! What a URDD records of pairs: of shapes, which need no collision check, the reasons (the robot's allowed collision matrix), and
//! statistics of their distances; of links, the learned self-collision model.

use crate::Robot;
use crate::error::RobotError;
use crate::robot::usable;
use crate::shapes::ShapeKind;
use urdd_document::shape_matrices::{at, reasons, shape_lists, skips, statistics};
use urdd_document::shapes::Shapes;
use urdd_document::urdd::Urdd;
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_format::link_shapes_skips::{LinkShapesSkipsModule, SkipEdit, SkippedReason};
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_learned::CollisionModel;

pub(super) const SKIPS: ModuleKind = ModuleKind::LinkShapesSkips;
pub(super) const SIMPLE: ModuleKind = ModuleKind::LinkShapesSimpleSkips;

/// The skips between the shapes of one kind: MoveIt's *allowed collision matrix*, for shapes instead of links.
#[derive(Debug, Clone)]
pub struct Skips {
    /// The link and the piece of each shape.
    places: Vec<(usize, usize)>,
    skipped: Matrix<bool>,
    reasons: Option<Matrix<SkipReason>>,
    edits: Vec<SkipEdit>,
    skipped_reasons: Option<Vec<SkippedReason>>,
}

/// A matrix over the shapes themselves, or over the links' hulls if the module omits that of the pieces (SPEC 8.4).
#[derive(Debug, Clone)]
struct Matrix<T> {
    rows: Vec<Vec<T>>,
    /// The row of each shape.
    row_of: Vec<Option<usize>>,
}

impl<T: Copy> Matrix<T> {
    fn at(&self, i: usize, j: usize) -> Option<T> {
        at(&self.rows, self.row_of.get(i).copied()??, self.row_of.get(j).copied()??)
    }
}

impl Robot {
    /// The skips between the shapes of a kind: those of `link_shapes_skips_module`, or of
    /// `link_shapes_simple_skips_module` if the former is missing.
    ///
    /// # Errors
    /// If both are missing, if one is unusable, or if a mesh module of a legacy URDD is missing or unusable.
    pub fn skips(&self, kind: ShapeKind) -> Result<Skips, RobotError> {
        let meshes = [ModuleKind::ConvexHullMeshes, ModuleKind::ConvexDecompositionMeshes];
        let part = self.part_as_it_is(&[SKIPS, SIMPLE, meshes[0], meshes[1]])?;
        let from = match part.module(SKIPS) {
            None if part.module(SIMPLE).is_some() => SIMPLE,
            _ => SKIPS,
        };
        usable(&part, from)?;
        if from != SIMPLE && part.module(SIMPLE).is_some() {
            usable(&part, SIMPLE)?;
        }
        let shapes = shapes(&part, from, &meshes)?;
        let document = part.document(from).ok_or(RobotError::Missing(from))?;
        let six = skips(document).ok_or(RobotError::Missing(from))?;
        let places = (0..shapes.count(kind)).filter_map(|shape| shapes.place(kind, shape));
        let rows = Rows::new(kind, places.collect(), &shapes.full);
        let module = match document {
            ModuleDocument::LinkShapesSkips(module) => Some(&**module),
            _ => None,
        };
        Ok(Skips {
            skipped: rows.matrix(&six),
            reasons: part.document(SIMPLE).and_then(reasons).map(|six| rows.matrix(&six)),
            edits: module.map_or_else(Vec::new, |module| module.edits.clone()),
            skipped_reasons: module.map(|module| module.skipped_reasons.clone()),
            places: rows.places,
        })
    }
}

/// Maps the shapes of a kind to rows of the six matrices of a module.
struct Rows {
    kind: ShapeKind,
    /// The link and the piece of each shape.
    places: Vec<(usize, usize)>,
    /// For each shape, the row of its link's hull.
    of_hulls: Vec<Option<usize>>,
}

impl Rows {
    /// `full` lists the links that have a hull, in row order.
    fn new(kind: ShapeKind, places: Vec<(usize, usize)>, full: &[usize]) -> Self {
        let row = |link: usize| full.iter().position(|full| *full == link);
        Rows { kind, of_hulls: places.iter().map(|(link, _)| row(*link)).collect(), places }
    }

    /// The matrix of the kind, or that of the hulls if it is omitted (SPEC 8.4).
    fn matrix<T: Copy>(&self, six: &[Option<&[Vec<T>]>; 6]) -> Matrix<T> {
        match six[self.kind as usize] {
            Some(rows) => {
                Matrix { rows: rows.to_vec(), row_of: (0..self.places.len()).map(Some).collect() }
            }
            None => Matrix {
                rows: six[ShapeKind::Hulls as usize].unwrap_or_default().to_vec(),
                row_of: self.of_hulls.clone(),
            },
        }
    }
}

/// The shapes of the rows: as listed in the module or, for a legacy module, derived from the meshes.
fn shapes(part: &Urdd, from: ModuleKind, meshes: &[ModuleKind]) -> Result<Shapes, RobotError> {
    let document = part.document(from).ok_or(RobotError::Missing(from))?;
    if let Some((full, pieces)) = shape_lists(document) {
        return Ok(Shapes {
            full: full.iter().map(|link| link.get()).collect(),
            pieces: pieces.iter().map(|one| (one.link_idx.get(), one.piece_idx.get())).collect(),
        });
    }
    for kind in meshes {
        usable(part, *kind)?;
    }
    Shapes::new(part).ok_or(RobotError::Missing(meshes[0]))
}

impl Skips {
    /// Number of shapes.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether there are no shapes.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// The link and the piece of each shape.
    pub fn places(&self) -> &[(usize, usize)] {
        &self.places
    }

    /// Whether a pair of shapes is skipped. A pair that is not in the module is not skipped; a shape with itself is.
    pub fn is_skipped(&self, i: usize, j: usize) -> bool {
        self.skipped.at(i, j).unwrap_or(i == j)
    }

    /// The reason that `link_shapes_simple_skips_module` gives for a pair: the same link, always or never in contact,
    /// and so on. Edits can override it. `None` for legacy URDDs, or without that module.
    pub fn reason(&self, i: usize, j: usize) -> Option<SkipReason> {
        self.reasons.as_ref()?.at(i, j)
    }

    /// The user's edits, in order. Empty without `link_shapes_skips_module`, or in a legacy URDD.
    pub fn edits(&self) -> &[SkipEdit] {
        &self.edits
    }

    /// The reasons for which pairs are skipped, before the edits. `None` without `link_shapes_skips_module`, or in a
    /// legacy URDD.
    pub fn skipped_reasons(&self) -> Option<&[SkippedReason]> {
        self.skipped_reasons.as_deref()
    }

    /// The skips of other shapes of the same robot, given the reason of each pair: what this URDD skips, by its skipped
    /// reasons, with its edits, which [`Skips::is_skipped`] does not have.
    #[doc(hidden)]
    pub fn of_reasons(&self, places: Vec<(usize, usize)>, reasons: Vec<Vec<SkipReason>>) -> Self {
        let is_skipped = |reason: &SkipReason| match &self.skipped_reasons {
            Some(chosen) => chosen.iter().any(|one| one.of_pair() == *reason),
            None => reason.is_simple(),
        };
        let skipped = reasons.iter().map(|row| row.iter().map(is_skipped).collect()).collect();
        let row_of: Vec<Option<usize>> = (0..places.len()).map(Some).collect();
        Skips {
            skipped: Matrix { rows: skipped, row_of: row_of.clone() },
            reasons: Some(Matrix { rows: reasons, row_of }),
            edits: self.edits.clone(),
            skipped_reasons: self.skipped_reasons.clone(),
            places,
        }
    }

    /// The same shapes and reasons with the skips of another `link_shapes_skips_module` of the same URDD. `kind` is the
    /// kind of these shapes.
    pub(super) fn of_module(&self, kind: ShapeKind, module: LinkShapesSkipsModule) -> Self {
        let full: Vec<usize> = module.full_shapes.iter().map(|link| link.get()).collect();
        let rows = Rows::new(kind, self.places.clone(), &full);
        let (edits, skipped_reasons) = (module.edits.clone(), module.skipped_reasons.clone());
        let document = ModuleDocument::LinkShapesSkips(Box::new(module));
        Skips {
            skipped: skips(&document).map_or_else(|| self.skipped.clone(), |six| rows.matrix(&six)),
            reasons: self.reasons.clone(),
            edits,
            skipped_reasons: Some(skipped_reasons),
            places: rows.places,
        }
    }
}

const MODULE: ModuleKind = ModuleKind::LinkShapesDistanceStatistics;

/// Distance statistics of a pair of shapes over the sampled configurations, in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairStatistics {
    /// The mean.
    pub mean: f64,
    /// The smallest.
    pub min: f64,
    /// The largest.
    pub max: f64,
}

impl PairStatistics {
    /// Those of two shapes of a kind; `None` if `part` has none of that module, kind or pair.
    pub(super) fn of(part: &Urdd, kind: ShapeKind, i: usize, j: usize) -> Option<Self> {
        let one = statistics(part.document(MODULE)?)?[kind as usize]?;
        let [mean, min, max] = [one.mean, one.min, one.max].map(|matrix| at(matrix, i, j));
        Some(PairStatistics { mean: mean?, min: min?, max: max? })
    }
}

/// Each method fails if the files of the URDD cannot be listed.
impl Robot {
    pub(super) fn statistics(&self) -> Result<Urdd, RobotError> {
        self.part_as_it_is(&[MODULE])
    }

    /// Number of configurations that the statistics cover; `None` if the URDD does not record it.
    pub fn num_samples(&self) -> Result<Option<u32>, RobotError> {
        let part = self.statistics()?;
        let six = part.document(MODULE).and_then(statistics);
        Ok(six.and_then(|six| six.into_iter().flatten().find_map(|one| one.num_samples)))
    }

    /// The statistics of a pair of shapes of a kind, by their indices (SPEC 8.1); `None` if the URDD has none.
    pub fn pair_statistics(
        &self,
        kind: ShapeKind,
        i: usize,
        j: usize,
    ) -> Result<Option<PairStatistics>, RobotError> {
        Ok(PairStatistics::of(&self.statistics()?, kind, i, j))
    }
}

impl Robot {
    /// The learned self-collision model (SPEC 8.8): an estimate of the clearance between links. It filters out
    /// configurations that are far from contact, before an exact check of the rest. It is an estimate, not a guarantee:
    /// [`CollisionModel::evaluation`] gives its measured error rates.
    ///
    /// ```
    /// # use urdd_robot::{Queries, Robot, RobotError, ShapeKind};
    /// fn is_free(robot: &Robot, q: &[f64]) -> Result<bool, RobotError> {
    ///     let model = robot.collision_model()?;
    ///     if !model.may_collide(q)? {
    ///         return Ok(true); // most free configurations, and some collisions: `evaluation` counts them
    ///     }
    ///     Ok(!robot.proximity(ShapeKind::Pieces)?.in_collision(q)?)
    /// }
    /// ```
    ///
    /// # Errors
    /// If `self_collision_model_module`, `chain_module` or `dof_module` is missing or unusable.
    pub fn collision_model(&self) -> Result<CollisionModel, RobotError> {
        let kind = ModuleKind::SelfCollisionModel;
        let part = self.part(&[kind])?;
        let Some(ModuleDocument::SelfCollisionModel(module)) = part.document(kind) else {
            return Err(RobotError::Missing(kind));
        };
        let num_dofs = self.motion()?.kinematics.num_dofs();
        let unusable = |reason: String| RobotError::Unusable { module: kind, reason };
        let (pairs, others) = (module.pairs.iter(), module.other_pairs.iter());
        let links = pairs.flat_map(|pair| [pair.link_a_idx, pair.link_b_idx]);
        let links = links.chain(others.flat_map(|pair| [pair.link_a_idx, pair.link_b_idx]));
        let num_links = self.link_names()?.len();
        if let Some(link) = links.map(|link| link.get()).find(|link| *link >= num_links) {
            let reason = format!("link {link} is out of range: the robot has {num_links} links");
            return Err(unusable(reason));
        }
        CollisionModel::new(module, num_dofs).map_err(|error| unusable(error.to_string()))
    }
}
