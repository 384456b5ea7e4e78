//! The command line.

use std::ffi::OsString;
use std::process::ExitCode;

use pyo3::prelude::*;

/// Runs the command line, and returns the exit status. The first word is the program's name.
#[pyfunction]
pub fn main(py: Python<'_>, words: Vec<OsString>, closed: bool) -> u8 {
    let status = py.detach(|| urdd::cli::run(words, closed));
    // The only way to get the number of an exit status.
    (0..=u8::MAX).find(|number| ExitCode::from(*number) == status).unwrap_or(101)
}
