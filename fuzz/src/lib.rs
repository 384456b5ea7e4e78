//! The bodies of the fuzz targets. They are with the tests, which replay what fuzzing found.

#[path = "../../crates/urdd-c/tests/border/calls.rs"]
pub mod calls;
#[path = "../../tests/program/readers/mod.rs"]
pub mod readers;
