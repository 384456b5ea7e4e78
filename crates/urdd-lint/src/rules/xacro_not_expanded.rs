use super::prelude::*;

declare_lint! {
    /// A .urdf is a xacro file.
    ///
    /// Programs ignore its `xacro:` elements, and take `${...}` and `$(...)` as text: the robot is empty, or has meshes
    /// called `$(arg ...)`. No other rule looks at such a file; the report lists them as not checked.
    ///
    /// Expand it, `xacro robot.urdf.xacro > robot.urdf`, or lint it with `--xacro`, and
    /// `name:=value` for its arguments. Parts that another file includes are linted with that file.
    LNT051 "xacro-not-expanded", Error, Format, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    if let Some(node) = urdf.macros() {
        let message = "this is a xacro file, and programs take its macros as text; expand it, or lint it with --xacro";
        urdf.at(node, message).report(findings);
    }
    Some(())
}
