//! `urdd schema`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Subcommand};

use super::new_extension::{self, NewExtensionArguments};
use super::output::{self, Failure};
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
    output::ended(schema(&arguments.command))
}

fn schema(command: &Command) -> Result<u8, Failure> {
    let mut status = 0;
    let text = match command {
        Command::List => table(),
        Command::Show { id, open } => {
            let help = |error| format!("{error}\nhelp: `urdd schema list` lists them all");
            Subject::find(id).map_err(help)?.text(open.variant())
        }
        Command::Bundle { open } => format!("{:#}\n", bundle::bundle(open.variant())),
        Command::Export { folder, open } => {
            let written = schema_files::export(folder, open.variant())?;
            let unchanged = schema::files(open.variant()).len() - written;
            format!("{}: {written} written, {unchanged} unchanged\n", folder.display())
        }
        Command::Check { folder } => {
            let faults = schema_files::check(folder)?;
            status = u8::from(!faults.is_empty());
            report(&faults, folder)
        }
        Command::NewExtension(arguments) => new_extension::run(arguments)?,
    };
    output::print(&text)?;
    Ok(status)
}

fn table() -> String {
    let mut rows = vec![["id", "profile", "class", "folder"].map(str::to_owned)];
    rows.extend(Subject::all().map(|subject| {
        let (profile, class, folder) = match subject {
            Subject::FirstReport
            | Subject::Report
            | Subject::DiffReport
            | Subject::FirstDiffReport
            | Subject::SecondDiffReport
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
    if faults.is_empty() {
        return "every schema matches what this program writes\n".to_owned();
    }
    let mut text: String = faults.iter().map(|fault| format!("{fault}\n")).collect();
    if faults.iter().any(SchemaFault::is_mended_by_export) {
        text.push_str(&format!(
            "repair: urdd schema export {}\n",
            escape::shell(&folder.display().to_string())
        ));
    }
    text
}
