//! The report of the format: the engine fills it, and one file per format renders it.

#[doc(hidden)]
pub mod causes;
mod fill;
pub mod github;
pub mod human;
pub mod junit;
pub mod place;
pub mod programs;
pub mod sarif;
pub mod style;
#[doc(hidden)]
pub mod summary;
mod words;

use serde::Serialize;

use urdd_format::escape;

pub(crate) use fill::fill;
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
