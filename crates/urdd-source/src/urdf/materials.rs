//! Checks materials. Questionable ones are kept as they are.

use std::collections::{BTreeSet, HashMap};

use super::reader::UrdfReader;
use crate::note::NoteKind;
use urdd_format::short::Short;
use urdd_format::urdf::{Color, Material, Texture};

/// How a material looks, if it says so.
fn look(material: &Material) -> Option<(&Option<Color>, &Option<Texture>)> {
    let look = (&material.color, &material.texture);
    (look != (&None, &None)).then_some(look)
}

/// Notes conflicting looks under one name, materials without a name, and names without a look. (A link may reference a
/// material that is declared later.)
pub(super) fn check(reader: &mut UrdfReader) {
    let materials = std::mem::take(&mut reader.materials);
    let mut looks = HashMap::new();
    for (_, material) in &materials {
        if let (Some(name), Some(look)) = (&material.name, look(material)) {
            looks.entry(name.as_str()).or_insert(look);
        }
    }
    let mut told = BTreeSet::new();
    let mut notes = Vec::new();
    for (offset, material) in &materials {
        let look = look(material);
        // Some programs write an empty name for a material without one.
        if material.name.as_deref() == Some("") {
            continue;
        }
        let (problem, assumed) = match &material.name {
            None => ("a material has no name".to_owned(), "it applies only to its element"),
            Some(name) => match looks.get(name.as_str()) {
                Some(first) if look.is_some_and(|look| look != *first) && told.insert(name) => (
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
