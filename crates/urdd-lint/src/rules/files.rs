use std::collections::HashMap;
use std::ops::Range;
use std::path::PathBuf;

use percent_encoding::percent_decode_str;
use urdd_findings::part::SkipReason;
use urdd_format::escape;
use urdd_source::{Files, MissingMesh, OtherCase};

use super::prelude::*;
use crate::beside::NamedFile;

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
    LNT028 "letter-case", Error, MissingGeometry, since "1.1.0" => letter_case;

    /// A mesh is not there.
    ///
    /// Programs refuse the robot, or have no shape there. RViz shows nothing at that place, and planners see no
    /// collision. A mesh of a package that is not found is LNT037's, unless a package or folder of a near name has it: write that
    /// name, or rename the folder. A file that is there, outside of the robot's folder and packages, is no finding; its shape is
    /// read with `--allow-folder`.
    ///
    /// Correct the name, or add the file. A relative name is relative to the URDF.
    LNT029 "mesh-not-found", Error, MissingGeometry, since "1.1.0" => mesh_not_found;

    /// A package that the URDF names is not found.
    ///
    /// It may be installed elsewhere: then name it, `--package NAME=FOLDER`, or set ROS_PACKAGE_PATH or AMENT_PREFIX_PATH. Rules
    /// about geometry do not look at links whose meshes are in it.
    ///
    /// Correct the name, or say where the package is.
    LNT037 "package-not-found", Info, MissingGeometry, since "1.1.0", off by default => package_not_found;

    /// A texture of a mesh or of a `<material>`, or the material library of an OBJ, is not there.
    ///
    /// The part is white or grey. Meshcat and Drake warn. Textures of a package that is not found are LNT037's.
    ///
    /// Add the file, or correct the name in the mesh or in the URDF. A mesh names files beside itself.
    LNT030 "texture-missing", Info, Appearance, since "1.1.0" => texture_missing
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
        let range = urdf
            .value(file.node, "filename")
            .filter(|_| is_there_with_slashes(urdf, &meshes, file.name));
        let fix = range.map(|range| {
            let with_slashes = urdf.text[range.clone()].replace('\\', "/");
            urdf.fix("write `/`", range, with_slashes)
        });
        let finding = urdf.at_attribute(file.node, "filename", message);
        finding.actual(file.name).fix(fix).report(findings);
    }
    Some(())
}

type Meshes<'a> = HashMap<&'a str, &'a Result<PathBuf, MissingMesh>>;

