//! The users' decisions about the parts, under the names that things have in the combined robot: edits of skips, with the
//! recipe's skips between parts, and named configurations.

use std::collections::{HashMap, HashSet};

use super::compose::Member;
use super::error::{Note, Result};
use super::recipe::{Recipe, Word};
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};

/// The reason given for a skip from the recipe.
const REASON: &str = "the recipe skips it";

/// The skip edits of the combined robot, and the reasons for which its pairs are skipped.
pub(super) fn skips(
    recipe: &Recipe,
    parts: &[Member],
    notes: &mut Vec<Note>,
) -> Result<(Vec<SkipEdit>, Option<Vec<SkippedReason>>)> {
    let (mut edits, mut length) = (Vec::new(), 0);
    let mut reasons: Vec<&Vec<SkippedReason>> = Vec::new();
    for member in parts {
        let Some(skips) = &member.loaded.skips else { continue };
        reasons.push(&skips.reasons);
        let kept = |name: &String| {
            let idx = member.loaded.links.get(name);
            idx.is_some_and(|idx| member.trim.keeps_link(*idx))
        };
        for edit in &skips.edits {
            length += edit.link_a.len() + edit.link_b.len() + edit.reason.len();
            recipe.check_length(member.part, "the edits of skips", length)?;
            if kept(&edit.link_a) && kept(&edit.link_b) {
                edits.push(SkipEdit {
                    link_a: member.renamed(&edit.link_a),
                    link_b: member.renamed(&edit.link_b),
                    ..edit.clone()
                });
            } else {
                let text = format!(
                    "the edit of the skips between `{}` and `{}` is left out, since one of them is dropped",
                    edit.link_a, edit.link_b
                );
                notes.push(Note::of_part("edit-lost", &member.part.id.text, text));
            }
        }
    }
    let by_id: HashMap<&str, &Member> =
        parts.iter().map(|member| (member.part.id.text.as_str(), member)).collect();
    for member in parts {
        for [a, b] in &member.part.skip {
            edits.push(SkipEdit {
                link_a: link(recipe, &by_id, member, a)?,
                link_b: link(recipe, &by_id, member, b)?,
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
    by_id: &HashMap<&str, &Member>,
    own: &Member,
    word: &Word,
) -> Result<String> {
    let is_own = own.loaded.links.contains_key(&word.text);
    let other = word.text.split_once('/').filter(|_| !is_own);
    match other.and_then(|(id, name)| Some((by_id.get(id)?, name))) {
        Some((other, name)) => other.link(recipe, name, word),
        None => own.link(recipe, &word.text, word),
    }
}

/// The named configurations of the combined robot: those of each part, with its prefix.
pub(super) fn configurations(
    recipe: &Recipe,
    parts: &[Member],
    notes: &mut Vec<Note>,
) -> Result<Vec<ConfigurationEdit>> {
    let (mut edits, mut length) = (Vec::new(), 0);
    let mut names = HashSet::new();
    for member in parts {
        let mut note = |kind, text| notes.push(Note::of_part(kind, &member.part.id.text, text));
        for edit in &member.loaded.configurations {
            let words = edit.positions.iter().map(|position| position.dof_name.len());
            length += edit.name.as_str().len() + words.sum::<usize>();
            recipe.check_length(member.part, "the named configurations", length)?;
            let renamed = ConfigurationName::new(member.renamed(edit.name.as_str()));
            let Some(name) = renamed.filter(|name| names.insert(name.clone())) else {
                note(
                    "configuration-lost",
                    format!(
                        "the configuration `{}` is left out, since an earlier part has one of this name; give the part a prefix",
                        edit.name
                    ),
                );
                continue;
            };
            let mut positions = Vec::new();
            for position in &edit.positions {
                match moves(member, &position.dof_name) {
                    true => positions.push(DofPosition {
                        dof_name: member.renamed(&position.dof_name),
                        ..position.clone()
                    }),
                    false => note(
                        "position-lost",
                        format!(
                            "the configuration `{}` is kept without a position of `{}`, whose joint is dropped or frozen",
                            edit.name, position.dof_name
                        ),
                    ),
                }
            }
            edits.push(ConfigurationEdit { name, positions });
        }
    }
    Ok(edits)
}

/// Whether the joint of a part's DOF is kept, and not frozen.
fn moves(member: &Member, dof: &str) -> bool {
    let joints = &member.loaded.joints;
    // The name of a DOF is that of its joint, or has the coordinate after it. Names of joints may hold slashes too.
    let joint = joints.get(dof).or_else(|| joints.get(dof.rsplit_once('/')?.0));
    joint.is_some_and(|idx| member.trim.keeps_joint(*idx) && !member.trim.frozen.contains_key(idx))
}
