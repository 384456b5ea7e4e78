//! What a rule says of itself, to those who read a report.

use super::code::Code;
pub use urdd_format::report::{Consequence, Severity};

/// A rule's documentation.
pub struct Description {
    /// Its code.
    pub code: Code,
    /// Its name, which states the fault.
    pub name: &'static str,
    /// Severity of its findings, unless settings change it.
    pub severity: Severity,
    /// The clause of SPEC.md that it checks; `None` for rules about robots, which are not of SPEC.md.
    pub clause: Option<&'static str>,
    /// The first version of urdd that has it.
    pub since: &'static str,
    /// Effect of the fault on users of the URDD.
    pub consequence: Consequence,
    /// When it runs.
    pub phase: Phase,
    /// Its documentation in Markdown, line by line: what is wrong, why it matters, what to do.
    pub doc: &'static [&'static str],
}

/// When a rule runs. Phases run in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Phase {
    /// The files of the URDD.
    Files,
    /// JSON and YAML as text.
    Syntax,
    /// Documents against their schemas.
    Schema,
    /// Values against each other, within and across modules.
    References,
    /// Meshes, and their bounding boxes and bounding spheres.
    Geometry,
    /// Poses.
    Kinematics,
    /// Distances between shapes in sampled configurations.
    Statistics,
}

impl Description {
    /// Its documentation as a single text.
    pub fn explanation(&self) -> String {
        let lines: Vec<&str> =
            self.doc.iter().map(|line| line.strip_prefix(' ').unwrap_or(line)).collect();
        lines.join("\n").trim().to_owned()
    }

    /// The first paragraph of its documentation.
    pub fn summary(&self) -> String {
        let text = self.explanation();
        text.split("\n\n").next().unwrap_or_default().replace('\n', " ")
    }
}
