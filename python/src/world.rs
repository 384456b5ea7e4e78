//! Queries on a robot and obstacles.

use std::sync::Arc;

use numpy::ndarray::{Dimension, IntoDimension};
use numpy::{
    Element, PyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use urdd_robot::{EdgeSettings, ObstacleDistance, RobotError, World, fill};

use crate::arrays::{Batch, answers, check_memory, shaped, zeros};
use crate::errors::of_robot;
use crate::obstacle::{Obstacle, objects_of};
use crate::proximity::{Overlapping, Proximity, overlapping};
use crate::threads::num_threads;

/// Memory of a configuration for each pair of a shape and a part of an obstacle: four lists, which grow by doubling.
const BYTES_A_PAIR: usize = 256;

/// The name of a link or an attached object, the index of its piece, the index of an obstacle, the distance, and the
/// closest points.
type Near = (String, usize, usize, f64, [[f64; 3]; 2]);

/// The shapes of a robot, and obstacles.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct WorldProximity {
    proximity: Shared,
    /// Maximum number of pairs of a shape and a part of an obstacle: one configuration needs memory for all of them.
    num_tested: usize,
}

type Shared = urdd_robot::WorldProximity<Arc<urdd_robot::Proximity>>;

impl WorldProximity {
    /// The results of a batch of configurations, in this shape.
    fn each<'py, T: Element + Copy, S: IntoDimension>(
        &self,
        py: Python<'py>,
        configurations: &PyReadonlyArray2<'py, f64>,
        shape: S,
        write: impl Fn(&Shared, &[f64], &mut [T]) -> Result<(), RobotError> + Sync,
    ) -> PyResult<Bound<'py, PyArray<T, S::Dim>>> {
        let batch = Batch::new(configurations)?;
        let threads = match batch.count {
            0 | 1 => 1,
            count => count.min(num_threads()?),
        };
        self.check_memory(threads)?;
        let shape = shape.into_dimension();
        let width = shape.slice().iter().skip(1).product();
        answers(py, shape, 1, batch.is_one(), |cancellation, out| {
            fill(
                out,
                width,
                1,
                || (),
                |(), k, out| {
                    cancellation.check()?;
                    write(&self.proximity, batch.row(k), out)
                },
            )
        })
    }

    /// Whether the robot is at most `margin` from an obstacle in one configuration, m.
    pub fn is_within_of(&self, configuration: &[f64], margin: f64) -> Result<bool, RobotError> {
        self.proximity.is_within(configuration, margin)
    }

    /// Raises `MemoryError` if there is not enough memory for this many configurations at once.
    fn check_memory(&self, configurations: usize) -> PyResult<()> {
        let each = self.num_tested.saturating_mul(BYTES_A_PAIR);
        check_memory(each.saturating_mul(configurations))
    }
}

#[pymethods]
impl WorldProximity {
    /// Each obstacle with the names of the links that may touch it.
    #[new]
    fn new(
        py: Python<'_>,
        proximity: PyRef<'_, Proximity>,
        obstacles: Vec<(Py<Obstacle>, Vec<String>)>,
    ) -> PyResult<Self> {
        let world = World::new(objects_of(&obstacles));
        let parts = world.obstacles().iter().map(|one| one.num_parts());
        let proximity = proximity.shared();
        let num_tested = proximity.num_shapes().saturating_mul(parts.sum());
        let proximity = Shared::new(proximity, &world);
        Ok(WorldProximity {
            proximity: proximity.map_err(|error| of_robot(py, &error))?,
            num_tested,
        })
    }

    /// (pairs, 3): the link, the piece and the obstacle of each pair.
    fn pairs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<usize>>> {
        let array = zeros(py, [self.proximity.num_pairs(), 3])?;
        let mut guard = array.readwrite();
        let rows = guard.as_slice_mut()?.chunks_exact_mut(3);
        for (row, ([link, piece], obstacle)) in rows.zip(self.proximity.pairs()) {
            row.copy_from_slice(&[link, piece, obstacle]);
        }
        drop(guard);
        Ok(array)
    }

