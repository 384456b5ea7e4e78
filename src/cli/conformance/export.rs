//! `urdd conformance export`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use crate::cli::output;
use crate::conformance::export::export;

/// Arguments of `urdd conformance export`.
#[derive(Args)]
pub struct ExportArguments {
    /// The folder that gets the suite.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Runs `urdd conformance export`.
pub fn run(arguments: &ExportArguments) -> ExitCode {
    match export(&arguments.folder) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            output::error(&error.to_string());
            ExitCode::from(2)
        }
    }
}
