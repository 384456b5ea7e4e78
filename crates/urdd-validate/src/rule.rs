//! What a rule is: its documentation, its needs and its check.

use std::ops::Deref;

use super::context::{Context, Described};
use urdd_findings::code::Code;
use urdd_findings::description::{Consequence, Description};
use urdd_findings::finding::Findings;
use urdd_format::registry::ModuleKind;

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
    /// None of the other rules found anything.
    NoneFailed(&'static [Code]),
    /// As [`Need::NotFailed`], in a URDD of version 1 only: in legacy URDDs the other rule often reports a convention.
    NotFailedInV1(Code),
    All(&'static [Need]),
    /// Each part passed these rules. Parts that failed one are left out ([`Findings::judges`]). A fault that does not
    /// belong to single parts skips the whole rule.
    Each(&'static [Code]),
    /// The same, in a URDD of version 1 only: in legacy URDDs, these rules often report a convention.
    EachInV1(&'static [Code]),
    /// In a URDD of version 1: the other rule found no fault in convex pieces.
    NoPieceInV1(Code),
    /// The URDD is of version 1.
    Version1,
    /// The URDD was published before there was a version 1.
    Legacy,
}

impl Need {
    /// The needs of a list, those of groups one by one.
    pub fn each_of(needs: &[Need]) -> Vec<Need> {
        let each = needs.iter().flat_map(|need| match need {
            Need::All(needs) => Need::each_of(needs),
            need => vec![*need],
        });
        each.collect()
    }

    /// The rules that decide whether it is met.
    pub fn codes(&self) -> Vec<Code> {
        match self {
            Need::Passed(code)
            | Need::NotFailed(code)
            | Need::NotFailedInV1(code)
            | Need::NoPieceInV1(code) => vec![*code],
            Need::NoneFailed(codes) | Need::Each(codes) | Need::EachInV1(codes) => codes.to_vec(),
            Need::All(needs) => needs.iter().flat_map(Need::codes).collect(),
            _ => Vec::new(),
        }
    }
}

/// A rule: one kind of fault in a URDD.
pub struct Rule {
    pub description: Description,
    pub needs: &'static [Need],
    /// Reports what it finds. `None`: the check stopped early, either for a reason given to [`Findings::skip`] or,
    /// without one, because it takes something that its needs do not guarantee. The second is a fault of the rule.
    pub check: CheckOf,
}

/// A check, by what it is of.
pub enum CheckOf {
    /// A URDD.
    Urdd(fn(&Context, &mut Findings) -> Option<()>),
    /// A robot, of a URDD or of a URDF alone.
    Robot(fn(&Described, &mut Findings) -> Option<()>),
}

impl Deref for Rule {
    type Target = Description;

    fn deref(&self) -> &Description {
        &self.description
    }
}

/// The consequence of a family's faults, unless a rule declares another.
pub const fn of_family(code: &str) -> Consequence {
    match code.as_bytes().first_chunk() {
        Some(b"URD" | b"DOF" | b"CHN" | b"CON" | b"BND" | b"KIN" | b"CNF" | b"LOP") => {
            Consequence::WrongMotion
        }
        Some(b"MSH") => Consequence::MissingGeometry,
        Some(b"SHP" | b"SPH") => Consequence::Collisions,
        Some(b"SRC") => Consequence::Looseness,
        _ => Consequence::Format,
    }
}

/// Declares the rules of a file, as its `RULES`, each with the function that checks it; `of Robot` makes it a rule of URDFs
/// without a URDD, too. `urdd explain` prints its documentation.
macro_rules! declare_rule {
    ($(
        $(#[doc = $doc:literal])+
        $code:ident $name:literal, $severity:ident, clause $clause:literal, since $since:literal,
        phase $phase:ident, $(consequence $consequence:ident,)?
        needs [$($need:expr),* $(,)?], $(of $of:ident,)? check $check:expr,
    )+) => {
        /// The rules of this file. A `static` would be compiled into whatever does not use it, too.
        pub const RULES: &[&$crate::rule::Rule] = &[$({
            #[allow(unused_imports)]
            use $crate::needs::*;
            #[allow(unused_imports)]
            use $crate::rule::Need::*;
            #[allow(unused_imports)]
            use urdd_findings::code::Code::*;
            &$crate::rule::Rule {
                description: urdd_findings::description::Description {
                    code: urdd_findings::code::Code::$code,
                    name: $name,
                    severity: urdd_findings::description::Severity::$severity,
                    clause: Some($clause),
                    since: $since,
                    consequence: {
                        #[allow(unused_variables)]
                        let consequence = $crate::rule::of_family(stringify!($code));
                        $(let consequence = urdd_findings::description::Consequence::$consequence;)?
                        consequence
                    },
                    phase: urdd_findings::description::Phase::$phase,
                    doc: &[$($doc),+],
                },
                needs: &[$($need),*],
                check: $crate::rule::check_of!($check $(, $of)?),
            }
        }),+];
    };
}
pub(crate) use declare_rule;

/// A check of a URDD, unless the rule says of what it is.
macro_rules! check_of {
    ($check:expr) => {
        $crate::rule::CheckOf::Urdd($check)
    };
    ($check:expr, $of:ident) => {
        $crate::rule::CheckOf::$of($check)
    };
}
pub(crate) use check_of;
