//! What layers compose: prims with the properties that the strongest opinions say; and what a layer says without the layers
//! that it names.

mod compose;
mod composed;
mod layers;
mod sources;
mod tree;

use std::sync::Arc;

use crate::door::Door;
use crate::error::{Fault, Place, UsdError};
use crate::layer::{Item, Name, Spec, Value, field};
use layers::{Layers, error};
use sources::Composer;

pub use composed::{Authored, Prim, Property, Stage, Targets};

/// Reads a layer and all that it is composed of.
///
/// # Errors
/// If one of them is not there, is not USD, or says what is not read.
pub fn open(path: &str, door: &mut dyn Door) -> Result<Stage, UsdError> {
    let mut layers = Layers::new(door);
    let stack = layers.stack(path)?;
    Composer::new(layers).stage(stack)
}

/// Reads a file by the path that an asset has in a stage: it may be in a package.
///
/// # Errors
/// If it is not there.
pub fn file(path: &str, door: &mut dyn Door) -> Result<Arc<[u8]>, Fault> {
    Layers::new(door).bytes(path)
}

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
                Err(fault @ Fault::TooMuch(_)) => return Err(error(path, Place::Layer, fault)),
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