/// Whether the file is there with slashes, and not with the backslashes that Linux has in names.
fn is_there_with_slashes(urdf: &Subject, meshes: &Meshes, name: &str) -> bool {
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
    let textures = textures.filter_map(|(NamedFile { node, name }, file)| {
        let near = file.err()?.other_case?;
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

/// How far up to look for a name that is relative to a folder above the URDF.
const LEVELS: usize = 6;

fn mesh_not_found(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.meshes(findings)? {
        let Err(missing) = &mesh.file else { continue };
        let file = NamedFile { node, name: &mesh.filename };
        // Other rules say these.
        if missing.other_case.is_some()
            || missing.no_package.is_some() && !missing.is_in_near_package()
            || missing.outside.is_some()
            || file.is_absolute()
            || file.is_on_a_host()
        {
            continue;
        }
        let mut above = urdf.folder.ancestors().skip(1).take(LEVELS);
        let is_plain = !mesh.filename.contains("://");
        let above =
            above.find(|folder| is_plain && urdf.files.is_file(&folder.join(&mesh.filename)));
        let near = missing.near_package.as_ref().zip(missing.no_package.as_ref());
        let near = near.map(|(near, package)| near.in_words(package));
        let message = near.unwrap_or_else(|| match above {
            Some(folder) => format!(
                "the file is there only from the folder `{}` above, where few programs look; name it relative to the URDF",
                folder.file_name().unwrap_or_default().to_string_lossy()
            ),
            None if mesh.filename.starts_with("package:///") => {
                "the name has no package, which stands after `package://`; write it".to_owned()
            }
            None => "the file is not there; correct the name, or add the file".to_owned(),
        });
        urdf.at_attribute(node, "filename", message).actual(&mesh.filename).report(findings);
    }
    Some(())
}

fn package_not_found(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let mut told = BTreeSet::new();
    let meshes = urdf.meshes(findings)?;
    let textures = textures(urdf, findings)?;
    let of_meshes = meshes.into_iter().map(|(node, mesh)| (node, mesh.file.clone()));
    let of_textures = textures.into_iter().map(|(named, file)| (named.node, file));
    for (node, file) in of_meshes.chain(of_textures) {
        let Some((package, near)) = file.err().and_then(|missing| {
            // LNT029 says these.
            let is_said = node.tag_name().name() == "mesh" && missing.is_in_near_package();
            Some((missing.no_package.filter(|_| !is_said)?, missing.near_package))
        }) else {
            continue;
        };
        if told.insert(package.clone()) {
            let message = near.map(|near| near.in_words(&package)).unwrap_or_else(|| {
                format!(
                    "there is no package `{package}` at or above the URDF; say where it is: --package {}=FOLDER",
                    escape::shell(&package)
                )
            });
            urdf.at_attribute(node, "filename", message).report(findings);
        }
    }
    Some(())
}

fn texture_missing(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    // With another scale, a mesh names the same files.
    let mut seen = BTreeSet::new();
    for (node, mesh) in urdf.read_meshes(findings)? {
        let (Ok(facts), GeometryKind::Visual) = (mesh.facts, mesh.kind) else { continue };
        if !seen.insert(mesh.file) {
            continue;
        }
        let folder = mesh.file.parent().unwrap_or(Path::new("."));
        for name in &facts.side_files {
            if !is_there(urdf.files, folder, name) {
                let message = format!(
                    "the mesh names the file `{}`, which is not there; add it beside the mesh",
                    urdd_format::escape::line(name)
                );
                urdf.at_attribute(node, "filename", message).report(findings);
            }
        }
    }
    for (named, file) in textures(urdf, findings)? {
        let Err(missing) = file else { continue };
        // Other rules say these.
        let in_other_case = missing.other_case.is_some_and(|near| near.is_only);
        if in_other_case
            || missing.no_package.is_some()
            || missing.outside.is_some()
            || named.is_absolute()
            || named.is_on_a_host()
            || named.is_fetched()
        {
            continue;
        }
        let message = "the texture is not there; correct the name, or add the file";
        let finding = urdf.at_attribute(named.node, "filename", message);
        finding.actual(named.name).report(findings);
    }
    Some(())
}

/// Whether a file is there by its name, as it is or as a URI.
fn is_there(files: &Files, folder: &Path, name: &str) -> bool {
    let plain = name.strip_prefix("file://").or_else(|| name.strip_prefix("file:")).unwrap_or(name);
    let plain = plain.replace('\\', "/");
    let plain = plain.trim();
    let decoded = percent_decode_str(plain).decode_utf8_lossy();
    plain.is_empty()
        || plain.starts_with("data:")
        || files.is_file(&folder.join(plain))
        || files.is_file(&folder.join(&*decoded))
}

/// A `<texture>` and the name there, and its file, or why there is none.
type Texture<'a> = (NamedFile<'a, 'a>, Result<PathBuf, MissingMesh>);

/// The textures of materials, each name once an element. Skips the rule if the URDF describes no robot.
fn textures<'a>(urdf: &Subject<'a>, findings: &mut Findings) -> Option<Vec<Texture<'a>>> {
    let source = urdf.source(findings)?;
    let in_material = |file: &NamedFile<'a, 'a>| {
        let above = file.node.parent_element();
        !file.name.trim().is_empty()
            && file.node.tag_name().name() == "texture"
            && above.is_some_and(|above| above.tag_name().name() == "material")
    };
    let named = urdf.named_files().into_iter().filter(in_material);
    let mut all = Vec::new();
    for named in named {
        let file = source.find(named.name);
        if let Some(why) = file.as_ref().err().and_then(|missing| missing.stopped) {
            findings.skip(SkipReason::obstacle(format!("textures were not looked for: {why}")))?;
        }
        all.push((named, file));
    }
    Some(all)
}
