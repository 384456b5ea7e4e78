use std::collections::HashMap;
use std::path::PathBuf;

use super::prelude::*;
use urdd_source::MissingMesh;

declare_lint! {
    /// The name of a mesh or texture has a backslash.
    ///
    /// Only Windows takes it as a separator. MuJoCo finds the file elsewhere too; Pinocchio and PyBullet refuse it. Where no
    /// file is there with `/` either, this finding says that as well.
    ///
    /// Write `/`.
    LNT027 "backslash-in-path", Warning, MissingGeometry, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let source = urdf.source(&mut Findings::default());
    let meshes = source.iter().flat_map(|source| &source.meshes);
    let meshes = meshes.map(|mesh| (mesh.filename.as_str(), &mesh.file)).collect();
    for file in urdf.named_files() {
        if !file.name.contains('\\') || file.is_absolute() {
            continue;
        }
        let message = "only Windows takes a backslash as a separator; write `/`";
        let range =
            urdf.value(file.node, "filename").filter(|_| is_there(urdf, &meshes, file.name));
        let fix = range.map(|range| {
            let with_slashes = urdf.text[range.clone()].replace('\\', "/");
            urdf.fix("write `/`", range, with_slashes)
        });
        let finding = urdf.at_attribute(file.node, "filename", message);
        finding.actual(file.name).fix(fix).report(findings);
    }
    Some(())
}

/// The files of meshes, by their names.
type Meshes<'a> = HashMap<&'a str, &'a Result<PathBuf, MissingMesh>>;

/// Whether the file is there with slashes, and not with the backslashes that Linux has in names.
fn is_there(urdf: &Subject, meshes: &Meshes, name: &str) -> bool {
    let by_slashes =
        |path: &Path| urdf.files.is_file(path) && !path.to_string_lossy().contains('\\');
    match meshes.get(name) {
        Some(Ok(file)) => by_slashes(file),
        Some(Err(missing)) => missing.outside.as_deref().is_some_and(by_slashes),
        None => {
            let in_folder = |name: &str| urdf.files.is_file(&urdf.folder.join(name));
            !in_folder(name) && in_folder(&name.replace('\\', "/"))
        }
    }
}
