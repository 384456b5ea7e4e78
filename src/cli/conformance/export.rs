//! `urdd conformance export`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use crate::cli::output;
use crate::conformance::catalogue::CATALOGUE;
use crate::conformance::export::{Exported, export};

/// Arguments of `urdd conformance export`.
#[derive(Args)]
pub struct ExportArguments {
    /// The folder that gets the suite: robots, URDDs, and suite.json, which lists what is expected of each. New or empty.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Runs `urdd conformance export`.
pub fn run(arguments: &ExportArguments) -> ExitCode {
    let exported = export(&arguments.folder).map_err(|error| error.to_string());
    output::printed(exported.and_then(|exported| output::print(&told(&exported))))
}

fn told(exported: &Exported) -> String {
    let mut text = format!(
        "{} valid URDDs and {} cases; {CATALOGUE} lists them\n",
        exported.valid, exported.cases
    );
    for case in &exported.left_out {
        text += &format!("left out, since this operating system cannot have it: {case}\n");
    }
    for robot in &exported.other_bytes {
        text += &format!(
            "valid/{robot} is right, but not byte for byte what the suite was checked with: another platform\n"
        );
    }
    text
}
