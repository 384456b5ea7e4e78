//! The learned self-collision model, evaluated and counted again from SPEC 8.8. Shares nothing with training and use of
//! models except the distances of shapes.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use sha2::{Digest, Sha256};

use super::samples::{Budget, Poses};
use crate::skip;
use crate::solids::Solids;
use urdd_document::shape_matrices::{at, skips};
use urdd_document::shapes::Shapes;
use urdd_document::urdd::Urdd;
use urdd_findings::part::SkipReason;
use urdd_format::index::Count;
use urdd_format::registry::ModuleKind;
use urdd_format::self_collision_model::{
    CONFIRMATION_SECOND, EVALUATION_FIRST, ModelEvaluation, ModelInput, NEAR_CONTACT_STEP,
    SelfCollisionModelModule,
};
use urdd_geometry::convex::BodyPairs;
use urdd_kinematics::rotation::from_rotation_vector;

/// Number of values of an input.
pub fn width(input: &ModelInput) -> usize {
    match input {
        ModelInput::Angle(_) => 4,
        ModelInput::Length(_) => 1,
        ModelInput::RotationVector(_) => 9,
    }
}

/// The first sampled configuration of the second confirmation: SPEC 8.8.12.
pub fn second_confirmation(model: &SelfCollisionModelModule) -> u32 {
    let mut hash = Sha256::new();
    for layer in &model.layers {
        for number in layer.weights.iter().flatten().chain(&layer.biases) {
            hash.update(number.to_le_bytes());
        }
    }
    for pair in &model.pairs {
        hash.update(pair.margin.to_le_bytes());
    }
    let digest = hash.finalize();
    let first = digest.iter().take(4);
    let bits = first.fold(0, |number, byte| number << 8 | u32::from(*byte));
    CONFIRMATION_SECOND + (bits >> 3)
}

/// A network whose lists have the right lengths.
pub struct Network {
    inputs: Vec<ModelInput>,
    layers: Vec<(DMatrix<f64>, DVector<f64>)>,
    margins: DVector<f64>,
}

impl Network {
    /// For a model in which LRN003 found no fault.
    pub fn new(model: &SelfCollisionModelModule) -> Self {
        let layers = model.layers.iter().map(|layer| {
            let (rows, columns) = (layer.weights.len(), layer.weights.first().map_or(0, Vec::len));
            let numbers = layer.weights.iter().flatten().copied();
            let weights = DMatrix::from_row_iterator(rows, columns, numbers);
            (weights, DVector::from_column_slice(&layer.biases))
        });
        let margins = model.pairs.iter().map(|pair| pair.margin);
        Self {
            inputs: model.inputs.clone(),
            layers: layers.collect(),
            margins: DVector::from_iterator(model.pairs.len(), margins),
        }
    }

    /// The clearance of each pair in a configuration with one value per DOF, metres.
    pub fn clearances(&self, configuration: &[f64]) -> Vec<f64> {
        let mut values = Vec::new();
        for input in &self.inputs {
            match input {
                ModelInput::Angle(of) => {
                    let q = configuration[of.dof_idx.get()];
                    values.extend([q.sin(), q.cos(), (2.0 * q).sin(), (2.0 * q).cos()]);
                }
                ModelInput::Length(of) => {
                    let q = configuration[of.dof_idx.get()];
                    values.push((q - of.middle) / of.half_range);
                }
                ModelInput::RotationVector(of) => {
                    let vector = of.dof_idxs.map(|dof| configuration[dof.get()]);
                    let rotation = from_rotation_vector(vector).to_rotation_matrix();
                    values.extend(rotation.matrix().transpose().iter());
                }
            }
        }
        let mut values = DVector::from_vec(values);
        for (place, (weights, biases)) in self.layers.iter().enumerate() {
            values = weights * values + biases;
            if place + 1 < self.layers.len() {
                values.apply(|value| *value = value.tanh());
            }
        }
        (values - &self.margins).as_slice().to_vec()
    }

    /// Whether the model clears a configuration: every clearance is above 0.
    pub fn clears(&self, configuration: &[f64]) -> bool {
        let clearances = self.clearances(configuration);
        clearances.into_iter().all(|clearance| clearance > 0.0)
    }
}

/// Maximum number of pairs of pieces: each takes 16 bytes.
const MOST: usize = 20_000_000;

/// A link with pieces.
struct Link {
    link: usize,
    /// The indices of its pieces.
    pieces: Range<usize>,
    /// Its rows of the matrix; none without a hull.
    rows: Range<usize>,
}

