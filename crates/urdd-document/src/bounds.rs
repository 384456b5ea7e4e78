//! Version-independent view of `bounds_module`.

use urdd_format::bounds::BoundsModule;
use urdd_format::registry::ModuleDocument;

/// Bounds of all DOFs.
#[derive(Debug, Clone, Copy)]
pub struct Bounds<'a> {
    /// `bounds`
    pub bounds: &'a [[f64; 2]],
    /// `dof_lower_bounds`
    pub lower: &'a [f64],
    /// `dof_upper_bounds`
    pub upper: &'a [f64],
    /// The module, if it is of version 1, which has more fields.
    pub v1: Option<&'a BoundsModule>,
}

/// The view of a `bounds_module`.
pub fn view(document: &ModuleDocument) -> Option<Bounds<'_>> {
    match document {
        ModuleDocument::Bounds(module) => Some(Bounds {
            bounds: &module.bounds,
            lower: &module.dof_lower_bounds,
            upper: &module.dof_upper_bounds,
            v1: Some(module),
        }),
        ModuleDocument::LegacyBounds(module) => Some(Bounds {
            bounds: &module.bounds,
            lower: &module.dof_lower_bounds,
            upper: &module.dof_upper_bounds,
            v1: None,
        }),
        _ => None,
    }
}
