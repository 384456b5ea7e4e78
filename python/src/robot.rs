//! A robot.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use nalgebra::Isometry3;
use numpy::{PyArray1, PyArray2, PyArray3, PyArray4, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use rayon::prelude::*;
use urdd::cancellation::Cancellation;
use urdd::directory::root::Root;
use urdd::directory::source::is_urdd;
use urdd::robot::{Inverse, InverseSettings, RobotError, ShapeKind, Target};

use crate::arrays::{Batch, copy3, matrix, pose, shaped, write_matrix};
use crate::collision_model::CollisionModel;
use crate::errors::{of_robot, raise};
use crate::proximity::Proximity;
use crate::work;

/// Configurations that are looked at without other threads, whose waking takes longer.
const FEW: usize = 16;
/// Configurations that one thread works on at once.
const BLOCK: usize = 64;
/// Jacobians between two looks whether to stop.
const BETWEEN_LOOKS: usize = 4096;

/// A robot, as its URDD describes it.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct Robot {
    pub robot: Arc<urdd::robot::Robot>,
    pub root: Root,
    pub path: PathBuf,
    /// Held by whoever reads modules for the first time: two that wait for each other on the threads of one pool might
    /// wait for ever.
    reading: Mutex<()>,
    is_read: AtomicBool,
    proximity: Mutex<HashMap<ShapeKind, Py<Proximity>>>,
    collision_model: Mutex<Option<Py<CollisionModel>>>,
}

impl Robot {
    /// A robot whose kinematics and bounds were read, as far as they can be.
    pub fn read(&self, py: Python<'_>) -> PyResult<&Arc<urdd::robot::Robot>> {
        if !self.is_read.load(Ordering::Acquire) {
            let _reading = work::lock(py, &self.reading)?;
            let robot = Arc::clone(&self.robot);
            work::run(py, move |_| {
                let _ = robot.links();
                let _ = robot.configurations();
            })?;
            self.is_read.store(true, Ordering::Release);
        }
        Ok(&self.robot)
    }

    /// What a question about the robot gives.
    pub fn ask<T: Send + 'static>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&urdd::robot::Robot, &Cancellation) -> Result<T, RobotError>
        + Send
        + 'static,
    ) -> PyResult<T> {
        let robot = Arc::clone(self.read(py)?);
        work::run(py, move |cancellation| question(&robot, cancellation))?
            .map_err(|error| of_robot(py, &error))
    }

    fn names<'a, T: ?Sized>(
        &'a self,
        py: Python<'_>,
        names: impl FnOnce(&'a urdd::robot::Robot) -> Result<&'a T, RobotError>,
    ) -> PyResult<&'a T> {
        self.read(py)?;
        names(&self.robot).map_err(|error| of_robot(py, &error))
    }
}

