//! The mesh modules.

use urdd_format::registry::ModuleKind;

/// Every mesh module.
pub(super) const MODULES: &[ModuleKind] = &[
    ModuleKind::OriginalMeshes,
    ModuleKind::PlainMeshes,
    ModuleKind::ConvexHullMeshes,
    ModuleKind::ConvexDecompositionMeshes,
];
