//! Combines the users' decisions about the skips of the parts with the recipe's skips between parts.

use std::collections::HashMap;

use super::compose::Taken;
use super::error::CombineError;
use super::note::Note;
use super::recipe::{Recipe, Word};
use super::recipe_fault::RecipeFault;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::nearest::nearest;

/// The reason given for a skip from the recipe.
const REASON: &str = "the recipe skips it";

/// The skip edits of the combined robot, and the reasons for which its pairs are skipped.
///
/// # Errors
/// If the recipe names a missing link.
pub(super) fn decisions(
    recipe: &Recipe,
    parts: &[Taken],
    notes: &mut Vec<Note>,
) -> Result<(Vec<SkipEdit>, Option<Vec<SkippedReason>>), CombineError> {
    let (mut edits, mut length) = (Vec::new(), 0);
    let mut reasons: Vec<&Vec<SkippedReason>> = Vec::new();
    for taken in parts {
        let Some(skips) = &taken.loaded.skips else {
            continue;
        };
        reasons.push(&skips.reasons);
        let kept = |name: &String| {
            let idx = taken.loaded.links.get(name);
            idx.is_some_and(|idx| taken.trim.keeps_link(*idx))
        };
        for edit in &skips.edits {
            length += edit.link_a.len() + edit.link_b.len() + edit.reason.len();
            recipe.check_length(taken.part, "the edits of skips", length)?;
            if kept(&edit.link_a) && kept(&edit.link_b) {
                edits.push(SkipEdit {
                    link_a: taken.renamed(&edit.link_a),
                    link_b: taken.renamed(&edit.link_b),
                    ..edit.clone()
                });
            } else {
                let text = format!(
                    "the edit of the skips between `{}` and `{}` is left out, since one of them is dropped",
                    edit.link_a, edit.link_b
                );
                notes.push(Note::of_part("edit-lost", &taken.part.id.text, text));
            }
        }
    }
    let by_id: HashMap<&str, &Taken> =
        parts.iter().map(|taken| (taken.part.id.text.as_str(), taken)).collect();
    for taken in parts {
        for [a, b] in &taken.part.skip {
            edits.push(SkipEdit {
                link_a: link(recipe, &by_id, taken, a)?,
                link_b: link(recipe, &by_id, taken, b)?,
                skip: true,
                reason: REASON.to_owned(),
            });
        }
    }
    let first = reasons.first().copied().cloned();
    if reasons.windows(2).any(|two| two[0] != two[1]) {
        let text = "the parts skip pairs for different reasons; the default ones are used: same-link, always, adjacent, default (`--skip` chooses others)";
        notes.push(Note { kind: "reasons-differ", part: None, text: text.to_owned() });
        return Ok((edits, None));
    }
    Ok((edits, first))
}

/// The name, in the combined robot, of the link that a word of the part `own` refers to.
fn link(
    recipe: &Recipe,
    by_id: &HashMap<&str, &Taken>,
    own: &Taken,
    word: &Word,
) -> Result<String, CombineError> {
    let is_own = own.loaded.links.contains_key(&word.text);
    let other = word.text.split_once('/').filter(|_| !is_own);
    match other.and_then(|(id, name)| Some((by_id.get(id)?, name))) {
        Some((other, name)) => existing(recipe, other, name, word),
        None => existing(recipe, own, &word.text, word),
    }
}

/// The name of a part's link in the combined robot.
///
/// # Errors
/// If the part has no such link, or it is dropped.
pub(super) fn existing(
    recipe: &Recipe,
    taken: &Taken,
    name: &str,
    at: &Word,
) -> Result<String, CombineError> {
    let part = taken.part.id.text.clone();
    let Some(&idx) = taken.loaded.links.get(name) else {
        let links = taken.loaded.robot.links.iter();
        let fault = RecipeFault::Unknown {
            what: "link",
            part,
            name: name.to_owned(),
            nearest: nearest(links.map(|link| link.name.as_str()), name),
        };
        return Err(recipe.refused(at, fault));
    };
    match taken.trim.dropped_links[idx] {
        None => Ok(taken.renamed(name)),
        Some(with) => {
            let fault = RecipeFault::Dropped {
                what: "link",
                part,
                name: name.to_owned(),
                with: taken.part.drop[with].text.clone(),
            };
            Err(recipe.refused(at, fault))
        }
    }
}
