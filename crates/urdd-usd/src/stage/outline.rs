//! What a layer says without the layers that it names: which these are, and whether it has bodies.

use super::super::door::Door;
use super::super::error::UsdError;
use super::super::layer::{Spec, field};
use super::super::value::{Item, Name, Value};
use super::layers::Layers;

/// The schema of bodies.
const BODY: &str = "PhysicsRigidBodyAPI";

/// A file without the files that it names.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Outline {
    /// The layers that it names, in whatever variant: as the door has them, see [`Door::read`].
    pub names: Vec<String>,
    /// Whether there is a rigid body in it.
    pub has_bodies: bool,
}

/// Reads one file; of a package, all layers in it.
///
/// # Errors
/// If it is no USD.
pub fn outline(path: &str, door: &mut dyn Door) -> Result<Outline, UsdError> {
    let mut layers = Layers::new(door);
    layers.load(path)?;
    let (mut outline, mut next) = (Outline::default(), 0);
    while let Some(loaded) = layers.all.get(next) {
        let specs = &loaded.layer.specs;
        outline.has_bodies |= specs.iter().any(is_body);
        let sublayers = loaded.layer.metadata("subLayers").and_then(Value::texts);
        let named = sublayers.into_iter().flatten().chain(specs.iter().flat_map(references));
        let named: Vec<Name> = named.filter(|name| !name.is_empty()).cloned().collect();
        for name in named {
            match layers.named(next as u32, &name) {
                // Of another one, or not there: whoever composes the stage says so.
                Ok(name) if name.ends_with(']') => drop(layers.load(&name)),
                Ok(name) => outline.names.push(name),
                Err(_) => {}
            }
        }
        next += 1;
    }
    outline.names.sort();
    outline.names.dedup();
    Ok(outline)
}

fn items<'s>(spec: &'s Spec, name: &str) -> impl Iterator<Item = &'s Item> {
    field(&spec.fields, name).and_then(Value::list).into_iter().flat_map(|list| {
        let explicit = list.explicit.iter().flatten();
        explicit.chain(&list.added).chain(&list.prepended).chain(&list.appended)
    })
}

fn is_body(spec: &Spec) -> bool {
    items(spec, "apiSchemas").any(|item| **item.text() == *BODY)
}

fn references(spec: &Spec) -> impl Iterator<Item = &Name> {
    items(spec, "references").chain(items(spec, "payload")).filter_map(|item| match item {
        Item::Reference { asset, .. } => Some(asset),
        _ => None,
    })
}
