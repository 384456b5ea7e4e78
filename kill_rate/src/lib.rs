//! Internal to urdd; no stability promise.
//!
//! The kill rate of `urdd validate`: the proportion of single mutations of valid URDDs that the validator detects.
//!
//! Each mutation changes one value of a URDD. Then the sizes and hashes in the root metadata are updated, as a producer
//! with that fault would write them, and the validator runs. A mutation without findings survives.
//! `conformance/kill_rate.md` defines which changes count.

#![allow(clippy::disallowed_methods, reason = "for maintainers")]

mod carried_mesh_changes;
mod dice;
mod documents;
mod edit;
mod field;
mod file_bytes;
mod file_changes;
mod free;
mod glb_node;
mod key_changes;
mod list_changes;
mod meaning;
mod measure;
mod mesh_changes;
mod mesh_edit;
mod module_changes;
mod mutation;
mod number_changes;
mod original;
mod outcome;
mod plan;
mod pointer;
pub mod present;
mod reach;
mod result;
mod sample;
mod schema;
mod source_changes;
mod text_changes;
mod value_changes;
mod workbench;

pub use free::{
    FIELD_TOLERANCES, FREE_FIELDS, FieldTolerance, FreeField, PERMITTED, Permitted, Tolerance,
};
pub use measure::{MeasureError, measure};
pub use mutation::{Description, Target};
pub use original::OriginalError;
pub use outcome::{Outcome, Trial};
pub use plan::{Judge, Plan};
pub use result::{FieldCount, Measured, ModuleCount, Tally, modules_of};
