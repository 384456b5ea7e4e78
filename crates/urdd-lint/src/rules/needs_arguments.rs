use super::prelude::*;

declare_lint! {
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
}

/// There is no robot to look at where it finds something: see `needs`.
fn check(_: &Subject, _: &mut Findings) -> Option<()> {
    Some(())
}
