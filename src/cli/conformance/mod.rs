//! `urdd conformance`: a subcommand a file.

mod export;
mod kill_rate;

use std::process::ExitCode;

use clap::{Args, Subcommand};

/// Arguments of `urdd conformance`.
#[derive(Args)]
pub struct ConformanceArguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Write the suite into a folder.
    Export(export::ExportArguments),
    /// Change valid URDDs one value at a time, and count what the validator notices.
    KillRate(kill_rate::KillRateArguments),
}

/// Runs `urdd conformance`.
pub fn run(arguments: &ConformanceArguments) -> ExitCode {
    match &arguments.command {
        Command::Export(arguments) => export::run(arguments),
        Command::KillRate(arguments) => kill_rate::run(arguments),
    }
}
