use super::prelude::*;
use urdd_findings::code::Code;

declare_lint! {
    /// A program refuses the whole robot.
    ///
    /// For each program there is a reader, a model of how that program reads a URDF, which is held to the program on
    /// thousands of changed files (`docs/lint.md` has the versions). The finding names the programs that have no robot
    /// because of this fault, and what the others do with it. Where another rule finds the same fault, that rule's
    /// finding names the programs instead.
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
    LNT061 "not-read-as-written", Warning, WrongMotion, since "1.3.0" => |urdf, findings| report(urdf, Code::LNT061, findings)
}

/// Reports the faults that this rule tells of.
fn report(urdf: &Subject, code: Code, findings: &mut Findings) -> Option<()> {
    let left = urdf.programs.get().into_iter().flatten();
    for fault in left.filter(|fault| fault.code == code) {
        fault.reported(urdf.at_offset(fault.offset, &fault.message)).report(findings);
    }
    Some(())
}
