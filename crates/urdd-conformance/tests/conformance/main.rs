//! The conformance suite as data, judged by our validator.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod cases;
mod export;
mod judge;
mod profile;
mod unreadable;
mod valid;

use urdd_conformance::suite::Suite;

/// The suite in the repository.
fn suite() -> Suite {
    let files = testkit::files::below(&testkit::repository().join("conformance"));
    Suite::of(files).expect("the suite reads")
}
