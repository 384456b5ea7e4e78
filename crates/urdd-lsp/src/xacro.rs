//! Findings about what xacro makes of a file, shown in the file; and the files that it includes, as far as the text tells.

use std::cell::LazyCell;
use std::fs;
use std::path::{Path, PathBuf};

use lsp_types::{Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, Location};

use crate::diagnostics::{
    Found, at_the_top, diagnostic, failures, further, line_of, message, not_well_formed, of_check,
    of_offset,
};
use crate::document::Snapshot;
use crate::project::Project;
use urdd_findings::check::Check;
use urdd_findings::finding::Finding;
use urdd_format::index::Count;
use urdd_format::report::{MacroPlace, Place, WrittenAt};
use urdd_lint::{lint_source, lint_undeclared};
use urdd_source::macros::has_no_link;
use urdd_source::{FolderFacts, SourceError, read_source};
use urdd_xml::Xml;

/// What is wrong with the text as it is.
pub fn of_text(snapshot: &Snapshot) -> Vec<Found> {
    match not_well_formed(snapshot) {
        Some(found) => vec![found],
        None => missing(snapshot),
    }
}

/// What is wrong with the text, and with the robot that xacro makes of the file, if the user allows to expand it.
pub fn of_files(snapshot: &Snapshot, project: &Project) -> Vec<Found> {
    if let Some(found) = not_well_formed(snapshot) {
        return vec![found];
    }
    let mut found = missing(snapshot);
    let path = snapshot.path.as_ref().filter(|_| snapshot.options.xacro);
    let Some(path) = path.filter(|_| !is_part(snapshot)) else {
        return found;
    };
    let settings = &project.settings;
    let read = match read_source(path, &settings.source) {
        Ok(read) => read,
        Err(SourceError::NeedsArguments { needed, fault, .. }) => {
            let is_declared = !settings.source.xacro.arguments.is_empty();
            let examined = lint_undeclared(path, &needed, &fault, is_declared, settings);
            let examined = project.apply(snapshot, examined);
            found.extend(failures(snapshot, &examined));
            found.extend(examined.checks.iter().flat_map(|check| of_check(snapshot, check)));
            return found;
        }
        Err(error) => {
            found.push(of_error(snapshot, path, &error));
            return found;
        }
    };
    let xml = Xml::new(&read.text);
    if has_no_link(&xml) {
        return found;
    }
    let examined = project.apply(snapshot, lint_source(path, &read, &xml, settings));
    found.extend(failures(snapshot, &examined));
    let files = Files { own: fs::canonicalize(path).ok(), included: included(snapshot) };
    for check in &examined.checks {
        for finding in &check.findings {
            let place = |place| of_place(snapshot, &files, check, finding, place).into();
            found.extend(finding.places().map(place));
        }
    }
    found
}

/// Why there is no robot, at its place in the document; of one in another file, at the top, with that place beside it.
fn of_error(snapshot: &Snapshot, path: &Path, error: &SourceError) -> Found {
    let severity = DiagnosticSeverity::ERROR;
    let mut top = at_the_top(snapshot, severity, &error.to_string());
    let Some(at) = error.place().filter(|at| at.line > 0) else { return top };
    let file = fs::canonicalize(&at.file).unwrap_or_default();
    if fs::canonicalize(path).is_ok_and(|own| own == file) {
        let begin = snapshot.text.reported(at.line as usize, at.column as usize);
        top.diagnostic.range = snapshot.text.range(begin..snapshot.text.line_end(begin).max(begin));
    } else {
        let place = line_of(&file, at.line as usize);
        top.diagnostic.related_information =
            place.map(|place| vec![further(place, "xacro stops here")]);
    }
    top
}

/// Whether only other files make a robot of it: `<robot>` without a name.
fn is_part(snapshot: &Snapshot) -> bool {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    !markup.elements.is_empty() && markup.attribute(text, 0, "name").is_none()
}

/// A finding at the place in the file that xacro made the element from; if that is in another file, where the value is used
/// or the macro called in this one, or at the element that includes that file; if it is not known, at the element of the same
/// name; else at the top.
fn of_place(
    snapshot: &Snapshot,
    files: &Files,
    check: &Check,
    finding: &Finding,
    place: &Place,
) -> Diagnostic {
    let mut message = message(finding, place);
    let mut related = Vec::new();
    let written = place.written_at.as_ref().filter(|at| at.line.is_some());
    let offset = match written.map(|at| Written::new(snapshot, files, at)) {
        Some(Written::Here(offset)) => offset,
        Some(Written::There { location, words, offset }) => {
            message += &format!(" ({words})");
            related.extend(location.map(|location| further(location, &words)));
            offset
        }
        None => same_name(snapshot, place).unwrap_or_else(|| snapshot.text.content_start()),
    };
    related.extend(written.into_iter().flat_map(|written| trail(snapshot, written)));
    let mut found = of_offset(snapshot, check, finding, place, offset, &message);
    found.related_information = Some(related).filter(|related| !related.is_empty());
    found
}

/// Where a value is used, and the calls of macros by which xacro came there.
fn trail(snapshot: &Snapshot, at: &WrittenAt) -> Vec<DiagnosticRelatedInformation> {
    let words = |what: &str, place: &MacroPlace| match &place.macro_name {
        Some(name) => format!("{what}: macro `{name}`"),
        None => what.to_owned(),
    };
    let used_at = at.used_at.iter().map(|place| (place, words("the value is used here", place)));
    let calls = at.calls.iter().map(|place| (place, words("called here", place)));
    let shown = used_at.chain(calls).filter_map(|(place, words)| {
        let location = line_of(&resolved(snapshot, &place.file), place.line.get())?;
        Some(further(location, &words))
    });
    shown.collect()
}

