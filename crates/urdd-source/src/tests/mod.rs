//! The tests of this crate.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod arguments;
mod error;
mod files;
mod inspect;
mod installed;
mod loops;
mod origin;
mod packages;
