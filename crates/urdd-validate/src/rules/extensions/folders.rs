//! The folders of extensions, and how much is said of each.

use crate::context::Context;
use urdd_document::module::{Module, is_extension};

/// Maximum number of reported places of a document.
pub(super) const MAX_PLACES: usize = 1000;

/// The folders of extensions.
pub(super) fn extensions(context: &Context) -> impl Iterator<Item = &Module> {
    let modules = context.modules().iter();
    modules.filter(|module| module.kind.is_none() && is_extension(&module.folder))
}
