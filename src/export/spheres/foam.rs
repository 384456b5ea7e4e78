//! Spheres as Foam writes them, by link.

use serde_json::{Map, Value, json};

use super::super::Export;
use super::super::error::ExportError;
use super::super::subject::Subject;
use crate::format::escape;

pub(in super::super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let spheres = super::spheres(subject)?;
    let mut links = Map::new();
    for (link, spheres) in subject.links.iter().zip(&spheres) {
        let list: Vec<Value> = spheres
            .iter()
            .map(|sphere| json!({ "origin": sphere.centre, "radius": sphere.radius }))
            .collect();
        if !list.is_empty() {
            links.insert(link.clone(), json!({ "spheres": list }));
        }
    }
    let document = json!({ "made_from": subject.origin()?, "links": links });
    let text = serde_json::to_string_pretty(&document).unwrap_or_default() + "\n";
    Ok(Export {
        text: escape::json(&text).into_owned(),
        files: Vec::new(),
        notes: subject.notes(),
    })
}
