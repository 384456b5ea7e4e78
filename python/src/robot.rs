//! A robot.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use nalgebra::Isometry3;
use numpy::{
    PyArray1, PyArray2, PyArray3, PyArray4, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3,
    PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::pose::{unchecked_pose, write_matrix};
use urdd_robot::{
    GravitySettings, InverseSettings, Payload, Queries, RobotError, ShapeKind, Target, Verdict,
    check_margin, fill,
};

use crate::arrays::{Batch, answers, copy, shaped};
use crate::collision_model::CollisionModel;
use crate::errors::of_robot;
use crate::proximity::Proximity;
use crate::queries::Asked;
use crate::work;
use crate::world::WorldProximity;

/// Number of configurations up to which this thread works alone: waking others takes longer.
pub const FEW: usize = 16;
/// Configurations in one block of work.
const BLOCK: usize = 64;

/// The settings of inverse kinematics, and the point of the link that they apply to.
#[derive(FromPyObject)]
struct InverseOptions<'py> {
    point: [f64; 3],
    position_tolerance: f64,
    rotation_tolerance: f64,
    iterations: usize,
    restarts: usize,
    seed: u64,
    bounds: Option<PyReadonlyArray2<'py, f64>>,
    weights: Option<[f64; 6]>,
    locked: Vec<usize>,
    posture: Option<Vec<f64>>,
    free_of: Vec<FreeOf>,
    margin: f64,
    open_loops: bool,
}

/// What solutions of inverse kinematics must not touch.
#[derive(FromPyObject)]
enum FreeOf {
    Itself(Py<Proximity>),
    World(Py<WorldProximity>),
}

impl FreeOf {
    fn is_free(&self, q: &[f64], margin: f64) -> bool {
        let touches = match self {
            FreeOf::Itself(proximity) => proximity.get().queries().in_collision(q),
            FreeOf::World(world) => world.get().queries().is_within(q, margin),
        };
        touches == Ok(false)
    }
}

/// A robot, as its URDD describes it.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct Robot {
    pub robot: Arc<urdd_robot::Robot>,
    pub path: PathBuf,
    is_read: AtomicBool,
    proximity: Mutex<HashMap<ShapeKind, Py<Proximity>>>,
    collision_model: Mutex<Option<Py<CollisionModel>>>,
}

impl Robot {
    /// The robot, after reading its kinematics and bounds as far as possible.
    pub fn read(&self, py: Python<'_>) -> PyResult<&Arc<urdd_robot::Robot>> {
        if !self.is_read.load(Ordering::Acquire) {
            work::run(py, |_| {
                let _ = self.robot.link_names();
                let _ = self.robot.configurations();
            })?;
            self.is_read.store(true, Ordering::Release);
        }
        Ok(&self.robot)
    }

