use super::prelude::*;

declare_lint! {
    /// A .urdf is a xacro file.
    ///
    /// Programs ignore its `xacro:` elements, and take `${...}` and `$(...)` as text: the robot is empty, or has meshes
    /// called `$(arg ...)`. No other rule looks at such a file; the report lists them as not checked.
    ///
    /// Expand it, `xacro robot.urdf.xacro > robot.urdf`, or lint it with `--xacro`, and
    /// `name:=value` for its arguments. Parts that another file includes are linted with that file.
    LNT051 "xacro-not-expanded", Error, Format, since "1.1.0" => xacro_not_expanded;

    /// A xacro file needs arguments.
    ///
    /// An argument has no default, or one for which the package has no files or the file leaves a property undefined
    /// (`<xacro:if value="${side == 'left'}">`), or `<robot>` itself names it (xacro reads `<robot name="$(arg name)">` before
    /// any default), and nobody gives a value. Then there is no robot, and no other rule looks at the file.
    ///
    /// Declare the robots of the file in `urdd.toml`: `urdd lint --write-robots` writes the lines of the message, with the
    /// values for which the package has files, and `urdd info` lists all arguments. Or give values, as in
    /// `urdd lint arm.urdf.xacro type:=short`.
    LNT065 "needs-arguments", Info, Format, since "1.3.0"
    // There is no robot to look at where it finds something: see `needs`.
    => |_, _| Some(())
}

fn xacro_not_expanded(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    if let Some(node) = urdf.macros() {
        let message = "this is a xacro file, and programs take its macros as text; expand it, or lint it with --xacro";
        urdf.at(node, message).report(findings);
    }
    Some(())
}
