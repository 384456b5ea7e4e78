//! The report of the format: the engine fills it, and one file per format renders it.

mod causes;
mod fill;
pub mod github;
pub mod human;
pub mod info;
pub mod info_parts;
pub mod junit;
pub mod place;
pub mod sarif;
pub mod style;
mod summary;
mod unverified;
mod words;

use crate::rule::Rule;
use crate::rules;
use urdd_format::escape;
use urdd_format::report::Report;

pub(crate) use fill::{blank, fill};
pub use github::github;
pub use junit::junit;
pub use sarif::sarif;

/// The rule that a report names by its code.
fn rule(code: &str) -> Option<&'static Rule> {
    let mut all = rules::all().into_iter().chain([&rules::testing::CRASHING]);
    all.find(|rule| rule.code.as_str() == code)
}

/// The report as JSON, indented, with a newline at its end.
///
/// # Errors
/// Never for the report of a [`Run`](crate::Run): every number in it is finite.
pub fn json(report: &Report) -> serde_json::Result<String> {
    let text = serde_json::to_string_pretty(report)?;
    Ok(escape::json(&text).into_owned() + "\n")
}
