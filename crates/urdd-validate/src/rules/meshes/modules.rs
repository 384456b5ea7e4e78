//! The mesh modules.

use urdd_format::registry::ModuleKind as Kind;

/// Every mesh module.
pub(super) const MODULES: &[Kind] = &[
    Kind::OriginalMeshes,
    Kind::PlainMeshes,
    Kind::ConvexHullMeshes,
    Kind::ConvexDecompositionMeshes,
];
