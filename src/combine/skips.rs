//! What people decided about the skips of the parts, and what the recipe says of pairs across them.

use super::compose::Taken;
use super::error::{CombineError, RecipeFault};
use super::note::Note;
use super::recipe::{Recipe, Word};
use crate::format::link_shapes_skips::{SkipEdit, SkippedReason};
use crate::format::nearest::nearest;

/// Why a pair of the recipe is skipped.
const REASON: &str = "the recipe skips it";

/// The edits of the robot that is made, and the reasons for which its pairs are skipped.
///
/// # Errors
/// Where the recipe names a link that is not there.
pub(super) fn decisions(
    recipe: &Recipe,
    parts: &[Taken],
    notes: &mut Vec<Note>,
) -> Result<(Vec<SkipEdit>, Option<Vec<SkippedReason>>), CombineError> {
    let mut edits = Vec::new();
    let mut reasons: Vec<&Vec<SkippedReason>> = Vec::new();
    for taken in parts {
        let Some(skips) = &taken.loaded.skips else {
            continue;
        };
        reasons.push(&skips.reasons);
        let kept = |name: &String| {
            let mut links = taken.loaded.robot.links.iter();
            let idx = links.position(|link| link.name == *name);
            idx.is_some_and(|idx| taken.trim.keeps_link(idx))
        };
        for edit in &skips.edits {
            if kept(&edit.link_a) && kept(&edit.link_b) {
                edits.push(SkipEdit {
                    link_a: taken.renamed(&edit.link_a),
                    link_b: taken.renamed(&edit.link_b),
                    ..edit.clone()
                });
            } else {
                notes.push(Note::EditLost {
                    part: taken.part.id.text.clone(),
                    link_a: edit.link_a.clone(),
                    link_b: edit.link_b.clone(),
                });
            }
        }
    }
    for (idx, taken) in parts.iter().enumerate() {
        for [a, b] in &taken.part.skip {
            edits.push(SkipEdit {
                link_a: link(recipe, parts, idx, a)?,
                link_b: link(recipe, parts, idx, b)?,
                skip: true,
                reason: REASON.to_owned(),
            });
        }
    }
    let first = reasons.first().copied().cloned();
    if reasons.windows(2).any(|two| two[0] != two[1]) {
        notes.push(Note::ReasonsDiffer);
        return Ok((edits, None));
    }
    Ok((edits, first))
}

/// The link that a word of part `idx` means, by its name in the robot that is made.
fn link(recipe: &Recipe, parts: &[Taken], idx: usize, word: &Word) -> Result<String, CombineError> {
    let is_own = |name: &str| {
        let mut links = parts[idx].loaded.robot.links.iter();
        links.any(|link| link.name == name)
    };
    match word.text.split_once('/') {
        Some((id, name)) if !is_own(&word.text) && recipe.part(id).is_some() => {
            let part = recipe.part(id).unwrap_or(idx);
            existing(recipe, &parts[part], name, word)
        }
        _ => existing(recipe, &parts[idx], &word.text, word),
    }
}

/// The name, in the robot that is made, of a link of a part.
///
/// # Errors
/// Where the part has no such link, or it is dropped.
pub(super) fn existing(
    recipe: &Recipe,
    taken: &Taken,
    name: &str,
    at: &Word,
) -> Result<String, CombineError> {
    let links = taken
        .loaded
        .robot
        .links
        .iter()
        .map(|link| link.name.as_str());
    let part = taken.part.id.text.clone();
    let Some(idx) = links.clone().position(|link| link == name) else {
        let fault = RecipeFault::Unknown {
            what: "link",
            part,
            name: name.to_owned(),
            nearest: nearest(links, name),
        };
        return Err(recipe.refused(at, fault));
    };
    match &taken.trim.dropped_links[idx] {
        None => Ok(taken.renamed(name)),
        Some(with) => {
            let fault = RecipeFault::Dropped {
                what: "link",
                part,
                name: name.to_owned(),
                with: with.clone(),
            };
            Err(recipe.refused(at, fault))
        }
    }
}
