//! Checks materials. Questionable ones are kept as they are.

use std::collections::{BTreeSet, HashMap};

use super::reader::UrdfReader;
use crate::note::NoteKind;
use urdd_format::short::Short;

/// Notes conflicting looks under one name, materials without a name, and names without a look. (A link may reference a
/// material that is declared later.)
pub(super) fn check(reader: &mut UrdfReader) {
    let materials = std::mem::take(&mut reader.materials);
    let mut looks = HashMap::new();
    for (_, material) in &materials {
        let look = (&material.color, &material.texture);
        if let (Some(name), true) = (&material.name, look != (&None, &None)) {
            looks.entry(name.as_str()).or_insert(look);
        }
    }
    let mut told = BTreeSet::new();
    let mut notes = Vec::new();
    for (offset, material) in &materials {
        let look = (&material.color, &material.texture);
        let has_look = look != (&None, &None);
        // Some programs write an empty name for a material without one.
        if material.name.as_deref() == Some("") {
            continue;
        }
        let (problem, assumed) = match &material.name {
            None => ("a material has no name".to_owned(), "it applies only to its element"),
            Some(name) => match looks.get(name.as_str()) {
                Some(first) if has_look && *first != look && told.insert(name) => (
                    format!("material `{}` is defined again, and looks different", Short::of(name)),
                    "each element keeps its own; a name alone means the first",
                ),
                None if told.insert(name) => (
                    format!("no material `{}` has a colour or texture", Short::of(name)),
                    "the name is kept, without a look",
                ),
                _ => continue,
            },
        };
        notes.push((*offset, problem, assumed));
    }
    for (offset, problem, assumed) in notes {
        reader.remark(NoteKind::Material, offset, problem, assumed);
    }
}
