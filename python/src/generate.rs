//! Generation of URDDs, and combination of robots.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::ModuleKind;
use urdd_format::word::UnknownWord;
use urdd_generate::batch::caught;
use urdd_generate::combine::{Recipe, check_parts};
use urdd_generate::{Generated, MeshFormats, Pieces, Progress, Selection, Settings};
use urdd_validate::find_errors;

use crate::errors::{of_combine, of_generate};
use crate::source::{Source, is_second};
use crate::work::{self, Step, Teller};

/// The options of `urdd.generate`, which checks their types.
#[derive(FromPyObject)]
pub struct Options {
    modules: Option<Vec<String>>,
    source: Source,
    geometry: String,
    mesh_formats: Vec<String>,
    pieces: u8,
    piece_tolerance: Option<f64>,
    samples: u32,
    skip: Option<Vec<String>>,
    reference: Option<String>,
    strict: bool,
    drop_edits: bool,
    force: bool,
}

impl Options {
    fn settings(self) -> Result<Settings, String> {
        let selection = match &self.modules {
            None => Selection::all(),
            Some(words) => Selection::parse(words.iter().map(String::as_str))
                .map_err(|error| format!("modules: {error}"))?,
        };
        let source = self.source.settings()?;
        let skip = skipped_reasons(self.skip).map_err(|error| error.to_string())?;
        for word in &self.mesh_formats {
            if !["glb", "stl", "obj"].contains(&word.as_str()) {
                let word = word.escape_debug();
                return Err(format!(
                    "mesh_formats: there is no `{word}`; there are: glb, stl, obj"
                ));
            }
        }
        let is_collision = is_second("geometry", &self.geometry, ["visual", "collision"])?;
        let has = |word: &str| self.mesh_formats.iter().any(|format| format == word);
        let settings = Settings {
            selection,
            source,
            preferred_geometry: match is_collision {
                false => GeometryKind::Visual,
                true => GeometryKind::Collision,
            },
            mesh_formats: MeshFormats { stl: has("stl"), obj: has("obj") },
            pieces: Pieces { most: self.pieces, tolerance: self.piece_tolerance },
            num_samples: self.samples,
            model_effort: Default::default(),
            skipped_reasons: skip,
            reference: self.reference,
            strict: self.strict,
            drop_edits: self.drop_edits,
            force: self.force,
            donors: Vec::new(),
        };
        settings.check().map_err(|error| error.to_string())?;
        Ok(settings)
    }
}

/// The reasons of these words.
fn skipped_reasons(words: Option<Vec<String>>) -> Result<Option<Vec<SkippedReason>>, UnknownWord> {
    words.map(|words| words.iter().map(|word| word.parse()).collect()).transpose()
}

/// Reports the progress of a job.
struct Told<'a> {
    teller: &'a Teller,
    /// The module that began last, and the total number of modules.
    last: Mutex<Option<(ModuleKind, usize)>>,
}

impl Progress for Told<'_> {
    fn module(&self, kind: ModuleKind, done: usize, total: usize) {
        // The first module of the next URDD, in a combination of several.
        if done == 0 {
            self.end();
        }
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        *last = Some((kind, total));
        self.teller.tell((kind.name().to_owned(), done, total));
    }

    fn part(&self, kind: ModuleKind, done: usize, total: usize) {
        let step = format!("{}: step", kind.name());
        self.teller.tell((step, done, total));
    }
}

impl Told<'_> {
    /// Reports that all modules are finished.
    fn end(&self) {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((kind, total)) = last.take() {
            self.teller.tell((kind.name().to_owned(), total, total));
        }
    }
}

/// Runs a job, and calls `progress` with its progress.
fn with_progress<T: Send, E: Send>(
    py: Python<'_>,
    options: Options,
    progress: Option<Bound<'_, PyAny>>,
    make: impl FnOnce(&Settings, &dyn Progress) -> Result<T, E> + Send,
) -> PyResult<Result<T, E>> {
    let mut settings = options.settings().map_err(PyValueError::new_err)?;
    let hear = |step: Step| match &progress {
        Some(progress) => progress.call1(step).map(drop),
        None => Ok(()),
    };
    work::run_and_tell(py, hear, move |cancellation, teller| {
        settings.source.cancellation = cancellation.clone();
        let told = Told { teller, last: Mutex::default() };
        let made = make(&settings, &told);
        if made.is_ok() {
            told.end();
        }
        made
    })
}

/// The summary of a generated URDD.
fn summary<'py>(py: Python<'py>, generated: &Generated) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    found.set_item("robot_name", &generated.robot_name)?;
    found.set_item("num_links", generated.num_links)?;
    found.set_item("num_joints", generated.num_joints)?;
    found.set_item("num_dofs", generated.num_dofs)?;
    found.set_item("conformance_class", generated.class.as_str())?;
    let kept = |kept: bool| -> Vec<&str> {
        let modules = generated.modules.iter().filter(|made| made.kept == kept);
        modules.map(|made| made.kind.name()).collect()
    };
    found.set_item("modules_made", kept(false))?;
    found.set_item("modules_kept", kept(true))?;
    found.set_item("changed", generated.changed)?;
    found.set_item("meshes_named", generated.meshes.named)?;
    found.set_item("meshes_not_found", generated.meshes.not_found)?;
    found.set_item("meshes_not_usable", generated.meshes.not_usable)?;
    let notes = generated.notes.iter().map(|note| {
        (
            note.kind.as_str(),
            note.file.clone(),
            note.line,
            note.column,
            note.problem.clone(),
            note.assumed.clone(),
        )
    });
    found.set_item("notes", notes.collect::<Vec<_>>())?;
    Ok(found)
}

/// Generates a URDD from a file, or from `text` if given, whose relative mesh names are resolved from the folder
/// `source`.
#[pyfunction]
pub fn generate<'py>(
    py: Python<'py>,
    source: PathBuf,
    text: Option<Vec<u8>>,
    target: PathBuf,
    options: Options,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let made = with_progress(py, options, progress, move |settings, progress| match text {
        None => caught(&source, || urdd_generate::generate(&source, &target, settings, progress)),
        Some(text) => {
            let shown = "<text>";
            caught(shown.as_ref(), || {
                urdd_generate::generate_text(text, shown, &source, &target, settings, progress)
            })
        }
    })?;
    summary(py, &made.map_err(|error| of_generate(py, &error))?)
}

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
        let find_errors = |part: &Path| find_errors(part, &settings.source.cancellation);
        let distrusted = check_parts(&recipe, settings, find_errors)?;
        urdd_generate::combine::combine(&recipe, &target, settings, &distrusted, progress)
    })?;
    let made = made.map_err(|error| of_combine(py, &error))?;
    let notes = made.notes.iter();
    let notes = notes.map(|note| (note.kind, note.to_string())).collect();
    Ok((summary(py, &made.generated)?, notes))
}
