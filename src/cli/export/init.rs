//! `urdd export init`.

use super::arguments::ExportArguments;
use crate::cli::inputs;
use crate::cli::output::{self, Failure, about, shown};
use urdd_export::Setup;

/// Writes `NAME.export.toml`, or another file. One that exists is a person's: it stays.
pub(super) fn write(arguments: &ExportArguments) -> Result<(), Failure> {
    let path = &arguments.path;
    let robot = inputs::open(path)?;
    let setup = Setup::guess(&robot).map_err(about(path))?;
    let text = setup.to_toml(&robot).map_err(about(path))?;
    let file = arguments.output.clone().unwrap_or_else(|| Setup::path(path));
    if file.as_os_str() == "-" {
        return Ok(output::print_raw(&text)?);
    }
    if file.symlink_metadata().is_ok() && !arguments.force {
        Err(format!(
            "{} already exists and was left as it is: `-o -` prints the guesses, --force overwrites it",
            shown(&file)
        ))?;
    }
    output::write_alone(&file, &text, arguments.force)?;
    let file = shown(&file);
    let text = format!("{file}: written; check the lines that begin with `# Guess`\n");
    Ok(output::print(&text)?)
}
