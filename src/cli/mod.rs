//! The command line: arguments in, text out. Everything else is in the library.

mod schema;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Specification, validator and reference generator of the Universal Robot Description Directory.
#[derive(Parser)]
#[command(name = "urdd", version, about, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Show, export or check the published JSON Schemas.
    Schema(schema::SchemaArguments),
}

/// Reads the command line and runs what it asks for.
pub fn run() -> ExitCode {
    match Arguments::parse().command {
        Command::Schema(arguments) => schema::run(&arguments),
    }
}
