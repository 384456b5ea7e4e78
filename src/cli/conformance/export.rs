//! `urdd conformance export`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use crate::cli::output::{self, Failure};
use crate::suite;
use urdd_conformance::catalogue::CATALOGUE;
use urdd_conformance::export::{Exported, export};

/// Arguments of `urdd conformance export`.
#[derive(Args)]
pub struct ExportArguments {
    /// Folder to write the suite into, new or empty: robots, URDDs, and suite.json with the expected results.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Runs `urdd conformance export`.
pub fn run(arguments: &ExportArguments) -> ExitCode {
    output::printed(exported(&arguments.folder))
}

fn exported(folder: &Path) -> Result<String, Failure> {
    Ok(told(&export(&suite::carried()?, folder)?))
}

fn told(exported: &Exported) -> String {
    let mut text = format!(
        "{} valid URDDs and {} cases; {CATALOGUE} lists them\n",
        exported.valid, exported.cases
    );
    for case in &exported.left_out {
        text += &format!("left out, since this operating system cannot store it: {case}\n");
    }
    for robot in &exported.other_bytes {
        text += &format!(
            "valid/{robot} is correct, but its bytes differ from those that the suite was checked with, due to the platform\n"
        );
    }
    text
}
