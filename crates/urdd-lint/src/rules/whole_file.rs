use urdd_findings::code::Code;

use super::prelude::*;

declare_lint! {
    /// A program refuses the whole robot.
    ///
    /// For each program there is a reader, a model of how that program reads a URDF, which is held to the program on
    /// thousands of changed files (`docs/lint.md` has the versions). The finding names the programs that have no robot
    /// because of this fault, and what the others do with it. Where another rule finds the same fault, that rule's
    /// finding names the programs instead. ros2_control refuses a robot if none of its controllers can start; the robot
    /// itself may load everywhere.
    ///
    /// It is an error if ROS refuses the robot, or two of the other programs do; else a warning. Where `--for` or
    /// `for` in `urdd.toml` names programs, it is an error if one of these refuses the robot, and an information if only
    /// others do.
    LNT060 "refused-by-programs", Warning, Format, since "1.3.0" => |urdf, findings| report(urdf, Code::LNT060, findings);

    /// A program loads the robot, but leaves a part of it out, or reads a part otherwise than it is written.
    ///
    /// The robot that the program has is another one than the file describes, and the program says nothing of it, or
    /// prints a line that scrolls away. The finding names the programs, and what they make of it. What a program never
    /// has, such as a material in a program without pictures, is no fault and is not reported.
    ///
    /// Where `--for` or `for` in `urdd.toml` names programs, it is an information if only other programs do so.
    LNT061 "not-read-as-written", Warning, WrongMotion, since "1.3.0" => |urdf, findings| report(urdf, Code::LNT061, findings);

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
    /// any default), and nobody gives a value. Then there is no robot, no other rule looks at the file, and it does not pass: it
    /// was not examined. Of a file that is named, or of which `urdd.toml` declares robots, it is an error.
    ///
    /// Declare the robots of the file in `urdd.toml`: `urdd lint --write-robots` writes the lines of the message, with the
    /// values for which the package has files, and `urdd info` lists all arguments. Or give values, as in
    /// `urdd lint arm.urdf.xacro type:=short`.
    LNT065 "needs-arguments", Info, Format, since "1.3.0"
    // There is no robot to look at where it finds something: see `needs`.
    => |_, _| Some(())
}

fn report(urdf: &Subject, code: Code, findings: &mut Findings) -> Option<()> {
    let found = urdf.programs.get().into_iter().flatten();
    found.filter(|(of, _)| *of == code).for_each(|(_, one)| findings.report(one.clone()));
    Some(())
}

fn xacro_not_expanded(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    if let Some(node) = urdf.macros() {
        let message = "this is a xacro file, and programs take its macros as text; expand it, or lint it with --xacro";
        urdf.at(node, message).report(findings);
    }
    Some(())
}
