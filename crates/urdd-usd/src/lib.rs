//! Internal to urdd; no stability promise.
//!
//! Reads USD: layers of text (`usda`), crate files (`usdc`) and packages (`usdz`), and composes them into a [`Stage`]:
//! sublayers, references, payloads, inherits, variants, `over`, `active` and instances. What is not read is refused by
//! name. Files and memory come through a [`Door`].
//!
//! Memory and work are charged where neither can be had without: specs of layers (a list of them is made by `Layers::specs`
//! alone), edits of lists (`Composer::edited`), and of a stage values, targets and paths ([`Authored`], [`Targets`],
//! [`Stage::find`]).
//!
//! - Values are those at the default time; a property that has values by time alone has the first of them, and says so.
//! - Specializes count as inherits that are weaker than payloads of the same prim.
//! - Local opinions below an instance do not count, as in USD; prototypes are read in the place of instances.
//! - Relocates, expressions in paths, and layers from the network are refused.
//!
//! The crate `openusd` was tried first. 0.8 needs Rust 1.96. 0.6 is 86,000 lines with an editor and a tracker of changes,
//! and brings six crates that nothing else of ours has. Of 1,739 files that differ from a good one in one byte, it panics
//! on 491, asks for more memory than there is on 137, and does not end on one.

mod binary;
mod door;
mod error;
mod layer;
mod stage;
mod text;

pub use binary::START as CRATE_START;
pub use door::{Door, beside};
pub use error::{Fault, Place, UsdError};
pub use layer::{Item, ListOp, MAX_LEVELS, Name, Value};
pub use stage::{Authored, Outline, Prim, Property, Stage, Targets, file, open, outline};
