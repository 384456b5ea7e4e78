//! What a rule is: its documentation, its needs and its check.

use std::ops::Deref;

use super::code::Code;
use super::context::Context;
use super::finding::Findings;
use super::part::{PartKind, Parts};
use urdd_format::registry::ModuleKind;
pub use urdd_format::report::{Consequence, Severity};

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

/// A precondition of a rule. The rule does not run unless all its needs are met, so its check may take with `?`
/// whatever they guarantee.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// The module exists and its document fits its schema. `urdf_module` may be missing where the carried URDF is the
    /// robot's description.
    Module(ModuleKind),
    /// The same, and the document is of version 1.
    ModuleV1(ModuleKind),
    /// At least one of the modules exists and its document fits its schema.
    AnyModule(&'static [ModuleKind]),
    /// The robot of the source: of the carried URDF if it exists and is readable, otherwise of `urdf_module`.
    SourceRobot,
    /// `urdd.json` exists and fits its schema.
    RootMetadata,
    /// The source URDF is carried and not too large. (URD011 checks whether it is a robot.)
    CarriedUrdf,
    /// The source URDF is carried, even if it is too large to be read.
    UrdfFile,
    /// The other rule ran and found nothing.
    Passed(Code),
    /// The other rule found nothing, or did not apply.
    NotFailed(Code),
    /// The same, in a URDD of version 1 only: in legacy URDDs the other rule often reports a convention.
    NotFailedInV1(Code),
    /// All of these.
    All(&'static [Need]),
    /// Each part passed these rules. Parts that failed one are left out ([`Findings::judges`]). A fault that does not
    /// belong to single parts skips the whole rule.
    Each(Parts),
    /// In a URDD of version 1: the other rule found no fault in parts of this kind.
    NoPartInV1(Code, PartKind),
    /// The URDD is of version 1.
    Version1,
    /// The URDD was published before there was a version 1.
    Legacy,
}

impl Need {
    /// The rules that decide whether it is met.
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

/// What a rule judges. This decides which of the two descriptions of the robot it uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Judges {
    /// Files, texts, a module on its own, or a module against the URDF. Runs once.
    AsItStands,
    /// Whether the robot is valid: a tree of links, mimics that can be resolved. Runs for both descriptions, because
    /// other rules depend on it.
    Robot,
    /// The robot itself, whatever the modules contain. Uses the source if it is readable.
    Source,
    /// Data derived from the robot. A fault counts only if both descriptions give it.
    Derived,
}

impl Judges {
    /// The default for rules of a phase.
    pub const fn by_phase(phase: Phase) -> Judges {
        match phase {
            Phase::Files | Phase::Syntax | Phase::Schema => Judges::AsItStands,
            _ => Judges::Derived,
        }
    }
}

/// What a rule says of itself, to those who read a report.
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

/// A rule: one kind of fault in a URDD.
pub struct Rule {
    /// What it says of itself.
    pub description: Description,
    /// What it judges.
    pub judges: Judges,
    /// What it needs.
    pub needs: &'static [Need],
    /// Reports what it finds. `None`: the check stopped early, either for a reason given to [`Findings::skip`] or,
    /// without one, because it takes something that its needs do not guarantee. The second is a fault of the rule.
    pub check: fn(&Context, &mut Findings) -> Option<()>,
}

impl Deref for Rule {
    type Target = Description;

    fn deref(&self) -> &Description {
        &self.description
    }
}

/// The consequence of a family's faults, unless a rule declares another.
pub const fn of_family(code: &str) -> Consequence {
    match code.as_bytes() {
        [b'U', b'R', b'D', ..]
        | [b'D', b'O', b'F', ..]
        | [b'C', b'H', b'N', ..]
        | [b'C', b'O', b'N', ..]
        | [b'B', b'N', b'D', ..]
        | [b'K', b'I', b'N', ..]
        | [b'C', b'N', b'F', ..] => Consequence::WrongMotion,
        [b'M', b'S', b'H', ..] => Consequence::MissingGeometry,
        [b'S', b'H', b'P', ..] => Consequence::Collisions,
        [b'S', b'R', b'C', ..] => Consequence::Looseness,
        _ => Consequence::Format,
    }
}

/// Declares the rule of a file as `Declared::RULE`, checked by the file's function `check`. `urdd explain` prints its
/// documentation.
macro_rules! declare_rule {
    (
        $(#[doc = $doc:literal])+
        $code:ident $name:literal, $severity:ident, clause $clause:literal, since $since:literal,
        phase $phase:ident, $(judges $judges:ident,)? $(consequence $consequence:ident,)?
        needs [$($need:expr),* $(,)?] $(,)?
    ) => {
        /// The rule of this file. A `static` of the module would be compiled into whatever does not use it, too.
        pub struct Declared;

        impl Declared {
            $(#[doc = $doc])+
            pub const RULE: &'static $crate::rule::Rule = &{
                #[allow(unused_imports)]
                use $crate::needs::*;
                #[allow(unused_imports)]
                use $crate::rule::Need::*;
                #[allow(unused_imports)]
                use urdd_format::registry::ModuleKind as Kind;
                #[allow(unused_imports)]
                use $crate::code::Code::*;
                $crate::rule::Rule {
                    description: $crate::rule::Description {
                        code: $crate::code::Code::$code,
                        name: $name,
                        severity: $crate::rule::Severity::$severity,
                        clause: Some($clause),
                        since: $since,
                        consequence: {
                            #[allow(unused_variables)]
                            let consequence = $crate::rule::of_family(stringify!($code));
                            $(let consequence = $crate::rule::Consequence::$consequence;)?
                            consequence
                        },
                        phase: $crate::rule::Phase::$phase,
                        doc: &[$($doc),+],
                    },
                    judges: [
                        $($crate::rule::Judges::$judges,)?
                        $crate::rule::Judges::by_phase(
                            $crate::rule::Phase::$phase,
                        ),
                    ][0],
                    needs: &[$($need),*],
                    check,
                }
            };
        }
    };
}
pub(crate) use declare_rule;

/// Lists the rules of a family, one file each, as `rules()`.
macro_rules! rules {
    ($($file:ident),+ $(,)?) => {
        /// The rules of this family.
        pub fn rules() -> &'static [&'static $crate::rule::Rule] {
            &[$($file::Declared::RULE),+]
        }
    };
}
pub(crate) use rules;
