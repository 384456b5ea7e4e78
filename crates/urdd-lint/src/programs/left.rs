//! What other rules do not see.

use urdd_format::report::{Consequence, Does, Fix, Severity};

/// A fault that no other rule finds, as LNT060 and LNT061 report it.
#[derive(Debug, Clone)]
pub struct Left {
    /// Where it is in the text.
    pub offset: usize,
    pub message: String,
    pub severity: Severity,
    /// What it leads to, if that is not what the rule says.
    pub consequence: Option<Consequence>,
    pub programs: Vec<Does>,
    pub fix: Option<Fix>,
    /// Whether a program has no robot because of it.
    pub is_refused: bool,
}
