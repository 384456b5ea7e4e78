//! The kill rate of `urdd validate`: how many single changes of valid URDDs the validator notices.
//!
//! Of each URDD one value after the other is changed, nothing else, sizes and hashes in the root metadata are brought up
//! to date as the producer of that fault would have had them, and the validator looks. A change that it says nothing of
//! has survived. `conformance/kill_rate.md` says what counts as a change.

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
pub use result::{FieldCount, Measured, ModuleCount, Tally};

use urdd::validate::rule::Rule;
use urdd::validate::settings::Settings;

/// What to measure.
#[derive(Debug, Clone)]
pub struct Plan {
    /// What choices follow from.
    pub seed: u64,
    /// How many changes are made of a field; `None` for all.
    pub per_field: Option<usize>,
    /// How many changes are made of a URDD, taken evenly from all fields; `None` for all.
    pub limit: Option<usize>,
    /// Names of the modules to change (`urdd.json` and `source` are such names too); empty for all.
    pub modules: Vec<String>,
    /// How many changes are looked at at once; `None` for one a processor. The result is the same.
    pub threads: Option<usize>,
}

/// What is measured.
pub struct Judge<'a> {
    /// The rules.
    pub rules: &'a [&'static Rule],
    /// Settings of the plain run.
    pub plain: Settings,
    /// Settings of a second run, over what survives the first; `None` for no second run.
    pub deep: Option<Settings>,
}
