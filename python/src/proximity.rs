//! Distances and collisions.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArray3, PyReadonlyArray2};
use pyo3::prelude::*;
use urdd::robot::{PairDistance, RobotError, Until};

use crate::arrays::{Batch, shaped};
use crate::errors::of_robot;
use crate::work;

/// The indices of the two links and their pieces, the distance, the same over the pair's mean, and two points.
type Near = ([usize; 2], [usize; 2], f64, Option<f64>, [[f64; 3]; 2]);

/// The shapes of one kind, prepared for distances.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct Proximity(Arc<urdd::robot::Proximity>);

impl Proximity {
    pub fn of(proximity: urdd::robot::Proximity) -> Self {
        Proximity(Arc::new(proximity))
    }

    pub fn shared(&self) -> Arc<urdd::robot::Proximity> {
        Arc::clone(&self.0)
    }

    /// What each of many configurations gives.
    fn each<T: Copy + Send + 'static>(
        &self,
        py: Python<'_>,
        batch: Batch,
        one: impl FnOnce(&urdd::robot::Proximity, &[f64]) -> Result<Vec<T>, RobotError> + Send,
        many: impl FnOnce(&Until<'_>, &[f64]) -> Result<Vec<T>, RobotError> + Send + 'static,
    ) -> PyResult<Vec<T>> {
        work::ask(py, &self.0, batch, one, |own, cancellation, batch| {
            many(&own.until(cancellation), &batch.values)
        })
    }
}

#[pymethods]
impl Proximity {
    #[getter]
    fn kind(&self) -> &'static str {
        self.0.kind().name()
    }

    #[getter]
    fn num_shapes(&self) -> usize {
        self.0.num_shapes()
    }

    #[getter]
    fn num_pairs(&self) -> usize {
        self.0.num_pairs()
    }

    /// (pairs, 2, 2): of each pair and each of its two shapes the link and the piece.
    fn pairs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<usize>>> {
        let numbers = self
            .0
            .pairs()
            .flatten()
            .flat_map(|(link, piece)| [link, piece]);
        shaped(py, numbers.collect(), [self.0.num_pairs(), 2, 2])
    }

    /// (count, pairs).
    fn distances<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let batch = Batch::new(&configurations);
        let count = batch.count;
        let values = self.each(
            py,
            batch,
            |proximity, q| proximity.distance_values(q),
            |proximity, all| proximity.distances_batch(all),
        )?;
        shaped(py, values, [count, self.0.num_pairs()])
    }

    /// (count,); infinite where there is no pair.
    fn self_distance<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let values = self.each(
            py,
            Batch::new(&configurations),
            |proximity, q| Ok(vec![proximity.self_distance(q)?.unwrap_or(f64::INFINITY)]),
            |proximity, all| proximity.self_distance_batch(all),
        )?;
        Ok(PyArray1::from_vec(py, values))
    }

    /// (count,).
    fn in_collision<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let values = self.each(
            py,
            Batch::new(&configurations),
            |proximity, q| Ok(vec![proximity.in_collision(q)?]),
            |proximity, all| proximity.in_collision_batch(all),
        )?;
        Ok(PyArray1::from_vec(py, values))
    }

    /// The nearest pairs in one configuration, nearest first.
    fn nearest(
        &self,
        py: Python<'_>,
        configuration: PyReadonlyArray2<'_, f64>,
        k: usize,
    ) -> PyResult<Vec<Near>> {
        let batch = Batch::new(&configuration);
        let found = py.detach(|| self.0.nearest(&batch.values, k));
        found
            .map(|pairs| pairs.iter().map(near).collect())
            .map_err(|error| of_robot(py, &error))
    }

    /// The pairs that touch or overlap in one configuration.
    fn collisions(
        &self,
        py: Python<'_>,
        configuration: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Vec<Near>> {
        let batch = Batch::new(&configuration);
        let found = py.detach(|| self.0.collisions(&batch.values));
        found
            .map(|pairs| pairs.iter().map(near).collect())
            .map_err(|error| of_robot(py, &error))
    }
}

fn near(pair: &PairDistance) -> Near {
    (
        pair.link_idxs,
        pair.pieces,
        pair.distance,
        pair.relative,
        pair.points,
    )
}
