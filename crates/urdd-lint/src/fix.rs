//! Mends what has one right answer, in the file that a path leads to.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;
use urdd_directory::listing::ReadError;
use urdd_directory::position::{LineIndex, Position};
use urdd_directory::regular;
use urdd_findings::finding::Finding;
use urdd_format::index::Count;
use urdd_format::report::{Fix, Place, TextEdit};
use urdd_source::Format;
use urdd_xml::element::{Edit, apply};

use crate::sources::within_limits;
use crate::{LintError, LintSettings, sources, stems};

/// How often a file is examined again: a mended fault may uncover another one.
const ROUNDS: usize = 10;
/// Stays where it is.
const BYTE_ORDER_MARK: &str = "\u{feff}";

/// A file whose text changes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mended {
    /// The file, as it was found.
    pub path: PathBuf,
    /// The file to write, with links resolved; or why it is left as it is.
    pub target: Result<PathBuf, LeftAlone>,
    /// Its text as it was read.
    pub before: String,
    /// The text that is to be there.
    pub after: String,
    /// Number of mended places.
    pub places: usize,
}

/// Why a mended file was not written.
#[derive(Debug, Error)]
pub enum ChangedError {
    /// Somebody wrote to it meanwhile.
    #[error("the file was changed while it was examined, and is left as it is; run it again")]
    Changed,
    /// It is gone, or cannot be read.
    #[error("the file cannot be read again: {0}")]
    Unreadable(#[from] ReadError),
}

impl Mended {
    /// Checks that `target` is still the file that was read: itself, and not a link by now.
    ///
    /// # Errors
    /// If it is not.
    pub fn check(&self, target: &Path) -> Result<(), ChangedError> {
        let is_itself = target.canonicalize().is_ok_and(|now| now == target);
        match regular::read(target, self.before.len() as u64) {
            Ok(bytes) if is_itself && bytes == self.before.as_bytes() => Ok(()),
            Ok(_) | Err(ReadError::TooLong { .. }) => Err(ChangedError::Changed),
            Err(error) => Err(error.into()),
        }
    }
}

/// What the safe fixes of all findings make of the files, as `lint` would report them. Writes nothing. Text that xacro made
/// is left out, as is a file that is not UTF-8: its places are not those of a text that a person wrote. `is_forced` also
/// changes files that are read-only or have several names.
///
/// # Errors
/// If a path has nothing to examine, or the run is cancelled.
pub fn mend(
    paths: &[PathBuf],
    settings: &LintSettings,
    is_forced: bool,
) -> Result<Vec<Mended>, LintError> {
    let jobs = sources(paths, settings)?.jobs;
    let mut files: Vec<PathBuf> = jobs.into_iter().map(|job| job.source).collect();
    files.dedup();
    let to = |path: &Path| target(path, paths, is_forced).ok();
    within_limits(&files, settings, |file| file, |file, settings| mended(file, settings, to))
}

fn mended(
    path: &Path,
    settings: &LintSettings,
    target: impl Fn(&Path) -> Option<Result<PathBuf, LeftAlone>>,
) -> Option<Mended> {
    let read = urdd_source::read_source(path, &settings.source).ok()?;
    // Fixes of an MJCF, SDF or USD are for the URDF that an import makes of it.
    if Format::of(&read.text).is_some() || read.trail.is_some() {
        return None;
    }
    let before = String::from_utf8(read.bytes().to_owned()).ok()?;
    let mark = if before.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK } else { "" };
    if read.text != before[mark.len()..] {
        return None;
    }
    let (folder, name) = stems(path);
    let folder = folder.canonicalize().unwrap_or(folder);
    let mut text = read.text;
    let mut places = 0;
    for _ in 0..ROUNDS {
        let examined = crate::lint_text(&text, &name, &folder, settings);
        let examined = settings.apply(Some(path), name.clone(), examined);
        let findings = examined.checks.iter().flat_map(|check| &check.findings);
        let (next, mended) = with_fixes(&text, &name, findings.flat_map(Finding::places));
        if mended == 0 || settings.source.cancellation.is_cancelled() {
            break;
        }
        (text, places) = (next, places + mended);
    }
    let after = format!("{mark}{text}");
    if after == before {
        return None;
    }
    Some(Mended { path: path.to_owned(), target: target(path)?, before, after, places })
}

