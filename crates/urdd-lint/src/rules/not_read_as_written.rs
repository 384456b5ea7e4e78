use super::prelude::*;
use super::refused_by_programs::report;

declare_lint! {
    /// A program loads the robot, but leaves a part of it out, or reads a part otherwise than it is written.
    ///
    /// The robot that the program has is another one than the file describes, and the program says nothing of it, or
    /// prints a line that scrolls away. The finding names the programs, and what they make of it. What a program never
    /// has, such as a material in a program without pictures, is no fault and is not reported.
    ///
    /// Where `--for` or `for` in `urdd.toml` names programs, it is an information if only other programs do so.
    LNT061 "not-read-as-written", Warning, WrongMotion, since "1.3.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    report(urdf, false, findings);
    Some(())
}
