//! The descriptions among files, and a URDF of an MJCF, SDF or USD.

use serde::Deserialize;
use serde_json::{Value, json};
use urdd_directory::cancellation::Cancellation;
use urdd_import::import_whole;
use urdd_source::ImportOptions;
use urdd_source::dropped::{Dropped, descriptions};

use crate::around::GivenFiles;
use crate::files::Files;
use crate::{answer, memory};

/// How a ball joint is written.
#[derive(Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Ball {
    /// As a spherical joint.
    Spherical,
    /// As three revolute joints.
    Revolute,
}

/// The mass of links between the joints of one body.
#[derive(Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Massless {
    /// None.
    None,
    /// 1e-9 kg and 1e-9 kg m².
    Tiny,
}

/// What is chosen of a description that is no URDF, as in `urdd.import_robot` in Python.
pub fn options(
    body: Option<String>,
    model: Option<String>,
    ball: Option<Ball>,
    massless: Option<Massless>,
) -> ImportOptions {
    let has_revolute_balls = ball == Some(Ball::Revolute);
    let has_tiny_masses = massless == Some(Massless::Tiny);
    ImportOptions { body, model, has_revolute_balls, has_tiny_masses }
}

/// What is asked.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Question {
    /// The path of the MJCF, SDF or USD.
    path: String,
    body: Option<String>,
    model: Option<String>,
    ball: Option<Ball>,
    massless: Option<Massless>,
}

/// Imports an MJCF, SDF or USD among these files. The question is a [`Question`] as JSON. The answer has the address of `files`
/// (the URDF, its meshes, `NAME.srdf`, `NAME.export.toml`), the path of the `urdf` there, and the `report`.
///
/// # Safety
/// `files` is open; the question is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_import(
    files: *mut Files,
    question: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (files, question) = unsafe { (&*files, memory::bytes(question, length)) };
    answer::result(import(files, question))
}

fn import(files: &Files, question: &[u8]) -> Result<Value, String> {
    let question: Question = serde_json::from_slice(question).map_err(|error| error.to_string())?;
    let given = GivenFiles::of(files)?;
    let mut settings = given.settings(&question.path)?;
    settings.import = options(question.body, question.model, question.ball, question.massless);
    let path = given.place(&question.path);
    let imported = import_whole(&path, &settings, &Cancellation::default());
    let (imported, _) = imported.map_err(|error| error.to_string())?;
    let report = serde_json::from_str::<Value>(&imported.report.to_json());
    let report = report.map_err(|error| error.to_string())?;
    let files = Files::address_of("", imported.files)?;
    Ok(json!({ "files": files, "urdf": imported.urdf, "report": report }))
}

/// The descriptions among these files: `path`, `name` and `format` (`urdf`, `xacro`, `mjcf`, `sdf`, `usd`) of each.
///
/// # Safety
/// `files` is open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_descriptions(files: *mut Files) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let files = unsafe { &*files };
    answer::result(GivenFiles::of(files).map(|given| {
        let one = |Dropped { job, kind }: &Dropped| {
            json!({ "path": given.path(&job.source), "name": job.name, "format": kind.name() })
        };
        Value::from(descriptions(given.files()).iter().map(one).collect::<Vec<_>>())
    }))
}
