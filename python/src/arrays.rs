//! Arrays of numpy, in and out.

use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion};
use numpy::PyReadonlyArray3;
use numpy::ndarray::IntoDimension;
use numpy::{
    Element, IntoPyArray, PyArray, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods,
};
use pyo3::prelude::*;

/// Configurations, one a row, in memory of their own.
pub struct Batch {
    pub count: usize,
    pub values: Vec<f64>,
}

impl Batch {
    pub fn new(array: &PyReadonlyArray2<'_, f64>) -> Self {
        Batch {
            count: array.shape()[0],
            values: copy(array),
        }
    }

    /// The values of each configuration; of a robot without DOFs none.
    pub fn row(&self, k: usize) -> &[f64] {
        let dofs = self.values.len() / self.count.max(1);
        &self.values[k * dofs..(k + 1) * dofs]
    }
}

/// The values of an array, row after row.
pub fn copy(array: &PyReadonlyArray2<'_, f64>) -> Vec<f64> {
    array.as_array().iter().copied().collect()
}

/// The values of an array, row after row.
pub fn copy3(array: &PyReadonlyArray3<'_, f64>) -> Vec<f64> {
    array.as_array().iter().copied().collect()
}

/// An array of this shape, which takes over the values.
pub fn shaped<'py, T: Element, S: IntoDimension>(
    py: Python<'py>,
    values: Vec<T>,
    shape: S,
) -> PyResult<Bound<'py, PyArray<T, S::Dim>>> {
    values.into_pyarray(py).reshape(shape)
}

/// A pose as the 16 numbers of its matrix, row after row.
pub fn write_matrix(pose: &Isometry3<f64>, out: &mut [f64]) {
    let rotation = pose.rotation.to_rotation_matrix();
    let translation = &pose.translation.vector;
    for row in 0..3 {
        for column in 0..3 {
            out[4 * row + column] = rotation[(row, column)];
        }
        out[4 * row + 3] = translation[row];
    }
    out[12..16].copy_from_slice(&[0.0, 0.0, 0.0, 1.0]);
}

/// The matrix of a pose.
pub fn matrix(pose: &Isometry3<f64>) -> [f64; 16] {
    let mut out = [0.0; 16];
    write_matrix(pose, &mut out);
    out
}

/// The pose of 16 numbers, which are a rotation and a translation.
pub fn pose(matrix: &[f64]) -> Isometry3<f64> {
    let rotation = nalgebra::Matrix3::from_fn(|row, column| matrix[4 * row + column]);
    let rotation = Rotation3::from_matrix_unchecked(rotation);
    Isometry3::from_parts(
        Translation3::new(matrix[3], matrix[7], matrix[11]),
        UnitQuaternion::from_rotation_matrix(&rotation),
    )
}
