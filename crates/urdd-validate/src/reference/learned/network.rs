//! SPEC 8.8.3 and 8.8.4, implemented literally.

use nalgebra::{DMatrix, DVector};
use sha2::{Digest, Sha256};

use urdd_format::self_collision_model::{
    CONFIRMATION_SECOND, ModelInput, SelfCollisionModelModule,
};
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
