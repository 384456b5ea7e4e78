//! `urdd schema new-extension`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::output::{Failure, one_line, shown};
use urdd_directory::canonical;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::metadata::{add_module, write_folder};
use urdd_directory::root::Root;
use urdd_document::module::is_extension;
use urdd_document::urdd::Urdd;
use urdd_format::escape;
use urdd_format::new_extension::{VERSION, new_extension};
use urdd_format::registry::ModuleKind;

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
///
/// # Errors
/// A message with advice, if the name is not allowed or taken, or something cannot be read or written.
pub fn run(arguments: &NewExtensionArguments) -> Result<String, Failure> {
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
        return add(parent, &module);
    }
    let folder = write_folder(parent, &module, &files(&module, None)).map_err(one_line)?;
    Ok(format!(
        "wrote {}\nnext: say in schema.json what it is about; put the folder into a URDD, and list it in its {ROOT_METADATA}\n",
        shown(&folder)
    ))
}

/// Adds it to a URDD.
fn add(parent: &Path, module: &str) -> Result<String, Failure> {
    let urdd = Urdd::read(parent).map_err(one_line)?;
    let joints = urdd.robot().map(|robot| robot.joints.len());
    let root = Root::open(parent).map_err(one_line)?;
    let files = files(module, joints);
    let folder = add_module(&root, module, VERSION, &[ModuleKind::Urdf], &files);
    let folder = shown(&folder.map_err(one_line)?);
    let parent = escape::shell(&parent.display().to_string());
    Ok(format!(
        "wrote {folder}, and listed it in {ROOT_METADATA}\nnext: say in schema.json what it is about, write module.json and module.yaml; then `urdd rehash {parent}` and `urdd validate {parent}`\n"
    ))
}

/// The files of the module.
fn files(module: &str, joints: Option<usize>) -> [(&'static str, String); 4] {
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
