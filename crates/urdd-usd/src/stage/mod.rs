//! What layers compose: prims with the properties that the strongest opinions say.

mod compose;
mod composed;
mod layers;
mod outline;
mod sources;
mod tree;
mod variants;

use super::door::Door;
use super::error::{Fault, UsdError};
pub use composed::{Prim, Property, Stage};
use layers::Layers;
pub use outline::{Outline, outline};
use sources::Composer;
use std::sync::Arc;

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
