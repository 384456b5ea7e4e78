//! A URDD in the format of another program.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Deserialize;
use serde_json::{Map, Value, json};
use urdd_export::{Choice, Choices, Setup, export as exported};
use urdd_robot::Robot;

use crate::files::Files;
use crate::{answer, memory};

/// What is asked.
#[derive(Deserialize)]
struct Question {
    /// The word of the format.
    format: String,
    /// The name of the file, or of the package.
    output: String,
    /// The content of an `export.toml`.
    setup: Option<String>,
    /// The options, as those of `urdd.export` in Python.
    #[serde(flatten)]
    chosen: Map<String, Value>,
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
    let mut choices =
        Choices { output: Some(question.output.clone().into()), ..Choices::default() };
    for (name, value) in &question.chosen {
        Choice::named(name).map_err(words)?.set(&mut choices, value).map_err(words)?;
    }
    if let Some(text) = &question.setup {
        choices.setup = Some(Setup::from_toml(text, "export.toml", robot).map_err(words)?);
    }
    Ok(choices)
}

fn words(error: impl std::fmt::Display) -> String {
    error.to_string()
}
