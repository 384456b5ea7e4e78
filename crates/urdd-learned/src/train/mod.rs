//! Training of the self-collision model. SPEC 8.8 defines the model; this module trains it.
//!
//! Each pair of links that comes near has one output. For training, distances are clipped at the clip distance. Beyond
//! it an output only has to be at least that large; in contact it only has to lie some distance below 0. The network
//! can thus continue smoothly beyond both ends. Margins are then chosen on separate configurations, so that few
//! collisions are missed and as many free configurations as possible are cleared. The stated counts come from the
//! configurations that the specification reserves for evaluation.
//!
//! The settings are the same for every robot: tuned on UR5, Panda, xArm7, Z1, H1 and Orca.
//!
//! The result is identical to the bit for any number of threads.

#[doc(hidden)]
pub mod calibration;
#[doc(hidden)]
pub mod labels;
mod optimiser;
mod subject;

pub use subject::{Effort, NoModel, Subject};

use crate::inputs::{self, Input};
use crate::model::CollisionModel;
use crate::network::{Layer, Network};
use labels::{Counted, Labels};
use optimiser::SEED;
use subject::{model_inputs, rounded};
use urdd_directory::cancellation::Cancellation;
use urdd_format::index::{Count, LinkIdx, SampleIdx};
use urdd_format::self_collision_model::{
    CONFIRMATION_COUNT, CONFIRMATION_FIRST, EVALUATION_COUNT, EVALUATION_FIRST, LinkPair,
    ModelEvaluation, ModelInput, ModelLayer, ModelPair, ModelTestVector, SampleRange,
    SelfCollisionModelModule,
};
use urdd_kinematics::unit;

/// Version of the training; changed whenever the trained model changes.
pub const VERSION: &str = "2";
/// Maximum number of pairs of links: labels take 4 bytes per pair and configuration.
pub const MAX_PAIRS: usize = 512;
/// Maximum number of DOFs: a configuration takes 8 bytes per DOF, and its network inputs 32.
const MAX_DOFS: usize = 100;
/// A pair gets an output if it comes nearer than this, as a fraction of the clip distance.
const NEAR: f64 = 0.5;
/// Size of each of the two hidden layers.
const HIDDEN: usize = 64;
/// Initial value of all outputs, as a fraction of the clip distance.
const FIRST_OUTPUT: f64 = 0.7;
/// Maximum number of training attempts, each with different initial weights. By chance, the rates of about one in a
/// hundred honest models are not confirmed (SPEC 8.8.12).
const ATTEMPTS: u64 = 3;
/// Number of sampled configurations among the test vectors.
const TEST_VECTORS: u32 = 8;

