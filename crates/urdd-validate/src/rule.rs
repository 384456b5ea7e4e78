//! What a rule is: what it says, what it needs, and how it checks.

use super::code::Code;
use super::context::Context;
use super::finding::Findings;
use super::part::{PartKind, Parts};
use urdd_format::registry::ModuleKind;
pub use urdd_format::report::{Consequence, Severity};

/// When a rule runs. Phases run in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Phase {
    /// What lies in the directory.
    Files,
    /// JSON and YAML as text.
    Syntax,
    /// Documents against their schemas.
    Schema,
    /// Values against each other, within and across modules.
    References,
    /// Meshes, and the boxes and spheres about them.
    Geometry,
    /// Poses.
    Kinematics,
    /// Distances of shapes in many configurations.
    Statistics,
}

/// What a rule needs before it can say anything.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// The module is there, and its document fits its schema.
    Module(ModuleKind),
    /// At least one of the modules is there, and its document fits its schema.
    AnyModule(&'static [ModuleKind]),
    /// The robot as its source has it: the carried URDF where one is carried and reads, otherwise
    /// `urdf_module`.
    SourceRobot,
    /// `urdd.json` is there and fits its schema.
    RootMetadata,
    /// The source URDF is carried. (Whether it can be read as one: URD011.)
    CarriedUrdf,
    /// The other rule ran and found nothing.
    Passed(Code),
    /// The other rule found nothing, or had nothing to look at.
    NotFailed(Code),
    /// The same, but in a URDD of version 1 only: what the other rule finds in legacy ones is often
    /// a convention, and no obstacle.
    NotFailedInV1(Code),
    /// Each of these.
    All(&'static [Need]),
    /// The part is sound by these rules. One that is not is left out ([`Findings::judges`]); a fault
    /// that is not of single parts leaves out the whole rule.
    Each(Parts),
    /// In a URDD of version 1: the other rule found no fault in parts of this kind.
    NoPartInV1(Code, PartKind),
    /// The URDD is of version 1.
    Version1,
    /// The URDD was published before there was a version 1.
    Legacy,
}

impl Need {
    /// The rules that have to run before it is known whether it is met.
    pub fn codes(&self) -> Vec<Code> {
        match self {
            Need::Passed(code)
            | Need::NotFailed(code)
            | Need::NotFailedInV1(code)
            | Need::NoPartInV1(code, _) => vec![*code],
            Need::Each(parts) => parts.codes.to_vec(),
            Need::All(needs) => needs.iter().flat_map(Need::codes).collect(),
            _ => Vec::new(),
        }
    }
}

/// What a rule judges, which decides by which of the two descriptions of the robot it does so.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Judges {
    /// Files, texts, a module by itself, or a module beside the URDF: one run says all.
    AsItStands,
    /// Whether the robot is one at all: a tree of links, mimics that can be resolved. Others count on
    /// it by either description.
    Robot,
    /// The robot, whatever the modules say of it: by its source, where that can be read.
    Source,
    /// What follows from the robot: at fault where it is so by both descriptions.
    Derived,
}

impl Judges {
    /// What rules of a phase judge that do not say it.
    pub const fn by_phase(phase: Phase) -> Judges {
        match phase {
            Phase::Files | Phase::Syntax | Phase::Schema => Judges::AsItStands,
            _ => Judges::Derived,
        }
    }
}

/// A rule: one fault that a URDD can have.
pub struct Rule {
    /// Its code.
    pub code: Code,
    /// Its name, which states the fault.
    pub name: &'static str,
    /// How bad a finding is, unless settings say otherwise.
    pub severity: Severity,
    /// The clause of SPEC.md that it checks.
    pub clause: &'static str,
    /// The version of urdd that it came in.
    pub since: &'static str,
    /// What the fault does to whoever uses the URDD.
    pub consequence: Consequence,
    /// When it runs.
    pub phase: Phase,
    /// What it judges.
    pub judges: Judges,
    /// What it needs.
    pub needs: &'static [Need],
    /// Its documentation, in Markdown, line by line: first what is wrong, then why and what to do.
    pub doc: &'static [&'static str],
    /// Looks, and reports what it finds.
    pub check: fn(&Context, &mut Findings),
}

impl Rule {
    /// Its documentation as one text.
    pub fn explanation(&self) -> String {
        let lines: Vec<&str> = self
            .doc
            .iter()
            .map(|line| line.strip_prefix(' ').unwrap_or(line))
            .collect();
        lines.join("\n").trim().to_owned()
    }

    /// The first sentence of its documentation.
    pub fn summary(&self) -> String {
        let text = self.explanation();
        text.split("\n\n")
            .next()
            .unwrap_or_default()
            .replace('\n', " ")
    }
}

/// What faults of a family do, unless a rule says otherwise.
pub const fn of_family(code: &str) -> Consequence {
    match code.as_bytes() {
        [b'U', b'R', b'D', ..]
        | [b'D', b'O', b'F', ..]
        | [b'C', b'H', b'N', ..]
        | [b'C', b'O', b'N', ..]
        | [b'B', b'N', b'D', ..]
        | [b'K', b'I', b'N', ..] => Consequence::WrongMotion,
        [b'M', b'S', b'H', ..] => Consequence::MissingGeometry,
        [b'S', b'H', b'P', ..] => Consequence::Collisions,
        [b'S', b'R', b'C', ..] => Consequence::Looseness,
        _ => Consequence::Format,
    }
}

/// Declares the rule of a file as `RULE`. Its documentation is what `urdd explain` prints.
macro_rules! declare_rule {
    (
        $(#[doc = $doc:literal])+
        $code:ident $name:literal, $severity:ident, clause $clause:literal, since $since:literal,
        phase $phase:ident, $(judges $judges:ident,)? $(consequence $consequence:ident,)?
        needs [$($need:expr),* $(,)?], check $check:path $(,)?
    ) => {
        $(#[doc = $doc])+
        pub static RULE: $crate::rule::Rule = {
            #[allow(unused_imports)]
            use $crate::needs::*;
            #[allow(unused_imports)]
            use $crate::rule::Need::*;
            #[allow(unused_imports)]
            use urdd_format::registry::ModuleKind as Kind;
            #[allow(unused_imports)]
            use $crate::code::Code::*;
            $crate::rule::Rule {
                code: $crate::code::Code::$code,
                name: $name,
                severity: $crate::rule::Severity::$severity,
                clause: $clause,
                since: $since,
                consequence: {
                    #[allow(unused_variables)]
                    let consequence = $crate::rule::of_family(stringify!($code));
                    $(let consequence = $crate::rule::Consequence::$consequence;)?
                    consequence
                },
                phase: $crate::rule::Phase::$phase,
                judges: [
                    $($crate::rule::Judges::$judges,)?
                    $crate::rule::Judges::by_phase(
                        $crate::rule::Phase::$phase,
                    ),
                ][0],
                needs: &[$($need),*],
                doc: &[$($doc),+],
                check: $check,
            }
        };
    };
}
pub(crate) use declare_rule;
