//! Reports: one model, and a file for each rendering of it.

pub mod human;
pub mod info;
pub mod junit;
pub mod model;
pub mod place;
pub mod sarif;

pub use junit::junit;
pub use model::Report;
pub use sarif::sarif;

/// The report as JSON, indented, with a newline at its end.
///
/// # Errors
/// Never for a report that [`Report::new`] made: every number in it is finite.
pub fn json(report: &Report) -> serde_json::Result<String> {
    Ok(serde_json::to_string_pretty(report)? + "\n")
}
