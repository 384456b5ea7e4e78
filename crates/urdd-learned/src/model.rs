//! Evaluation of a self-collision model.

use fearless_simd::Level;
use rayon::prelude::*;

use super::inputs::{self, Input};
use super::network::{LANES, ModelError, Network};
use urdd_format::self_collision_model::{
    LinkPair, ModelEvaluation, ModelPair, SelfCollisionModelModule,
};
use urdd_kinematics::ConfigurationError;

/// An estimator of the clearance between a robot's links.
///
/// The clearance of a pair is in metres; 0 or less means that the pair may be in contact. Large clearances have no
/// exact meaning, because training clips distances. The result is an estimate, not a guarantee:
/// [`CollisionModel::evaluation`] states the error rates.
#[derive(Debug, Clone)]
pub struct CollisionModel {
    num_dofs: usize,
    inputs: Vec<Input>,
    network: Network,
    pairs: Vec<ModelPair>,
    other_pairs: Vec<LinkPair>,
    clip_distance: f64,
    evaluation: ModelEvaluation,
    level: Level,
}

/// The minimum clearance of a configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Clearance {
    /// The index of its pair in [`CollisionModel::pairs`].
    pub pair: usize,
    /// The clearance, metres.
    pub value: f64,
    /// Its gradient with respect to the DOFs, m/rad or m/m, for this pair. If two pairs have the minimum clearance, the
    /// minimum is not differentiable.
    pub gradient: Vec<f64>,
}

impl CollisionModel {
    /// Reads a model of a robot with `num_dofs` DOFs.
    ///
    /// # Errors
    /// [`ModelError`] if list lengths do not match, or an index or number is invalid.
    pub fn new(module: &SelfCollisionModelModule, num_dofs: usize) -> Result<Self, ModelError> {
        let inputs = inputs::read(&module.inputs, num_dofs)?;
        let width = inputs.iter().map(Input::width).sum();
        let network = Network::read(&module.layers, width, module.pairs.len())?;
        Ok(Self {
            num_dofs,
            inputs,
            network,
            pairs: module.pairs.clone(),
            other_pairs: module.other_pairs.clone(),
            clip_distance: module.clip_distance,
            evaluation: module.evaluation.clone(),
            level: Level::new(),
        })
    }

    /// Number of DOFs, which is the length of a configuration.
    pub fn num_dofs(&self) -> usize {
        self.num_dofs
    }

    /// The link pairs with an output, with their margins.
    pub fn pairs(&self) -> &[ModelPair] {
        &self.pairs
    }

    /// The link pairs that the model assumes to be always apart.
    pub fn other_pairs(&self) -> &[LinkPair] {
        &self.other_pairs
    }

    /// The distance at which training clips, metres.
    pub fn clip_distance(&self) -> f64 {
        self.clip_distance
    }

    /// Number of weights and biases.
    pub fn num_parameters(&self) -> usize {
        self.network.num_parameters()
    }

    /// Its accuracy on configurations that were not used to make it, as its module states. The validator verifies it.
    pub fn evaluation(&self) -> &ModelEvaluation {
        &self.evaluation
    }

    /// The clearance of each pair, in the order of [`CollisionModel::pairs`], metres. `configuration` has one value per
    /// DOF, rad or m.
    ///
    /// # Errors
    /// If the configuration has the wrong length or a value that is not finite.
    pub fn clearances(&self, configuration: &[f64]) -> Result<Vec<f64>, ConfigurationError> {
        let values = self.values_of_one(configuration)?;
        Ok(self.clearances_of(&values, 0).collect())
    }

    /// Whether any pair may be in contact: whether a clearance is 0 or less, or NaN.
    ///
    /// # Errors
    /// As [`CollisionModel::clearances`].
    pub fn may_collide(&self, configuration: &[f64]) -> Result<bool, ConfigurationError> {
        Ok(!is_clear(self.clearances(configuration)?))
    }

    /// The minimum clearance and its gradient; `None` for a model without pairs.
    ///
    /// # Errors
    /// As [`CollisionModel::clearances`].
    pub fn min_clearance(
        &self,
        configuration: &[f64],
    ) -> Result<Option<Clearance>, ConfigurationError> {
        let values = self.values_of_one(configuration)?;
        let clearances = self.clearances_of(&values, 0).enumerate();
        let least = clearances.min_by(|a, b| a.1.total_cmp(&b.1));
        Ok(least.map(|(pair, value)| {
            let gradient = self.gradient_of(configuration, &values, pair);
            Clearance { pair, value, gradient }
        }))
    }

    /// The gradient of a pair's clearance with respect to the DOFs, m/rad or m/m; `None` if the pair does not exist.
    ///
    /// # Errors
    /// As [`CollisionModel::clearances`].
    pub fn gradient(
        &self,
        configuration: &[f64],
        pair: usize,
    ) -> Result<Option<Vec<f64>>, ConfigurationError> {
        let values = self.values_of_one(configuration)?;
        let exists = pair < self.pairs.len();
        Ok(exists.then(|| self.gradient_of(configuration, &values, pair)))
    }

