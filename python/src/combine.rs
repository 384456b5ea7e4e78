//! Combination of robots.

use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use pyo3::types::PyDict;
use urdd_generate::combine::{Recipe, check_parts};
use urdd_validate::find_errors;

use crate::errors::of_combine;
use crate::generate::{Options, summary, with_progress};

/// How a robot is attached to a link of another: the link, the position and roll, pitch, yaw, and the name of the
/// combined robot.
type Attached = (String, [[f64; 3]; 2], Option<String>);

/// Combines robots: those of a recipe, or with `attached` two, of which the first is `source`. Returns the notes on the
/// URDD, and those on the parts, each a kind and a message.
#[pyfunction]
#[allow(clippy::type_complexity)]
pub fn combine<'py>(
    py: Python<'py>,
    source: PathBuf,
    attached: Option<(PathBuf, Attached)>,
    target: PathBuf,
    options: Options,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyDict>, Vec<(&'static str, String)>)> {
    let made = with_progress(py, options, progress, move |settings, progress| {
        let recipe = match attached {
            None => Recipe::read(&source)?,
            Some((held, (link, pose, name))) => {
                Recipe::of_two(&source, &held, name.as_deref(), &link, pose)?
            }
        };
        let find_errors = |part: &Path| find_errors(part, &settings.cancellation);
        let distrusted = check_parts(&recipe, settings, find_errors)?;
        urdd_generate::combine::combine(&recipe, &target, settings, &distrusted, progress)
    })?;
    let made = made.map_err(|error| of_combine(py, &error))?;
    let notes = made.notes.iter();
    let notes = notes.map(|note| (note.kind, note.to_string())).collect();
    Ok((summary(py, &made.generated)?, notes))
}
