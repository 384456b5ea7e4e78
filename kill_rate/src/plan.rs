//! The scope of a measurement.

use urdd_validate::rule::Rule;
use urdd_validate::settings::Settings;

/// Which mutations to apply.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Seed of the random choices.
    pub seed: u64,
    /// Number of mutations per field; `None` for all.
    pub per_field: Option<usize>,
    /// Maximum number of mutations per URDD, taken evenly from all fields; `None` for all.
    pub limit: Option<usize>,
    /// Names of the modules to mutate, including `urdd.json` and `source`; empty for all.
    pub modules: Vec<String>,
    /// Number of mutations to validate in parallel; `None` for the number of processors. It does not affect the result.
    pub threads: Option<usize>,
}

/// The validator under measurement.
pub struct Judge<'a> {
    /// The rules.
    pub rules: &'a [&'static Rule],
    /// Settings of the plain run.
    pub plain: Settings,
    /// Settings of a second run on the survivors of the first; `None` for no second run.
    pub deep: Option<Settings>,
}
