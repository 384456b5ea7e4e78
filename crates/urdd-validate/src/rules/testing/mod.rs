//! TST: rules for trying out the validator itself. None of them is ever run unasked.

mod crashing_rule;

/// A rule that crashes: TST001.
pub use crashing_rule::RULE as CRASHING;
