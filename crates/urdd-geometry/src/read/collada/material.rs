//! Diffuse colours of COLLADA materials.

use std::collections::HashMap;

use urdd_xml::{Node, NodeId};

use super::super::assembly::Material;
use super::super::number::Words;
use super::super::scene::Texture;
use super::document::{Document, child, children, file_of_image, text};

/// The colour and the texture of each effect that was read.
pub(super) type Looks = HashMap<NodeId, (Option<[f64; 4]>, Option<Texture>)>;

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
    looks: &mut Looks,
) -> Material {
    let Some(symbol) = symbol else {
        return Material::default();
    };
    let material = document.find("material", bindings.get(symbol).unwrap_or(&symbol));
    let name = material
        .and_then(|material| material.attribute("name").or_else(|| material.attribute("id")));
    let (color, texture) = material
        .and_then(|material| child(material, "instance_effect"))
        .and_then(|effect| document.find("effect", effect.attribute("url")?))
        .map(|effect| {
            let read = || (diffuse(effect), texture(document, effect));
            looks.entry(effect.id()).or_insert_with(read).clone()
        })
        .unwrap_or_default();
    Material { name: Some(name.unwrap_or(symbol).to_owned()), color, texture }
}

/// The diffuse colour of an effect, or the emission of a `constant` one, which has no diffuse colour; `None` for a
/// texture.
fn diffuse(effect: Node<'_, '_>) -> Option<[f64; 4]> {
    let (scopes, value) = value(effect)?;
    if let Some(color) = child(value, "color") {
        return rgba(color);
    }
    // A named parameter of the technique, profile or effect.
    parameter(scopes, child(value, "param")?.attribute("ref")?)
        .and_then(|parameter| {
            parameter
                .children()
                .find(|node| matches!(node.tag_name().name(), "float4" | "float3" | "color"))
        })
        .and_then(rgba)
}

/// That texture, whose image is named by a sampler and its surface (1.4), by a sampler (1.5), or directly.
fn texture(document: &Document<'_>, effect: Node<'_, '_>) -> Option<Texture> {
    let (scopes, value) = value(effect)?;
    let mut id = child(value, "texture")?.attribute("texture")?;
    let sampler = parameter(scopes, id).and_then(|found| child(found, "sampler2D"));
    if let Some(image) = sampler.and_then(|sampler| child(sampler, "instance_image")) {
        id = image.attribute("url")?;
    } else if let Some(source) = sampler.and_then(|sampler| child(sampler, "source")) {
        let surface = child(parameter(scopes, source.text()?.trim())?, "surface")?;
        id = child(surface, "init_from")?.text()?;
    }
    let name = file_of_image(document.find("image", id)?)?;
    Some(Texture { name, ..Texture::default() })
}

/// The diffuse value of an effect, or the emission of a `constant` one; and the scopes of its parameters.
fn value<'a>(effect: Node<'a, 'a>) -> Option<([Node<'a, 'a>; 3], Node<'a, 'a>)> {
    let profile = child(effect, "profile_COMMON")?;
    let technique = child(profile, "technique")?;
    let shader = technique.children().find(|node| {
        matches!(node.tag_name().name(), "phong" | "blinn" | "lambert" | "constant")
    })?;
    let wanted = if shader.tag_name().name() == "constant" { "emission" } else { "diffuse" };
    Some(([technique, profile, effect], child(shader, wanted)?))
}

fn parameter<'a>(scopes: [Node<'a, 'a>; 3], name: &str) -> Option<Node<'a, 'a>> {
    let mut parameters = scopes.into_iter().flat_map(|scope| children(scope, "newparam"));
    parameters.find(|parameter| parameter.attribute("sid") == Some(name))
}

/// Three or four numbers, clamped to 0 to 1.
fn rgba(node: Node<'_, '_>) -> Option<[f64; 4]> {
    let text = text(node);
    let mut words = Words::new(text.as_bytes());
    let mut value = || words.float().filter(|value| value.is_finite());
    let color = [value()?, value()?, value()?, value().unwrap_or(1.0)];
    Some(color.map(|value| value.clamp(0.0, 1.0)))
}
