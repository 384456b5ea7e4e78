//! The named configurations of the parts, under the names that they and their joints have in the combined robot.

use std::collections::HashSet;

use super::compose::Member;
use super::error::CombineError;
use super::note::Note;
use super::recipe::Recipe;
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};

/// The named configurations of the combined robot: those of each part, with its prefix.
///
/// # Errors
/// If they are too long together.
pub(super) fn of_parts(
    recipe: &Recipe,
    parts: &[Member],
    notes: &mut Vec<Note>,
) -> Result<Vec<ConfigurationEdit>, CombineError> {
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