/// A file of a report, with symbolic links resolved.
fn resolved(snapshot: &Snapshot, file: &str) -> PathBuf {
    fs::canonicalize(snapshot.folder.join(file)).unwrap_or_default()
}

/// The document's own file, and those that it includes with the byte offsets of the elements that do, with symbolic links
/// resolved.
struct Files {
    own: Option<PathBuf>,
    included: Vec<(PathBuf, usize)>,
}

/// Where an element is written.
enum Written {
    /// In the document, at a byte offset.
    Here(usize),
    /// In a file that the element at `offset` includes.
    There { location: Option<Location>, words: String, offset: usize },
}

impl Written {
    fn new(snapshot: &Snapshot, files: &Files, at: &WrittenAt) -> Self {
        let (line, column) = (at.line.map_or(1, Count::get), at.column.map_or(1, Count::get));
        let file = resolved(snapshot, &at.file);
        if files.own.as_ref() == Some(&file) {
            return Written::Here(snapshot.text.reported(line, column));
        }
        let mut around = at.used_at.iter().chain(&at.calls);
        let here = around.find(|place| files.own == Some(resolved(snapshot, &place.file)));
        let in_macro = |name| format!(", in the macro `{name}`");
        let in_macro = at.macro_name.as_ref().map(in_macro).unwrap_or_default();
        let mut included = files.included.iter();
        let element = included.find(|(included, _)| *included == file);
        Written::There {
            location: line_of(&file, line),
            words: format!("written at {}:{line}{in_macro}", at.file),
            offset: match (here, element) {
                (Some(here), _) => snapshot.text.reported(here.line.get(), here.column.get()),
                (None, Some((_, start))) => *start,
                (None, None) => snapshot.text.content_start(),
            },
        }
    }
}

/// The element that a place's subject, such as ``link `base` ``, names.
fn same_name(snapshot: &Snapshot, place: &Place) -> Option<usize> {
    let subject = place.subject.as_deref()?;
    let mut parts = subject.split('`');
    let kind = parts.next()?.trim();
    let name = parts.next()?;
    let element = snapshot.outline().element(kind, name)?;
    Some(snapshot.markup().elements[element].tag.start)
}

struct Include {
    element: usize,
    file: PathBuf,
}

/// Elements whose content xacro may leave out.
const CONDITIONAL: [&str; 3] = ["xacro:if", "xacro:unless", "xacro:macro"];

/// Included files that are not there.
fn missing(snapshot: &Snapshot) -> Vec<Found> {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    let is_certain = |element: usize| {
        let mut around = markup.ancestors(element);
        let optional = markup.value(text, element, "optional");
        optional.is_none() && !around.any(|one| CONDITIONAL.contains(&markup.name(text, one)))
    };
    let missing = includes(snapshot).filter(|one| is_certain(one.element) && !one.file.exists());
    missing
        .filter_map(|one| {
            let attribute = markup.attribute(text, one.element, "filename")?;
            let message = format!(
                "the included file is missing: {}; xacro refuses this file",
                one.file.display()
            );
            let range = snapshot.text.range(attribute.value.clone());
            let severity = DiagnosticSeverity::ERROR;
            Some(diagnostic(range, severity, "", &message, (None, None)).into())
        })
        .collect()
}

/// The included files that are there, with symbolic links resolved, and the byte offsets of the elements that include them.
fn included(snapshot: &Snapshot) -> Vec<(PathBuf, usize)> {
    let start = |element: usize| snapshot.markup().elements[element].tag.start;
    let resolved = |one: Include| Some((fs::canonicalize(one.file).ok()?, start(one.element)));
    includes(snapshot).filter_map(resolved).collect()
}

/// The included files whose paths the text tells.
fn includes(snapshot: &Snapshot) -> impl Iterator<Item = Include> {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    let folder = snapshot.path.as_deref().and_then(Path::parent);
    let packages = LazyCell::new(move || folder.map(own_packages).unwrap_or_default());
    let all =
        (0..markup.elements.len()).filter(|element| markup.name(text, *element) == "xacro:include");
    all.filter_map(move |element| {
        let name = markup.value(text, element, "filename")?;
        Some(Include { element, file: named(&name, folder?, &packages)? })
    })
}

/// The file of a name; `None` if only xacro can tell.
fn named(name: &str, folder: &Path, packages: &[(String, &Path)]) -> Option<PathBuf> {
    let (start, rest) = match name.strip_prefix("$(find ") {
        Some(rest) => {
            let (package, rest) = rest.split_once(")/")?;
            let own = packages.iter().find(|(name, _)| name == package.trim())?;
            (own.1, rest)
        }
        None => (folder, name),
    };
    // Substitutions and patterns are xacro's matter.
    let is_plain =
        !rest.is_empty() && !rest.contains(['$', '*', '?', '[']) && !rest.contains("://");
    is_plain.then(|| start.join(rest))
}

/// The packages that contain a folder: others may be anywhere.
fn own_packages(folder: &Path) -> Vec<(String, &Path)> {
    let facts = FolderFacts::new(&urdd_source::Files::Disk);
    let named = |above| Some((facts.package_name(above)?.to_string(), above));
    folder.ancestors().filter_map(named).collect()
}
