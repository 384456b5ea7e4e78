//! Distances and collisions between the links of a robot.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArray3, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use urdd_robot::{EdgeSettings, Obstruction, PairDistance, Queries};

use crate::arrays::{Batch, shaped};
use crate::errors::of_robot;
use crate::obstacle::{Obstacle, objects_of};
use crate::queries::{Asked, queries};

/// The names of the two links or attached objects, the indices of their pieces, the distance, the distance divided by the
/// pair's mean, and the closest points.
type Near = ([String; 2], [usize; 2], f64, Option<f64>, [[f64; 3]; 2]);

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
}

impl Asked for Proximity {
    type Of = urdd_robot::Proximity;
    type Pair = PairDistance;
    type Near = Near;

    fn queries(&self) -> &Self::Of {
        &self.0
    }

    fn near(pair: &PairDistance) -> Near {
        let links = pair.links.each_ref().map(ToString::to_string);
        (links, pair.pieces, pair.distance, pair.relative, pair.points)
    }
}

queries!(Proximity, Near);

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

    /// The pairs that touch or overlap in one configuration.
    fn collisions(
        &self,
        py: Python<'_>,
        configuration: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Vec<Near>> {
        let found = self.one(py, &configuration, Queries::collisions)?;
        Ok(found.iter().map(Self::near).collect())
    }
}
