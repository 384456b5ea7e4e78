//! A URDD in the format of another program.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Deserialize;
use serde_json::{Value, json};
use urdd_directory::range::Range;
use urdd_export::{
    Choices, Fit, SAMPLES, SPHERES, Setup, SphereBudget, TOTAL_SPHERES, export as exported,
};
use urdd_robot::Robot;

use crate::files::Files;
use crate::{answer, memory};

/// What is asked. The options are those of `urdd.export` in Python.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Question {
    /// The word of the format.
    format: String,
    /// The name of the file, or of the package.
    output: String,
    shapes: Option<String>,
    #[serde(default)]
    keep_pairs: bool,
    spheres: Option<f64>,
    total_spheres: Option<f64>,
    samples: Option<f64>,
    visuals: Option<bool>,
    actuators: Option<String>,
    bandwidth: Option<f64>,
    #[serde(default)]
    floating_base: bool,
    #[serde(default)]
    merge_fixed: bool,
    root: Option<String>,
    fit: Option<[f64; 2]>,
    ros: Option<String>,
    /// The content of an `export.toml`.
    setup: Option<String>,
}

/// Exports the robot of the URDD in these files. The question is a [`Question`] as JSON. The answer has the address of
/// `files`, the path of the format's own file among them as `main`, `notes`, and the `report`.
///
/// # Safety
/// `files` is open; the question is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_export(
    files: *mut Files,
    question: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (files, question) = unsafe { (&*files, memory::bytes(question, length)) };
    answer::result(export(files, question))
}

fn export(files: &Files, question: &[u8]) -> Result<Value, String> {
    let question: Question = serde_json::from_slice(question).map_err(|error| error.to_string())?;
    let robot = Robot::of(files.root.clone());
    let format = question.format.parse().map_err(words)?;
    let made = exported(&robot, &choices(&question, &robot)?.options(format).map_err(words)?);
    let made = made.map_err(words)?;
    let main = made.path.unwrap_or(question.output);
    let mut all: BTreeMap<String, Arc<[u8]>> =
        made.files.into_iter().map(|(path, bytes)| (path, bytes.into())).collect();
    all.insert(main.clone(), made.text.into_bytes().into());
    let files = Files::address_of("", all)?;
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    let report: Value = serde_json::from_str(&made.report).map_err(words)?;
    Ok(json!({ "files": files, "main": main, "notes": notes, "report": report }))
}

fn choices(question: &Question, robot: &Robot) -> Result<Choices, String> {
    let count = |range: Range, given: Option<f64>| -> Result<Option<usize>, String> {
        let count = given.map(|given| range.check(given)).transpose().map_err(words)?;
        Ok(count.map(|count| count as usize))
    };
    let fit = question.fit.map(|[volume, standoff]| Fit::new(volume, standoff));
    let mut choices = Choices {
        keep_pairs: question.keep_pairs,
        spheres: SphereBudget::new(
            count(SPHERES, question.spheres)?,
            count(TOTAL_SPHERES, question.total_spheres)?,
        ),
        output: Some(question.output.clone().into()),
        bandwidth: question.bandwidth,
        floating_base: question.floating_base,
        merge_fixed: question.merge_fixed,
        root: question.root.clone(),
        fit: fit.transpose().map_err(words)?,
        ..Choices::default()
    };
    if let Some(word) = &question.shapes {
        choices.shapes = word.parse().map_err(words)?;
    }
    if let Some(word) = &question.actuators {
        choices.actuators = Some(word.parse().map_err(words)?);
    }
    if let Some(word) = &question.ros {
        choices.ros = Some(word.parse().map_err(words)?);
    }
    choices.samples = count(SAMPLES, question.samples)?.unwrap_or(choices.samples);
    choices.visuals = choices.visuals.filter(|_| question.visuals != Some(false));
    if let Some(text) = &question.setup {
        choices.setup = Some(Setup::from_toml(text, "export.toml", robot).map_err(words)?);
    }
    Ok(choices)
}

fn words(error: impl std::fmt::Display) -> String {
    error.to_string()
}
