//! What a place of a URDF names: a link, a joint, a material, a mesh; and where that is defined.

use std::ops::Range;
use std::path::{Path, PathBuf};

use lsp_types::{Location, Position};

use crate::document::Snapshot;
use crate::markup::{Attribute, Markup, Place, unescaped};
use crate::uri;

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// What it is; links and joints are told apart where the text has a link of the name.
    pub to: Names,
    pub name: String,
    /// The bytes that name it.
    pub range: Range<usize>,
    pub element: usize,
}

/// What the names in an attribute are of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Names {
    Links,
    Joints,
    Both,
    Materials,
    Meshes,
}

/// What an attribute of an element names.
pub fn names(text: &str, markup: &Markup, element: usize, attribute: &str) -> Option<Names> {
    let parent = markup.parent_name(text, element).unwrap_or_default();
    match (parent, markup.name(text, element), attribute) {
        (_, "parent" | "child", "link") | (_, "link", "name") => Some(Names::Links),
        // URDF+.
        ("loop" | "coupling", "predecessor" | "successor", "link") => Some(Names::Links),
        (_, "mimic", "joint") | (_, "joint", "name") => Some(Names::Joints),
        (_, "gazebo", "reference") => Some(Names::Both),
        (_, "material", "name") => Some(Names::Materials),
        (_, "mesh", "filename") => Some(Names::Meshes),
        _ => None,
    }
}

/// What is named at an offset: in the value of an attribute, or by the tag of a link or joint.
pub fn reference(snapshot: &Snapshot, offset: usize) -> Option<Found> {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    let names = |element, attribute: &Attribute| {
        names(text, markup, element, &text[attribute.name.clone()])
    };
    let (element, attribute, range) = match markup.place(text, offset) {
        Place::Content { .. } | Place::EndTag { .. } => return None,
        Place::Value { element, attribute } => {
            let attribute = markup.elements[element].attributes.get(attribute)?;
            (element, attribute, attribute.value.clone())
        }
        // Anywhere else in the start tag: its first attribute that names something.
        Place::TagName { element } | Place::AttributeName { element, .. } => {
            let tag = &markup.elements[element];
            let mut attributes = tag.attributes.iter();
            let first = attributes.find(|attribute| names(element, attribute).is_some())?;
            (element, first, tag.tag.clone())
        }
    };
    let name = unescaped(&text[attribute.value.clone()]).into_owned();
    let to = match names(element, attribute)? {
        Names::Both if snapshot.outline().link(&name).is_some() => Names::Links,
        Names::Both => Names::Joints,
        to => to,
    };
    Some(Found { to, name, range, element })
}

/// Where what a position names is defined.
pub fn definition(snapshot: &Snapshot, at: Position) -> Option<Location> {
    let found = reference(snapshot, snapshot.text.offset(at))?;
    let kind = match found.to {
        Names::Links => "link",
        Names::Joints | Names::Both => "joint",
        Names::Materials => "material",
        Names::Meshes => return mesh(snapshot, &found.name),
    };
    let element = snapshot.outline().element(kind, &found.name)?;
    let markup = snapshot.markup();
    let name = markup.attribute(snapshot.text.as_str(), element, "name")?;
    Some(Location { uri: snapshot.uri.clone(), range: snapshot.text.range(name.value.clone()) })
}

fn mesh(snapshot: &Snapshot, name: &str) -> Option<Location> {
    let file = match snapshot.robot() {
        Some(model) => {
            let mut meshes = model.source.meshes.iter();
            let mesh = meshes.find(|mesh| mesh.filename == name)?;
            mesh.file.clone().ok().or_else(|| folder(snapshot, name))
        }
        // A xacro file, or a URDF that describes no robot yet: only plain names are looked for.
        None => plain(&snapshot.folder, name),
    };
    Some(Location { uri: uri::of_path(&file?)?, range: lsp_types::Range::default() })
}

/// The nearest folder above a file that was not found, below the URDF's package.
fn folder(snapshot: &Snapshot, name: &str) -> Option<PathBuf> {
    let (_, rest) = name.split_once("://")?;
    let (package, rest) = rest.split_once('/').unwrap_or((rest, ""));
    let mut above = snapshot.folder.ancestors();
    let package = above.find(|above| above.file_name().is_some_and(|found| found == package))?;
    let inside = package.join(rest);
    let mut folders = inside.ancestors().skip(1);
    let found = folders.find(|folder| folder.is_dir() && folder.starts_with(package));
    found.map(Path::to_owned)
}

fn plain(folder: &Path, name: &str) -> Option<PathBuf> {
    let file = folder.join(name.strip_prefix("file://").unwrap_or(name));
    file.is_file().then_some(file)
}
