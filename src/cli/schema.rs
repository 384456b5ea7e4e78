//! `urdd schema`.

use std::process::ExitCode;

use clap::Args;

/// Arguments of `urdd schema`.
#[derive(Args)]
pub struct SchemaArguments {}

/// Runs `urdd schema`.
pub fn run(_arguments: &SchemaArguments) -> ExitCode {
    ExitCode::SUCCESS
}