/// The text with the safe fix of each place, and their number. Of two that overlap, the second waits.
fn with_fixes<'a>(
    text: &str,
    name: &str,
    places: impl Iterator<Item = &'a Place>,
) -> (String, usize) {
    let lines = LineIndex::new(text);
    let fixes = places.filter_map(|place| {
        let of_file = |fix: &&Fix| fix.is_safe && fix.edits.iter().all(|edit| edit.file == name);
        place.fixes.iter().find(of_file)
    });
    let mut all: Vec<Edit> = Vec::new();
    // The ends of edits by their beginnings: none touches another fix.
    let mut ends: BTreeMap<usize, usize> = BTreeMap::new();
    let mut mended = 0;
    for fix in fixes {
        let edits: Option<Vec<Edit>> = fix.edits.iter().map(|edit| edit_of(&lines, edit)).collect();
        let Some(edits) = edits else { continue };
        let touches = |edit: &Edit| {
            let before = ends.range(..=edit.range.end).next_back();
            before.is_some_and(|(_, end)| *end >= edit.range.start)
        };
        if edits.iter().any(touches) {
            continue;
        }
        mended += 1;
        for edit in &edits {
            let end = ends.entry(edit.range.start).or_default();
            *end = edit.range.end.max(*end);
        }
        all.extend(edits);
    }
    (apply(text, all), mended)
}

fn edit_of(lines: &LineIndex, edit: &TextEdit) -> Option<Edit> {
    let offset =
        |line: Count, column: Count| lines.offset(Position { line: line.0, column: column.0 });
    let start = offset(edit.line, edit.column)?;
    let end = offset(edit.end_line, edit.end_column)?;
    (start <= end).then(|| Edit { range: start..end, text: edit.text.clone() })
}

/// Why a file is left as it is.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LeftAlone {
    /// A link in a folder that was named leads to a file that is in none.
    #[error("the link leads to {}, outside of what was named; name that file to mend it", .0.display())]
    Outside(PathBuf),
    /// It has several names, and a new file has one of them.
    #[error(
        "the file has {0} names (hard links), and the others would keep the old text; --force mends this one"
    )]
    HardLinks(u64),
    /// It may not be written to.
    #[error("the file is read-only; make it writable, or mend it with --force")]
    ReadOnly,
}

/// The file that a path leads to, with links resolved. `named` are the paths on the command line; `is_forced` allows files
/// that are read-only or have several names.
pub fn target(
    path: &Path,
    named: &[PathBuf],
    is_forced: bool,
) -> io::Result<Result<PathBuf, LeftAlone>> {
    let target = path.canonicalize()?;
    let mut named = named.iter().filter_map(|named| named.canonicalize().ok());
    if !named.any(|named| target.starts_with(named)) {
        return Ok(Err(LeftAlone::Outside(target)));
    }
    let metadata = fs::metadata(&target)?;
    let names = names(&metadata);
    if names > 1 && !is_forced {
        return Ok(Err(LeftAlone::HardLinks(names)));
    }
    // Another user's file has bits that count for that user alone.
    #[expect(clippy::disallowed_methods, reason = "it asks whether it could, and writes nothing")]
    let is_refused = || {
        let opened = OpenOptions::new().write(true).open(&target);
        opened.is_err_and(|error| error.kind() == io::ErrorKind::PermissionDenied)
    };
    if !is_forced && (metadata.permissions().readonly() || is_refused()) {
        return Ok(Err(LeftAlone::ReadOnly));
    }
    Ok(Ok(target))
}

#[cfg(unix)]
fn names(metadata: &fs::Metadata) -> u64 {
    std::os::unix::fs::MetadataExt::nlink(metadata)
}

/// Elsewhere, the standard library does not say.
#[cfg(not(unix))]
fn names(_: &fs::Metadata) -> u64 {
    1
}
