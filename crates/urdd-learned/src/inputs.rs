//! The network's inputs for a configuration: SPEC 8.8.3.

use nalgebra::{Matrix3, Vector3};

use super::network::ModelError;
use urdd_format::index::DofIdx;
use urdd_format::readable::counted;
use urdd_format::self_collision_model::ModelInput;

/// An input with valid indices.
#[derive(Debug, Clone, PartialEq)]
pub enum Input {
    /// Cosines and sines of an angle; the index of its DOF.
    Angle(usize),
    /// A length, scaled by its bounds.
    Length {
        dof: usize,
        /// Middle of its bounds, metres.
        middle: f64,
        /// Half the distance between its bounds, metres.
        half_range: f64,
    },
    /// The rotation matrix of a rotation vector; the indices of its DOFs.
    RotationVector([usize; 3]),
}

const MATRIX: usize = 9;
const WAVES: usize = 4;

/// Reads the inputs of a robot with `num_dofs` DOFs.
pub fn read(inputs: &[ModelInput], num_dofs: usize) -> Result<Vec<Input>, ModelError> {
    let check = |place: usize, key: &str, dof: DofIdx| {
        if dof.get() < num_dofs {
            return Ok(dof.get());
        }
        let dofs = counted(num_dofs, "DOF");
        let fault = format!("DOF {} is out of range: the robot has {dofs}", dof.get());
        Err(ModelError::new(format!("/inputs/{place}/{key}"), fault))
    };
    let read = |(place, input): (usize, &ModelInput)| {
        Ok(match input {
            ModelInput::Angle(of) => Input::Angle(check(place, "Angle/dof_idx", of.dof_idx)?),
            ModelInput::Length(of) => {
                let dof = check(place, "Length/dof_idx", of.dof_idx)?;
                let (middle, half_range) = (of.middle, of.half_range);
                if !(middle.is_finite() && half_range.is_finite() && half_range > 0.0) {
                    return Err(ModelError::number(format!("/inputs/{place}/Length")));
                }
                Input::Length { dof, middle, half_range }
            }
            ModelInput::RotationVector(of) => {
                let mut dofs = [0; 3];
                for (to, from) in dofs.iter_mut().zip(of.dof_idxs) {
                    *to = check(place, "RotationVector/dof_idxs", from)?;
                }
                Input::RotationVector(dofs)
            }
        })
    };
    inputs.iter().enumerate().map(read).collect()
}

/// Writes the values of all inputs to `row`, in order.
pub fn write(inputs: &[Input], configuration: &[f64], mut row: &mut [f64]) {
    for input in inputs {
        let (own, rest) = row.split_at_mut(input.width());
        input.put(configuration, own);
        row = rest;
    }
}

impl Input {
    /// Number of values of this input.
    pub fn width(&self) -> usize {
        match self {
            Input::Angle(_) => WAVES,
            Input::Length { .. } => 1,
            Input::RotationVector(_) => MATRIX,
        }
    }

    /// Writes its [`Input::width`] values.
    pub fn put(&self, configuration: &[f64], values: &mut [f64]) {
        match *self {
            Input::Angle(dof) => {
                let q = configuration[dof];
                let waves = [libm::sin(q), libm::cos(q), libm::sin(2.0 * q), libm::cos(2.0 * q)];
                values.copy_from_slice(&waves);
            }
            Input::Length { dof, middle, half_range } => {
                values[0] = (configuration[dof] - middle) / half_range
            }
            Input::RotationVector(dofs) => {
                let rotation = rotation(dofs.map(|dof| configuration[dof]));
                values.copy_from_slice(rotation.transpose().as_slice());
            }
        }
    }

    /// Adds the gradient with respect to its values, transformed by the chain rule, to the gradient with respect to the
    /// DOFs.
    pub fn pull_back(&self, configuration: &[f64], by_values: &[f64], by_dofs: &mut [f64]) {
        match *self {
            Input::Angle(dof) => {
                let q = configuration[dof];
                let waves = [
                    libm::cos(q),
                    -libm::sin(q),
                    2.0 * libm::cos(2.0 * q),
                    -2.0 * libm::sin(2.0 * q),
                ];
                let products = waves.iter().zip(by_values).map(|(a, b)| a * b);
                by_dofs[dof] += products.sum::<f64>();
            }
            Input::Length { dof, half_range, .. } => by_dofs[dof] += by_values[0] / half_range,
            Input::RotationVector(dofs) => {
                let v = dofs.map(|dof| configuration[dof]);
                for (k, dof) in dofs.into_iter().enumerate() {
                    let derivative = rotation_derivative(v, k).transpose();
                    let products = derivative.iter().zip(by_values).map(|(a, b)| a * b);
                    by_dofs[dof] += products.sum::<f64>();
                }
            }
        }
    }
}

/// The rotation by |v| about v / |v|.
fn rotation(v: [f64; 3]) -> Matrix3<f64> {
    let v = Vector3::from(v);
    let angle = v.norm();
    let cross = v.cross_matrix();
    // sin x / x and (1 - cos x) / x^2, replaced near 0 by their series.
    let (a, b) = if angle < 1e-4 {
        (1.0 - angle * angle / 6.0, 0.5 - angle * angle / 24.0)
    } else {
        let half = libm::sin(0.5 * angle) / (0.5 * angle);
        (libm::sin(angle) / angle, 0.5 * half * half)
    };
    Matrix3::identity() + cross * a + cross * cross * b
}

/// The derivative of [`rotation`] with respect to component `k` of the rotation vector (Gallego and Yezzi, 2015).
fn rotation_derivative(v: [f64; 3], k: usize) -> Matrix3<f64> {
    let rotation = rotation(v);
    let v = Vector3::from(v);
    let unit = Vector3::ith(k, 1.0);
    let squared = v.norm_squared();
    if squared < 1e-16 {
        return unit.cross_matrix();
    }
    let turned = v.cross(&(unit - rotation * unit));
    (v.cross_matrix() * v[k] + turned.cross_matrix()) / squared * rotation
}
