//! `urdd schema`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Subcommand};

use super::new_extension::{self, NewExtensionArguments};
use super::output;
use urdd_directory::schema_files::{self, SchemaFault};
use urdd_format::bundle;
use urdd_format::escape;
use urdd_format::registry::Profile;
use urdd_format::schema::{self, Subject, Variant};

/// Arguments of `urdd schema`.
#[derive(Args)]
pub struct SchemaArguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// List every schema: id, profile, conformance class, folder in a URDD.
    List,
    /// Print a schema.
    Show {
        /// Its id, such as `dof_module@1.0.0`.
        id: String,
        #[command(flatten)]
        open: Open,
    },
    /// Write every schema into a folder.
    Export {
        /// The folder; created if it does not exist.
        folder: PathBuf,
        #[command(flatten)]
        open: Open,
    },
    /// Print a single schema that covers a whole URDD of version 1, for code generators.
    Bundle {
        #[command(flatten)]
        open: Open,
    },
    /// Compare a folder of schemas with those that this program writes.
    Check {
        /// The folder.
        #[arg(default_value = "schema")]
        folder: PathBuf,
    },
    /// Write a module of your own with a schema, and add it to a URDD.
    NewExtension(NewExtensionArguments),
}

#[derive(Args)]
struct Open {
    /// Allow unknown keys, so that generated code can also read later minor versions.
    #[arg(long)]
    open: bool,
}

impl Open {
    fn variant(&self) -> Variant {
        if self.open { Variant::Open } else { Variant::Strict }
    }
}

/// Runs `urdd schema`.
pub fn run(arguments: &SchemaArguments) -> ExitCode {
    match &arguments.command {
        Command::List => print(&table()),
        Command::Show { id, open } => match Subject::find(id) {
            Ok(subject) => print(&subject.text(open.variant())),
            Err(error) => fail(&format!("{error}\nhelp: `urdd schema list` lists them all")),
        },
        Command::Bundle { open } => print(&format!("{:#}\n", bundle::bundle(open.variant()))),
        Command::Export { folder, open } => match schema_files::export(folder, open.variant()) {
            Ok(written) => print(&format!(
                "{}: {written} written, {} unchanged\n",
                folder.display(),
                schema::files(open.variant()).len() - written
            )),
            Err(error) => fail(&error.to_string()),
        },
        Command::Check { folder } => match schema_files::check(folder) {
            Ok(faults) if faults.is_empty() => {
                print("every schema matches what this program writes\n")
            }
            Ok(faults) => match output::print(&report(&faults, folder)) {
                Ok(()) => ExitCode::FAILURE,
                Err(error) => fail(&error),
            },
            Err(error) => fail(&error.to_string()),
        },
        Command::NewExtension(arguments) => match new_extension::run(arguments) {
            Ok(text) => print(&text),
            Err(error) => fail(&error),
        },
    }
}

fn table() -> String {
    let mut rows = vec![["id", "profile", "class", "folder"].map(str::to_owned)];
    rows.extend(Subject::all().map(|subject| {
        let (profile, class, folder) = match subject {
            Subject::Report
            | Subject::DiffReport
            | Subject::FirstDiffReport
            | Subject::ProducerResult
            | Subject::ValidatorResult => (Profile::V1, None, "-"),
            Subject::RootMetadata => (Profile::V1, None, "."),
            Subject::Module(spec) => (spec.profile, spec.kind.class(), spec.kind.folder()),
        };
        [
            subject.id(),
            profile.as_str().to_owned(),
            class.map_or_else(|| "-".to_owned(), |class| class.to_string()),
            folder.to_owned(),
        ]
    }));
    let widths = [0, 1, 2].map(|i| rows.iter().map(|row| row[i].len()).max().unwrap_or(0));
    let mut text = String::new();
    for [id, profile, class, folder] in &rows {
        let [a, b, c] = widths;
        text.push_str(&format!("{id:a$}  {profile:b$}  {class:c$}  {folder}\n"));
    }
    text
}

fn report(faults: &[SchemaFault], folder: &Path) -> String {
    let mut text = String::new();
    for fault in faults {
        text.push_str(&format!("{fault}\n"));
    }
    if faults.iter().any(SchemaFault::is_mended_by_export) {
        text.push_str(&format!(
            "repair: urdd schema export {}\n",
            escape::shell(&folder.display().to_string())
        ));
    }
    text
}

fn print(text: &str) -> ExitCode {
    output::printed(output::print(text))
}

fn fail(message: &str) -> ExitCode {
    output::printed(Err(message.to_owned()))
}
