//! The command line: arguments in, text out. Everything else is in the library.

mod conformance;
mod explain;
mod generate;
mod generate_output;
mod info;
mod output;
mod rehash;
mod schema;
mod validate;

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
    /// Make URDDs of URDFs.
    Generate(generate::GenerateArguments),
    /// Check URDDs against the specification.
    Validate(validate::ValidateArguments),
    /// Tell about a rule, or list them all.
    Explain(explain::ExplainArguments),
    /// Tell what a URDD holds, without judging it.
    Info(info::InfoArguments),
    /// Bring the sizes and hashes in urdd.json up to date with the files.
    Rehash(rehash::RehashArguments),
    /// The conformance suite: for people who write producers and validators.
    Conformance(conformance::ConformanceArguments),
    /// Show, export or check the published JSON Schemas.
    Schema(schema::SchemaArguments),
}

/// Reads the command line and runs what it asks for.
pub fn run() -> ExitCode {
    match Arguments::parse().command {
        Command::Generate(arguments) => generate::run(&arguments),
        Command::Validate(arguments) => validate::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
        Command::Rehash(arguments) => rehash::run(&arguments),
        Command::Conformance(arguments) => conformance::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments),
    }
}
