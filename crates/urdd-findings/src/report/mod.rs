//! The report as JSON; a file for each other format.

pub mod github;
pub mod human;
pub mod junit;
pub mod programs;
pub mod sarif;
pub mod style;
#[doc(hidden)]
pub mod summary;
mod unexamined;
mod variants;

/// Paths of URDDs relative to the working directory.
pub mod place {
    pub use crate::run::{file_in, is_inside, places, relative};
}

use serde::Serialize;

use urdd_format::escape;

pub use github::{github, markdown};
pub use junit::junit;
pub use sarif::sarif;

/// A report, or other output, as JSON, indented, with a newline at its end.
///
/// # Errors
/// If `output` cannot be JSON. Never for the report of a [`Run`](crate::run::Run): every number in it is finite.
pub fn json(output: &impl Serialize) -> serde_json::Result<String> {
    let text = serde_json::to_string_pretty(output)?;
    Ok(escape::json(&text).into_owned() + "\n")
}
