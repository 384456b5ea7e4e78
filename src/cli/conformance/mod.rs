//! `urdd conformance`: one file per subcommand.

mod common;
mod export;
mod follow;
mod producer;
mod validator;

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
    /// Run a producer on the suite's robots, and score the URDDs that it writes.
    Producer(producer::ProducerArguments),
    /// Run a validator on every case, and score its verdicts.
    Validator(validator::ValidatorArguments),
}

/// Runs `urdd conformance`.
pub fn run(arguments: &ConformanceArguments) -> ExitCode {
    match &arguments.command {
        Command::Export(arguments) => export::run(arguments),
        Command::Producer(arguments) => producer::run(arguments),
        Command::Validator(arguments) => validator::run(arguments),
    }
}
