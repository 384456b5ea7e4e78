//! Exports.

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use urdd_directory::file_type::FileType;
use urdd_directory::limits::MAX_SRDF_BYTES;
use urdd_directory::regular;
use urdd_export::{
    Choices, Detail, ExportError, Fit, Setup, SetupError, SphereBudget, joint_groups_of_srdf,
};

use crate::advice;
use crate::errors::{of_robot, raise};
use crate::generate::skipped_reasons;
use crate::robot::Robot;
use crate::work;

/// The text, its path in a folder, the other files by path, notes, and the report.
type Made<'py> = (String, Option<String>, Vec<(String, Bound<'py, PyBytes>)>, Vec<String>, String);

/// The options of `urdd.export`, which checks their types.
#[derive(FromPyObject)]
pub struct Options {
    shapes: String,
    reasons: Option<Vec<String>>,
    keep_pairs: bool,
    spheres: Option<usize>,
    total_spheres: Option<usize>,
    cover: bool,
    samples: usize,
    visuals: bool,
    detail: Option<f64>,
    mesh_folder: Option<String>,
    actuators: Option<String>,
    bandwidth: Option<f64>,
    floating_base: bool,
    merge_fixed: bool,
    root: Option<String>,
    fit: Option<(f64, f64)>,
    sensors: bool,
    scene: bool,
    output: Option<PathBuf>,
    setup: Option<PathBuf>,
    package: Option<String>,
    ros: Option<String>,
    robot_file: Option<String>,
}

impl Options {
    fn choices(self, py: Python<'_>, urdd: &Path, robot: &urdd_robot::Robot) -> PyResult<Choices> {
        let setup = Setup::find(self.setup.as_deref(), urdd, robot);
        let detail = match self.detail {
            None => Detail::Full,
            Some(given) => Detail::new(given).map_err(of_value)?,
        };
        let fit = self.fit.map(|(volume, standoff)| Fit::new(volume, standoff));
        let shapes = self.shapes.parse::<urdd_export::Shapes>();
        let ros = self.ros.map(|word| word.parse());
        let actuators = self.actuators.map(|word| word.parse());
        Ok(Choices {
            shapes: shapes.map_err(|error| of_robot(py, &error.into()))?,
            reasons: skipped_reasons(self.reasons).map_err(of_value)?,
            keep_pairs: self.keep_pairs,
            spheres: SphereBudget::new(self.spheres, self.total_spheres),
            cover: self.cover,
            samples: self.samples,
            visuals: self.visuals.then_some(detail),
            mesh_folder: self.mesh_folder,
            output: self.output,
            package: self.package,
            ros: ros.transpose().map_err(of_value)?,
            robot_file: self.robot_file,
            floating_base: self.floating_base,
            merge_fixed: self.merge_fixed,
            root: self.root,
            fit: fit.transpose().map_err(of_value)?,
            actuators: actuators.transpose().map_err(of_value)?,
            bandwidth: self.bandwidth,
            sensors: self.sensors,
            scene: self.scene,
            setup: setup.map_err(|error| of_setup(py, error))?,
        })
    }
}

/// A robot, and the options of a format for it.
fn subject(
    py: Python<'_>,
    robot: &Robot,
    format: &str,
    options: Options,
) -> PyResult<(Arc<urdd_robot::Robot>, urdd_export::Options)> {
    let format = format.parse().map_err(of_value)?;
    let path = robot.path.clone();
    let robot = Arc::clone(robot.read(py)?);
    let options = options.choices(py, &path, &robot)?.options(format);
    Ok((robot, options.map_err(of_value)?))
}

/// Where a free base is in a configuration, or in a named one: x, y, z, and the quaternion w, x, y, z.
#[pyfunction]
pub fn base_pose(
    py: Python<'_>,
    robot: &Robot,
    format: &str,
    options: Options,
    name: Option<String>,
    configuration: Vec<f64>,
) -> PyResult<Option<[f64; 7]>> {
    let (robot, options) = subject(py, robot, format, options)?;
    let found = work::run(py, move |_| {
        urdd_export::base_pose(&robot, &options, name.as_deref(), &configuration)
    })?;
    found.map_err(|error| of_export(py, error))
}

/// A robot in another format, in memory.
#[pyfunction]
pub fn export<'py>(
    py: Python<'py>,
    robot: &Robot,
    format: &str,
    options: Options,
) -> PyResult<Made<'py>> {
    let (robot, options) = subject(py, robot, format, options)?;
    let made = work::run(py, move |_| urdd_export::export(&robot, &options))?;
    let made = made.map_err(|error| of_export(py, error))?;
    let files = made.files.iter();
    Ok((
        made.text,
        made.path,
        files.map(|(path, bytes)| (path.clone(), PyBytes::new(py, bytes))).collect(),
        made.notes.iter().map(ToString::to_string).collect(),
        made.report,
    ))
}

/// The joint groups of an SRDF or an `export.toml`; of that beside the robot, or guessed, without a file.
#[pyfunction]
pub fn joint_groups(
    py: Python<'_>,
    robot: &Robot,
    file: Option<PathBuf>,
) -> PyResult<Vec<(String, Vec<usize>)>> {
    let path = robot.path.clone();
    let robot = Arc::clone(robot.read(py)?);
    let failed = |message: String| raise(py, "ExportError", message, &[]);
    let groups = match file {
        Some(file) if FileType::Srdf.is_of(&file) => {
            std::fs::metadata(&file).map_err(|error| {
                let code = error.raw_os_error();
                PyOSError::new_err((code, error.kind().to_string(), file.clone()))
            })?;
            let shown = file.display().to_string();
            let about = |error: String| failed(format!("{}: {error}", shown.escape_debug()));
            let bytes = regular::read(&file, MAX_SRDF_BYTES).map_err(|it| about(it.to_string()))?;
            let text = String::from_utf8(bytes).map_err(|_| about("it is not UTF-8".to_owned()))?;
            joint_groups_of_srdf(&robot, &text).map_err(|error| about(error.to_string()))?
        }
        file => {
            let setup = Setup::find(file.as_deref(), &path, &robot);
            let groups = setup.map_err(|error| of_setup(py, error))?;
            let groups = groups.map_or_else(|| Setup::guess(&robot), Ok);
            let groups = groups.and_then(|setup| setup.joint_groups(&robot));
            groups.map_err(|error| of_export(py, error))?
        }
    };
    Ok(groups.into_iter().map(|one| (one.name, one.dofs)).collect())
}

fn of_setup(py: Python<'_>, error: SetupError) -> PyErr {
    match error {
        SetupError::Robot(ExportError::Robot(error)) => of_robot(py, &error),
        error => raise(py, "ExportError", error.to_string(), &[]),
    }
}

fn of_export(py: Python<'_>, error: ExportError) -> PyErr {
    match error {
        ExportError::Robot(error) => of_robot(py, &error),
        ExportError::Range(error) => of_value(error),
        error => raise(py, "ExportError", advice::of_export(&error), &[]),
    }
}

fn of_value(error: impl Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}
