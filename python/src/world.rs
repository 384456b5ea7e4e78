//! Queries on a robot and obstacles.

use std::sync::Arc;

use nalgebra::Isometry3;
use numpy::{
    PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use urdd_kinematics::pose::pose;
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

/// The pose of a matrix that is one beyond doubt: `World.move` has the last word about others.
fn plain(matrix: &[f64]) -> Option<Isometry3<f64>> {
    let found = pose(matrix).filter(|_| matrix[12..16] == [0.0, 0.0, 0.0, 1.0])?;
    let rotation = found.rotation.to_rotation_matrix();
    let is_near = |k: usize| (rotation[(k / 3, k % 3)] - matrix[4 * (k / 3) + k % 3]).abs() < 1e-7;
    (0..9).all(is_near).then_some(found)
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

    /// The same, with the obstacles at `places` at other poses: matrices (n, 4, 4). `None` if one of them is not a pose, or there
    /// are not as many.
    fn moved(
        &self,
        py: Python<'_>,
        places: Vec<usize>,
        poses: PyReadonlyArray3<'_, f64>,
    ) -> PyResult<Option<Self>> {
        let poses: Option<Vec<Isometry3<f64>>> =
            poses.as_slice()?.chunks_exact(16).map(plain).collect();
        let Some(poses) = poses.filter(|poses| poses.len() == places.len()) else {
            return Ok(None);
        };
        let (mut proximity, mut begin) = (self.proximity.clone(), 0);
        for run in places.chunk_by(|a, b| a + 1 == *b) {
            let moved = proximity.move_obstacles(run[0], &poses[begin..begin + run.len()]);
            moved.map_err(|error| of_robot(py, &error))?;
            begin += run.len();
        }
        Ok(Some(WorldProximity { proximity, num_tested: self.num_tested }))
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