    /// Runs a query on the robot.
    pub fn ask<T: Send>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&urdd_robot::Robot, &Cancellation) -> Result<T, RobotError> + Send,
    ) -> PyResult<T> {
        let robot = self.read(py)?;
        work::run(py, |cancellation| question(robot, cancellation))?
            .map_err(|error| of_robot(py, &error))
    }

    fn names<'a, T: ?Sized>(
        &'a self,
        py: Python<'_>,
        names: impl FnOnce(&'a urdd_robot::Robot) -> Result<&'a T, RobotError>,
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
        let robot = urdd_robot::Robot::open_urdd(&path).map_err(|error| of_robot(py, &error))?;
        Ok(Robot {
            robot: Arc::new(robot),
            path,
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
        Ok(self.names(py, |robot| robot.link_names())?.to_vec())
    }

    fn joint_names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.names(py, |robot| robot.joint_names())?.to_vec())
    }

    fn dof_names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.names(py, |robot| robot.dof_names())?.to_vec())
    }

    fn dof_units(&self, py: Python<'_>) -> PyResult<Vec<&'static str>> {
        Ok(self.names(py, |robot| robot.dof_units())?.to_vec())
    }

    /// The names and values of the configurations that a person named.
    fn named_configurations<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<Vec<(String, Bound<'py, PyArray1<f64>>)>> {
        let named = self.ask(py, |robot, _| Ok(robot.named_configurations()?.to_vec()))?;
        let array = |values: Vec<f64>| PyArray1::from_vec(py, values);
        let named = named.into_iter();
        Ok(named.map(|named| (named.name.to_string(), array(named.configuration))).collect())
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

    /// (dofs,): whether each DOF is limited.
    fn dof_is_limited(&self, py: Python<'_>) -> PyResult<Vec<bool>> {
        Ok(self.names(py, |robot| robot.configurations())?.dof_is_limited().to_vec())
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
    fn random<'py>(
        &self,
        py: Python<'py>,
        count: usize,
        first: u64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let space = self.names(py, |robot| robot.configurations())?;
        rows(py, count, space.num_dofs(), |k, out| {
            out.copy_from_slice(&space.random(first.wrapping_add(k as u64)));
        })
    }

    /// Clamps each value to its bounds.
    fn clamp<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let space = self.names(py, |robot| robot.configurations())?;
        let batch = Batch::new(&configurations)?;
        rows(py, batch.count, space.num_dofs(), |k, out| {
            out.copy_from_slice(batch.row(k));
            space.clamp(out);
        })
    }

    /// (count, links, 4, 4); for one link (count, 1, 4, 4).
    #[pyo3(signature = (configurations, link=None))]
    fn link_poses<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
        link: Option<usize>,
    ) -> PyResult<Bound<'py, PyArray4<f64>>> {
        let links = self.names(py, |robot| robot.link_names())?.len();
        let shown = link.map_or(links, |_| 1);
        let batch = Batch::new(&configurations)?;
        let shape = [batch.count, shown, 4, 4];
        answers(py, shape, FEW, batch.is_one(), |on, out| {
            each(on, out, shown * 16, |poses: &mut Vec<_>, k, out| {
                self.robot.link_poses_into(batch.row(k), poses)?;
                write_poses(poses, link, out)
            })
        })
    }

    /// (count, 6, dofs), of a point of the link in the link's frame. In memory the DOFs come before the rows.
    fn jacobians<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
        link: usize,
        point: Option<[f64; 3]>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let dofs = self.names(py, |robot| robot.dof_names())?.len();
        let (batch, point) = (Batch::new(&configurations)?, point.unwrap_or_default());
        let (robot, shape) = (&self.robot, [batch.count, dofs, 6]);
        let columns = answers(py, shape, FEW, batch.is_one(), |on, out| {
            robot.jacobian_batch_into(&batch.values, link, point, on, out)
        })?;
        columns.permute(Some([0, 2, 1]))
    }

    /// For targets (count, 4, 4) of poses or (count, 1, 3) of positions, a row (dofs + 5) each: the configuration, the
    /// verdict (by its place among `VERDICTS`), the position error and the rotation error, restarts and iterations.
    fn inverse_kinematics<'py>(
        &self,
        py: Python<'py>,
        link: usize,
        targets: PyReadonlyArray3<'py, f64>,
        starts: PyReadonlyArray2<'py, f64>,
        options: InverseOptions<'py>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let dofs = self.names(py, |robot| robot.dof_names())?.len();
        let (count, is_pose) = (targets.shape()[0], targets.shape()[1] == 4);
        let (targets, starts) = (copy(&targets)?, Batch::new(&starts)?);
        let pairs = |bounds: &PyReadonlyArray2<'_, f64>| {
            Ok::<_, PyErr>(copy(bounds)?.as_chunks().0.to_vec())
        };
        let settings = InverseSettings {
            position_tolerance: options.position_tolerance,
            rotation_tolerance: options.rotation_tolerance,
            iterations: options.iterations,
            restarts: options.restarts,
            seed: options.seed,
            bounds: options.bounds.as_ref().map(pairs).transpose()?,
            locked: options.locked,
            posture: options.posture,
            explain: true,
            open_loops: options.open_loops,
        };
        let (robot, point, weights) = (&self.robot, options.point, options.weights);
        let margin = check_margin(options.margin).map_err(|error| of_robot(py, &error))?;
        let free_of = options.free_of;
        let accepts = |q: &[f64]| free_of.iter().all(|shapes| shapes.is_free(q, margin));
        let write = |on: &Cancellation, k: usize, out: &mut [f64]| -> Result<(), RobotError> {
            let target = match is_pose {
                true => Target::pose(link, unchecked_pose(&targets[16 * k..16 * k + 16])),
                false => {
                    let position = &targets[3 * k..3 * k + 3];
                    Target::position(link, [position[0], position[1], position[2]])
                }
            };
            let target = target.of_point(point);
            let target = weights.map_or(target, |weights| target.weighted(weights));
            let start = starts.row(if starts.count == 1 { 0 } else { k });
            let found = robot.inverse_kinematics_where(&target, start, &settings, &accepts, on)?;
            let nearest = found.nearest();
            let (configuration, rest) = out.split_at_mut(dofs);
            configuration.copy_from_slice(&nearest.configuration);
            rest.copy_from_slice(&[
                match nearest.verdict {
                    Verdict::Reached => 0.0,
                    Verdict::Refused => 1.0,
                    Verdict::Limits => 2.0,
                    Verdict::OutOfReach => 3.0,
                    Verdict::Unknown => 4.0,
                    Verdict::Loops => 5.0,
                },
                nearest.position_error,
                nearest.rotation_error,
                nearest.restarts as f64,
                nearest.iterations as f64,
            ]);
            Ok(())
        };
        // A single solution can take long too, so none runs on this thread, which cannot react to Ctrl-C.
        answers(py, [count, dofs + 5], 0, false, |on, out| {
            fill(out, dofs + 5, 1, |(): &mut (), k, out| write(on, k, out))
        })
    }

    /// (dofs,) each: the largest speeds and efforts.
    fn limits<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyArray1<f64>>; 2]> {
        let robot = self.read(py)?;
        let both = [robot.velocity_limits(), robot.effort_limits()];
        let [speeds, efforts] = both.map(|limits| limits.map_err(|error| of_robot(py, &error)));
        Ok([speeds?, efforts?].map(|limits| PyArray1::from_slice(py, limits)))
    }

    /// (links, 4): the mass of each link, and its centre of mass.
    fn masses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let masses = self.read(py)?.link_masses();
        let masses = masses.map_err(|error| of_robot(py, &error))?;
        let rows = masses.iter().flat_map(|link| {
            let [x, y, z] = link.centre;
            [link.mass, x, y, z]
        });
        shaped(py, rows.collect(), [masses.len(), 4])
    }

    /// (count, dofs). A payload is a link, a mass and a point of the link.
    fn gravity_torques<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
        gravity: [f64; 3],
        payload: Option<(usize, f64, [f64; 3])>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let dofs = self.names(py, |robot| robot.dof_names())?.len();
        let batch = Batch::new(&configurations)?;
        let payload = payload.map(|(link, mass, point)| Payload { link, mass, point });
        let settings = GravitySettings { gravity, payload };
        answers(py, [batch.count, dofs], FEW, batch.is_one(), |on, out| {
            each(on, out, dofs, |(): &mut (), k, out| {
                self.robot.gravity_torques_into(batch.row(k), &settings, out)
            })
        })
    }

    /// The DOFs that move one of two links against the other.
    fn dofs_between(&self, py: Python<'_>, base: usize, tip: usize) -> PyResult<Vec<usize>> {
        let dofs = self.read(py)?.dofs_between(base, tip);
        dofs.map_err(|error| of_robot(py, &error))
    }

    /// The shapes of a kind, prepared for distances.
    fn proximity(&self, py: Python<'_>, kind: &str) -> PyResult<Py<Proximity>> {
        let kind = kind.parse::<ShapeKind>().map_err(|error| of_robot(py, &error.into()))?;
        if let Some(known) = work::lock(py, &self.proximity)?.get(&kind) {
            return Ok(known.clone_ref(py));
        }
        let made = self.ask(py, move |robot, _| robot.proximity(kind))?;
        let made = Py::new(py, Proximity::of(made))?;
        let mut known = work::lock(py, &self.proximity)?;
        Ok(known.entry(kind).or_insert(made).clone_ref(py))
    }

    /// The pairs of a kind that are skipped because they touch at rest; `None` without any.
    fn skipped_contacts(&self, py: Python<'_>, kind: &str) -> PyResult<Option<Proximity>> {
        let kind = kind.parse::<ShapeKind>().map_err(|error| of_robot(py, &error.into()))?;
        Ok(self.ask(py, move |robot, _| robot.skipped_contacts(kind))?.map(Proximity::of))
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

/// Configurations, each written given its number: (count, dofs).
fn rows<'py>(
    py: Python<'py>,
    count: usize,
    dofs: usize,
    write: impl Fn(usize, &mut [f64]) + Sync + Send,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    answers(py, [count, dofs], BLOCK, dofs == 0, |on, out| {
        each(on, out, dofs, |(): &mut (), k, out| {
            write(k, out);
            Ok(())
        })
    })
}

/// Runs a query for each configuration of a batch, until Ctrl-C.
pub fn each<S: Default>(
    on: &Cancellation,
    out: &mut [f64],
    width: usize,
    write: impl Fn(&mut S, usize, &mut [f64]) -> Result<(), RobotError> + Sync,
) -> Result<(), RobotError> {
    fill(out, width, BLOCK, |shared, k, out| {
        on.check()?;
        write(shared, k, out)
    })
}

/// Writes the poses of all links, or of one, as matrices.
fn write_poses(
    poses: &[Isometry3<f64>],
    link: Option<usize>,
    out: &mut [f64],
) -> Result<(), RobotError> {
    let shown = match link {
        None => poses,
        Some(link) => {
            let (what, index, count) = ("link", link, poses.len());
            let found = poses.get(link..=link);
            found.ok_or(RobotError::OutOfRange { what, index, count })?
        }
    };
    for (pose, out) in shown.iter().zip(out.chunks_exact_mut(16)) {
        write_matrix(pose, out);
    }
    Ok(())
}
