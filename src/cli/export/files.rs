//! Writes what was exported.

use std::path::{Path, PathBuf};

use super::arguments::{self, ExportArguments};
use crate::cli::inputs;
use crate::cli::output::{self, Failure, about, shown};
use urdd_directory::outputs::{self, Output, Target};
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
    let report = arguments.report.as_deref().map(|file| (file, made.report.as_bytes()));
    let force = arguments.force;
    if output.as_os_str() == "-" {
        if let Some((file, _)) = report {
            output::write_files(Target::File(file), Vec::new(), report, force, "")?;
        }
        return Ok(output::print_raw(&made.text)?);
    }
    let (own, target) = match &made.path {
        Some(path) => (PathBuf::from(path), Target::Folder(output)),
        None => (outputs::name_of(output).into(), Target::File(output)),
    };
    let place = target.folder().join(&own);
    let is_merged = arguments.update && (made.path.is_none() || place.exists());
    if is_merged {
        made.text = merged(&place, &made.text)?;
    }
    // The file that references the others is last.
    let mut files: Vec<Output> = (made.files.iter())
        .map(|(path, bytes)| Output { path: path.into(), bytes, replaces: force })
        .collect();
    if arguments.update {
        files.retain(|file| {
            let place = target.folder().join(&file.path);
            let stays = outputs::is_other(&place, file.bytes);
            if stays {
                output::error(&format!("note: {} stays as it is", shown(&place)));
            }
            !stays
        });
    }
    files.push(Output { path: own, bytes: made.text.as_bytes(), replaces: force || is_merged });
    let also = match arguments.format {
        arguments::Target::Srdf => "; --update replaces the pairs of links in it",
        arguments::Target::Moveit => {
            "; --update replaces the pairs of links in the SRDF, and leaves other files as they are"
        }
        _ => "",
    };
    Ok(output::write_files(target, files, report, force, also)?)
}
