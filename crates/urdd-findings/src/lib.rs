//! Internal to urdd; no stability promise.
//!
//! What is wrong, where, and what becomes of it: findings of rules, the settings that change them, baselines of what was
//! found before, and reports as text, JSON, SARIF and JUnit. Knows no rule: the validator and lint have theirs.

pub mod baseline;
pub mod cause;
pub mod check;
pub mod code;
pub mod description;
pub mod examined;
pub mod family;
pub mod file_error;
pub mod finding;
pub mod part;
pub mod places;
pub mod programs;
pub mod report;
pub mod robots;
pub mod run;
pub mod selection;
pub mod settings;
pub mod settings_file;
pub mod skip;

#[cfg(test)]
mod tests;
