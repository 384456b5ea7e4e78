//! The command line: parses arguments and prints text. Everything else is in the library.

mod check_collisions;
mod combine;
mod configurations;
mod conformance;
mod diff;
mod editing;
mod explain;
mod export;
mod foreign;
mod generate;
mod generate_output;
mod import;
mod info;
mod inputs;
mod lint;
mod lsp;
mod making;
mod named_configurations;
mod new_extension;
mod output;
mod packages;
mod rehash;
mod reporting;
mod robots;
mod schema;
mod signals;
mod skips;
mod validate;
mod view;
mod viewed;
mod words;
mod xacro;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;

use self::output::{Color, Failure};
use urdd_format::escape;

/// Specification, validator and reference generator of the Universal Robot Description Directory.
#[derive(Parser)]
#[command(name = "urdd", version, about, arg_required_else_help = true)]
struct Arguments {
    /// When to colour the output.
    #[arg(long, global = true, value_enum, default_value_t = Color::Auto, value_name = "WHEN")]
    color: Color,

    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Generate URDDs from URDFs.
    Generate(generate::GenerateArguments),
    /// Combine robots: a gripper on an arm, arms on a base.
    Combine(combine::CombineArguments),
    /// Import an MJCF or SDF: a URDF, its meshes, an SRDF, what exports need.
    Import(import::ImportArguments),
    /// Check URDDs against the specification.
    Validate(validate::ValidateArguments),
    /// Check URDFs: what is wrong with them, and what is odd.
    Lint(lint::LintArguments),
    /// Language server: findings, hover and completion in editors.
    Lsp(lsp::LspArguments),
    /// Compare two robots by meaning: links, joints, geometry, skipped pairs and findings.
    Diff(diff::DiffArguments),
    /// Check a robot for self-collisions, and list its nearest pairs of links.
    CheckCollisions(check_collisions::CheckCollisionsArguments),
    /// Show robots in the browser: shapes, joints, distances, skips and findings.
    View(view::ViewArguments),
    /// Export a robot: SRDF, URDF, MJCF, spheres.
    Export(export::ExportArguments),
    /// Import edits of the skips from an SRDF.
    Skips(skips::SkipsArguments),
    /// List, set and remove named configurations: home, ready.
    Configurations(named_configurations::ConfigurationsArguments),
    /// Explain a rule, or list all rules.
    Explain(explain::ExplainArguments),
    /// Show what a URDD contains, without validating it.
    Info(info::InfoArguments),
    /// Update the sizes and hashes in urdd.json to match the files.
    Rehash(rehash::RehashArguments),
    /// Conformance suite, for authors of producers and validators.
    Conformance(conformance::ConformanceArguments),
    /// Show, export or check the published JSON Schemas, or begin an extension.
    Schema(schema::SchemaArguments),
    /// Print the completion script of a shell: `urdd completions bash > ~/.local/share/bash-completion/completions/urdd`.
    Completions {
        /// The shell.
        shell: Shell,
    },
}

/// Parses the command line and runs the command. The first word is the program's name. `closed` states whether standard
/// output was closed when the program started.
pub fn run(words: Vec<OsString>, closed: bool) -> ExitCode {
    if closed {
        output::standard_output_is_closed();
    }
    let arguments = match Arguments::try_parse_from(&words) {
        Ok(arguments) => arguments,
        Err(error) => return usage(error, &words),
    };
    let color = arguments.color;
    match arguments.command {
        Command::Generate(arguments) => generate::run(&arguments),
        Command::Combine(arguments) => combine::run(&arguments),
        Command::Import(arguments) => import::run(&arguments),
        Command::Validate(arguments) => validate::run(&arguments, color),
        Command::Lint(arguments) => lint::run(&arguments, color),
        Command::Lsp(arguments) => lsp::run(&arguments),
        Command::Diff(arguments) => diff::run(&arguments),
        Command::CheckCollisions(arguments) => check_collisions::run(&arguments),
        Command::View(arguments) => view::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Skips(arguments) => skips::run(&arguments),
        Command::Configurations(arguments) => named_configurations::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
        Command::Rehash(arguments) => rehash::run(&arguments),
        Command::Conformance(arguments) => conformance::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "urdd", &mut script);
            output::printed(Ok::<_, Failure>(String::from_utf8_lossy(&script).into_owned()))
        }
    }
}

/// Prints help if requested, or the error of the command line. Its words come from the user or from file names, so they
/// are escaped.
fn usage(error: clap::Error, words: &[OsString]) -> ExitCode {
    if error.use_stderr() {
        // Parses again with escaped words, so that no word adds a line to the message.
        let words = words.iter().map(|word| escape::line(&word.to_string_lossy()).into_owned());
        let error = Arguments::try_parse_from(words).err().unwrap_or(error);
        let text = error.render().to_string();
        let text = escape::lines(text.trim_end());
        let _ = writeln!(std::io::stderr().lock(), "{text}");
        return ExitCode::from(output::USAGE);
    }
    output::printed(Ok::<_, Failure>(error.render().to_string()))
}
