//! The report of a URDF.

use std::path::Path;
use std::sync::Arc;

use serde::Deserialize;
use urdd_directory::listing::EntryKind;
use urdd_directory::root::Root;
use urdd_findings::report;
use urdd_findings::settings::parse_program;
use urdd_lint::{LintSettings, lint_with_text};
use urdd_source::{Files as Around, MAX_SOURCE_BYTES};

use crate::files::Files;
use crate::{answer, memory};

/// Maximum size of a mesh file, bytes.
const MAX_FILE_BYTES: u64 = 1 << 30;

/// What is asked.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Question {
    /// The path of the URDF; it may be left out where there is one alone.
    urdf: Option<String>,
    /// The programs that it is for.
    #[serde(default, rename = "for")]
    programs: Vec<String>,
}

/// The report on a URDF among these files, as `urdd lint --format json` prints it. The question is a [`Question`] as JSON.
///
/// # Safety
/// `files` is open; the question is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_lint(
    files: *mut Files,
    question: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (files, question) = unsafe { (&*files, memory::bytes(question, length)) };
    match lint(files, question) {
        Ok(report) => answer::text(&report),
        Err(error) => answer::result(Err(error)),
    }
}

fn lint(files: &Files, question: &[u8]) -> Result<String, String> {
    let question: Question = serde_json::from_slice(question).map_err(|error| error.to_string())?;
    let paths = paths(&files.root)?;
    let urdf = urdf(&paths, question.urdf)?;
    let mut settings = LintSettings::default();
    for name in &question.programs {
        let known = parse_program(name).map_err(|error| error.to_string())?;
        settings.report.programs.push(known);
    }
    // In a folder of its name, as on a disk: programs look for packages by the names of folders.
    let name = files.root.folder_name();
    let is_plain = !name.is_empty() && !name.contains(['/', '\\']) && !name.starts_with('.');
    let folder = if is_plain { name.as_str() } else { "robot" };
    let mut all = Vec::new();
    for path in &paths {
        let limit = if *path == urdf { MAX_SOURCE_BYTES } else { MAX_FILE_BYTES };
        let bytes = files.read(path, limit).map_err(|error| format!("{path}: {error}"))?;
        all.push((format!("{folder}/{path}"), Arc::from(bytes)));
    }
    settings.source.files = Around::in_memory(all).map_err(|error| error.to_string())?;
    let linted = lint_with_text(&Path::new("/").join(folder).join(&urdf), None, &settings);
    let (run, _) = linted.map_err(|error| error.to_string())?;
    report::json(&run.report).map_err(|error| error.to_string())
}

fn paths(root: &Root) -> Result<Vec<String>, String> {
    let listing = root.list().map_err(|error| error.to_string())?;
    let files = listing.entries.into_iter().filter(|entry| entry.kind == EntryKind::File);
    Ok(files.map(|entry| entry.path).collect())
}

/// The URDF that is asked about, or the only one.
fn urdf(paths: &[String], asked: Option<String>) -> Result<String, String> {
    if let Some(asked) = asked {
        let is_there = paths.contains(&asked);
        let missing = || format!("there is no file `{}`", asked.escape_debug());
        return if is_there { Ok(asked) } else { Err(missing()) };
    }
    let mut urdfs = paths.iter().filter(|path| path.ends_with(".urdf"));
    match (urdfs.next(), urdfs.next()) {
        (Some(only), None) => Ok(only.clone()),
        (None, _) => Err("there is no .urdf among the files".to_owned()),
        (Some(first), Some(second)) => Err(format!(
            "there are several URDFs, such as `{}` and `{}`: name one as `urdf`",
            first.escape_debug(),
            second.escape_debug()
        )),
    }
}
