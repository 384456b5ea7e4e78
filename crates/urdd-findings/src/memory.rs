//! How much memory the places of findings take.

use urdd_format::report::Place;

/// Approximate memory of a place, a fix and an edit without their texts, in bytes. Constants, so that a report is the
/// same on every machine.
const PLACE: usize = 320;
const FIX: usize = 56;
const EDIT: usize = 64;
/// And of a program that does something because of it.
const PROGRAM: usize = 40;

/// Approximate memory of a place, in bytes.
pub fn bytes(place: &Place) -> usize {
    let texts = [
        &place.file,
        &place.pointer,
        &place.subject,
        &place.message,
        &place.expected,
        &place.actual,
    ];
    let texts = texts.into_iter().flatten().map(String::len);
    let fixes = place.fixes.iter().map(|fix| {
        let edits = fix.edits.iter();
        let edits = edits.map(|edit| EDIT + edit.file.len() + edit.text.len());
        FIX + fix.message.len() + edits.sum::<usize>()
    });
    let related = place.related.iter().map(bytes);
    let programs = PROGRAM * place.programs.len();
    PLACE + programs + texts.sum::<usize>() + fixes.sum::<usize>() + related.sum::<usize>()
}
