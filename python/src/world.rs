//! Obstacles, and robots among them.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;
use urdd::geometry::Mesh;
use urdd::robot::{ObstacleDistance, RobotError, World};

use crate::arrays::{Batch, copy, pose, shaped};
use crate::errors::of_robot;
use crate::proximity::Proximity;
use crate::work;

/// The index of a link and its piece, that of an obstacle, the distance, and two points.
type Near = ([usize; 2], usize, f64, [[f64; 3]; 2]);

/// A body that a robot should keep away from.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct Obstacle(urdd::robot::Obstacle);

/// An obstacle of a pose, which is a matrix (4, 4).
fn obstacle(
    py: Python<'_>,
    at: &PyReadonlyArray2<'_, f64>,
    make: impl FnOnce(nalgebra::Isometry3<f64>) -> Result<urdd::robot::Obstacle, RobotError>,
) -> PyResult<Obstacle> {
    let made = make(pose(&copy(at)));
    made.map(Obstacle).map_err(|error| of_robot(py, &error))
}

/// The rows of an array (n, 3).
fn rows(array: &PyReadonlyArray2<'_, f64>) -> Vec<[f64; 3]> {
    copy(array).as_chunks().0.to_vec()
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
        let make = |pose| urdd::robot::Obstacle::cuboid(name, pose, half_extents);
        obstacle(py, &pose, make)
    }

    #[staticmethod]
    fn sphere(py: Python<'_>, name: &str, centre: [f64; 3], radius: f64) -> PyResult<Self> {
        let made = urdd::robot::Obstacle::sphere(name, centre, radius);
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
        let make = |pose| urdd::robot::Obstacle::capsule(name, pose, radius, half_length);
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
        let make = |pose| urdd::robot::Obstacle::cylinder(name, pose, radius, half_length);
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
        let points = rows(&points);
        let make = |pose| urdd::robot::Obstacle::hull(name, pose, &points);
        obstacle(py, &pose, make)
    }

    /// Vertices (n, 3) and triangles (m, 3), of which convex pieces are made.
    #[staticmethod]
    fn mesh(
        py: Python<'_>,
        name: String,
        pose: PyReadonlyArray2<'_, f64>,
        vertices: PyReadonlyArray2<'_, f64>,
        faces: PyReadonlyArray2<'_, u32>,
    ) -> PyResult<Self> {
        let faces: Vec<u32> = faces.as_array().iter().copied().collect();
        let mesh = Mesh {
            vertices: rows(&vertices),
            triangles: faces.as_chunks().0.to_vec(),
        };
        let pose = crate::arrays::pose(&copy(&pose));
        let make = move |_: &_| urdd::robot::Obstacle::mesh(&name, pose, &mesh);
        let made = work::run(py, make)?;
        made.map(Obstacle).map_err(|error| of_robot(py, &error))
    }

    /// Number of convex shapes that stand for it.
    #[getter]
    fn num_parts(&self) -> usize {
        self.0.num_parts()
    }
}

/// The shapes of a robot among obstacles.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct Among(Arc<urdd::robot::Among<Arc<urdd::robot::Proximity>>>);

type Asked = urdd::robot::Among<Arc<urdd::robot::Proximity>>;

impl Among {
    /// What each of many configurations gives.
    fn each<T: Copy + Send + 'static>(
        &self,
        py: Python<'_>,
        batch: Batch,
        one: impl Fn(&Asked, &[f64]) -> Result<Vec<T>, RobotError> + Copy + Send + Sync + 'static,
    ) -> PyResult<Vec<T>> {
        work::ask(py, &self.0, batch, one, move |own, cancellation, batch| {
            let row = |k: usize| {
                cancellation.check()?;
                one(own, batch.row(k))
            };
            let found = (0..batch.count).into_par_iter().map(row);
            let found: Vec<Vec<T>> = found.collect::<Result<_, RobotError>>()?;
            Ok(found.concat())
        })
    }
}

#[pymethods]
impl Among {
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
        let world = World::new(each);
        let among = Asked::new(proximity.shared(), &world);
        let among = among.map_err(|error| of_robot(py, &error))?;
        Ok(Among(Arc::new(among)))
    }

    /// (pairs, 3): of each pair the link, the piece and the obstacle.
    fn pairs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<usize>>> {
        let pairs = self.0.pairs();
        let numbers = pairs.flat_map(|([link, piece], obstacle)| [link, piece, obstacle]);
        let numbers: Vec<usize> = numbers.collect();
        let count = numbers.len() / 3;
        shaped(py, numbers, [count, 3])
    }

    /// (count, pairs).
    fn distances<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let batch = Batch::new(&configurations);
        let count = batch.count;
        let values = self.each(py, batch, |among, q| among.distance_values(q))?;
        shaped(py, values, [count, self.0.pairs().count()])
    }

    /// (count,); infinite where there is no pair.
    fn distance<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let values = self.each(py, Batch::new(&configurations), |among, q| {
            Ok(vec![among.least_distance(q)?.unwrap_or(f64::INFINITY)])
        })?;
        Ok(PyArray1::from_vec(py, values))
    }

    /// (count,).
    fn in_collision<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let values = self.each(py, Batch::new(&configurations), |among, q| {
            Ok(vec![among.in_collision(q)?])
        })?;
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
        let near = |pair: &ObstacleDistance| {
            let shape = [pair.link_idx, pair.piece];
            (shape, pair.obstacle_idx, pair.distance, pair.points)
        };
        found
            .map(|pairs| pairs.iter().map(near).collect())
            .map_err(|error| of_robot(py, &error))
    }
}
