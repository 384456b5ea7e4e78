//! The folders of extensions, and how much is said of each.

use crate::context::Context;
use crate::views::extension_schema;
use serde_json::Value;
use urdd_document::module::{Module, is_extension};

/// Maximum number of reported places of a document.
pub(super) const MAX_PLACES: usize = 1000;

/// The folders of extensions.
pub(super) fn extensions(context: &Context) -> impl Iterator<Item = &Module> {
    let modules = context.modules();
    modules.filter(|module| module.kind.is_none() && is_extension(&module.folder))
}

/// The extensions with a document and a schema that can be used (EXT001 reports others), and those two. Only schemas that
/// are `wanted` are tried: this takes time.
pub(super) fn described<'a>(
    context: &'a Context,
    wanted: impl Fn(&Value) -> bool + 'a,
) -> impl Iterator<Item = (&'a Module, Value, &'a Value)> {
    extensions(context).filter_map(move |module| {
        let document = &module.json.document()?.value;
        let schema =
            extension_schema::read(context, module).ok().filter(|schema| wanted(schema))?;
        let faults = extension_schema::faults(&schema, Some(document));
        faults.is_empty().then_some((module, schema, document))
    })
}
