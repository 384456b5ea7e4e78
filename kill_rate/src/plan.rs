//! What is measured, and how much of it.

use urdd_validate::rule::Rule;
use urdd_validate::settings::Settings;

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
