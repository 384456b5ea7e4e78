//! `urdd export` and imports of SRDFs as processes, and hostile texts in every place of a robot. Its crate's tests say what
//! is in each format.

mod command;
mod moveit;
mod pairs;
mod setup;
mod srdf_import;
mod states;
pub(crate) mod texts;
