//! EXT: extension modules.

mod document_invalid;
mod schema_unusable;

use crate::context::Context;
use crate::rule::rules;
use urdd_document::module::{Module, is_extension};

/// The folders of extensions.
fn extensions(context: &Context) -> impl Iterator<Item = &Module> {
    let modules = context.modules().iter();
    modules.filter(|module| module.kind.is_none() && is_extension(&module.folder))
}

rules! {
    document_invalid, schema_unusable
}
