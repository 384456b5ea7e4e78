//! Converts errors to the exceptions of `urdd.errors`.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use urdd_generate::combine::CombineError;
use urdd_generate::{GenerateError, SourceError};
use urdd_robot::RobotError;

use crate::advice;

/// An exception of this class. Its first argument is the message.
pub fn raise<'py>(
    py: Python<'py>,
    class: &str,
    message: impl ToString,
    more: &[(&str, Bound<'py, PyAny>)],
) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let class = py.import("urdd.errors")?.getattr(class)?;
        let named = PyDict::new(py);
        for (name, value) in more {
            named.set_item(name, value)?;
        }
        let message = PyTuple::new(py, [message.to_string()])?;
        Ok(PyErr::from_value(class.call(message, Some(&named))?))
    };
    made().unwrap_or_else(|error| error)
}

fn text<'py>(py: Python<'py>, text: &str) -> Bound<'py, PyAny> {
    pyo3::types::PyString::new(py, text).into_any()
}

/// The exception of an error of a robot query.
pub fn of_robot(py: Python<'_>, error: &RobotError) -> PyErr {
    let none = || py.None().into_bound(py);
    match error {
        RobotError::Open { .. } | RobotError::NoUrdd { .. } | RobotError::List(_) => {
            raise(py, "OpenError", error, &[])
        }
        RobotError::Missing(module) | RobotError::Unusable { module, .. } => {
            let is_missing = matches!(error, RobotError::Missing(_));
            let class = if is_missing { "ModuleMissingError" } else { "ModuleUnusableError" };
            raise(py, class, advice::of_robot(error), &[("module", text(py, module.name()))])
        }
        RobotError::MotionOpen
        | RobotError::Metadata(_)
        | RobotError::Kinematics(_)
        | RobotError::Changed(_) => raise(py, "ModuleUnusableError", advice::of_robot(error), &[]),
        RobotError::Unknown { what, name, nearest } => raise(
            py,
            "UnknownNameError",
            error,
            &[
                ("what", text(py, what)),
                ("name", text(py, name)),
                ("nearest", nearest.as_deref().map_or_else(none, |name| text(py, name))),
            ],
        ),
        RobotError::OutOfRange { .. } => pyo3::exceptions::PyIndexError::new_err(error.to_string()),
        RobotError::Configuration(_)
        | RobotError::Batch { .. }
        | RobotError::Target(_)
        | RobotError::Setting(_)
        | RobotError::Sphere { .. }
        | RobotError::Far { .. }
        | RobotError::NotClosed { .. }
        | RobotError::NotCoupled { .. }
        | RobotError::Steps { .. } => raise(py, "ConfigurationError", error, &[]),
        RobotError::Obstacle { name, .. } => {
            raise(py, "ObstacleError", error, &[("name", text(py, name))])
        }
        RobotError::Mesh { .. } => raise(py, "MeshError", error, &[]),
        RobotError::Memory { .. } => pyo3::exceptions::PyMemoryError::new_err(error.to_string()),
        RobotError::Cancelled(_) => {
            pyo3::exceptions::PyKeyboardInterrupt::new_err(error.to_string())
        }
        _ => raise(py, "UrddError", error, &[]),
    }
}

/// The exception of a generation error.
pub fn of_generate(py: Python<'_>, error: &GenerateError) -> PyErr {
    if matches!(error, GenerateError::Cancelled) {
        return pyo3::exceptions::PyKeyboardInterrupt::new_err(error.to_string());
    }
    let places = placed(py, places_of(error));
    let code = text(py, error.code());
    raise(py, "GenerateError", advice::of_generate(error), &[("code", code), ("places", places)])
}

/// The exception of a combination error.
pub fn of_combine(py: Python<'_>, error: &CombineError) -> PyErr {
    let (part, places) = match error {
        CombineError::Generate { error: GenerateError::Cancelled, .. } => {
            return pyo3::exceptions::PyKeyboardInterrupt::new_err(error.to_string());
        }
        CombineError::Generate { id, error } => (id.as_deref(), places_of(error)),
        CombineError::Part { id, .. } => (Some(id.as_str()), Vec::new()),
        CombineError::Recipe { file, at: Some(at), fault } => {
            (None, vec![(file.clone(), at.line, at.column, fault.to_string())])
        }
        _ => (None, Vec::new()),
    };
    let part = part.filter(|part| !part.is_empty());
    let part = part.map_or_else(|| py.None().into_bound(py), |part| text(py, part));
    let more = [("code", text(py, error.code())), ("part", part), ("places", placed(py, places))];
    raise(py, "CombineError", advice::of_combine(error), &more)
}

/// A file, a line, a column, and the problem there.
type Place = (String, u32, u32, String);

fn placed<'py>(py: Python<'py>, places: Vec<Place>) -> Bound<'py, PyAny> {
    let made = places.into_pyobject(py).map(Bound::into_any);
    made.unwrap_or_else(|_| py.None().into_bound(py))
}

fn places_of(error: &GenerateError) -> Vec<Place> {
    let mut places = Vec::new();
    match error {
        GenerateError::Source(SourceError::Refused { file, faults }) => {
            places.extend(faults.iter().map(|placed| {
                let at = placed.place(file);
                (at.file, at.line, at.column, advice::of_fault(&placed.fault))
            }))
        }
        GenerateError::Source(SourceError::Import { file, line, column, fault }) => {
            places.push((file.clone(), *line, *column, fault.to_string()));
        }
        GenerateError::Outside { meshes, .. } => places.extend(meshes.iter().map(|mesh| {
            let (leads, at) = (mesh.path.display(), &mesh.place);
            let words = format!("mesh {}: leads to {leads}", mesh.name);
            (at.file.clone(), at.line, at.column, words)
        })),
        GenerateError::Strict { notes } => places.extend(notes.iter().map(|note| {
            (
                note.file.clone(),
                note.line,
                note.column,
                format!("{}: {}", note.problem, note.assumed),
            )
        })),
        GenerateError::Edits { file, at: Some(at), fault, .. } => {
            places.push((file.display().to_string(), at.line, at.column, advice::of_edits(fault)))
        }
        _ => {}
    }
    places
}
