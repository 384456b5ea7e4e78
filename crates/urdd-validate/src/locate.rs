//! Adds line, column and names to places that only have a pointer. Only for the findings that are kept, and in a single
//! pass over each text.

use std::collections::BTreeMap;

use super::context::Context;
use super::finding::{Finding, Place};
use super::names::Names;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::position::{self, LineIndex};
use urdd_format::registry::ModuleKind;

/// Completes the places of findings.
pub(super) fn locate(context: &Context, findings: &mut [Finding]) {
    let mut by_file: BTreeMap<String, Vec<&mut Place>> = BTreeMap::new();
    let places = findings.iter_mut().flat_map(|finding| {
        let more = finding.more.iter_mut().map(|other| &mut other.place);
        std::iter::once(&mut finding.place).chain(more)
    });
    for place in places {
        if let (Some(file), Some(_)) = (&place.file, &place.pointer) {
            by_file.entry(file.clone()).or_default().push(place);
        }
    }
    let names = Names::new(context);
    for (file, mut places) in by_file {
        let urdf = context.urdf().ok().filter(|urdf| urdf.path == file);
        if let Some((text, kind)) = json_text(context, &file) {
            let pointers: Vec<String> = places.iter().map(|place| pointer(place)).collect();
            let pointers: Vec<&str> = pointers.iter().map(String::as_str).collect();
            let positions = position::locate_all(text, &pointers);
            for (place, found) in places.iter_mut().zip(positions) {
                place.position = place.position.or(found);
                place.subject = kind.and_then(|kind| names.subject(kind, &pointer(place)));
            }
        } else if let (Some(urdf), Some(reading)) = (urdf, context.urdf_text()) {
            let lines = LineIndex::new(&urdf.text);
            for place in places {
                place.subject = names.subject(ModuleKind::Urdf, &pointer(place));
                if place.position.is_none() {
                    // The pointer is that of the value in urdf_module, which does not exist in XML.
                    place.position = reading.position(&lines, &pointer(place));
                    place.pointer = None;
                }
            }
        }
    }
}

fn pointer(place: &Place) -> String {
    place.pointer.clone().unwrap_or_default()
}

/// The text of a document, and its module.
fn json_text<'a>(context: &'a Context, file: &str) -> Option<(&'a str, Option<ModuleKind>)> {
    if file == ROOT_METADATA {
        return Some((context.metadata_file().json.text()?, None));
    }
    let folder = file.strip_suffix("/module.json")?;
    let mut modules = context.modules().iter();
    let module = modules.find(|module| module.folder == folder)?;
    Some((module.json.text()?, module.kind))
}
