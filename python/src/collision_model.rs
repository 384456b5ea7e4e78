//! The learned self-collision model.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;
use urdd::format::index::LinkIdx;
use urdd::kinematics::ConfigurationError;
use urdd::robot::RobotError;

use crate::arrays::{Batch, shaped};
use crate::errors::of_robot;
use crate::work;

/// Configurations that are looked at without other threads, whose waking takes longer.
const FEW: usize = 16;
/// Configurations between two looks whether to stop.
const BETWEEN_LOOKS: usize = 16_384;

type Model = urdd::robot::CollisionModel;
type Answer<T> = Result<Vec<T>, ConfigurationError>;

/// A network that estimates how near links are.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct CollisionModel(Arc<Model>);

impl CollisionModel {
    pub fn of(model: Model) -> Self {
        CollisionModel(Arc::new(model))
    }

    /// What each of many configurations gives, by `many` block after block; of a few by `one`, on this thread.
    fn each<T: Send + 'static>(
        &self,
        py: Python<'_>,
        batch: Batch,
        one: impl Fn(&Model, &[f64]) -> Answer<T> + Send,
        many: impl Fn(&Model, &[f64]) -> Answer<T> + Send + 'static,
    ) -> PyResult<Vec<T>> {
        let answer = if batch.count <= FEW {
            let own = &*self.0;
            py.detach(move || -> Result<Vec<T>, RobotError> {
                let mut all = Vec::new();
                for k in 0..batch.count {
                    all.extend(one(own, batch.row(k))?);
                }
                Ok(all)
            })
        } else {
            let own = Arc::clone(&self.0);
            work::run(py, move |cancellation| -> Result<Vec<T>, RobotError> {
                let mut all = Vec::new();
                for block in batch.values.chunks(BETWEEN_LOOKS * own.num_dofs().max(1)) {
                    cancellation.check()?;
                    all.extend(many(&own, block)?);
                }
                Ok(all)
            })?
        };
        answer.map_err(|error| of_robot(py, &error))
    }
}

#[pymethods]
impl CollisionModel {
    #[getter]
    fn num_pairs(&self) -> usize {
        self.0.pairs().len()
    }

    #[getter]
    fn num_parameters(&self) -> usize {
        self.0.num_parameters()
    }

    #[getter]
    fn clip_distance(&self) -> f64 {
        self.0.clip_distance()
    }

    /// The first configuration, and how many there are, collide, are missed, and are cleared.
    #[getter]
    fn held_out(&self) -> [u32; 5] {
        let of = self.0.held_out();
        [
            of.first_sample_idx.0,
            of.num_configurations.0,
            of.num_colliding.0,
            of.num_missed.0,
            of.num_cleared.0,
        ]
    }

    /// (pairs, 2): the links of each pair.
    fn pairs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<usize>>> {
        let pairs = self.0.pairs().iter();
        links(py, pairs.map(|pair| [pair.link_a_idx, pair.link_b_idx]))
    }

    /// (pairs,): the margin of each pair.
    fn margins<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let margins = self.0.pairs().iter().map(|pair| pair.margin);
        PyArray1::from_vec(py, margins.collect())
    }

    /// (others, 2): the links of each pair that has no output.
    fn other_pairs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<usize>>> {
        let pairs = self.0.other_pairs().iter();
        links(py, pairs.map(|pair| [pair.link_a_idx, pair.link_b_idx]))
    }

    /// (count, pairs).
    fn clearances<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let batch = Batch::new(&configurations);
        let count = batch.count;
        let values = self.each(py, batch, Model::clearances, Model::clearances_batch)?;
        shaped(py, values, [count, self.0.pairs().len()])
    }

    /// (count,).
    fn least<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let batch = Batch::new(&configurations);
        let one =
            |model: &Model, q: &[f64]| -> Answer<f64> { Ok(vec![least(&model.clearances(q)?)]) };
        let values = self.each(py, batch, one, Model::least_batch)?;
        Ok(PyArray1::from_vec(py, values))
    }

    /// (count,).
    fn may_collide<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let batch = Batch::new(&configurations);
        let one = |model: &Model, q: &[f64]| -> Answer<bool> { Ok(vec![model.may_collide(q)?]) };
        let values = self.each(py, batch, one, Model::may_collide_batch)?;
        Ok(PyArray1::from_vec(py, values))
    }

    /// (count, dofs): the derivative of the least clearance, or of that of a pair.
    fn gradient<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
        pair: Option<usize>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        if let Some(index) = pair
            && index >= self.0.pairs().len()
        {
            let (what, count) = ("pair", self.0.pairs().len());
            return Err(of_robot(py, &RobotError::OutOfRange { what, index, count }));
        }
        let batch = Batch::new(&configurations);
        let (count, dofs) = (batch.count, self.0.num_dofs());
        let one = move |model: &Model, q: &[f64]| -> Answer<f64> {
            let found = match pair {
                Some(pair) => model.gradient(q, pair)?,
                None => model.least(q)?.map(|least| least.gradient),
            };
            Ok(found.unwrap_or_else(|| vec![0.0; q.len()]))
        };
        let many = move |model: &Model, all: &[f64]| -> Answer<f64> {
            let each = all.par_chunks_exact(dofs.max(1)).map(|q| one(model, q));
            let rows: Vec<Vec<f64>> = each.collect::<Result<_, _>>()?;
            Ok(rows.concat())
        };
        let values = self.each(py, batch, one, many)?;
        shaped(py, values, [count, dofs])
    }
}

/// The least of some clearances; NaN where one is.
fn least(clearances: &[f64]) -> f64 {
    let least = |least: f64, clearance: &f64| match least < *clearance || least.is_nan() {
        true => least,
        false => *clearance,
    };
    clearances.iter().fold(f64::INFINITY, least)
}

/// (n, 2).
fn links<'py>(
    py: Python<'py>,
    pairs: impl ExactSizeIterator<Item = [LinkIdx; 2]>,
) -> PyResult<Bound<'py, PyArray2<usize>>> {
    let count = pairs.len();
    let numbers = pairs.flatten().map(LinkIdx::get);
    shaped(py, numbers.collect(), [count, 2])
}
