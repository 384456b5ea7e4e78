//! The files that a xacro file includes, as far as the text tells: nothing is expanded.

use std::cell::LazyCell;
use std::fs;
use std::path::{Path, PathBuf};

use lsp_types::DiagnosticSeverity;

use crate::diagnostics::{Found, diagnostic};
use crate::document::Snapshot;
use urdd_source::{Files, package_name};

/// An element that includes a file.
struct Include {
    element: usize,
    file: PathBuf,
}

/// Elements whose content xacro may leave out.
const CONDITIONAL: [&str; 3] = ["xacro:if", "xacro:unless", "xacro:macro"];

/// Included files that are not there.
pub fn missing(snapshot: &Snapshot) -> Vec<Found> {
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
pub fn included(snapshot: &Snapshot) -> Vec<(PathBuf, usize)> {
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
    let named = |above| Some((package_name(above, &Files::Disk)?, above));
    folder.ancestors().filter_map(named).collect()
}
