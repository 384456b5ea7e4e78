//! The folders of extensions.

use crate::context::Context;
use urdd_document::module::{Module, is_extension};

/// The folders of extensions.
pub(super) fn extensions(context: &Context) -> impl Iterator<Item = &Module> {
    let modules = context.modules().iter();
    modules.filter(|module| module.kind.is_none() && is_extension(&module.folder))
}
