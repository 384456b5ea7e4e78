//! Internal to urdd; no stability promise.
//!
//! What is wrong, where, and what becomes of it: findings of rules, the settings that change them, baselines of what was
//! found before, and reports as text, JSON, SARIF and JUnit. Knows no rule: the validator and lint have theirs.

pub mod answer;
pub mod baseline;
pub mod check;
pub mod code;
pub mod description;
pub mod finding;
pub mod part;
pub mod places;
pub mod report;
pub mod run;
pub mod settings;
pub mod settings_file;

/// The rules to report.
pub mod selection {
    pub use crate::settings::{Codes, Selection, UnknownCodes};
}

#[cfg(test)]
mod tests;
