//! TST: rules for trying out the validator itself. None of them is ever run unasked.

pub mod crashing_rule;
