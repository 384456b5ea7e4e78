//! Obstacles, and queries on a robot and obstacles.

use std::sync::Arc;

use numpy::ndarray::{Dimension, IntoDimension};
use numpy::{
    Element, PyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use urdd_geometry::Mesh;
use urdd_kinematics::pose_matrix::unchecked_pose;
use urdd_robot::{ObstacleDistance, RobotError, World, fill};

use crate::arrays::{Batch, answers, check_memory, copy, zeros};
use crate::errors::of_robot;
use crate::proximity::Proximity;
use crate::threads::num_threads;
use crate::work;

/// Upper bounds of the memory to create an obstacle, as for mesh files (docs/security.md).
const BYTES_A_VERTEX: usize = 200;
const BYTES_A_TRIANGLE: usize = 600;
/// Memory of a configuration for each pair of a shape and a part of an obstacle: four lists, which grow by doubling.
const BYTES_A_PAIR: usize = 256;

/// The indices of a link and its piece, the index of an obstacle, the distance, and the closest points.
type Near = ([usize; 2], usize, f64, [[f64; 3]; 2]);

/// A body that a robot should keep away from.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct Obstacle(urdd_robot::Obstacle);

/// Creates an obstacle from a pose, a matrix (4, 4).
fn obstacle(
    py: Python<'_>,
    at: &PyReadonlyArray2<'_, f64>,
    make: impl FnOnce(nalgebra::Isometry3<f64>) -> Result<urdd_robot::Obstacle, RobotError>,
) -> PyResult<Obstacle> {
    let made = make(unchecked_pose(&copy(at)?));
    made.map(Obstacle).map_err(|error| of_robot(py, &error))
}

/// The rows of an array (n, 3).
fn rows(array: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<[f64; 3]>> {
    let values = copy(array)?;
    check_memory(size_of_val(values.as_slice()))?;
    Ok(values.as_chunks().0.to_vec())
}

#[pymethods]
impl Obstacle {
    #[staticmethod]
    fn cuboid(
        py: Python<'_>,
        name: &str,
        pose: PyReadonlyArray2<'_, f64>,
        half_extents: [f64; 3],
    ) -> PyResult<Self> {
        let make = |pose| urdd_robot::Obstacle::cuboid(name, pose, half_extents);
        obstacle(py, &pose, make)
    }

    #[staticmethod]
    fn sphere(py: Python<'_>, name: &str, centre: [f64; 3], radius: f64) -> PyResult<Self> {
        let made = urdd_robot::Obstacle::sphere(name, centre, radius);
        made.map(Obstacle).map_err(|error| of_robot(py, &error))
    }

    #[staticmethod]
    fn capsule(
        py: Python<'_>,
        name: &str,
        pose: PyReadonlyArray2<'_, f64>,
        radius: f64,
        half_length: f64,
    ) -> PyResult<Self> {
        let make = |pose| urdd_robot::Obstacle::capsule(name, pose, radius, half_length);
        obstacle(py, &pose, make)
    }

    #[staticmethod]
    fn cylinder(
        py: Python<'_>,
        name: &str,
        pose: PyReadonlyArray2<'_, f64>,
        radius: f64,
        half_length: f64,
    ) -> PyResult<Self> {
        let make = |pose| urdd_robot::Obstacle::cylinder(name, pose, radius, half_length);
        obstacle(py, &pose, make)
    }

    /// The convex hull of points (n, 3).
    #[staticmethod]
    fn hull(
        py: Python<'_>,
        name: &str,
        pose: PyReadonlyArray2<'_, f64>,
        points: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Self> {
        let points = rows(&points)?;
        check_memory(points.len().saturating_mul(BYTES_A_VERTEX))?;
        let make = |pose| urdd_robot::Obstacle::hull(name, pose, &points);
        obstacle(py, &pose, make)
    }

    /// Vertices (n, 3) and triangles (m, 3), to be decomposed into convex pieces.
    #[staticmethod]
    fn mesh(
        py: Python<'_>,
        name: String,
        pose: PyReadonlyArray2<'_, f64>,
        vertices: PyReadonlyArray2<'_, f64>,
        faces: PyReadonlyArray2<'_, u32>,
    ) -> PyResult<Self> {
        let (vertices, faces) = (rows(&vertices)?, copy(&faces)?);
        let of_vertices = vertices.len().saturating_mul(BYTES_A_VERTEX);
        check_memory(of_vertices.saturating_add(faces.len() / 3 * BYTES_A_TRIANGLE))?;
        let mesh = Mesh {
            vertices,
            triangles: faces.as_chunks().0.to_vec(),
        };
        let pose = unchecked_pose(&copy(&pose)?);
        let made = work::run(py, |_| urdd_robot::Obstacle::mesh(&name, pose, &mesh))?;
        made.map(Obstacle).map_err(|error| of_robot(py, &error))
    }

    /// Number of convex shapes that represent it.
    #[getter]
    fn num_parts(&self) -> usize {
        self.0.num_parts()
    }
}

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
        let each = obstacles.iter().map(|(obstacle, ignored)| {
            let links = ignored.iter();
            links.fold(obstacle.get().0.clone(), |one, link| one.ignoring(link))
        });
        let parts = obstacles
            .iter()
            .map(|(obstacle, _)| obstacle.get().0.num_parts());
        let proximity = proximity.shared();
        let num_tested = proximity.num_shapes().saturating_mul(parts.sum());
        let proximity = Shared::new(proximity, &World::new(each));
        Ok(WorldProximity {
            proximity: proximity.map_err(|error| of_robot(py, &error))?,
            num_tested,
        })
    }

    /// (pairs, 3): the link, the piece and the obstacle of each pair.
    fn pairs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<usize>>> {
        let array = zeros(py, [self.proximity.pairs().count(), 3])?;
        let mut guard = array.readwrite();
        let rows = guard.as_slice_mut()?.chunks_exact_mut(3);
        for (row, ([link, piece], obstacle)) in rows.zip(self.proximity.pairs()) {
            row.copy_from_slice(&[link, piece, obstacle]);
        }
        drop(guard);
        Ok(array)
    }

    /// (count, pairs).
    fn distances<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let shape = [configurations.shape()[0], self.proximity.pairs().count()];
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
        let near = |pair: &ObstacleDistance| {
            let shape = [pair.link_idx, pair.piece];
            (shape, pair.obstacle_idx, pair.distance, pair.points)
        };
        found
            .map(|pairs| pairs.iter().map(near).collect())
            .map_err(|error| of_robot(py, &error))
    }
}
