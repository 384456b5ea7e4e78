//! Queries on a robot and obstacles.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use urdd_robot::{EdgeSettings, ObstacleDistance, Obstruction, Queries, World};

use crate::arrays::{Batch, check_memory, shaped, zeros};
use crate::errors::of_robot;
use crate::obstacle::{Obstacle, objects_of};
use crate::proximity::Proximity;
use crate::queries::{Asked, queries};
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

impl Asked for WorldProximity {
    type Of = Shared;
    type Pair = ObstacleDistance;
    type Near = Near;

    fn queries(&self) -> &Shared {
        &self.proximity
    }

    fn near(pair: &ObstacleDistance) -> Near {
        (pair.link.to_string(), pair.piece, pair.obstacle_idx, pair.distance, pair.points)
    }

    fn check_memory(&self, count: usize) -> PyResult<()> {
        let threads = match count {
            0 | 1 => 1,
            count => count.min(num_threads()?),
        };
        let each = self.num_tested.saturating_mul(BYTES_A_PAIR);
        check_memory(each.saturating_mul(threads))
    }
}

queries!(WorldProximity, Near);

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
}