/// What is skipped: by the matrix over pieces or, without one, by that over the hulls of links.
struct Skipped<'a> {
    matrix: &'a [Vec<bool>],
    is_of_pieces: bool,
    /// In their order.
    links: Vec<Link>,
}

impl<'a> Skipped<'a> {
    fn new(urdd: &'a Urdd, shapes: &Shapes) -> Option<Self> {
        let [full, _, _, of_pieces, _, _] = skips(urdd.document(ModuleKind::LinkShapesSkips)?)?;
        let full = full?;
        let mut links: Vec<Link> = Vec::new();
        for own in shapes.pieces.chunk_by(|a, b| a.0 == b.0) {
            let (link, first) = (own[0].0, links.last().map_or(0, |last| last.pieces.end));
            let pieces = first..first + own.len();
            let hull = shapes.full.iter().position(|full| *full == link);
            let row = hull.map_or(0..0, |row| row..row + 1);
            let rows = if of_pieces.is_some() { pieces.clone() } else { row };
            links.push(Link { link, pieces, rows });
        }
        let is_of_pieces = of_pieces.is_some();
        Some(Self { matrix: of_pieces.unwrap_or(full), is_of_pieces, links })
    }

    fn is_checked(&self, i: usize, j: usize) -> bool {
        at(self.matrix, i, j) == Some(false)
    }

    /// The pairs of links that are not skipped, the lower link first.
    fn not_skipped(&self) -> impl Iterator<Item = [&Link; 2]> {
        let each = self.links.iter().enumerate();
        let pairs = each.flat_map(|(place, a)| {
            let after = &self.links[place + 1..];
            after.iter().map(move |b| [a, b])
        });
        pairs.filter(|[a, b]| a.rows.clone().any(|i| b.rows.clone().any(|j| self.is_checked(i, j))))
    }
}

/// The pairs of links that are not skipped, the lower link first.
pub fn not_skipped(urdd: &Urdd) -> Option<Vec<[usize; 2]>> {
    let skipped = Skipped::new(urdd, &Shapes::new(urdd)?)?;
    Some(skipped.not_skipped().map(|both| both.map(|one| one.link)).collect())
}

/// The pieces, with the pairs that are not skipped.
///
/// # Errors
/// Why there are none.
pub fn pieces(urdd: &Urdd, solids: &Solids) -> Result<BodyPairs, SkipReason> {
    let open = || SkipReason::obstacle("there are no pieces to take distances of");
    let shapes = Shapes::new(urdd).ok_or_else(open)?;
    let skipped = Skipped::new(urdd, &shapes).ok_or_else(open)?;
    let pairs = skipped.not_skipped();
    let count = pairs.map(|[a, b]| a.pieces.len().saturating_mul(b.pieces.len()));
    let count = count.fold(0, usize::saturating_add);
    if count > MOST {
        let why = format!(
            "the pairs of links that are not skipped have {count} pairs of pieces, and distances are taken of {MOST} at most"
        );
        return Err(SkipReason::obstacle(why));
    }
    let kind = ModuleKind::ConvexDecompositionMeshes;
    let meshes = shapes.pieces.iter().map(|(link, piece)| {
        let mesh = solids.mesh(kind, *link, *piece)?;
        Some((*link, mesh.vertices.as_slice()))
    });
    let meshes: Vec<(usize, &[[f64; 3]])> = meshes.collect::<Option<_>>().ok_or_else(open)?;
    let mut pairs = BodyPairs::new(meshes)
        .map_err(|(piece, error)| SkipReason::obstacle(format!("piece {piece}: {error}")))?;
    for both in skipped.not_skipped() {
        let is_checked = |a, b| !skipped.is_of_pieces || skipped.is_checked(a, b);
        pairs.add(both.map(|one| one.link), is_checked);
    }
    Ok(pairs)
}

/// Average work allowed per configuration, so that counting takes at most about 20 seconds on one core. The unit is
/// about a nanosecond.
const DEFAULT: u64 = 200_000;
/// The same with `--deep`: about 7 minutes.
const DEEP: u64 = 4_000_000;
/// Work of comparing two pieces whose bounding spheres intersect, of the unit that `DEFAULT` has.
pub const COMPARISON: u64 = 150;
/// A count may differ by one per this many configurations that it is counted among.
pub const PER_TOLERANCE: u32 = 10_000;

