//! TST: rules for trying out the validator itself. None of them is ever run unasked.

mod crashing_rule;
