//! Diffuse colours of COLLADA materials.

use std::collections::HashMap;

use roxmltree::{Node, NodeId};

use super::super::assembly::Material;
use super::super::number::Words;
use super::document::{Document, child, children, text};

/// The colour of each effect that was read.
pub(super) type Colors = HashMap<NodeId, Option<[f64; 4]>>;

/// The bindings of a geometry instance: from symbol to material URL.
pub(super) fn bindings<'a>(instance: Option<Node<'a, 'a>>) -> HashMap<&'a str, &'a str> {
    let mut bindings = HashMap::new();
    for node in instance.into_iter().flat_map(|instance| instance.descendants()) {
        if let ("instance_material", Some(symbol), Some(target)) =
            (node.tag_name().name(), node.attribute("symbol"), node.attribute("target"))
        {
            bindings.entry(symbol).or_insert(target);
        }
    }
    bindings
}

/// The material that the instance binds to the symbol, or else the material with that id.
pub(super) fn of_symbol(
    document: &Document<'_>,
    bindings: &HashMap<&str, &str>,
    symbol: Option<&str>,
    colors: &mut Colors,
) -> Material {
    let Some(symbol) = symbol else {
        return Material::default();
    };
    let material = document.find("material", bindings.get(symbol).unwrap_or(&symbol));
    let name = material
        .and_then(|material| material.attribute("name").or_else(|| material.attribute("id")));
    let color = material
        .and_then(|material| child(material, "instance_effect"))
        .and_then(|effect| document.find("effect", effect.attribute("url")?))
        .and_then(|effect| *colors.entry(effect.id()).or_insert_with(|| diffuse(effect)));
    Material { name: Some(name.unwrap_or(symbol).to_owned()), color }
}

/// The diffuse colour of an effect, or the emission of a `constant` one, which has no diffuse colour; `None` for a
/// texture.
fn diffuse(effect: Node<'_, '_>) -> Option<[f64; 4]> {
    let profile = child(effect, "profile_COMMON")?;
    let technique = child(profile, "technique")?;
    let shader = technique.children().find(|node| {
        matches!(node.tag_name().name(), "phong" | "blinn" | "lambert" | "constant")
    })?;
    let wanted = if shader.tag_name().name() == "constant" { "emission" } else { "diffuse" };
    let value = child(shader, wanted)?;
    if let Some(color) = child(value, "color") {
        return rgba(color);
    }
    // A named parameter of the technique, profile or effect.
    let name = child(value, "param")?.attribute("ref")?;
    [technique, profile, effect]
        .into_iter()
        .flat_map(|scope| children(scope, "newparam"))
        .find(|parameter| parameter.attribute("sid") == Some(name))
        .and_then(|parameter| {
            parameter
                .children()
                .find(|node| matches!(node.tag_name().name(), "float4" | "float3" | "color"))
        })
        .and_then(rgba)
}

/// Three or four numbers, clamped to 0 to 1.
fn rgba(node: Node<'_, '_>) -> Option<[f64; 4]> {
    let text = text(node);
    let mut words = Words::new(text.as_bytes());
    let mut value = || words.float().filter(|value| value.is_finite());
    let color = [value()?, value()?, value()?, value().unwrap_or(1.0)];
    Some(color.map(|value| value.clamp(0.0, 1.0)))
}
