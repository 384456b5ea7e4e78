//! Findings about meshes between one save and the next. A finding of the last save stays while the links and joints
//! that it is about read as they did then. It goes with the first change in one of them, and comes back, or not, with
//! the next save.

use std::ops::Range;

use lsp_types::{DiagnosticRelatedInformation, NumberOrString, TextEdit};

use crate::analysis::{Analysis, Postponed};
use crate::diagnostics::Found;
use crate::document::Snapshot;

/// The findings of an earlier version that still stand in a later one.
pub fn kept(
    (before, old): (&Snapshot, &Analysis),
    now: &Snapshot,
    postponed: &Postponed,
) -> Vec<Found> {
    let is_postponed = |found: &&Found| match (postponed, &found.diagnostic.code) {
        (Postponed::None, _) => false,
        (Postponed::All, _) => true,
        (Postponed::Codes(codes), Some(NumberOrString::String(code))) => {
            codes.contains(code.as_str())
        }
        (Postponed::Codes(_), _) => false,
    };
    let old = old.found.iter().filter(is_postponed);
    old.filter_map(|found| moved(found, before, now)).collect()
}

fn moved(found: &Found, before: &Snapshot, now: &Snapshot) -> Option<Found> {
    let mut found = found.clone();
    let diagnostic = &mut found.diagnostic;
    diagnostic.range = moved_range(diagnostic.range, before, now)?;
    let others = diagnostic.related_information.iter_mut().flatten();
    for DiagnosticRelatedInformation { location, .. } in others {
        if location.uri == before.uri {
            location.range = moved_range(location.range, before, now)?;
        }
    }
    found.repairs.retain_mut(|repair| {
        let mut edits = repair.edits.iter_mut();
        edits.all(|TextEdit { range, .. }| match moved_range(*range, before, now) {
            Some(new) => {
                *range = new;
                true
            }
            None => false,
        })
    });
    Some(found)
}

/// A range in a later version; `None` if the link or joint around it is not the same to the byte.
fn moved_range(
    range: lsp_types::Range,
    before: &Snapshot,
    now: &Snapshot,
) -> Option<lsp_types::Range> {
    let (start, end) = (before.text.offset(range.start), before.text.offset(range.end));
    let (kind, name, old) = around(before, start).filter(|(.., old)| end <= old.end)?;
    let new = named(now, &kind, &name)?;
    if before.text.as_str().get(old.clone()) != now.text.as_str().get(new.clone()) {
        return None;
    }
    let shifted = |offset: usize| offset - old.start + new.start;
    Some(now.text.range(shifted(start)..shifted(end)))
}

/// The link or joint around an offset: what it is, its name and its bytes.
fn around(snapshot: &Snapshot, offset: usize) -> Option<(String, String, Range<usize>)> {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    let after = markup.elements.partition_point(|one| one.tag.start <= offset);
    let mut ancestors = markup.ancestors(after.checked_sub(1)?);
    let part = ancestors.find(|one| matches!(markup.name(text, *one), "link" | "joint"))?;
    let element = &markup.elements[part];
    let name = markup.value(text, part, "name")?;
    let kind = markup.name(text, part).to_owned();
    let range = element.tag.start..element.end;
    range.contains(&offset).then(|| (kind, name.into_owned(), range))
}

/// The bytes of the link or joint of a name.
fn named(snapshot: &Snapshot, kind: &str, name: &str) -> Option<Range<usize>> {
    let element = snapshot.outline().element(kind, name)?;
    let element = &snapshot.markup().elements[element];
    Some(element.tag.start..element.end)
}
