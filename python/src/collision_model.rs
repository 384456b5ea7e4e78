//! The learned self-collision model.

use numpy::ndarray::IntoDimension;
use numpy::{Element, PyArray, PyArray1, PyArray2, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;
use urdd_format::index::LinkIdx;
use urdd_kinematics::ConfigurationError;
use urdd_robot::RobotError;

use crate::arrays::{Batch, answers, shaped};
use crate::errors::of_robot;

/// Number of configurations up to which this thread works alone: waking others takes longer.
const FEW: usize = 16;
/// Maximum number of configurations between two checks for cancellation.
const BETWEEN_LOOKS: usize = 16_384;
/// Maximum number of values of a block: 16 MB besides the results.
const VALUES_AT_ONCE: usize = 1 << 20;

type Model = urdd_robot::CollisionModel;
type Answer<T> = Result<Vec<T>, ConfigurationError>;

/// A network that estimates how near links are.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct CollisionModel(Model);

impl CollisionModel {
    pub fn of(model: Model) -> Self {
        CollisionModel(model)
    }

    /// The results of a batch of configurations, in this shape: computed in blocks by `many`, or by `one` for a few
    /// configurations.
    fn each<'py, T: Element + Copy, S: IntoDimension>(
        &self,
        py: Python<'py>,
        configurations: &PyReadonlyArray2<'py, f64>,
        shape: S,
        one: impl Fn(&Model, &[f64]) -> Answer<T> + Sync,
        many: impl Fn(&Model, &[f64]) -> Answer<T> + Sync,
    ) -> PyResult<Bound<'py, PyArray<T, S::Dim>>> {
        let batch = Batch::new(configurations)?;
        let (count, dofs) = (batch.count, self.0.num_dofs());
        answers(py, shape, FEW, batch.is_one(), |cancellation, out| {
            let rows = if batch.is_one() { 1 } else { count };
            let width = out.len() / rows;
            if width == 0 {
                return Ok(());
            }
            if rows <= FEW {
                let mut rows = out.chunks_exact_mut(width).enumerate();
                return rows.try_for_each(|(k, out)| {
                    out.copy_from_slice(&one(&self.0, batch.row(k))?);
                    Ok(())
                });
            }
            // Limits the additional memory of a block.
            let block = (VALUES_AT_ONCE / width).clamp(1, BETWEEN_LOOKS);
            let blocks = batch.values.chunks(block * dofs);
            for (block, out) in blocks.zip(out.chunks_mut(block * width)) {
                cancellation.check()?;
                out.copy_from_slice(&many(&self.0, block)?);
            }
            Ok(())
        })
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

    /// Numbers of configurations: colliding, missed, near contact, missed of these, free, and cleared.
    #[getter]
    fn evaluation(&self) -> [u32; 6] {
        let of = self.0.evaluation();
        [
            of.num_colliding.0,
            of.num_missed.0,
            of.num_near_contact.0,
            of.num_near_contact_missed.0,
            of.num_free.0,
            of.num_cleared.0,
        ]
    }

    /// (count, of, lower, upper) of the rates of misses, of misses near contact, and of cleared configurations.
    #[getter]
    fn rates(&self) -> [(u32, u32, f64, f64); 3] {
        let of = self.0.evaluation();
        let rates = [of.miss_rate(), of.near_contact_miss_rate(), of.clear_rate()];
        rates.map(|rate| (rate.count, rate.of, rate.lower, rate.upper))
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
        let shape = [configurations.shape()[0], self.0.pairs().len()];
        let (one, many) = (Model::clearances, Model::clearances_batch);
        self.each(py, &configurations, shape, one, many)
    }

    /// (count,).
    fn min_clearance<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let one =
            |model: &Model, q: &[f64]| -> Answer<f64> { Ok(vec![least(&model.clearances(q)?)]) };
        let count = configurations.shape()[0];
        self.each(py, &configurations, count, one, Model::min_clearance_batch)
    }

    /// (count,).
    fn may_collide<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let one = |model: &Model, q: &[f64]| -> Answer<bool> { Ok(vec![model.may_collide(q)?]) };
        let count = configurations.shape()[0];
        self.each(py, &configurations, count, one, Model::may_collide_batch)
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
        let dofs = self.0.num_dofs();
        let one = move |model: &Model, q: &[f64]| -> Answer<f64> {
            let found = match pair {
                Some(pair) => model.gradient(q, pair)?,
                None => model.min_clearance(q)?.map(|least| least.gradient),
            };
            Ok(found.unwrap_or_else(|| vec![0.0; q.len()]))
        };
        let many = move |model: &Model, all: &[f64]| -> Answer<f64> {
            let each = all.par_chunks_exact(dofs.max(1)).map(|q| one(model, q));
            let rows: Vec<Vec<f64>> = each.collect::<Result<_, _>>()?;
            Ok(rows.concat())
        };
        let shape = [configurations.shape()[0], dofs];
        self.each(py, &configurations, shape, one, many)
    }
}

/// The minimum of clearances; NaN if one of them is NaN.
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
