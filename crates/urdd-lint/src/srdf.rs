//! The SRDFs of a URDF: beside it, and in folders called `srdf` there and one level up. File and robot have its names.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use roxmltree::{Document, Node};

use super::subject::Subject;
use urdd_directory::regular;

/// Maximum size of an SRDF, bytes.
const MAX_BYTES: u64 = 16 << 20;

/// Calls `of` with each SRDF and its name as seen from the URDF's folder.
pub fn each(urdf: &Subject, mut of: impl FnMut(&str, &Document)) {
    for file in files(urdf) {
        let bytes = regular::read(&file, MAX_BYTES).ok();
        let text = bytes.and_then(|bytes| String::from_utf8(bytes).ok());
        let Some(text) = text else { continue };
        let Ok(document) = urdd_xml::parse(&text, urdd_xml::Kind::Robot) else {
            continue;
        };
        if document.root_element().attribute("name") == urdf.root.attribute("name") {
            let inside = file.strip_prefix(urdf.folder);
            let shown = inside.map_or_else(
                |_| format!("../srdf/{}", file.file_name().unwrap_or_default().to_string_lossy()),
                |inside| inside.to_string_lossy().replace('\\', "/"),
            );
            of(&shown, &document);
        }
    }
}

/// The pairs of links, each in order, of which an SRDF says that their collisions are not checked.
pub fn disabled_pairs(urdf: &Subject) -> BTreeSet<(String, String)> {
    let mut pairs = BTreeSet::new();
    each(urdf, |_, document| {
        let disabled = document
            .descendants()
            .filter(|node: &Node| node.tag_name().name() == "disable_collisions");
        pairs.extend(disabled.filter_map(|node| {
            let (a, b) = (node.attribute("link1")?, node.attribute("link2")?);
            Some((a.min(b).to_owned(), a.max(b).to_owned()))
        }));
    });
    pairs
}

fn files(urdf: &Subject) -> Vec<PathBuf> {
    let stem = Path::new(urdf.file).file_stem().unwrap_or_default().to_string_lossy();
    let above = urdf.folder.parent().map(|above| above.join("srdf"));
    let folders = [Some(urdf.folder.to_owned()), Some(urdf.folder.join("srdf")), above];
    let mut files = Vec::new();
    for folder in folders.into_iter().flatten() {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        files.extend(entries.map(|entry| entry.path()).filter(|path| {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            name.eq_ignore_ascii_case(&stem) && path.extension().is_some_and(|end| end == "srdf")
        }));
    }
    files.sort();
    files
}
