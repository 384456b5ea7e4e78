//! What is asked of a robot's own pairs and of those with obstacles, once for both classes.

use numpy::ndarray::IntoDimension;
use numpy::{Element, PyArray, PyReadonlyArray2};
use pyo3::prelude::*;
use urdd_directory::cancellation::Cancellation;
use urdd_robot::{Queries, RobotError};

use crate::arrays::{Batch, answers};
use crate::errors::of_robot;

/// A class whose pairs can be asked about.
pub trait Asked {
    type Of: Queries<Pair = Self::Pair>;
    /// What an answer says of a pair, in Rust and in Python.
    type Pair: Send;
    type Near;

    fn queries(&self) -> &Self::Of;

    fn near(pair: &Self::Pair) -> Self::Near;

    /// Raises `MemoryError` if there is not enough memory for a query on this many configurations.
    fn check_memory(&self, _count: usize) -> PyResult<()> {
        Ok(())
    }

    /// The results of a batch of configurations, in this shape.
    fn each<'py, T: Element + Copy, S: IntoDimension>(
        &self,
        py: Python<'py>,
        configurations: &PyReadonlyArray2<'py, f64>,
        shape: S,
        write: impl FnOnce(&Self::Of, &[f64], &Cancellation, &mut [T]) -> Result<(), RobotError> + Send,
    ) -> PyResult<Bound<'py, PyArray<T, S::Dim>>> {
        let batch = Batch::new(configurations)?;
        self.check_memory(batch.count)?;
        let of = self.queries();
        answers(py, shape, 1, batch.is_one(), |on, out| write(of, &batch.values, on, out))
    }

    /// The answer for one configuration.
    fn one<T: Send>(
        &self,
        py: Python<'_>,
        configuration: &PyReadonlyArray2<'_, f64>,
        ask: impl FnOnce(&Self::Of, &[f64]) -> Result<T, RobotError> + Send,
    ) -> PyResult<T> {
        let batch = Batch::new(configuration)?;
        self.check_memory(1)?;
        let of = self.queries();
        py.detach(|| ask(of, &batch.values)).map_err(|error| of_robot(py, &error))
    }
}

