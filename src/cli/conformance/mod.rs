//! `urdd conformance`: `export` here, and a file for each of the other commands.

mod common;
mod producer;
mod validator;

use std::path::{Path, PathBuf};

use clap::Subcommand;

use super::output::{self, Failure};
use crate::suite;
use urdd_conformance::export::export;
use urdd_conformance::export::{CATALOGUE, CATALOGUE_1_1};

/// The commands of `urdd conformance`.
#[derive(Subcommand)]
pub enum ConformanceCommand {
    /// Write the suite into a folder.
    Export {
        /// Folder to write the suite into, new or empty: robots, URDDs, and suite-1.1.json with the expected results.
        #[arg(value_name = "DIR")]
        folder: PathBuf,
    },
    /// Run a producer on the suite's robots, and score the URDDs that it writes.
    Producer(producer::ProducerArguments),
    /// Run a validator on every case, and score its verdicts.
    Validator(validator::ValidatorArguments),
}

/// Runs `urdd conformance`.
pub fn run(command: &ConformanceCommand) -> Result<u8, Failure> {
    match command {
        ConformanceCommand::Export { folder } => exported(folder),
        ConformanceCommand::Producer(arguments) => producer::run(arguments),
        ConformanceCommand::Validator(arguments) => validator::run(arguments),
    }
}

fn exported(folder: &Path) -> Result<u8, Failure> {
    let exported = export(&suite::carried()?, folder)?;
    let (valid, cases) = (exported.valid, exported.cases);
    let mut text = format!(
        "{valid} valid URDDs and {cases} cases; {CATALOGUE_1_1} lists them, {CATALOGUE} those that can be read\n"
    );
    for case in &exported.left_out {
        text += &format!("left out, since this operating system cannot store it: {case}\n");
    }
    for robot in &exported.other_bytes {
        text += &format!(
            "valid/{robot} is correct, but its bytes differ from those that the suite was checked with, due to the platform\n"
        );
    }
    output::print(&text)?;
    Ok(0)
}
