//! `urdd schema`.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use super::output::{self, Failure, one_line, shown};
use urdd_directory::canonical;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::metadata::{add_module, write_folder};
use urdd_directory::root::Root;
use urdd_directory::schema_files::{self, SchemaFault};
use urdd_document::module::is_extension;
use urdd_document::urdd::Urdd;
use urdd_format::bundle;
use urdd_format::escape;
use urdd_format::new_extension::{VERSION, new_extension};
use urdd_format::registry::{ModuleKind, Profile};
use urdd_format::schema::{self, Subject, Variant};

/// The commands of `urdd schema`.
#[derive(Subcommand)]
pub enum SchemaCommand {
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
pub struct Open {
    /// Allow unknown keys, so that generated code can also read later minor versions.
    #[arg(long)]
    open: bool,
}

impl Open {
    fn variant(&self) -> Variant {
        if self.open { Variant::Open } else { Variant::Strict }
    }
}

pub fn run(command: &SchemaCommand) -> Result<u8, Failure> {
    let mut status = 0;
    let text = match command {
        SchemaCommand::List => table(),
        SchemaCommand::Show { id, open } => {
            let help = |error| format!("{error}\nhelp: `urdd schema list` lists them all");
            Subject::find(id).map_err(help)?.text(open.variant())
        }
        SchemaCommand::Bundle { open } => format!("{:#}\n", bundle::bundle(open.variant())),
        SchemaCommand::Export { folder, open } => {
            let written = schema_files::export(folder, open.variant())?;
            let unchanged = schema::files(open.variant()).len() - written;
            format!("{}: {written} written, {unchanged} unchanged\n", folder.display())
        }
        SchemaCommand::Check { folder } => {
            let faults = schema_files::check(folder)?;
            status = u8::from(!faults.is_empty());
            report(&faults, folder)
        }
        SchemaCommand::NewExtension(arguments) => begin_extension(arguments)?,
    };
    output::print(&text)?;
    Ok(status)
}

fn table() -> String {
    let mut rows = vec![["id", "profile", "class", "folder"].map(str::to_owned)];
    rows.extend(Subject::all().map(|subject| {
        let (profile, class, folder) = match subject {
            Subject::RootMetadata => (Profile::V1, None, "."),
            Subject::Module(spec) => (spec.profile, spec.kind.class(), spec.kind.folder()),
            // Reports and results of the conformance suite.
            _ => (Profile::V1, None, "-"),
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

/// Arguments of `urdd schema new-extension`.
#[derive(Args)]
pub struct NewExtensionArguments {
    /// Vendor and name, such as `acme_gripper`: lower-case letters, digits and `_`.
    name: String,
    /// A URDD, to which the extension is added, or any other folder, into which it is written.
    #[arg(default_value = ".")]
    folder: PathBuf,
}

/// Writes the extension; returns what to print.
fn begin_extension(arguments: &NewExtensionArguments) -> Result<String, Failure> {
    let name = &arguments.name;
    let module = format!("x_{name}_module");
    if !is_extension(&module) || name.starts_with("x_") || name.ends_with("_module") {
        Err(format!(
            "`{}` is not a name of an extension: write your name, `_`, and what it is about, in lower-case letters, digits and `_`, such as acme_gripper; `x_` and `_module` are added",
            escape::line(name)
        ))?;
    }
    let parent = &arguments.folder;
    if !parent.is_dir() {
        let parent = shown(parent);
        Err(format!("{parent} is not a folder: name a URDD, or a folder to write into"))?;
    }
    if parent.join(ROOT_METADATA).exists() {
        return add_extension(parent, &module);
    }
    let files = extension_files(&module, None);
    let folder = write_folder(parent, &module, &files).map_err(one_line)?;
    Ok(format!(
        "wrote {}\nnext: say in schema.json what it is about; put the folder into a URDD, and list it in its {ROOT_METADATA}\n",
        shown(&folder)
    ))
}

fn add_extension(parent: &Path, module: &str) -> Result<String, Failure> {
    let urdd = Urdd::read(parent).map_err(one_line)?;
    let joints = urdd.robot().map(|robot| robot.joints.len());
    let root = Root::open(parent).map_err(one_line)?;
    let files = extension_files(module, joints);
    let folder = add_module(&root, module, VERSION, &[ModuleKind::Urdf], &files);
    let folder = shown(&folder.map_err(one_line)?);
    let parent = escape::shell(&parent.display().to_string());
    Ok(format!(
        "wrote {folder}, and listed it in {ROOT_METADATA}\nnext: say in schema.json what it is about, write module.json and module.yaml; then `urdd rehash {parent}` and `urdd validate {parent}`\n"
    ))
}

fn extension_files(module: &str, joints: Option<usize>) -> [(&'static str, String); 4] {
    let made = new_extension(module, joints);
    let mut yaml = String::new();
    // Writing to a String cannot fail.
    let _ = canonical::yaml(&made.document, &mut yaml);
    [
        ("VERSION", format!("{VERSION}\n")),
        ("module.json", canonical::json_string(&made.document)),
        ("module.yaml", yaml),
        ("schema.json", canonical::json_string(&made.schema)),
    ]
}
