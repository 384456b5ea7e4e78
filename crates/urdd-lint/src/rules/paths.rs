use std::collections::HashMap;
use std::ops::Range;
use std::path::PathBuf;

use super::prelude::*;
use urdd_source::{MissingMesh, OtherCase};

declare_lint! {
    /// A mesh or texture is named by an absolute path.
    ///
    /// No other machine has it there. After `file://` comes an absolute path: in `file://meshes/x.stl`, `meshes` is the name of
    /// a computer, and ROS finds nothing.
    ///
    /// Name it relative to the URDF, or by its package: `package://NAME/meshes/x.stl`.
    LNT026 "absolute-path", Error, MissingGeometry, since "1.1.0" => absolute_path;

    /// The name of a mesh or texture has a backslash.
    ///
    /// Only Windows takes it as a separator, and few programs do elsewhere. Where no file is there with `/` either, this finding
    /// says that as well.
    ///
    /// Write `/`.
    LNT027 "backslash-in-path", Warning, MissingGeometry, since "1.1.0" => backslash_in_path;

    /// A mesh or texture is not there, but a file whose path differs in the case of letters is.
    ///
    /// Windows and macOS find it, so its author does not notice; Linux does not. Of a texture it is an info: the part is white or grey.
    ///
    /// Write the name, and the folders in it, as they are called.
    LNT028 "letter-case", Error, MissingGeometry, since "1.1.0" => letter_case
}

fn absolute_path(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for file in urdf.named_files() {
        let message = if file.is_on_a_host() {
            "after `file://` comes an absolute path, and the first word here is the name of a computer; name the file \
            relative to the URDF, without `file://`"
        } else if file.is_absolute() {
            "the path is that of one machine; name the file relative to the URDF, or by its package"
        } else {
            continue;
        };
        let there = file.path().filter(|path| urdf.files.is_file(path));
        let relative = there
            .and_then(|path| path.strip_prefix(urdf.folder).ok()?.to_str())
            .filter(|relative| !relative.contains(['&', '<', '"', '\'', '\\']));
        let fix = relative.zip(urdf.value(file.node, "filename")).map(|(relative, range)| {
            urdf.fix("name it relative to the URDF", range, relative.to_owned())
        });
        let finding = urdf.at_attribute(file.node, "filename", message);
        finding.actual(file.name).fix(fix).report(findings);
    }
    Some(())
}

fn backslash_in_path(urdf: &Subject, findings: &mut Findings) -> Option<()> {
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

fn letter_case(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let meshes = urdf.meshes(findings)?.into_iter();
    let meshes = meshes.filter_map(|(node, mesh)| {
        let near = mesh.file.as_ref().err()?.other_case.clone()?;
        Some((node, mesh.filename.as_str(), near, None))
    });
    let textures = textures(urdf, findings)?.into_iter();
    let textures = textures.filter_map(|texture| {
        let near = texture.file.err()?.other_case?;
        let (node, name) = (texture.named.node, texture.named.name);
        // LNT030 says the others.
        near.is_only.then_some((node, name, near, Some(Severity::Info)))
    });
    for (node, name, near, severity) in meshes.chain(textures) {
        let value = urdf.value(node, "filename");
        let pieces = value.and_then(|value| pieces(urdf.text, value, &near));
        let from = pieces.as_ref().and_then(|pieces| pieces.first());
        let called = from.map_or(near.written.as_str(), |(_, from)| &near.written[*from..]);
        let message = match called.contains('/') {
            true => format!("the file is `{called}` there; write it so"),
            false => format!("the file is called `{called}`; write it so"),
        };
        let mut finding = urdf.at_attribute(node, "filename", message).actual(name);
        finding.severity = severity;
        if let Some(pieces) = pieces.filter(|_| near.is_only)
            && let (Some((first, _)), Some((last, _))) = (pieces.first(), pieces.last())
        {
            let range = first.start..last.end;
            let mut text = urdf.text[range.clone()].to_owned();
            for (piece, from) in &pieces {
                let (start, end) = (piece.start - range.start, piece.end - range.start);
                text.replace_range(start..end, &near.written[*from..from + piece.len()]);
            }
            finding = finding.fix(urdf.fix("write the name as the file has it", range, text));
        }
        finding.report(findings);
    }
    Some(())
}

/// The parts of a value, in order, whose letters have another case in the path of a file; each with its place in that path.
/// `None` if the value does not end with the path.
fn pieces(text: &str, value: Range<usize>, near: &OtherCase) -> Option<Vec<(Range<usize>, usize)>> {
    let mut found = Vec::new();
    let mut end = value.end;
    let mut to = near.written.len();
    for part in near.written.rsplit('/') {
        let written = &text[value.start..end];
        let start = value.start + written.rfind(['/', '\\']).map_or(0, |slash| slash + 1);
        let piece = &text[start..end];
        // Letters whose other case takes more bytes are left to people.
        if piece.len() != part.len() || piece.to_lowercase() != part.to_lowercase() {
            return None;
        }
        if piece != part {
            found.push((start..end, to - part.len()));
        }
        to = (to - part.len()).saturating_sub(1);
        end = start.saturating_sub(1).max(value.start);
    }
    found.reverse();
    (!found.is_empty()).then_some(found)
}