/// The methods of a class that is [`Asked`]; `$near` is its pair in Python.
macro_rules! queries {
    ($class:ty, $near:ty) => {
        #[pymethods]
        impl $class {
            /// (count, pairs).
            fn distances<'py>(
                &self,
                py: Python<'py>,
                configurations: PyReadonlyArray2<'py, f64>,
            ) -> PyResult<Bound<'py, PyArray2<f64>>> {
                let shape = [configurations.shape()[0], self.queries().num_pairs()];
                self.each(py, &configurations, shape, |of, all, on, out| {
                    of.distances_batch_into(all, on, out)
                })
            }

            /// (count,); infinite if there are no pairs.
            fn min_distance<'py>(
                &self,
                py: Python<'py>,
                configurations: PyReadonlyArray2<'py, f64>,
            ) -> PyResult<Bound<'py, PyArray1<f64>>> {
                let count = configurations.shape()[0];
                self.each(py, &configurations, count, |of, all, on, out| {
                    of.min_distance_batch_into(all, on, out)
                })
            }

            /// (count,).
            fn in_collision<'py>(
                &self,
                py: Python<'py>,
                configurations: PyReadonlyArray2<'py, f64>,
            ) -> PyResult<Bound<'py, PyArray1<bool>>> {
                let count = configurations.shape()[0];
                self.each(py, &configurations, count, |of, all, on, out| {
                    of.in_collision_batch_into(all, on, out)
                })
            }

            /// (count,): whether any pair is at most `margin` apart.
            fn is_within<'py>(
                &self,
                py: Python<'py>,
                configurations: PyReadonlyArray2<'py, f64>,
                margin: f64,
            ) -> PyResult<Bound<'py, PyArray1<bool>>> {
                let count = configurations.shape()[0];
                self.each(py, &configurations, count, |of, all, on, out| {
                    of.is_within_batch_into(all, margin, on, out)
                })
            }

            /// (count,): where each straight motion is blocked, from 0 to 1; NaN where it is free.
            fn blocked_edge<'py>(
                &self,
                py: Python<'py>,
                starts: PyReadonlyArray2<'py, f64>,
                ends: PyReadonlyArray2<'py, f64>,
                margin: f64,
                resolution: Option<f64>,
                open_loops: bool,
            ) -> PyResult<Bound<'py, PyArray1<f64>>> {
                let (count, from) = (ends.shape()[0], Batch::new(&starts)?);
                let settings = EdgeSettings { margin, resolution, open_loops };
                self.each(py, &ends, count, |of, all, on, out| {
                    of.blocked_edge_batch_into([&from.values, all], &settings, on, out)
                })
            }

            /// (count, 2): the last part of each straight motion that is free, and the first that is blocked; NaN where
            /// it is free.
            fn first_contact<'py>(
                &self,
                py: Python<'py>,
                starts: PyReadonlyArray2<'py, f64>,
                ends: PyReadonlyArray2<'py, f64>,
                margin: f64,
                resolution: Option<f64>,
                open_loops: bool,
            ) -> PyResult<Bound<'py, PyArray2<f64>>> {
                let (shape, from) = ([ends.shape()[0], 2], Batch::new(&starts)?);
                let settings = EdgeSettings { margin, resolution, open_loops };
                self.each(py, &ends, shape, |of, all, on, out| {
                    of.first_contact_batch_into([&from.values, all], &settings, on, out)
                })
            }

            /// (count,): what stops each motion: 0 for nothing, else by its place among `OBSTRUCTIONS`.
            fn obstruction<'py>(
                &self,
                py: Python<'py>,
                starts: PyReadonlyArray2<'py, f64>,
                ends: PyReadonlyArray2<'py, f64>,
                margin: f64,
                resolution: Option<f64>,
                open_loops: bool,
            ) -> PyResult<Bound<'py, PyArray1<u8>>> {
                let (count, from) = (ends.shape()[0], Batch::new(&starts)?);
                let settings = EdgeSettings { margin, resolution, open_loops };
                self.each(py, &ends, count, |of, all, on, out| {
                    let mut found = vec![None; count];
                    of.motion_batch_into([&from.values, all], &settings, on, &mut found)?;
                    for (out, found) in out.iter_mut().zip(found) {
                        *out = match found.map(|one| one.obstruction) {
                            None => 0,
                            Some(Obstruction::Open) => 2,
                            Some(Obstruction::Branch) => 3,
                            Some(_) => 1,
                        };
                    }
                    Ok(())
                })
            }

            /// The nearest pairs in one configuration, nearest first.
            fn nearest(
                &self,
                py: Python<'_>,
                configuration: PyReadonlyArray2<'_, f64>,
                k: usize,
            ) -> PyResult<Vec<$near>> {
                let found = self.one(py, &configuration, |of, q| of.nearest(q, k))?;
                Ok(found.iter().map(Self::near).collect())
            }

            /// The nearest pairs in one configuration, nearest first, with the gradients of their distances; `None` for
            /// pairs that touch.
            fn gradients(
                &self,
                py: Python<'_>,
                configuration: PyReadonlyArray2<'_, f64>,
                k: usize,
            ) -> PyResult<Vec<($near, Option<Vec<f64>>)>> {
                let found = self.one(py, &configuration, |of, q| of.gradients(q, k))?.into_iter();
                Ok(found.map(|one| (Self::near(&one.pair), one.gradient)).collect())
            }

            /// The pairs that touch or overlap in one configuration: depth, direction, gradient.
            fn penetrations(
                &self,
                py: Python<'_>,
                configuration: PyReadonlyArray2<'_, f64>,
            ) -> PyResult<Vec<($near, f64, [f64; 3], Vec<f64>)>> {
                let found = self.one(py, &configuration, Queries::penetrations)?.into_iter();
                let each = found
                    .map(|one| (Self::near(&one.pair), one.depth, one.direction, one.gradient));
                Ok(each.collect())
            }
        }
    };
}
pub(crate) use queries;
