//! What rules share: names, findings about documents, and lists.

pub use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::fmt::{Debug, Display};

pub use nalgebra::Vector3;
pub use rayon::prelude::*;

pub use crate::context::{Context, Described, Farthest};
pub use crate::needs::MESH_MODULES;
pub use crate::reference::distances::Tolerances;
pub(super) use crate::rule::declare_rule;
pub use crate::skip;
pub use crate::tolerance::*;
pub use crate::views::extension_schema;
pub use crate::views::judged::judged;
pub use crate::views::tangled::{Pair, Pairs, pairs};
pub use urdd_directory::discover::ROOT_METADATA;
pub use urdd_directory::path;
pub use urdd_directory::root::{EntryKind, ReadError};
pub use urdd_document::entries::{self, Entry};
pub use urdd_document::meshes::DERIVED;
pub use urdd_document::module::{Module, VersionFile};
pub use urdd_document::paths;
pub use urdd_document::robot::Robot;
pub use urdd_findings::code::Code;
pub use urdd_findings::finding::{Finding, Findings, Fold, point};
pub use urdd_findings::part::SkipReason;
pub use urdd_findings::part::{Part, Why};
pub use urdd_format::readable::{metres, number};
pub use urdd_format::registry::{ModuleDocument, ModuleKind as Kind, Profile};
pub use urdd_format::root_metadata::{FileEntry, Version};
use urdd_format::root_metadata::{RootMetadata, Source};
pub use urdd_format::shape_kind::ShapeKind;
pub use urdd_format::urdf::JointType;
pub use urdd_geometry::Mesh;

/// The document of a module, if it is of version 1: `document!(context, PlainMeshes)`. [`Need::ModuleV1`] guarantees it.
///
/// [`Need::ModuleV1`]: crate::rule::Need::ModuleV1
macro_rules! document {
    ($context:expr, $kind:ident) => {
        match $context.document_v1(Kind::$kind) {
            Some(ModuleDocument::$kind(document)) => Some(&**document),
            _ => None,
        }
    };
}
pub(super) use document;

/// The modules that `urdd.json` lists.
pub fn listed_modules(context: &Context) -> Option<Vec<Entry<'_>>> {
    context.metadata().map(|_| entries::all(context))
}

/// The files that `urdd.json` lists as those of modules.
pub fn listed_files(metadata: &RootMetadata) -> HashSet<&str> {
    let files = metadata.modules.iter().flat_map(|module| &module.files);
    files.map(|file| file.path.as_str()).collect()
}

/// The source URDF that `urdd.json` names.
pub fn source(context: &Context) -> Option<&FileEntry> {
    let Source::Urdf(file) = context.metadata()?.source.as_ref()?;
    Some(file)
}

/// The values that are present, with their kinds of shape.
pub fn by_kind<T>(six: [Option<T>; 6]) -> impl Iterator<Item = (ShapeKind, T)> {
    let six = ShapeKind::ALL.into_iter().zip(six);
    six.filter_map(|(kind, one)| Some((kind, one?)))
}

/// Reports a value beyond its bounds, which an odd robot has the other way round (SPEC 6.5.2).
pub fn report_beyond_bounds(
    [a, b]: [f64; 2],
    value: f64,
    findings: &mut Findings,
    finding: impl FnOnce() -> Finding,
) {
    let (lower, upper) = (a.min(b), a.max(b));
    let size = lower.abs().max(upper.abs());
    let tolerance = (NUMBER_RELATIVE * size).max(NUMBER_ABSOLUTE);
    let is_within = (lower - value).max(value - upper) <= tolerance;
    if !is_within {
        finding()
            .values(format!("{lower:?} to {upper:?}"), format!("{value:?}"))
            .tolerance(tolerance)
            .report(findings);
    }
}

/// Reports a value that should be another one, where that is a sum of bounds: sums cancel, so that the size of the
/// bounds matters.
pub fn report_off_by_bounds(
    [a, b]: [f64; 2],
    [expected, found]: [f64; 2],
    findings: &mut Findings,
    finding: impl FnOnce() -> Finding,
) {
    let tolerance = number_tolerance(expected, found).max(NUMBER_RELATIVE * a.abs().max(b.abs()));
    let is_same = (expected - found).abs() <= tolerance;
    if !is_same {
        finding().values(expected, found).tolerance(tolerance).report(findings);
    }
}

/// A value that may be absent, as a report shows it.
pub fn or_null<T: Debug>(value: Option<T>) -> String {
    value.map_or_else(|| "null".to_owned(), |value| format!("{value:?}"))
}

/// A document that findings are about.
pub trait Document {
    /// The file, and the pointer of a value in that file.
    fn locate(&self, pointer: String) -> (String, String);
}

/// `module.json`.
impl Document for &Module {
    fn locate(&self, pointer: String) -> (String, String) {
        (self.file("module.json"), pointer)
    }
}

/// `module.json` of the module of this kind.
impl Document for Kind {
    fn locate(&self, pointer: String) -> (String, String) {
        (format!("{}/module.json", self.folder()), pointer)
    }
}

/// The file that the robot was read from.
impl Document for &Described<'_> {
    fn locate(&self, pointer: String) -> (String, String) {
        (self.robot_file(), pointer)
    }
}

/// An entry of `modules` in `urdd.json`. Pointers are relative to the entry, without a leading slash.
impl Document for &Entry<'_> {
    fn locate(&self, pointer: String) -> (String, String) {
        (ROOT_METADATA.to_owned(), self.pointer(&pointer))
    }
}

/// A finding about a value of a document.
pub fn finding_in(
    document: impl Document,
    pointer: impl Into<String>,
    message: impl Into<String>,
) -> Finding {
    let (file, pointer) = document.locate(pointer.into());
    Finding::at(file, pointer, message)
}

/// The expected and the actual value of a finding at once, in the forms that rules use.
pub trait Compared: Sized {
    /// Sets both.
    fn values(self, expected: impl ToString, actual: impl ToString) -> Self;

    /// Sets both as literals: texts in quotes, numbers with all digits.
    fn literals(self, expected: impl Debug, actual: impl Debug) -> Self {
        self.values(format!("{expected:?}"), format!("{actual:?}"))
    }

    /// Sets both as numbers of something, such as `links`.
    fn counts(self, expected: impl Display, actual: impl Display, what: &str) -> Self {
        self.values(format!("{expected} {what}"), format!("{actual} {what}"))
    }
}

impl Compared for Finding {
    fn values(self, expected: impl ToString, actual: impl ToString) -> Self {
        self.expected(expected).actual(actual)
    }
}

/// The lists that do not have the expected length. A stale module is one mistake, even if it shows in every list.
pub struct WrongLengths {
    /// Pointer of the first one.
    pub pointer: String,
    /// Length of the first one.
    pub length: usize,
    /// All of them with their lengths, for messages.
    pub in_words: String,
    /// Whether every list is wrong.
    pub are_all: bool,
}

/// Finds the lists, given by key and length, that do not have the expected length.
pub fn wrong_lengths(lists: &[(&str, usize)], expected: usize) -> Option<WrongLengths> {
    let wrong = lists.iter().filter(|(_, length)| *length != expected);
    let (first, length) = wrong.clone().next()?;
    let words: Vec<String> = wrong.map(|(key, length)| format!("`{key}` has {length}")).collect();
    Some(WrongLengths {
        pointer: format!("/{first}"),
        length: *length,
        in_words: words.join(", "),
        are_all: words.len() == lists.len(),
    })
}
