use super::prelude::*;

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
