//! The bodies of the fuzz targets. They lie with the tests, which replay what fuzzing found on the
//! stable toolchain.

#[path = "../../tests/program/readers/mod.rs"]
pub mod readers;
