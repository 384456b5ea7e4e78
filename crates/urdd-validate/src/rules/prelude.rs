//! Names that rules use.

pub(super) use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

pub(super) use nalgebra::Vector3;
pub(super) use rayon::prelude::*;

pub(super) use crate::context::Context;
pub(super) use crate::described::Described;
pub(super) use crate::finding::{Compared, finding_in};
pub(super) use crate::memo::Farthest;
pub(super) use crate::needs::MESH_MODULES;
pub(super) use crate::reference::distances::shape_set::Tolerances;
pub(super) use crate::rule::declare_rule;
pub(super) use crate::skip;
pub(super) use crate::tolerance::*;
pub(super) use crate::views::extension_schema;
pub(super) use crate::views::judged::judged;
pub(super) use crate::views::lists::wrong_lengths;
pub(super) use crate::views::tangled::pairs;
pub(super) use crate::views::tangled::{Pair, Pairs};
pub(super) use urdd_directory::discover::ROOT_METADATA;
pub(super) use urdd_directory::path;
pub(super) use urdd_directory::root::{EntryKind, ReadError};
pub(super) use urdd_document::entries::{self, Entry};
pub(super) use urdd_document::meshes::DERIVED;
pub(super) use urdd_document::module::{Module, VersionFile};
pub(super) use urdd_document::paths;
pub(super) use urdd_document::robot::Robot;
pub(super) use urdd_findings::code::Code;
pub(super) use urdd_findings::finding::{Finding, Findings, Fold, point};
pub(super) use urdd_findings::part::{Part, Why};
pub(super) use urdd_findings::skip::SkipReason;
pub(super) use urdd_format::readable::{metres, number};
pub(super) use urdd_format::registry::{ModuleDocument, ModuleKind as Kind, Profile};
pub(super) use urdd_format::root_metadata::{FileEntry, Version};
use urdd_format::root_metadata::{RootMetadata, Source};
pub(super) use urdd_format::shape_kind::ShapeKind;
pub(super) use urdd_format::urdf::JointType;
pub(super) use urdd_geometry::Mesh;

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
pub(super) fn listed_modules(context: &Context) -> Option<Vec<Entry<'_>>> {
    context.metadata().map(|_| entries::all(context))
}

/// The files that `urdd.json` lists as those of modules.
pub(super) fn listed_files(metadata: &RootMetadata) -> HashSet<&str> {
    let files = metadata.modules.iter().flat_map(|module| &module.files);
    files.map(|file| file.path.as_str()).collect()
}

/// The source URDF that `urdd.json` names.
pub(super) fn source(context: &Context) -> Option<&FileEntry> {
    let Source::Urdf(file) = context.metadata()?.source.as_ref()?;
    Some(file)
}

/// The values that are present, with their kinds of shape.
pub(super) fn by_kind<T>(six: [Option<T>; 6]) -> impl Iterator<Item = (ShapeKind, T)> {
    let six = ShapeKind::ALL.into_iter().zip(six);
    six.filter_map(|(kind, one)| Some((kind, one?)))
}

/// The finding of a value beyond its bounds, which an odd robot has the other way round (SPEC 6.5.2).
pub(super) fn beyond_bounds(
    [a, b]: [f64; 2],
    value: f64,
    finding: impl FnOnce() -> Finding,
) -> Option<Finding> {
    let (lower, upper) = (a.min(b), a.max(b));
    let size = lower.abs().max(upper.abs());
    let tolerance = (NUMBER_RELATIVE * size).max(NUMBER_ABSOLUTE);
    let is_within = (lower - value).max(value - upper) <= tolerance;
    let of = || finding().values(format!("{lower:?} to {upper:?}"), format!("{value:?}"));
    (!is_within).then(|| of().tolerance(tolerance))
}

/// The finding of a value that should be another one, where that is a sum of bounds: sums cancel, so that the size of the
/// bounds matters.
pub(super) fn off_by_bounds(
    [a, b]: [f64; 2],
    [expected, found]: [f64; 2],
    finding: impl FnOnce() -> Finding,
) -> Option<Finding> {
    let tolerance = number_tolerance(expected, found).max(NUMBER_RELATIVE * a.abs().max(b.abs()));
    let is_same = (expected - found).abs() <= tolerance;
    (!is_same).then(|| finding().values(expected, found).tolerance(tolerance))
}

/// A value that may be absent, as a report shows it.
pub(super) fn or_null<T: std::fmt::Debug>(value: Option<T>) -> String {
    value.map_or_else(|| "null".to_owned(), |value| format!("{value:?}"))
}
