//! Distances and collisions.

use std::sync::Arc;

use numpy::ndarray::IntoDimension;
use numpy::{
    Element, PyArray, PyArray1, PyArray2, PyArray3, PyReadonlyArray2, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use urdd_robot::{Cancellable, EdgeSettings, Overlap, PairDistance, RobotError};

use crate::arrays::{Batch, answers, shaped};
use crate::errors::of_robot;
use crate::obstacle::{Obstacle, objects_of};

/// The names of the two links or attached objects, the indices of their pieces, the distance, the distance divided by the pair's mean, and the
/// closest points.
type Near = ([String; 2], [usize; 2], f64, Option<f64>, [[f64; 3]; 2]);

/// A pair, its depth, its direction, and the gradient of its depth.
pub type Overlapping<N> = (N, f64, [f64; 3], Vec<f64>);

pub fn overlapping<P, N>(found: Vec<Overlap<P>>, near: impl Fn(&P) -> N) -> Vec<Overlapping<N>> {
    let found = found.into_iter();
    found.map(|one| (near(&one.pair), one.depth, one.direction, one.gradient)).collect()
}

/// The shapes of one kind, prepared for distances.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct Proximity(Arc<urdd_robot::Proximity>);

impl Proximity {
    pub fn of(proximity: urdd_robot::Proximity) -> Self {
        Proximity(Arc::new(proximity))
    }

    pub fn shared(&self) -> Arc<urdd_robot::Proximity> {
        Arc::clone(&self.0)
    }

    /// The results of a batch of configurations, in this shape.
    fn each<'py, T: Element + Copy, S: IntoDimension>(
        &self,
        py: Python<'py>,
        configurations: &PyReadonlyArray2<'py, f64>,
        shape: S,
        write: impl FnOnce(&Cancellable<'_>, &[f64], &mut [T]) -> Result<(), RobotError> + Send,
    ) -> PyResult<Bound<'py, PyArray<T, S::Dim>>> {
        let batch = Batch::new(configurations)?;
        answers(py, shape, 1, batch.is_one(), |cancellation, out| {
            write(&self.0.cancellable(cancellation), &batch.values, out)
        })
    }

    /// Pairs in one configuration, with their closest points.
    fn near(
        &self,
        py: Python<'_>,
        configuration: &PyReadonlyArray2<'_, f64>,
        ask: impl FnOnce(&urdd_robot::Proximity, &[f64]) -> Result<Vec<PairDistance>, RobotError> + Send,
    ) -> PyResult<Vec<Near>> {
        let batch = Batch::new(configuration)?;
        let found = py.detach(|| ask(&self.0, &batch.values));
        let found = found.map_err(|error| of_robot(py, &error))?;
        Ok(found.iter().map(near).collect())
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

    /// (pairs, 2, 2): the link and the piece of both shapes of each pair.
    fn pairs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<usize>>> {
        let numbers = self.0.pairs().flatten().flat_map(|(link, piece)| [link, piece]);
        shaped(py, numbers.collect(), [self.0.num_pairs(), 2, 2])
    }

    /// The names of the links of each pair, or of attached objects.
    fn pair_names(&self) -> Vec<[&str; 2]> {
        self.0.pair_names().collect()
    }

    /// (pairs, 2): the body of both shapes of each pair.
    fn pair_bodies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<usize>>> {
        shaped(py, self.0.pair_bodies().flatten().collect(), [self.0.num_pairs(), 2])
    }

    /// The names of links, then of attached objects.
    fn bodies(&self) -> Vec<&str> {
        (0..self.0.num_bodies()).filter_map(|body| self.0.body_name(body)).collect()
    }

    /// These shapes, without pairs of bodies.
    fn without(&self, py: Python<'_>, pairs: Vec<[String; 2]>) -> PyResult<Proximity> {
        let with = self.0.without(pairs.iter().map(|pair| pair.each_ref().map(String::as_str)));
        with.map(Proximity::of).map_err(|error| of_robot(py, &error))
    }

    /// These shapes, without those of these bodies.
    fn without_bodies(&self, py: Python<'_>, names: Vec<String>) -> PyResult<Proximity> {
        let with = self.0.without_bodies(names.iter().map(String::as_str));
        with.map(Proximity::of).map_err(|error| of_robot(py, &error))
    }

    /// These shapes, and objects on a link, each with the names of those that may touch it.
    fn attach(
        &self,
        py: Python<'_>,
        link: usize,
        objects: Vec<(Py<Obstacle>, Vec<String>)>,
    ) -> PyResult<Proximity> {
        let mut with = Arc::clone(&self.0);
        for object in objects_of(&objects) {
            let more = with.attach(link, &object);
            with = Arc::new(more.map_err(|error| of_robot(py, &error))?);
        }
        Ok(Proximity(with))
    }

    /// (count, pairs).
    fn distances<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let shape = [configurations.shape()[0], self.0.num_pairs()];
        self.each(py, &configurations, shape, |proximity, all, out| {
            proximity.distances_batch_into(all, out)
        })
    }

    /// (count,); infinite if there are no pairs.
    fn self_distance<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let count = configurations.shape()[0];
        self.each(py, &configurations, count, |proximity, all, out| {
            proximity.self_distance_batch_into(all, out)
        })
    }

    /// (count,).
    fn in_collision<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let count = configurations.shape()[0];
        self.each(py, &configurations, count, |proximity, all, out| {
            proximity.in_collision_batch_into(all, out)
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
        self.each(py, &configurations, count, |proximity, all, out| {
            proximity.is_within_batch_into(all, margin, out)
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
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let count = ends.shape()[0];
        let from = Batch::new(&starts)?;
        let settings = EdgeSettings { margin, resolution };
        self.each(py, &ends, count, |proximity, all, out| {
            proximity.blocked_edge_batch_into(&from.values, all, &settings, out)
        })
    }

    /// (count, 2): the last part of each straight motion that is free, and the first that is blocked; NaN where it is
    /// free.
    fn first_contact<'py>(
        &self,
        py: Python<'py>,
        starts: PyReadonlyArray2<'py, f64>,
        ends: PyReadonlyArray2<'py, f64>,
        margin: f64,
        resolution: Option<f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let shape = [ends.shape()[0], 2];
        let from = Batch::new(&starts)?;
        let settings = EdgeSettings { margin, resolution };
        self.each(py, &ends, shape, |proximity, all, out| {
            proximity.first_contact_batch_into(&from.values, all, &settings, out)
        })
    }

    /// The pairs that touch or overlap in one configuration: depth, direction, gradient.
    fn penetrations(
        &self,
        py: Python<'_>,
        configuration: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Vec<Overlapping<Near>>> {
        let batch = Batch::new(&configuration)?;
        let found = py.detach(|| self.0.penetrations(&batch.values));
        found.map(|found| overlapping(found, near)).map_err(|error| of_robot(py, &error))
    }

    /// The nearest pairs in one configuration, nearest first, with the gradients of their distances; `None` for pairs
    /// that touch.
    fn gradients(
        &self,
        py: Python<'_>,
        configuration: PyReadonlyArray2<'_, f64>,
        k: usize,
    ) -> PyResult<Vec<(Near, Option<Vec<f64>>)>> {
        let batch = Batch::new(&configuration)?;
        let found = py.detach(|| self.0.gradients(&batch.values, k));
        let found = found.map_err(|error| of_robot(py, &error))?;
        let each = found.into_iter();
        Ok(each.map(|found| (near(&found.pair), found.gradient)).collect())
    }

    /// The nearest pairs in one configuration, nearest first.
    fn nearest(
        &self,
        py: Python<'_>,
        configuration: PyReadonlyArray2<'_, f64>,
        k: usize,
    ) -> PyResult<Vec<Near>> {
        self.near(py, &configuration, |proximity, q| proximity.nearest(q, k))
    }

    /// The pairs that touch or overlap in one configuration.
    fn collisions(
        &self,
        py: Python<'_>,
        configuration: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Vec<Near>> {
        self.near(py, &configuration, urdd_robot::Proximity::collisions)
    }
}

fn near(pair: &PairDistance) -> Near {
    (
        pair.links.each_ref().map(ToString::to_string),
        pair.pieces,
        pair.distance,
        pair.relative,
        pair.points,
    )
}
