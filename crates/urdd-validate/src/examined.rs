//! The result of examining one URDD or URDF.

use super::engine::Check;
use urdd_format::report::Urdd;

/// One examined URDD or URDF.
pub struct Examined {
    /// Its report, still without the results of the checks.
    pub report: Urdd,
    /// The result of every rule, in order of code.
    pub checks: Vec<Check>,
}
