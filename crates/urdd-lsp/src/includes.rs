//! The files that a xacro file includes, as far as the text tells: nothing is expanded.

use std::fs;
use std::path::{Path, PathBuf};

use lsp_types::DiagnosticSeverity;

use crate::diagnostics::{Found, diagnostic};
use crate::document::Snapshot;

/// An element that includes a file.
struct Include {
    element: usize,
    file: PathBuf,
}

/// Elements whose content xacro may leave out.
const CONDITIONAL: [&str; 3] = ["xacro:if", "xacro:unless", "xacro:macro"];
/// Maximum number of bytes of a package.xml.
const MAX_PACKAGE_XML: u64 = 1 << 20;

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

/// Byte offset of the element that includes a file.
pub fn that_includes(snapshot: &Snapshot, file: &Path) -> Option<usize> {
    let is_it = |one: &Include| {
        let included = fs::canonicalize(&one.file);
        included.is_ok_and(|included| included == file)
    };
    let found = includes(snapshot).find(is_it)?;
    Some(snapshot.markup().elements[found.element].tag.start)
}

/// The included files whose paths the text tells.
fn includes(snapshot: &Snapshot) -> impl Iterator<Item = Include> {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    let folder = snapshot.path.as_deref().and_then(Path::parent);
    let all =
        (0..markup.elements.len()).filter(|element| markup.name(text, *element) == "xacro:include");
    all.filter_map(move |element| {
        let name = markup.value(text, element, "filename")?;
        Some(Include {
            element,
            file: named(&name, folder?)?,
        })
    })
}

/// The file of a name; `None` if only xacro can tell.
fn named(name: &str, folder: &Path) -> Option<PathBuf> {
    let (start, rest) = match name.strip_prefix("$(find ") {
        Some(rest) => {
            let (package, rest) = rest.split_once(")/")?;
            (own_package(package.trim(), folder)?, rest)
        }
        None => (folder, name),
    };
    // Substitutions and patterns are xacro's matter.
    let is_plain =
        !rest.is_empty() && !rest.contains(['$', '*', '?', '[']) && !rest.contains("://");
    is_plain.then(|| start.join(rest))
}

/// The folder of a package that contains a folder: other packages may be anywhere.
fn own_package<'f>(name: &str, folder: &'f Path) -> Option<&'f Path> {
    let element = format!("<name>{name}</name>");
    folder.ancestors().find(|above| {
        let file = above.join("package.xml");
        let text = urdd_directory::regular::read(&file, MAX_PACKAGE_XML);
        text.is_ok_and(|text| String::from_utf8_lossy(&text).contains(&element))
    })
}
