//! The command line: parses arguments and prints text. Everything else is in the library.

mod arguments;
mod check_collisions;
mod combine;
mod configurations;
mod conformance;
mod diff;
mod edits;
mod explain;
mod export;
mod generate;
mod generate_output;
mod import;
mod info;
mod inputs;
mod lint;
mod output;
mod picture;
mod rehash;
mod schema;
mod validate;
mod view;
mod watch;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;

use self::output::{Color, Failure, one_line};
use self::watch::{LimitArguments, Watch};
use urdd_format::escape;

/// Specification, validator and reference generator of the Universal Robot Description Directory.
#[derive(Parser)]
#[command(name = "urdd", version, about, arg_required_else_help = true)]
struct Arguments {
    /// When to colour the output.
    #[arg(long, global = true, value_enum, default_value_t = Color::Auto, value_name = "WHEN")]
    color: Color,

    #[command(flatten)]
    limits: LimitArguments,

    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Generate URDDs from URDFs.
    Generate(generate::GenerateArguments),
    /// Combine robots: a gripper on an arm, arms on a base.
    Combine(combine::CombineArguments),
    /// Import an MJCF, SDF or USD: a URDF, its meshes, an SRDF, what exports need.
    Import(import::ImportArguments),
    /// Check URDDs against the specification.
    Validate(validate::ValidateArguments),
    /// Check URDFs: what is wrong with them, and what is odd.
    Lint(lint::LintArguments),
    /// Language server: findings, hover and completion in editors.
    #[command(
        after_help = "Editors start it: see docs/editors.md. It speaks the Language Server Protocol on standard input and \
        output, and ends with the editor.\n\n\
        Exit status: 0 the editor ended it; 1 the editor went away; 2 a message could not be read or written."
    )]
    Lsp {
        /// Accepted because some editors pass it: there is no other way to connect.
        #[arg(long, hide = true)]
        stdio: bool,
    },
    /// Compare two robots by meaning: links, joints, geometry, skipped pairs and findings.
    Diff(diff::DiffArguments),
    /// Check a robot for self-collisions, and list its nearest pairs of links.
    CheckCollisions(check_collisions::CheckCollisionsArguments),
    /// Show robots in the browser: shapes, joints, distances, skips and findings.
    View(view::ViewArguments),
    /// Draw a robot into a PNG, without a browser or a display.
    Picture(picture::PictureArguments),
    /// Export a robot: SRDF, URDF, MJCF, spheres.
    Export(export::ExportArguments),
    /// Import edits of the skips from an SRDF.
    #[command(subcommand)]
    Skips(edits::SkipsCommand),
    /// Import spheres of links: cuRobo's YAML, Foam's JSON, a URDF with spheres.
    #[command(subcommand)]
    Spheres(edits::SpheresCommand),
    /// List, set and remove named configurations: home, ready.
    #[command(subcommand)]
    Configurations(edits::ConfigurationsCommand),
    /// Explain a rule, or list all rules.
    Explain(explain::ExplainArguments),
    /// Show what a URDD contains, without validating it.
    Info(info::InfoArguments),
    /// Update the sizes and hashes in urdd.json to match the files.
    Rehash(rehash::RehashArguments),
    /// Conformance suite, for authors of producers and validators.
    #[command(subcommand)]
    Conformance(conformance::ConformanceCommand),
    /// Show, export or check the published JSON Schemas, or begin an extension.
    #[command(subcommand)]
    Schema(schema::SchemaCommand),
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
    let is_json = is_json(&words);
    let (color, limits) = (arguments.color, arguments.limits);
    let watch = &Watch::new(limits);
    let done = match arguments.command {
        Command::Generate(arguments) => generate::run(&arguments, watch),
        Command::Combine(arguments) => combine::run(&arguments, watch),
        Command::Import(arguments) => import::run(&arguments, watch),
        Command::Validate(arguments) => validate::run(&arguments, watch, color),
        Command::Lint(arguments) => lint::run(&arguments, watch, color),
        Command::Lsp { .. } => limits.refuse().map_err(Failure::from).and_then(|()| {
            urdd_lsp::serve_stdio()
                .map(|ended| u8::from(!ended.is_orderly()))
                .map_err(|error| one_line(error).into())
        }),
        Command::Diff(arguments) => diff::run(&arguments, watch),
        Command::CheckCollisions(arguments) => check_collisions::run(&arguments, watch),
        Command::View(arguments) => view::run(&arguments, watch, limits),
        Command::Picture(arguments) => picture::run(&arguments, watch),
        Command::Export(arguments) => export::run(&arguments, watch),
        Command::Skips(command) => edits::skips(&command, watch),
        Command::Spheres(command) => edits::spheres(&command, watch),
        Command::Configurations(command) => edits::configurations(&command, watch),
        Command::Explain(arguments) => printed(explain::run(&arguments)),
        Command::Info(arguments) => info::run(&arguments, watch),
        Command::Rehash(arguments) => rehash::run(&arguments, watch),
        Command::Conformance(command) => {
            limits.refuse().map_err(Failure::from).and_then(|()| conformance::run(&command, watch))
        }
        Command::Schema(command) => schema::run(&command),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "urdd", &mut script);
            printed(Ok(String::from_utf8_lossy(&script).into_owned()))
        }
    };
    output::ended(done, is_json)
}

/// Whether the words ask for JSON: `--format json`.
fn is_json(words: &[OsString]) -> bool {
    let words = words.iter().take_while(|word| *word != "--");
    let words: Vec<&OsString> = words.collect();
    let is_apart = words.windows(2).any(|two| two[0] == "--format" && two[1] == "json");
    is_apart || words.iter().any(|word| *word == "--format=json")
}

/// Options that destroy or replace what is there: no tip names them for a word that is misspelt.
const DESTRUCTIVE: [&str; 4] = ["--alone", "--drop-edits", "--fix", "--force"];

/// The error without a tip that names what destroys.
fn without_destructive_tips(mut error: clap::Error) -> clap::Error {
    if let Some(ContextValue::String(tip)) = error.get(ContextKind::SuggestedArg)
        && DESTRUCTIVE.contains(&tip.as_str())
    {
        error.remove(ContextKind::SuggestedArg);
    }
    error
}

/// Prints the text of a command that only prints.
fn printed(text: Result<String, Failure>) -> Result<u8, Failure> {
    output::print(&text?)?;
    Ok(0)
}

/// Prints help if requested, or the error of the command line. Its words come from the user or from file names, so they
/// are escaped.
fn usage(error: clap::Error, words: &[OsString]) -> ExitCode {
    if error.use_stderr() {
        // Parses again with escaped words, so that no word adds a line to the message.
        let safe = words.iter().map(|word| escape::line(&word.to_string_lossy()).into_owned());
        let error = Arguments::try_parse_from(safe).err().unwrap_or(error);
        let text = without_destructive_tips(error).render().to_string();
        let text = escape::lines(text.trim_end());
        let _ = writeln!(std::io::stderr().lock(), "{text}");
        output::print_error_as_json(&text, is_json(words));
        return ExitCode::from(output::USAGE);
    }
    output::ended(printed(Ok(error.render().to_string())), false)
}
