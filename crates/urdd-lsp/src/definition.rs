//! Where something that is named is defined.

use std::path::{Path, PathBuf};

use lsp_types::{Location, Position, Range};

use crate::document::Snapshot;
use crate::reference::{Names, reference};
use crate::uri;

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
    Some(Location { uri: uri::of_path(&file?)?, range: Range::default() })
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
