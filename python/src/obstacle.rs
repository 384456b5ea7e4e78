//! Bodies that a robot should keep away from, or that its links carry.

use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use urdd_geometry::Mesh;
use urdd_kinematics::pose::unchecked_pose;
use urdd_robot::RobotError;

use crate::arrays::{check_memory, copy};
use crate::errors::of_robot;
use crate::work;

/// Upper bounds of the memory to create an obstacle, as for mesh files (docs/security.md).
const BYTES_A_VERTEX: usize = 200;
const BYTES_A_TRIANGLE: usize = 600;

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

/// Refuses too many points of a cloud, or heights of a field, before they are copied.
fn check_count(py: Python<'_>, name: &str, count: usize) -> PyResult<()> {
    let checked = urdd_robot::Obstacle::check_count(name, count);
    checked.map_err(|error| of_robot(py, &error))?;
    check_memory(count.saturating_mul(BYTES_A_VERTEX))
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

    /// A cloud of points (n, 3).
    #[staticmethod]
    fn points(
        py: Python<'_>,
        name: &str,
        pose: PyReadonlyArray2<'_, f64>,
        points: PyReadonlyArray2<'_, f64>,
        radius: f64,
    ) -> PyResult<Self> {
        check_count(py, name, points.shape()[0])?;
        let points = rows(&points)?;
        let make = |pose| urdd_robot::Obstacle::points(name, pose, &points, radius);
        obstacle(py, &pose, make)
    }

    /// Heights (rows, columns).
    #[staticmethod]
    fn height_field(
        py: Python<'_>,
        name: &str,
        pose: PyReadonlyArray2<'_, f64>,
        heights: PyReadonlyArray2<'_, f64>,
        cell: [f64; 2],
        thickness: f64,
    ) -> PyResult<Self> {
        let columns = heights.shape()[1];
        check_count(py, name, heights.shape()[0].saturating_mul(columns))?;
        let heights = copy(&heights)?;
        let make = |pose| {
            urdd_robot::Obstacle::height_field(name, pose, &heights, columns, cell, thickness)
        };
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
        let mesh = Mesh { vertices, triangles: faces.as_chunks().0.to_vec() };
        let pose = unchecked_pose(&copy(&pose)?);
        let made = work::run(py, |_| urdd_robot::Obstacle::mesh(&name, pose, &mesh))?;
        made.map(Obstacle).map_err(|error| of_robot(py, &error))
    }

    /// The same bodies, with their frames at other poses: matrices (n, 16).
    #[staticmethod]
    fn at(
        py: Python<'_>,
        obstacles: Vec<Py<Obstacle>>,
        poses: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Vec<Self>> {
        let both = obstacles.iter().zip(poses.as_slice()?.chunks_exact(16));
        let moved = both.map(|(one, pose)| one.get().0.at(unchecked_pose(pose)).map(Obstacle));
        moved.collect::<Result<_, _>>().map_err(|error| of_robot(py, &error))
    }

    /// Number of convex shapes that represent it.
    #[getter]
    fn num_parts(&self) -> usize {
        self.0.num_parts()
    }
}

/// Obstacles, each with the names of those that may touch it.
pub fn objects_of(
    objects: &[(Py<Obstacle>, Vec<String>)],
) -> impl Iterator<Item = urdd_robot::Obstacle> {
    objects.iter().map(|(obstacle, ignored)| {
        let obstacle = obstacle.get().0.clone();
        let names = ignored.iter();
        names.fold(obstacle, |one, name| one.ignoring(name))
    })
}
