//! What a rule of the family LNT is, and names that rules use.

pub(super) use std::collections::{BTreeMap, BTreeSet};
pub(super) use std::path::Path;

pub(super) use nalgebra::{Point3, Vector3};
pub use urdd_findings::description::Description;
pub(super) use urdd_findings::description::Severity;
pub(super) use urdd_findings::finding::{Finding, Findings};
pub(super) use urdd_format::meshes::GeometryKind;
pub(super) use urdd_format::readable::metres;
pub(super) use urdd_geometry::read::{Format, NoteCode};
pub(super) use urdd_xml::Node;
pub(super) use urdd_xml::element::children;

pub(super) use crate::geometry::{bounds, diagonal};
pub(super) use crate::hull::Hull;
pub(super) use crate::pose::Inertial;
pub(super) use crate::srdf;
pub(super) use crate::subject::Subject;
pub(super) use crate::vocabulary::{ONE_DOF, WITH_AXIS, What, child, named, number, numbers};

/// A rule about URDFs.
pub struct LintRule {
    /// What it says of itself.
    pub description: Description,
    /// Whether it runs where neither `--select` nor `[severity]` of the settings names it.
    pub on_by_default: bool,
    /// Reports what it finds. `None`: what it judges is not there, for a reason given to [`Findings::skip`].
    pub check: fn(&Subject, &mut Findings) -> Option<()>,
}

/// Declares the rules of a file as `Declared::RULES`: each is checked by what is behind its `=>`, or by the file's function
/// `check`. `urdd explain` prints its documentation.
macro_rules! declare_lint {
    ($(
        $(#[doc = $doc:literal])+
        $code:ident $name:literal, $severity:ident, $consequence:ident, since $since:literal
        $(, $default:ident by default)? $(=> $check:expr)?
    );+) => {
        /// The rules of this file. A `static` of the module would be compiled into whatever does not use it, too.
        pub struct Declared;

        impl Declared {
            /// The rules.
            pub const RULES: &'static [&'static $crate::rules::prelude::LintRule] = &[$(
                &$crate::rules::prelude::LintRule {
                    description: $crate::rules::prelude::Description {
                        code: urdd_findings::code::Code::$code,
                        name: $name,
                        severity: urdd_findings::description::Severity::$severity,
                        clause: None,
                        since: $since,
                        consequence: urdd_findings::description::Consequence::$consequence,
                        phase: urdd_findings::description::Phase::References,
                        doc: &[
                            $($doc,)+
                            "",
                            $crate::in_programs::in_programs(urdd_findings::code::Code::$code),
                        ],
                    },
                    on_by_default: true $(&& $crate::rules::prelude::$default)?,
                    check: $crate::rules::prelude::declare_lint!(@check $($check)?),
                }
            ),+];
        }
    };
    (@check) => { check };
    (@check $check:expr) => { $check };
}
pub(crate) use declare_lint;

/// `off by default`, in a declaration.
#[allow(non_upper_case_globals)]
pub(crate) const off: bool = false;

/// Lists the files of rules as `all()`.
macro_rules! rules {
    ($($file:ident),+ $(,)?) => {
        /// Every rule, in the order of their codes.
        pub fn all() -> Vec<&'static $crate::rules::prelude::LintRule> {
            let mut rules = [$($file::Declared::RULES),+].concat();
            rules.sort_by_key(|rule| rule.description.code);
            rules
        }
    };
}
pub(crate) use rules;
