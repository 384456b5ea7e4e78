//! NumPy arrays as inputs and outputs.

use nalgebra::Isometry3;
use numpy::ndarray::{Dimension, IntoDimension};
use numpy::{
    Element, IntoPyArray, PyArray, PyArrayMethods, PyReadonlyArray, PyReadonlyArray2,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::pose::write_matrix;
use urdd_robot::{RobotError, has_room};

use crate::errors::of_robot;
use crate::work;

/// Maximum size of an array, in bytes, that is allocated without a memory check.
const SMALL: usize = 1 << 20;
/// Additional memory for work on a large array, in bytes: scratch space of the threads.
const BESIDES: usize = 64 << 20;

/// Configurations, one per row, in their own memory.
pub struct Batch {
    pub count: usize,
    pub values: Vec<f64>,
}

impl Batch {
    pub fn new(array: &PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        Ok(Batch { count: array.shape()[0], values: copy(array)? })
    }

    /// The values of a configuration; empty for a robot without DOFs.
    pub fn row(&self, k: usize) -> &[f64] {
        let dofs = self.values.len() / self.count.max(1);
        &self.values[k * dofs..(k + 1) * dofs]
    }

    /// Whether all configurations are identical, as for a robot without DOFs.
    pub fn is_one(&self) -> bool {
        self.values.is_empty()
    }
}

/// The values of an array in row-major order.
pub fn copy<T: Element + Copy, D: Dimension>(
    array: &PyReadonlyArray<'_, T, D>,
) -> PyResult<Vec<T>> {
    let values = array.as_slice()?;
    let mut own = Vec::new();
    let room = own.try_reserve_exact(values.len());
    room.map_err(|_| no_memory(size_of_val(values)))?;
    own.extend_from_slice(values);
    Ok(own)
}

/// Zeros of a shape that depends on the caller. Raises `MemoryError`, as NumPy does, if there is not enough memory.
pub fn zeros<'py, T: Element, S: IntoDimension>(
    py: Python<'py>,
    shape: S,
) -> PyResult<Bound<'py, PyArray<T, S::Dim>>> {
    let shape = shape.into_dimension();
    // As in NumPy, an axis of length 0 does not hide the size of the others.
    let mut each = shape.slice().iter().map(|length| (*length).max(1));
    let bytes = each.try_fold(size_of::<T>(), usize::checked_mul);
    let bytes = bytes.filter(|bytes| isize::try_from(*bytes).is_ok());
    if bytes.is_some_and(|bytes| bytes <= SMALL) {
        return Ok(PyArray::zeros(py, shape, false));
    }
    let Some(bytes) = bytes else {
        let shape = shape.slice();
        let words = format!("an array of the shape {shape:?} is larger than any memory");
        return Err(PyMemoryError::new_err(words));
    };
    if !has_room(bytes) {
        return Err(no_memory(bytes));
    }
    let lengths = PyTuple::new(py, shape.slice())?;
    let made = py.import("numpy")?.call_method1("zeros", (lengths, T::get_dtype(py)))?;
    check_memory(BESIDES)?;
    Ok(made.cast_into::<PyArray<T, S::Dim>>()?)
}

/// Raises `MemoryError` if `bytes` bytes are not available. Does not reserve them: another thread may take them.
pub fn check_memory(bytes: usize) -> PyResult<()> {
    if !has_room(bytes) {
        return Err(no_memory(bytes));
    }
    let mut probe: Vec<u8> = Vec::new();
    let room = probe.try_reserve_exact(bytes);
    // Prevents the compiler from removing the unused allocation.
    std::hint::black_box(&mut probe);
    room.map_err(|_| no_memory(bytes))
}

fn no_memory(bytes: usize) -> PyErr {
    let mebibytes = bytes.div_ceil(1 << 20);
    let words = format!("there are no {mebibytes} MiB of memory left: ask for less at once");
    PyMemoryError::new_err(words)
}

/// The results of a batch of configurations, in an array whose first axis is the configuration, as `write` writes them:
/// on this thread for `few` or fewer configurations, otherwise on the thread pool, until Ctrl-C. If all configurations
/// are `the_same`, it writes the results of the first, which are copied.
pub fn answers<'py, T: Element + Copy, S: IntoDimension>(
    py: Python<'py>,
    shape: S,
    few: usize,
    the_same: bool,
    write: impl FnOnce(&Cancellation, &mut [T]) -> Result<(), RobotError> + Send,
) -> PyResult<Bound<'py, PyArray<T, S::Dim>>> {
    let array = zeros(py, shape)?;
    let count = array.shape()[0];
    let mut guard = array.readwrite();
    let out = guard.as_slice_mut()?;
    let width = out.len() / count.max(1);
    let written = if count == 0 {
        Ok(())
    } else if the_same {
        let (first, others) = out.split_at_mut(width);
        let found = py.detach(|| write(&Cancellation::default(), first));
        let others = others.chunks_exact_mut(width.max(1));
        others.for_each(|other| other.copy_from_slice(first));
        found
    } else if count <= few {
        py.detach(|| write(&Cancellation::default(), out))
    } else {
        work::run(py, |cancellation| write(cancellation, out))?
    };
    drop(guard);
    written.map_err(|error| of_robot(py, &error))?;
    Ok(array)
}

/// An array of this shape that takes ownership of the values.
pub fn shaped<'py, T: Element, S: IntoDimension>(
    py: Python<'py>,
    values: Vec<T>,
    shape: S,
) -> PyResult<Bound<'py, PyArray<T, S::Dim>>> {
    values.into_pyarray(py).reshape(shape)
}

/// The matrix of a pose.
pub fn matrix(pose: &Isometry3<f64>) -> [f64; 16] {
    let mut out = [0.0; 16];
    write_matrix(pose, &mut out);
    out
}
