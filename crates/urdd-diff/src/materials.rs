//! Values of materials.

use crate::fields::Fields;
use urdd_format::urdf::Material;

/// The materials at the top of a URDF as parts.
pub(super) fn parts(materials: &[Material]) -> Vec<(String, Fields)> {
    let part = |material: &Material| {
        let mut fields = Fields::default();
        add_look("", material, &mut fields);
        (material.name.clone().unwrap_or_default(), fields)
    };
    materials.iter().map(part).collect()
}

/// The values of a visual element's material as written.
pub(super) fn written(material: Option<&Material>) -> Fields {
    resolved(material, &[])
}

/// The values of a visual element's material. A colour and a texture that it does not state are those of the first
/// material at the top of the URDF that has this name and states one.
pub(super) fn resolved(material: Option<&Material>, tops: &[Material]) -> Fields {
    let mut fields = Fields::default();
    let Some(material) = material else {
        return fields;
    };
    let named = |top: &&Material| top.name.is_some() && top.name == material.name;
    let tops = || tops.iter().filter(named);
    let look = Material {
        name: material.name.clone(),
        color: (material.color.clone()).or_else(|| tops().find_map(|top| top.color.clone())),
        texture: (material.texture.clone()).or_else(|| tops().find_map(|top| top.texture.clone())),
    };
    // Published URDDs have an empty name where there is none.
    let name = look.name.as_deref().filter(|name| !name.is_empty());
    fields.text("material.name", name);
    add_look("material.", &look, &mut fields);
    fields
}

fn add_look(prefix: &str, material: &Material, fields: &mut Fields) {
    let rgba = material.color.as_ref().map(|color| color.rgba);
    fields.numbers(format!("{prefix}rgba"), "", rgba);
    let texture = material.texture.as_ref().map(|texture| texture.filename.as_str());
    fields.text(format!("{prefix}texture"), texture);
}
