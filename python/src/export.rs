//! Exports.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use urdd_export::{
    ActuatorKind, Detail, ExportError, Format, MjcfOptions, Options, Setup, SetupError,
    SphereBudget, joint_groups_of_srdf,
};

use crate::advice;
use crate::errors::{of_robot, raise};
use crate::generate::skipped_reason;
use crate::robot::Robot;
use crate::work;

/// The text, its path in a folder, the other files by path, notes, and the report.
type Made<'py> = (String, Option<String>, Vec<(String, Bound<'py, PyBytes>)>, Vec<String>, String);

/// A robot in another format, in memory.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub fn export<'py>(
    py: Python<'py>,
    robot: &Robot,
    format: &str,
    shapes: &str,
    reasons: Option<Vec<String>>,
    keep_pairs: bool,
    spheres: Option<usize>,
    total_spheres: Option<usize>,
    cover: bool,
    samples: usize,
    visuals: bool,
    detail: Option<f64>,
    mesh_folder: String,
    actuators: Option<&str>,
    bandwidth: Option<f64>,
    floating_base: bool,
    sensors: bool,
    scene: bool,
    file: Option<String>,
    setup: Option<PathBuf>,
    package: Option<String>,
    robot_file: Option<String>,
) -> PyResult<Made<'py>> {
    let format = match format {
        "srdf" => Format::Srdf,
        "urdf" => Format::Urdf,
        "drake" => Format::Drake,
        "mjcf" => Format::Mjcf,
        "curobo" => Format::Curobo,
        "foam" => Format::Foam,
        "spherized" => Format::Spherized,
        "moveit" => Format::Moveit,
        "sdf" => Format::Sdf,
        other => {
            return Err(PyValueError::new_err(format!(
                "there is no format `{}`; there are: srdf, urdf, drake, mjcf, curobo, foam, spherized, moveit, sdf",
                other.escape_debug()
            )));
        }
    };
    let reasons = reasons.map(|words| {
        let each = words.iter().map(|word| skipped_reason(word));
        each.collect::<Result<Vec<_>, _>>()
    });
    let path = robot.path.clone();
    let robot = Arc::clone(robot.read(py)?);
    let setup = match setup {
        Some(file) => Setup::read(&file, &robot).map(Some),
        None => Setup::beside(&path, &robot),
    };
    let detail = match detail {
        None => Detail::Full,
        Some(ratio) if ratio < 1.0 => Detail::Ratio(ratio),
        Some(count) => Detail::Triangles(count as usize),
    };
    let options = Options {
        shapes: shapes
            .parse::<urdd_robot::ShapeKind>()
            .map_err(|error| of_robot(py, &error.into()))?,
        reasons: reasons.transpose().map_err(PyValueError::new_err)?,
        keep_pairs,
        spheres: match (total_spheres, spheres) {
            (Some(count), _) => SphereBudget::Total(count),
            (None, Some(count)) => SphereBudget::PerLink(count),
            (None, None) => SphereBudget::default(),
        },
        cover,
        samples,
        visuals,
        detail,
        mesh_folder,
        mjcf: MjcfOptions {
            actuators: actuators.map(actuator_kind).transpose()?,
            bandwidth,
            sensors,
            scene,
        },
        file,
        package,
        robot_file,
        floating_base,
        setup: setup.map_err(|error| of_setup(py, error))?,
    };
    let made = work::run(py, move |_| urdd_export::export(&robot, format, &options))?;
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
        Some(file) if file.extension().is_some_and(|extension| extension == "srdf") => {
            let text = std::fs::read_to_string(&file).map_err(|error| {
                let code = error.raw_os_error();
                PyOSError::new_err((code, error.kind().to_string(), file.clone()))
            })?;
            let shown = file.display().to_string();
            joint_groups_of_srdf(&robot, &text)
                .map_err(|error| failed(format!("{}: {error}", shown.escape_debug())))?
        }
        file => {
            let setup = match file {
                Some(file) => Setup::read(&file, &robot).map(Some),
                None => Setup::beside(&path, &robot),
            };
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
        error => raise(py, "ExportError", advice::of_export(&error), &[]),
    }
}

fn actuator_kind(word: &str) -> PyResult<ActuatorKind> {
    match word {
        "position" => Ok(ActuatorKind::Position),
        "velocity" => Ok(ActuatorKind::Velocity),
        "motor" => Ok(ActuatorKind::Motor),
        other => Err(PyValueError::new_err(format!(
            "there are no actuators `{}`; there are: position, velocity, motor",
            other.escape_debug()
        ))),
    }
}
