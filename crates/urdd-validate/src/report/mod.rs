//! Reports: one model, and a file for each rendering of it.

mod causes;
pub mod github;
pub mod human;
pub mod info;
pub mod info_parts;
pub mod junit;
pub mod model;
pub mod place;
pub mod sarif;
pub mod style;
mod summary;
mod unverified;
mod words;

use urdd_format::escape;

pub use github::github;
pub use junit::junit;
pub use model::Report;
pub use sarif::sarif;

/// The report as JSON, indented, with a newline at its end.
///
/// # Errors
/// Never for a report that [`Run::report`](crate::Run::report) made: every number in it is finite.
pub fn json(report: &Report) -> serde_json::Result<String> {
    let text = serde_json::to_string_pretty(report)?;
    Ok(escape::json(&text).into_owned() + "\n")
}
