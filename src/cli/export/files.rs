//! Writes what was exported.

use std::path::{Path, PathBuf};

use super::arguments::{ExportArguments, Target};
use crate::cli::inputs;
use crate::cli::output::{self, Failure, about, shown};
use urdd_export::{Export, merge_srdf};

/// The existing SRDF, merged with the new pairs.
fn merged(file: &Path, new: &str) -> Result<String, Failure> {
    let help = |error| format!("{error}; omit --update to write a new file");
    let merged = merge_srdf(&inputs::srdf(file).map_err(help)?, new).map_err(about(file))?;
    let pairs = |count: usize| match count {
        1 => "1 pair of links".to_owned(),
        _ => format!("{count} pairs of links"),
    };
    if merged.kept > 0 {
        let pairs = pairs(merged.kept);
        output::error(&format!(
            "note: kept {pairs} that a person disabled: their reason is not Adjacent, Always, Default or Never"
        ));
    }
    if merged.enabled > 0 {
        let pairs = pairs(merged.enabled);
        output::error(&format!("note: did not disable {pairs} that a person enabled"));
    }
    Ok(merged.text)
}

/// Writes the text, the other files and the report. What exists is overwritten on request only.
pub(super) fn write(
    arguments: &ExportArguments,
    output: &Path,
    mut made: Export,
) -> Result<(), Failure> {
    let report = arguments.report.clone().map(|file| (file, made.report.as_bytes()));
    if output.as_os_str() == "-" {
        let report: Vec<(PathBuf, &[u8])> = report.into_iter().collect();
        refuse_others(arguments, &report)?;
        output::write_files(&report)?;
        return Ok(output::print_raw(&made.text)?);
    }
    let (own, folder) = match &made.path {
        Some(path) => (output.join(path), output),
        None => (output.to_owned(), output.parent().unwrap_or(Path::new(""))),
    };
    let is_merged = arguments.update && (made.path.is_none() || own.exists());
    if is_merged {
        made.text = merged(&own, &made.text)?;
    }
    // The file that references the others is last.
    let files = made.files.iter().map(|(path, bytes)| (folder.join(path), bytes.as_slice()));
    let mut files: Vec<(PathBuf, &[u8])> = files.collect();
    if arguments.update {
        files.retain(|file| {
            let stays = output::is_other(file);
            if stays {
                output::error(&format!("note: {} stays as it is", shown(&file.0)));
            }
            !stays
        });
    }
    files.extend(report);
    let own = (own, made.text.as_bytes());
    refuse_others(arguments, files.iter().chain((!is_merged).then_some(&own)))?;
    files.push(own);
    Ok(output::write_files(&files)?)
}

/// An error if a file exists with different content.
fn refuse_others<'f>(
    arguments: &ExportArguments,
    files: impl IntoIterator<Item = &'f (PathBuf, &'f [u8])>,
) -> Result<(), Failure> {
    if !arguments.force {
        let also = match arguments.format {
            Target::Srdf => "; --update replaces the pairs of links in it",
            Target::Moveit => {
                "; --update replaces the pairs of links in the SRDF, and leaves other files as they are"
            }
            _ => "",
        };
        output::refuse_others(files, also)?;
    }
    Ok(())
}
