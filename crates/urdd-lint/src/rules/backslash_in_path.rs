use crate::rule::declare_lint;
use crate::subject::Subject;
use urdd_validate::finding::Findings;

declare_lint! {
    /// The name of a mesh or texture has a backslash.
    ///
    /// Only Windows takes it as a separator. MuJoCo finds the file elsewhere too; Pinocchio and PyBullet refuse it.
    ///
    /// Write `/`.
    LNT027 "backslash-in-path", Warning, MissingGeometry, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for file in urdf.named_files() {
        if !file.name.contains('\\') || file.is_absolute() {
            continue;
        }
        let message = "only Windows takes a backslash as a separator; write `/`";
        let mut finding = urdf
            .at_attribute(file.node, "filename", message)
            .actual(file.name);
        if let Some(range) = urdf.value(file.node, "filename") {
            let mended = urdf.text[range.clone()].replace('\\', "/");
            finding = finding.fix(urdf.fix("write `/`", range, mended));
        }
        finding.report(findings);
    }
    Some(())
}
