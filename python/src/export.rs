//! Exports.

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use pyo3::exceptions::{PyOSError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyDict, PyString};
use serde_json::Value;
use urdd_directory::account::Account;
use urdd_directory::file_type::FileType;
use urdd_directory::limits::MAX_SRDF_BYTES;
use urdd_directory::regular;
use urdd_export::{
    Choice, ChoiceError, Choices, Detail, ExportError, Kind, Setup, SetupError,
    joint_groups_of_srdf,
};

use crate::advice;
use crate::errors::{of_robot, raise};
use crate::robot::Robot;
use crate::work;

/// The text, its path in a folder, the other files by path, notes, and the report.
type Made<'py> = (String, Option<String>, Vec<(String, Bound<'py, PyBytes>)>, Vec<String>, String);

/// The options of `urdd.export` by name, and the folder where a setup is sought.
type Options<'py> = Bound<'py, PyDict>;

fn choices(given: &Options, urdd: &Path, robot: &urdd_robot::Robot) -> PyResult<Choices> {
    let py = given.py();
    let mut choices = Choices::default();
    let mut setup: Option<PathBuf> = None;
    for (name, value) in given {
        match name.extract::<&str>()? {
            "output" => choices.output = value.extract()?,
            "setup" => setup = value.extract()?,
            _ if value.is_none() => {}
            name => {
                let choice = Choice::named(name).map_err(of_value)?;
                choice.set(&mut choices, &json(choice, &value)?).map_err(|error| match error {
                    ChoiceError::Shapes(error) => of_robot(py, &error.into()),
                    error @ ChoiceError::Type { .. } => PyTypeError::new_err(error.to_string()),
                    error => of_value(error),
                })?;
            }
        }
    }
    let setup = Setup::find(setup.as_deref(), urdd, robot);
    Ok(Choices { setup: setup.map_err(|error| of_setup(py, error))?, ..choices })
}

/// A value of an option, as Python has it.
fn json(choice: &Choice, value: &Bound<PyAny>) -> PyResult<Value> {
    let number = |value: &Bound<PyAny>| value.extract::<f64>();
    Ok(match choice.kind {
        Kind::Flag => value.is_truthy()?.into(),
        Kind::Detail if value.is_instance_of::<PyBool>() => value.is_truthy()?.into(),
        Kind::Number(range) if range.unit.is_none() => {
            // Numbers of NumPy too, and none with a fraction.
            let index = value.py().import("operator")?.call_method1("index", (value,))?;
            number(&index)?.into()
        }
        // JSON has no number that is not finite.
        Kind::Number(range) => range.check(number(value)?).map_err(of_value)?.into(),
        Kind::Detail => {
            let given = number(value)?;
            Detail::new(given).map_err(of_value)?;
            given.into()
        }
        Kind::Fit => vec![number(&value.get_item(0)?)?, number(&value.get_item(1)?)?].into(),
        Kind::Words(_) if value.is_instance_of::<PyString>() => {
            let said = format!("{} must be a list of words: [{}]", choice.name, value.repr()?);
            return Err(PyTypeError::new_err(said));
        }
        Kind::Words(_) => {
            let words = value.try_iter()?.map(|word| word?.extract::<String>());
            words.collect::<PyResult<Vec<String>>>()?.into()
        }
        Kind::Word(_) | Kind::Text => value.extract::<String>()?.into(),
    })
}

/// A robot, and the options of a format for it.
fn subject(
    py: Python<'_>,
    robot: &Robot,
    format: &str,
    options: &Options,
) -> PyResult<(Arc<urdd_robot::Robot>, urdd_export::Options)> {
    let format = format.parse().map_err(of_value)?;
    let path = robot.path.clone();
    let robot = Arc::clone(robot.read(py)?);
    let options = choices(options, &path, &robot)?.options(format);
    Ok((robot, options.map_err(of_value)?))
}

/// Where a free base is in a configuration, or in a named one: x, y, z, and the quaternion w, x, y, z.
#[pyfunction]
pub fn base_pose(
    py: Python<'_>,
    robot: &Robot,
    format: &str,
    options: Options<'_>,
    name: Option<String>,
    configuration: Vec<f64>,
) -> PyResult<Option<[f64; 7]>> {
    let (robot, options) = subject(py, robot, format, &options)?;
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
    options: Options<'py>,
) -> PyResult<Made<'py>> {
    let (robot, options) = subject(py, robot, format, &options)?;
    let made = work::run(py, move |cancellation| {
        urdd_export::export_within(&robot, &options, &Account::new(cancellation))
    })?;
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
