//! What a rule says of itself to those who read a report, and the family that it is of.

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

/// A family of rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Family {
    /// The three letters with which its codes begin.
    pub code: &'static str,
    /// Its name, in lower case.
    pub name: &'static str,
    /// What its rules check, as a sentence.
    pub about: &'static str,
}

macro_rules! families {
    ($($code:ident $name:literal $about:literal;)*) => {
        &[$(Family { code: stringify!($code), name: $name, about: $about }),*]
    };
}

/// The families, in the order of [`Code::ALL`]; without that of the rule that only tests have.
pub const FAMILIES: &[Family] = families! {
    DIR "directory" "Which files and folders a URDD has, and what `urdd.json` says of them.";
    JSN "JSON" "Whether JSON documents can be read, and mean the same to every reader.";
    YML "YAML" "Whether YAML documents can be read, and say what the JSON beside them says.";
    SCH "schemas" "Whether each document has the form that its module's schema asks for.";
    EXT "extensions" "Modules of your own: their schemas, indices and lengths.";
    URD "kinematic structure" "Links and joints: names, one root, no circle, mimics, and that they are the URDF's.";
    SRC "physics in the URDF" "Masses, inertias, limits and mimics that are impossible or missing.";
    DOF "degrees of freedom" "Which joints move, and which position belongs to which joint.";
    CHN "kinematic chain" "Parents, children, axes, origins and levels of the tree.";
    CON "connections" "The stored paths between links.";
    BND "bounds" "Limits of each DOF: positions, velocities, efforts.";
    CMP "composition" "What a combined robot says of the parts it was made of.";
    MSH "meshes" "Mesh files, hulls and convex pieces, compared with what they stand for.";
    SHP "collision shapes" "Boxes, spheres, skipped pairs of links and distances between links.";
    LRN "learned model" "The learned model of self-collisions, and how often it is wrong.";
    SPH "spheres of links" "Spheres that stand for links: whether they cover, how well they fit, and how often they are right.";
    KIN "kinematics" "Stored poses of links, computed again from the joints.";
    CNF "named configurations" "Configurations with a name, such as `home`.";
    LOP "loops" "Kinematic loops: what holds them, whether they close, and which DOFs move freely.";
    LEG "legacy" "URDDs from before version 1.";
    LNT "lint" "What programs refuse, leave out or read otherwise in a URDF. Only `urdd lint` has them.";
};

impl Family {
    /// The family of a code; `None` for the rule that only tests have.
    pub fn of(code: Code) -> Option<&'static Family> {
        FAMILIES.iter().find(|family| family.code == code.family())
    }
}