/// Compares a model with exact geometry.
pub struct Judge {
    network: Network,
    poses: Poses,
    pieces: BodyPairs,
    /// Work of a configuration, without comparing pieces.
    cost: u64,
    /// Average work allowed per configuration.
    budget: u64,
    deep: bool,
}

impl Judge {
    /// For a model in which the rules before found no fault. `deep` allows more work.
    ///
    /// # Errors
    /// Why the model cannot be compared.
    pub fn new(
        urdd: &Urdd,
        solids: &Solids,
        model: &SelfCollisionModelModule,
        deep: bool,
    ) -> Result<Self, SkipReason> {
        let poses = Poses::new(urdd)?;
        let pieces = pieces(urdd, solids)?;
        let numbers: usize = model.layers.iter().map(|of| of.biases.len()).sum();
        let weights: usize = model.layers.iter().flat_map(|of| &of.weights).map(Vec::len).sum();
        let work = 50 * poses.num_links() + 4 * pieces.num_shape_pairs() + 20 * numbers + weights;
        Ok(Self {
            network: Network::new(model),
            poses,
            pieces,
            cost: 2_000 + work as u64,
            budget: if deep { DEEP } else { DEFAULT },
            deep,
        })
    }

    /// Counts over sampled configurations, from the first one on. Collisions near contact are determined for those of
    /// the evaluation only.
    ///
    /// # Errors
    /// If a configuration has no poses, or the work exceeds the limit. The sum of all work decides, independent of the
    /// machine and of the number of threads.
    pub fn count(&self, first: u32, count: u32) -> Result<ModelEvaluation, SkipReason> {
        let most = self.budget.saturating_mul(u64::from(count));
        let budget = Budget::of(most, skip::counting_takes_too_long(self.deep));
        let one = |k: u32| {
            let (found, work) = self.judge(first.wrapping_add(k), first == EVALUATION_FIRST)?;
            budget.spend(work)?;
            Ok(found)
        };
        let all = (0..count).into_par_iter().map(one);
        all.try_reduce(|| ModelEvaluation::NOTHING, |a, b| Ok(sum(a, b)))
    }

    /// The counts of one configuration, and the work that it took.
    fn judge(&self, sample: u32, near_contact: bool) -> Result<(ModelEvaluation, u64), SkipReason> {
        let (configuration, poses) = self.poses.sampled(sample)?;
        let (collides, compared) = self.pieces.any_touches_and_work(&poses);
        let mut work = self.cost + COMPARISON * compared as u64;
        let cleared = u32::from(self.network.clears(&configuration));
        let mut found = ModelEvaluation::NOTHING;
        if !collides {
            found.num_free.0 = 1;
            found.num_cleared.0 = cleared;
            return Ok((found, work));
        }
        found.num_colliding.0 = 1;
        found.num_missed.0 = cleared;
        if near_contact {
            let (next, _) = self.poses.sampled(sample.wrapping_add(1))?;
            let poses = self.poses.of(&stepped(&configuration, &next))?;
            let (collides, compared) = self.pieces.any_touches_and_work(&poses);
            work += self.cost + COMPARISON * compared as u64;
            if !collides {
                found.num_near_contact.0 = 1;
                found.num_near_contact_missed.0 = cleared;
            }
        }
        Ok((found, work))
    }
}

/// SPEC 8.8.10: steps towards the next configuration, until a DOF has changed by 0.05 or the next is reached.
pub fn stepped(from: &[f64], next: &[f64]) -> Vec<f64> {
    let differences: Vec<f64> = next.iter().zip(from).map(|(b, a)| b - a).collect();
    let largest = differences.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
    let scale = (NEAR_CONTACT_STEP / largest).min(1.0);
    let moved = from.iter().zip(&differences).map(|(a, d)| a + scale * d);
    moved.collect()
}

fn sum(a: ModelEvaluation, b: ModelEvaluation) -> ModelEvaluation {
    let add = |a: Count, b: Count| Count(a.0 + b.0);
    ModelEvaluation {
        num_colliding: add(a.num_colliding, b.num_colliding),
        num_missed: add(a.num_missed, b.num_missed),
        num_near_contact: add(a.num_near_contact, b.num_near_contact),
        num_near_contact_missed: add(a.num_near_contact_missed, b.num_near_contact_missed),
        num_free: add(a.num_free, b.num_free),
        num_cleared: add(a.num_cleared, b.num_cleared),
    }
}
