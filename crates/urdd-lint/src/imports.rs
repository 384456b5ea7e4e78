//! Lints the URDF that an import makes, and says of each finding where the original has what it is about.

use std::path::{Path, PathBuf};

use crate::examine::examined;
use crate::settings::LintSettings;
use crate::written::{named, say_where};
use urdd_findings::examined::Examined;
use urdd_format::index::Count;
use urdd_format::report::{ImportedFrom, ImportedPart, StaleIgnore, WrittenAt};
use urdd_import::Imported;
use urdd_source::SourceError;
use urdd_source::written::seen_from;
use urdd_xml::Xml;

/// What is found in the URDF of an import of the file `name` in `folder`, and the comments in it that matched nothing.
///
/// # Errors
/// If its files are more than memory may hold.
pub(crate) fn examined_import(
    imported: &Imported,
    (folder, name): (PathBuf, String),
    settings: &LintSettings,
) -> Result<(Examined, Vec<StaleIgnore>), SourceError> {
    let folder = settings.source.files.canonicalize(&folder).unwrap_or(folder);
    let settings =
        LintSettings { source: imported.settings(&settings.source)?, ..settings.clone() };
    let (mut examined, unused) =
        examined(&Xml::new(imported.text()), None, &name, Path::new("/"), &settings);
    let find = |kind: &str, part: &str| {
        let (file, line, column) = imported.place(kind, part)?;
        let is_main = file == imported.shown;
        Some(WrittenAt {
            file: if is_main { name.clone() } else { seen_from(Path::new(file), &folder) },
            line: Some(Count(line)),
            column: Some(Count(column)),
            macro_name: None,
        })
    };
    say_where(&mut examined.checks, &name, |place| {
        let (kind, part) = named(place.subject.as_deref()?)?;
        find(kind, part)
    });
    for effect in examined.report.programs.iter_mut().flat_map(|program| &mut program.effects) {
        // Such as `joint/elbow/limit`; a name may have slashes too.
        let part = effect.part.as_deref().and_then(|part| part.split_once('/'));
        let written = part.filter(|(kind, _)| matches!(*kind, "link" | "joint"));
        let written = written.and_then(|(kind, part)| {
            let ends = part.match_indices('/').map(|(end, _)| end).chain([part.len()]);
            ends.rev().find_map(|end| find(kind, &part[..end]))
        });
        // An effect has a line, and no file.
        let written = written.filter(|at| at.file == name);
        (effect.line, effect.column) = written.map_or((None, None), |at| (at.line, at.column));
    }
    examined.report.imported = Some(imported_from(imported));
    Ok((examined, unused))
}

fn imported_from(imported: &Imported) -> ImportedFrom {
    let report = &imported.report;
    let part = |what: &str, count: usize, how: Option<&str>| ImportedPart {
        what: what.to_owned(),
        count: Count::saturating(count),
        how: how.map(str::to_owned),
    };
    let otherwise = report.otherwise().map(|(what, count, how)| part(what, count, Some(how)));
    ImportedFrom {
        format: report.format.name().to_owned(),
        otherwise: otherwise.collect(),
        lost: report.lost().map(|(what, count)| part(what, count, None)).collect(),
        notes: report.remarks.iter().map(ToString::to_string).collect(),
    }
}
