use std::fs;
use std::path::Path;

use crate::rule::declare_lint;
use crate::subject::Subject;
use urdd_validate::finding::Findings;

declare_lint! {
    /// A mesh is not there, but a file whose name differs in the case of letters is.
    ///
    /// Windows and macOS find it, so its author does not notice. On Linux, MuJoCo, Pinocchio and PyBullet do not.
    ///
    /// Write the name as the file has it.
    LNT028 "letter-case", Error, MissingGeometry, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.meshes(findings)? {
        let Err(missing) = &mesh.file else {
            continue;
        };
        let file = missing.other_case.as_deref();
        let Some((file, name)) = file.and_then(|file| Some((file, file.file_name()?.to_str()?)))
        else {
            continue;
        };
        let message = format!("the file is called `{name}`; write it so");
        let mut finding = urdf
            .at_attribute(node, "filename", message)
            .actual(&mesh.filename);
        let range = urdf.value(node, "filename");
        let end = range.filter(|_| is_only(file, name)).filter(|range| {
            let written = &urdf.text[range.clone()];
            written.len() >= name.len()
                && written.is_char_boundary(written.len() - name.len())
                && written[written.len() - name.len()..].to_lowercase() == name.to_lowercase()
        });
        if let Some(range) = end {
            let range = range.end - name.len()..range.end;
            finding =
                finding.fix(urdf.fix("write the name as the file has it", range, name.to_owned()));
        }
        finding.report(findings);
    }
    Some(())
}

/// Whether no other file of the folder has this name in some case.
fn is_only(file: &Path, name: &str) -> bool {
    let name = name.to_lowercase();
    let entries = file.parent().and_then(|folder| fs::read_dir(folder).ok());
    let names = entries.into_iter().flatten().flatten();
    let names = names.map(|entry| entry.file_name().to_string_lossy().to_lowercase());
    names.filter(|other| *other == name).count() == 1
}