#[pymethods]
impl Robot {
    /// Opens a folder or a zip archive.
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let robot = urdd::robot::Robot::open(&path).map_err(|error| of_robot(py, &error))?;
        if path.is_dir() && !is_urdd(&path) {
            let message = format!(
                "{}: there is no URDD in this folder: neither urdd.json nor the folder of a module",
                path.display()
            );
            return Err(raise(py, "OpenError", message, &[]));
        }
        let root = Root::open(&path).map_err(|error| raise(py, "OpenError", error, &[]))?;
        Ok(Robot {
            robot: Arc::new(robot),
            root,
            path,
            reading: Mutex::default(),
            is_read: AtomicBool::new(false),
            proximity: Mutex::default(),
            collision_model: Mutex::default(),
        })
    }

    #[getter]
    fn path(&self) -> PathBuf {
        self.path.clone()
    }

    fn link_names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.names(py, |robot| robot.links())?.to_vec())
    }

    fn joint_names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.names(py, |robot| robot.joints())?.to_vec())
    }

    fn dof_names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.names(py, |robot| robot.dofs())?.to_vec())
    }

    fn dof_units(&self, py: Python<'_>) -> PyResult<Vec<&'static str>> {
        Ok(self.names(py, |robot| robot.units())?.to_vec())
    }

    /// The index of a link.
    fn link(&self, py: Python<'_>, name: &str) -> PyResult<usize> {
        self.read(py)?;
        self.robot.link(name).map_err(|error| of_robot(py, &error))
    }

    /// The index of a DOF.
    fn dof(&self, py: Python<'_>, name: &str) -> PyResult<usize> {
        self.read(py)?;
        self.robot.dof(name).map_err(|error| of_robot(py, &error))
    }

    /// (dofs, 2).
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let bounds = self.names(py, |robot| robot.configurations())?.bounds();
        shaped(py, bounds.as_flattened().to_vec(), [bounds.len(), 2])
    }

    /// One of `zero`, `middle`, `lower`, `upper`.
    fn configuration<'py>(
        &self,
        py: Python<'py>,
        name: &str,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let space = self.names(py, |robot| robot.configurations())?;
        let values = match name {
            "middle" => space.middle(),
            "lower" => space.lower(),
            "upper" => space.upper(),
            _ => space.zero(),
        };
        Ok(PyArray1::from_vec(py, values))
    }

    /// `count` configurations of SPEC 9.2, from number `first` on: (count, dofs).
    fn sample<'py>(
        &self,
        py: Python<'py>,
        count: usize,
        first: u64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let space = self.names(py, |robot| robot.configurations())?;
        let dofs = space.num_dofs();
        let values = py.detach(|| {
            let numbers = (0..count as u64).map(|k| first.wrapping_add(k));
            let mut values = Vec::with_capacity(count * dofs);
            numbers.for_each(|k| values.extend(space.random(k)));
            values
        });
        shaped(py, values, [count, dofs])
    }

    /// Each value at the nearest bound where it is out of bounds.
    fn clamp<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let space = self.names(py, |robot| robot.configurations())?;
        let mut batch = Batch::new(&configurations);
        let dofs = space.num_dofs();
        if dofs > 0 {
            let each = batch.values.chunks_mut(dofs);
            each.for_each(|configuration| space.clamp(configuration));
        }
        shaped(py, batch.values, [batch.count, dofs])
    }

    /// (count, links, 4, 4); of one link (count, 1, 4, 4).
    #[pyo3(signature = (configurations, link=None))]
    fn poses<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
        link: Option<usize>,
    ) -> PyResult<Bound<'py, PyArray4<f64>>> {
        let links = self.names(py, |robot| robot.links())?.len();
        let shown = link.map_or(links, |_| 1);
        let batch = Batch::new(&configurations);
        let count = batch.count;
        let values = if count <= FEW {
            let mut values = vec![0.0; count * shown * 16];
            write_poses(&self.robot, &batch, 0, link, shown, &mut values)
                .map_err(|error| of_robot(py, &error))?;
            values
        } else {
            self.ask(py, move |robot, cancellation| {
                let mut values = vec![0.0; count * shown * 16];
                let blocks = values.par_chunks_mut(BLOCK * shown * 16).enumerate();
                let faults: Vec<RobotError> = blocks
                    .filter_map(|(block, out)| {
                        let stopped = cancellation.check().map_err(RobotError::from);
                        let first = block * BLOCK;
                        let write = |()| write_poses(robot, &batch, first, link, shown, out);
                        stopped.and_then(write).err()
                    })
                    .collect();
                faults.into_iter().next().map_or(Ok(values), Err)
            })?
        };
        shaped(py, values, [count, shown, 4, 4])
    }

    /// (count, 6, dofs), of a point of the link in the link's frame. In memory the DOFs come before the rows.
    fn jacobians<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
        link: usize,
        point: Option<[f64; 3]>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let dofs = self.names(py, |robot| robot.dofs())?.len();
        let batch = Batch::new(&configurations);
        let count = batch.count;
        let ask = move |robot: &urdd::robot::Robot, cancellation: &Cancellation| match point {
            None if dofs > 0 => {
                let mut values = Vec::with_capacity(count * 6 * dofs);
                for some in batch.values.chunks(BETWEEN_LOOKS * dofs) {
                    cancellation.check()?;
                    values.extend(robot.jacobian_batch(some, link)?);
                }
                Ok(values)
            }
            point => {
                let point = point.unwrap_or_default();
                let one = |k: usize| {
                    cancellation.check()?;
                    let jacobian = robot.jacobian_at(batch.row(k), link, point)?;
                    Ok(jacobian.as_slice().to_vec())
                };
                let each = (0..count).into_par_iter().map(one);
                let rows: Vec<Vec<f64>> = each.collect::<Result<_, RobotError>>()?;
                Ok(rows.concat())
            }
        };
        let values = self.ask(py, ask)?;
        let columns = shaped(py, values, [count, dofs, 6])?;
        use numpy::PyArrayMethods;
        columns.permute(Some([0, 2, 1]))
    }

    /// For targets (count, 4, 4) of poses or (count, 1, 3) of places: the configurations (count, dofs), and of each
    /// whether it is reached, the position's and the rotation's error, restarts and iterations.
    #[allow(clippy::too_many_arguments, clippy::type_complexity)]
    fn inverse<'py>(
        &self,
        py: Python<'py>,
        link: usize,
        targets: PyReadonlyArray3<'py, f64>,
        starts: PyReadonlyArray2<'py, f64>,
        point: [f64; 3],
        tolerances: [f64; 2],
        iterations: usize,
        restarts: usize,
        seed: u64,
        bounds: Option<PyReadonlyArray2<'py, f64>>,
    ) -> PyResult<(
        Bound<'py, PyArray2<f64>>,
        Vec<bool>,
        Vec<[f64; 2]>,
        Vec<[usize; 2]>,
    )> {
        use numpy::PyUntypedArrayMethods;
        let dofs = self.names(py, |robot| robot.dofs())?.len();
        let (count, is_pose) = (targets.shape()[0], targets.shape()[1] == 4);
        let (targets, starts) = (copy3(&targets), Batch::new(&starts));
        let pairs = |bounds: &PyReadonlyArray2<'_, f64>| {
            let values = Batch::new(bounds);
            (0..values.count)
                .map(|dof| [values.row(dof)[0], values.row(dof)[1]])
                .collect()
        };
        let settings = InverseSettings {
            position_tolerance: tolerances[0],
            rotation_tolerance: tolerances[1],
            iterations,
            restarts,
            seed,
            bounds: bounds.as_ref().map(pairs),
        };
        let found = self.ask(py, move |robot, cancellation| {
            let one = |k: usize| {
                cancellation.check()?;
                let target = match is_pose {
                    true => Target::pose(link, pose(&targets[16 * k..16 * k + 16])),
                    false => {
                        let place = &targets[3 * k..3 * k + 3];
                        Target::position(link, [place[0], place[1], place[2]])
                    }
                };
                let start = starts.row(if starts.count == 1 { 0 } else { k });
                robot.inverse_kinematics(&target.of_point(point), start, &settings)
            };
            let each = (0..count).into_par_iter().map(one);
            each.collect::<Result<Vec<Inverse>, RobotError>>()
        })?;
        let nearest = || found.iter().map(Inverse::nearest);
        let configurations = nearest().flat_map(|one| one.configuration.clone());
        Ok((
            shaped(py, configurations.collect(), [count, dofs])?,
            found.iter().map(Inverse::is_reached).collect(),
            nearest()
                .map(|one| [one.position_error, one.rotation_error])
                .collect(),
            nearest()
                .map(|one| [one.restarts, one.iterations])
                .collect(),
        ))
    }

    /// The shapes of a kind, prepared for distances.
    fn proximity(&self, py: Python<'_>, kind: &str) -> PyResult<Py<Proximity>> {
        let kind: ShapeKind = kind.parse().map_err(|error| of_robot(py, &error))?;
        if let Some(known) = work::lock(py, &self.proximity)?.get(&kind) {
            return Ok(known.clone_ref(py));
        }
        let made = self.ask(py, move |robot, _| robot.proximity(kind))?;
        let made = Py::new(py, Proximity::of(made))?;
        let mut known = work::lock(py, &self.proximity)?;
        Ok(known.entry(kind).or_insert(made).clone_ref(py))
    }

    /// The learned self-collision model.
    fn collision_model(&self, py: Python<'_>) -> PyResult<Py<CollisionModel>> {
        if let Some(known) = &*work::lock(py, &self.collision_model)? {
            return Ok(known.clone_ref(py));
        }
        let made = self.ask(py, |robot, _| robot.collision_model())?;
        let made = Py::new(py, CollisionModel::of(made))?;
        let mut known = work::lock(py, &self.collision_model)?;
        Ok(known.get_or_insert(made).clone_ref(py))
    }
}

/// The poses of a block of configurations, from number `first` on, as matrices.
fn write_poses(
    robot: &urdd::robot::Robot,
    batch: &Batch,
    first: usize,
    link: Option<usize>,
    shown: usize,
    out: &mut [f64],
) -> Result<(), RobotError> {
    let mut poses: Vec<Isometry3<f64>> = Vec::new();
    for (k, out) in out.chunks_mut(16 * shown).enumerate() {
        robot.link_poses_into(batch.row(first + k), &mut poses)?;
        match link {
            Some(link) => {
                let (what, index, count) = ("link", link, poses.len());
                let found = poses.get(link);
                let found = found.ok_or(RobotError::OutOfRange { what, index, count })?;
                out.copy_from_slice(&matrix(found));
            }
            None => {
                for (pose, out) in poses.iter().zip(out.chunks_mut(16)) {
                    write_matrix(pose, out);
                }
            }
        }
    }
    Ok(())
}
