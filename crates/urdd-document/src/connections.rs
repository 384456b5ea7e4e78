//! Version-independent view of `connections_module`.

use urdd_format::connections::ConnectionsModule;
use urdd_format::index::LinkIdx;
use urdd_format::registry::ModuleDocument;

/// The paths between links.
#[derive(Debug, Clone, Copy)]
pub struct Connections<'a> {
    /// `link_connection_paths`
    pub descendant_paths: Option<&'a [Vec<Option<Vec<LinkIdx>>>]>,
    /// The module, if it is of version 1, which has more fields.
    pub v1: Option<&'a ConnectionsModule>,
}

/// The view of a `connections_module`.
pub fn view(document: &ModuleDocument) -> Option<Connections<'_>> {
    match document {
        ModuleDocument::Connections(module) => Some(Connections {
            descendant_paths: module.link_connection_paths.as_deref(),
            v1: Some(module),
        }),
        ModuleDocument::LegacyConnections(module) => {
            Some(Connections { descendant_paths: Some(&module.link_connection_paths), v1: None })
        }
        _ => None,
    }
}
