use crate::rule::declare_lint;
use crate::subject::Subject;
use urdd_findings::finding::Findings;

declare_lint! {
    /// A mesh or texture is named by an absolute path.
    ///
    /// No other machine has it there. After `file://` comes an absolute path: in `file://meshes/x.stl`, `meshes` is the name of
    /// a computer, and ROS finds nothing.
    ///
    /// Name it relative to the URDF, or by its package: `package://NAME/meshes/x.stl`.
    LNT026 "absolute-path", Error, MissingGeometry, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for file in urdf.named_files() {
        let message = if file.is_on_a_host() {
            "after `file://` comes an absolute path, and the first word here is the name of a computer; name the file \
            relative to the URDF, without `file://`"
        } else if file.is_absolute() {
            "the path is that of one machine; name the file relative to the URDF, or by its package"
        } else {
            continue;
        };
        let mut finding = urdf.at_attribute(file.node, "filename", message).actual(file.name);
        let inside = file.path().and_then(|path| path.strip_prefix(urdf.folder).ok());
        let relative = inside.and_then(|inside| inside.to_str());
        let is_there = file.path().is_some_and(std::path::Path::is_file);
        if let (Some(relative), Some(range), true) =
            (relative, urdf.value(file.node, "filename"), is_there)
            && !relative.contains(['&', '<', '"', '\'', '\\'])
        {
            finding =
                finding.fix(urdf.fix("name it relative to the URDF", range, relative.to_owned()));
        }
        finding.report(findings);
    }
    Some(())
}