    /// (pairs,): the body of each pair.
    fn pair_bodies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<usize>>> {
        let bodies: Vec<usize> = self.proximity.pair_bodies().collect();
        let shape = [bodies.len()];
        shaped(py, bodies, shape)
    }

    /// The name of the link of each pair, or of the attached object.
    fn pair_names(&self) -> Vec<&str> {
        self.proximity.pair_names().collect()
    }

    /// (count, pairs).
    fn distances<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let shape = [configurations.shape()[0], self.proximity.num_pairs()];
        self.each(py, &configurations, shape, |proximity, q, out| {
            out.copy_from_slice(&proximity.distances(q)?);
            Ok(())
        })
    }

    /// (count,); infinite if there are no pairs.
    fn min_distance<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let count = configurations.shape()[0];
        self.each(py, &configurations, count, |proximity, q, out| {
            out[0] = proximity.min_distance(q)?.unwrap_or(f64::INFINITY);
            Ok(())
        })
    }

    /// (count,).
    fn in_collision<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let count = configurations.shape()[0];
        self.each(py, &configurations, count, |proximity, q, out| {
            out[0] = proximity.in_collision(q)?;
            Ok(())
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
        self.each(py, &configurations, count, |proximity, q, out| {
            out[0] = proximity.is_within(q, margin)?;
            Ok(())
        })
    }

    /// (count,): where each straight motion is blocked, from 0 to 1; NaN where it is free. A row of `edges` is the
    /// start, then the end.
    fn blocked_edge<'py>(
        &self,
        py: Python<'py>,
        edges: PyReadonlyArray2<'py, f64>,
        margin: f64,
        resolution: Option<f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let count = edges.shape()[0];
        let settings = EdgeSettings { margin, resolution };
        self.each(py, &edges, count, |proximity, both, out| {
            let (start, end) = both.split_at(both.len() / 2);
            let blocked = proximity.blocked_edge(start, end, &settings)?;
            out[0] = blocked.unwrap_or(f64::NAN);
            Ok(())
        })
    }

    /// (count, 2): the last part of each straight motion that is free, and the first that is blocked; NaN where it is
    /// free. A row of `edges` is the start, then the end.
    fn first_contact<'py>(
        &self,
        py: Python<'py>,
        edges: PyReadonlyArray2<'py, f64>,
        margin: f64,
        resolution: Option<f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let shape = [edges.shape()[0], 2];
        let settings = EdgeSettings { margin, resolution };
        self.each(py, &edges, shape, |proximity, both, out| {
            let (start, end) = both.split_at(both.len() / 2);
            let contact = proximity.first_contact(start, end, &settings)?;
            out.copy_from_slice(&contact.map_or([f64::NAN; 2], |one| [one.free, one.blocked]));
            Ok(())
        })
    }

    /// The nearest pairs in one configuration, nearest first.
    fn nearest(
        &self,
        py: Python<'_>,
        configuration: PyReadonlyArray2<'_, f64>,
        k: usize,
    ) -> PyResult<Vec<Near>> {
        let batch = Batch::new(&configuration)?;
        self.check_memory(1)?;
        let found = py.detach(|| self.proximity.nearest(&batch.values, k));
        found.map(|pairs| pairs.iter().map(near).collect()).map_err(|error| of_robot(py, &error))
    }

    /// The pairs that touch or overlap in one configuration: depth, direction, gradient.
    fn penetrations(
        &self,
        py: Python<'_>,
        configuration: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Vec<Overlapping<Near>>> {
        let batch = Batch::new(&configuration)?;
        let found = py.detach(|| self.proximity.penetrations(&batch.values));
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
        self.check_memory(1)?;
        let found = py.detach(|| self.proximity.gradients(&batch.values, k));
        let found = found.map_err(|error| of_robot(py, &error))?;
        let each = found.into_iter();
        Ok(each.map(|found| (near(&found.pair), found.gradient)).collect())
    }
}

fn near(pair: &ObstacleDistance) -> Near {
    (pair.link.to_string(), pair.piece, pair.obstacle_idx, pair.distance, pair.points)
}
