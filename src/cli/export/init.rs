//! `urdd export init`.

use std::path::PathBuf;

use super::arguments::ExportArguments;
use crate::cli::{output, shapes};
use urdd_export::Setup;
use urdd_format::escape;

/// Writes `NAME.export.toml`, or another file. One that exists is a person's: it stays.
pub(super) fn write(arguments: &ExportArguments) -> Result<(), String> {
    let robot = shapes::open(&arguments.path)?;
    let shown = |path: &PathBuf| escape::line(&path.display().to_string()).into_owned();
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", shown(&arguments.path));
    let setup = Setup::guess(&robot).map_err(|error| failed(&error))?;
    let text = setup.to_toml(&robot).map_err(|error| failed(&error))?;
    let file = arguments.output.clone();
    let file = file.unwrap_or_else(|| Setup::path(&arguments.path));
    if file.as_os_str() == "-" {
        return output::print_raw(&text);
    }
    if file.symlink_metadata().is_ok() && !arguments.force {
        return Err(format!(
            "{} already exists and was left as it is: `-o -` prints the guesses, --force overwrites it",
            shown(&file)
        ));
    }
    output::write_file(&file, &text)?;
    output::print(&format!(
        "{}: written; check the lines that begin with `# Guess`\n",
        shown(&file)
    ))
}
