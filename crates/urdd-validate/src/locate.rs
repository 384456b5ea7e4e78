//! Adds line, column and subject to places that only have a pointer: for the findings that are kept, in one pass
//! through each text.

use std::collections::BTreeMap;

use super::context::Context;
use super::names::Names;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::position::{self, LineIndex, Position};
use urdd_findings::finding::{Finding, Place};
use urdd_format::index::Count;
use urdd_format::registry::ModuleKind;

/// Completes the places of findings, and then those related to them.
pub(super) fn locate(context: &Context, findings: &mut [Finding]) {
    let names = Names::new(context);
    let places = findings.iter_mut().flat_map(Finding::places_mut);
    complete(context, &names, places);
    let related = findings.iter_mut().flat_map(Finding::places_mut);
    complete(context, &names, related.flat_map(|place| &mut place.related));
}

fn complete<'a>(context: &Context, names: &Names, places: impl Iterator<Item = &'a mut Place>) {
    let mut by_file: BTreeMap<String, Vec<&mut Place>> = BTreeMap::new();
    for place in places {
        if let (Some(file), Some(_)) = (&place.file, &place.pointer) {
            by_file.entry(file.clone()).or_default().push(place);
        }
    }
    for (file, mut places) in by_file {
        let urdf = context.urdf().ok().filter(|urdf| urdf.path == file);
        if let Some((text, kind)) = json_text(context, &file) {
            let pointers: Vec<String> = places.iter().map(|place| pointer(place)).collect();
            let pointers: Vec<&str> = pointers.iter().map(String::as_str).collect();
            let positions = position::locate_all(text, &pointers);
            for (place, found) in places.iter_mut().zip(positions) {
                put_position(place, found);
                place.subject = kind.and_then(|kind| names.subject(kind, &pointer(place)));
            }
        } else if let (Some(urdf), Some(reading)) = (urdf, context.urdf_text()) {
            let lines = LineIndex::new(&urdf.text);
            for place in places {
                place.subject = names.subject(ModuleKind::Urdf, &pointer(place));
                if place.line.is_none() {
                    // The pointer is into urdf_module, not into the XML.
                    put_position(place, reading.position(&lines, &pointer(place)));
                    place.pointer = None;
                }
            }
        }
    }
}

/// Sets line and column if the place has none.
fn put_position(place: &mut Place, position: Option<Position>) {
    if let (None, Some(position)) = (place.line, position) {
        place.line = Some(Count(position.line));
        place.column = Some(Count(position.column));
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
    let mut modules = context.modules();
    let module = modules.find(|module| module.folder == folder)?;
    Some((module.json.text()?, module.kind))
}