    /// The clearances in many configurations, which are concatenated: value `k * pairs + pair` is that of `pair` in
    /// configuration `k`. Uses all threads of rayon's pool. Ignores values after the last complete configuration.
    ///
    /// # Errors
    /// As [`CollisionModel::clearances`], for the first invalid configuration.
    pub fn clearances_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, ConfigurationError> {
        self.batch(configurations, |clearances, out: &mut Vec<f64>| {
            out.extend(clearances);
        })
    }

    /// Whether any pair may be in contact in each of many configurations, as [`CollisionModel::may_collide`].
    ///
    /// # Errors
    /// As [`CollisionModel::clearances_batch`].
    pub fn may_collide_batch(
        &self,
        configurations: &[f64],
    ) -> Result<Vec<bool>, ConfigurationError> {
        self.batch(configurations, |clearances, out| {
            out.push(!is_clear(clearances));
        })
    }

    /// The minimum clearance in each of many configurations, metres; infinite for a model without pairs, NaN if a
    /// clearance is NaN.
    ///
    /// # Errors
    /// As [`CollisionModel::clearances_batch`].
    pub fn min_clearance_batch(
        &self,
        configurations: &[f64],
    ) -> Result<Vec<f64>, ConfigurationError> {
        self.batch(configurations, |clearances, out| {
            // `f64::min` would ignore NaN, and an unknown clearance would count as clear.
            let least = |least: f64, clearance: f64| {
                if least < clearance || least.is_nan() { least } else { clearance }
            };
            out.push(clearances.fold(f64::INFINITY, least));
        })
    }

    /// Evaluates configurations in batches; `take` appends the result for each configuration's clearances.
    fn batch<T: Send>(
        &self,
        configurations: &[f64],
        take: impl Fn(&mut dyn Iterator<Item = f64>, &mut Vec<T>) + Sync,
    ) -> Result<Vec<T>, ConfigurationError> {
        let blocks: Vec<Result<Vec<T>, ConfigurationError>> = configurations
            .par_chunks(LANES * self.num_dofs)
            .map_init(
                || self.network.buffers::<LANES>(),
                |values, block| {
                    self.write_values(block, values)?;
                    let count = block.len() / self.num_dofs;
                    let mut results = Vec::with_capacity(count);
                    for lane in 0..count {
                        take(&mut self.clearances_of(values, lane), &mut results);
                    }
                    Ok(results)
                },
            )
            .collect();
        Ok(blocks.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
    }

    /// Writes the network's inputs for at most `N` configurations, and the values after each layer. Ignores values after
    /// the last complete configuration.
    fn write_values<const N: usize>(
        &self,
        configurations: &[f64],
        values: &mut [Vec<[f64; N]>],
    ) -> Result<(), ConfigurationError> {
        let mut inputs = vec![0.0; values[0].len()];
        for (lane, configuration) in configurations.chunks_exact(self.num_dofs).enumerate() {
            ConfigurationError::check(configuration, self.num_dofs)?;
            inputs::write(&self.inputs, configuration, &mut inputs);
            for (lanes, input) in values[0].iter_mut().zip(&inputs) {
                lanes[lane] = *input;
            }
        }
        self.network.values(self.level, values);
        Ok(())
    }

    fn values_of_one(&self, q: &[f64]) -> Result<Vec<Vec<[f64; 1]>>, ConfigurationError> {
        ConfigurationError::check(q, self.num_dofs)?;
        let mut values = self.network.buffers();
        self.write_values(q, &mut values)?;
        Ok(values)
    }

    /// The clearances of one of `N` configurations, from the values after each layer.
    fn clearances_of<const N: usize>(
        &self,
        values: &[Vec<[f64; N]>],
        lane: usize,
    ) -> impl Iterator<Item = f64> {
        let outputs = values.last().into_iter().flatten().zip(&self.pairs);
        outputs.map(move |(value, pair)| value[lane] - pair.margin)
    }

    fn gradient_of(&self, q: &[f64], values: &[Vec<[f64; 1]>], pair: usize) -> Vec<f64> {
        let by_inputs = self.network.derivative(values, pair);
        let mut rest = by_inputs.as_slice();
        let mut by_dofs = vec![0.0; self.num_dofs];
        for input in &self.inputs {
            let own = rest.split_off(..input.width()).unwrap_or_default();
            input.pull_back(q, own, &mut by_dofs);
        }
        by_dofs
    }
}

/// Whether every clearance is above 0.
fn is_clear(clearances: impl IntoIterator<Item = f64>) -> bool {
    clearances.into_iter().all(|clearance| clearance > 0.0)
}
