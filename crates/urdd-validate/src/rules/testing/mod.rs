//! TST: rules for trying out the validator itself. None of them is ever run unasked.

mod crashing_rule;

/// A rule that crashes: TST001.
pub const CRASHING: &crate::rule::Rule = crashing_rule::Declared::RULES[0];
