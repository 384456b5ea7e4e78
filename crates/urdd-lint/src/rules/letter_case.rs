use std::ops::Range;

use super::prelude::*;
use urdd_findings::description::Severity;
use urdd_source::OtherCase;

declare_lint! {
    /// A mesh or texture is not there, but a file whose path differs in the case of letters is.
    ///
    /// Windows and macOS find it, so its author does not notice. On Linux, MuJoCo, Pinocchio and PyBullet do not. Of a texture
    /// it is an info: the part is white or grey.
    ///
    /// Write the name, and the folders in it, as they are called.
    LNT028 "letter-case", Error, MissingGeometry, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
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