/// Trains a model. `progress` receives the finished and the total steps.
///
/// # Errors
/// If a model would be of no use, a configuration has no valid poses, or training is cancelled.
pub fn train(
    subject: Subject,
    cancellation: &Cancellation,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<SelfCollisionModelModule, NoModel> {
    let model_inputs = model_inputs(&subject)?;
    let (num_pairs, num_dofs) = (subject.pairs.bodies().len(), subject.space.num_dofs());
    let useless = |why: String| Err(NoModel::OfNoUse(why));
    if num_pairs > MAX_PAIRS {
        return useless(format!(
            "more than {MAX_PAIRS} pairs of links are not skipped, and a model of so many is no faster than exact distances"
        ));
    }
    if num_dofs > MAX_DOFS {
        return useless(format!(
            "the robot has {num_dofs} DOFs, but a model supports at most {MAX_DOFS}"
        ));
    }
    let inputs = inputs::read(&model_inputs, num_dofs).unwrap_or_default();
    if num_pairs == 0 || inputs.is_empty() {
        return useless("no two links that are not skipped move relative to each other".to_owned());
    }
    // Computing the labels takes about as long as a few epochs.
    let total = subject.effort.epochs as usize + 3;
    let [training, calibration] = subject.effort.ranges();
    let step = |done: usize| progress(done, total);
    step(0);
    let mut training = Labels::new(&subject, training, cancellation)?;
    training.check()?;
    let near = training.near_pairs(NEAR * subject.clip_distance());
    training.keep(&near);
    step(1);
    let mut calibration = Labels::new(&subject, calibration, cancellation)?;
    calibration.keep(&near);
    step(2);
    let counted = |[first, count]: [u32; 2]| Counted::new(&subject, [first, count], cancellation);
    let evaluated = counted([EVALUATION_FIRST, EVALUATION_COUNT])?;
    evaluated.check()?;
    let confirming = counted([CONFIRMATION_FIRST, CONFIRMATION_COUNT])?;
    let examples = [training.inputs(&inputs), calibration.inputs(&inputs)];
    for attempt in 0..ATTEMPTS {
        let mut network = start(&inputs, near.len(), attempt);
        optimiser::train(
            &mut network,
            (&examples[0], &training),
            (&examples[1], &calibration),
            subject.effort.epochs as usize,
            cancellation,
            &|epoch| step(2 + epoch),
        )?;
        let (mut module, model) = module(&subject, &model_inputs, &network, &near, &calibration)?;
        module.evaluation = evaluated.count(&model)?;
        let own = counted([labels::second_confirmation(&module), CONFIRMATION_COUNT])?;
        let found = [confirming.count(&model)?, own.count(&model)?];
        if found.iter().all(|found| confirms(&module.evaluation, found)) {
            step(total);
            return Ok(module);
        }
    }
    let attempts = ATTEMPTS;
    useless(format!("the rates of {attempts} models were not confirmed on other configurations"))
}

/// Whether the rates found do not contradict the stated ones: SPEC 8.8.12.
fn confirms(stated: &ModelEvaluation, found: &ModelEvaluation) -> bool {
    let misses_more = found.miss_rate().is_above(&stated.miss_rate());
    !misses_more && !stated.clear_rate().is_above(&found.clear_rate())
}

/// A network with pseudorandom weights whose outputs start above 0.
fn start(inputs: &[Input], num_outputs: usize, attempt: u64) -> Network {
    let width: usize = inputs.iter().map(Input::width).sum();
    let widths = [width, HIDDEN, HIDDEN, num_outputs];
    // Distinct from the sequences that shuffle the examples.
    let sequence = SEED + (attempt << 24);
    let mut drawn = 0;
    let mut layer = |pair: &[usize]| {
        let (before, after) = (pair[0], pair[1]);
        // Glorot and Bengio (2010): the values of each layer have the same variance as those before.
        let most = (6.0 / (before + after) as f64).sqrt();
        let mut weight = || {
            drawn += 1;
            (2.0 * unit(sequence, drawn) - 1.0) * most
        };
        Layer { weights: (0..before * after).map(|_| weight()).collect(), biases: vec![0.0; after] }
    };
    let mut layers: Vec<Layer> = widths.windows(2).map(&mut layer).collect();
    if let Some(last) = layers.last_mut() {
        last.biases.fill(FIRST_OUTPUT);
    }
    Network { layers }
}

/// The layers as stored in the module: rounded, with outputs in metres.
fn layers(network: &Network, clip_distance: f64) -> Vec<ModelLayer> {
    let last = network.layers.len().saturating_sub(1);
    let layer = |(place, layer): (usize, &Layer)| {
        let unit = if place == last { clip_distance } else { 1.0 };
        let of = |numbers: &[f64]| numbers.iter().map(|x| rounded(unit * x)).collect();
        let rows = layer.weights.chunks_exact(layer.num_inputs().max(1));
        ModelLayer { weights: rows.map(of).collect(), biases: of(&layer.biases) }
    };
    network.layers.iter().enumerate().map(layer).collect()
}

/// The module without its counts, and the model that it defines.
fn module(
    subject: &Subject,
    inputs: &[ModelInput],
    network: &Network,
    near: &[usize],
    calibration: &Labels,
) -> Result<(SelfCollisionModelModule, CollisionModel), NoModel> {
    let links: Vec<[LinkIdx; 2]> = subject
        .pairs
        .bodies()
        .map(|bodies| bodies.map(|link| LinkIdx(u32::try_from(link).unwrap_or(u32::MAX))))
        .collect();
    let others = (0..links.len()).filter(|pair| !near.contains(pair));
    let pairs = near.iter().map(|pair| ModelPair {
        link_a_idx: links[*pair][0],
        link_b_idx: links[*pair][1],
        margin: 0.0,
    });
    let range = |[first, count]: [u32; 2]| SampleRange {
        first_sample_idx: SampleIdx(first),
        num_configurations: Count(count),
    };
    let [trained, calibrated] = subject.effort.ranges();
    let mut module = SelfCollisionModelModule {
        trained_on: subject.trained_on.clone(),
        clip_distance: subject.clip_distance(),
        layers: layers(network, subject.clip_distance()),
        inputs: inputs.to_vec(),
        pairs: pairs.collect(),
        other_pairs: others
            .map(|pair| LinkPair { link_a_idx: links[pair][0], link_b_idx: links[pair][1] })
            .collect(),
        training: range(trained),
        calibration: range(calibrated),
        evaluation: ModelEvaluation::NOTHING,
        test_vectors: Vec::new(),
    };
    let num_dofs = subject.space.num_dofs();
    let of = |module: &SelfCollisionModelModule| CollisionModel::new(module, num_dofs);
    // Valid: the module was built just above.
    let model = of(&module).unwrap_or_else(|error| unreachable!("{error}"));
    let outputs = model.clearances_batch(&calibration.configurations)?;
    let margins = calibration::margins(&outputs, calibration, module.clip_distance);
    for (pair, margin) in module.pairs.iter_mut().zip(margins) {
        pair.margin = rounded(margin);
    }
    let model = of(&module).unwrap_or_else(|error| unreachable!("{error}"));
    let samples = (0..TEST_VECTORS).map(|k| subject.space.sampled(u64::from(k)));
    let configurations = std::iter::once(subject.space.default_configuration()).chain(samples);
    let vector = |configuration: Vec<f64>| {
        Ok(ModelTestVector { clearances: model.clearances(&configuration)?, configuration })
    };
    module.test_vectors = configurations.map(vector).collect::<Result<_, NoModel>>()?;
    Ok((module, model))
}
