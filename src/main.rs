//! The `urdd` program.

use std::process::ExitCode;

fn main() -> ExitCode {
    urdd::cli::run()
}
