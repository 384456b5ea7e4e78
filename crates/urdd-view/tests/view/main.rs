//! The server of `urdd view` as its page and others use it: who is refused, what is served, what saving skips does. And
//! what is exported.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod asking;
mod cards;
mod dropping;
mod exporting;
mod following;
mod keeping;
mod living;
mod pictures;
mod refusing;
mod saving;
mod served;
mod site;
