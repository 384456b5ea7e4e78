//! `urdd rehash`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::output;
use urdd_directory::discover::{Found, discover};
use urdd_directory::rehash::rehash;
use urdd_directory::root::Root;
use urdd_document::module::Module;
use urdd_document::urdd::Urdd;
use urdd_format::escape;

/// Exit status: the hashes are up to date, but a document is broken.
const BROKEN: u8 = 1;
/// Exit status: hashes could not be updated.
const FAILED: u8 = 2;

/// Arguments of `urdd rehash`.
#[derive(Args)]
#[command(
    after_help = "Exit status: 0 up to date; 1 up to date, but the document of a module is broken; 2 could not be updated."
)]
pub struct RehashArguments {
    /// URDDs of version 1, or folders with URDDs at any depth.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
}

/// Runs `urdd rehash`.
pub fn run(arguments: &RehashArguments) -> ExitCode {
    let (mut failed, mut broken) = (false, false);
    for path in &arguments.paths {
        let found = match discover(path) {
            Ok(found) => found,
            Err(error) => {
                output::error(&escape::line(&error.to_string()));
                failed = true;
                continue;
            }
        };
        for urdd in found {
            let changed = urdd
                .closed
                .clone()
                .map_or_else(|| Root::open(&urdd.path), Err)
                .map_err(|error| error.to_string())
                .and_then(|root| rehash(&root).map_err(|error| error.to_string()));
            let name = escape::line(&urdd.name);
            let mut text = String::new();
            match changed {
                Ok(changed) => {
                    text += &match changed.is_empty() {
                        true => format!("{name}: up to date\n"),
                        false => format!("{name}: updated\n"),
                    };
                    for path in changed {
                        text += &format!("  {}\n", escape::line(&path));
                    }
                }
                Err(error) => {
                    output::error(&format!("{name}: {}", escape::line(&error)));
                    failed = true;
                }
            }
            let is_up_to_date = !text.is_empty();
            if let Err(error) = output::print(&text) {
                output::error(&error);
                failed = true;
            }
            broken |= is_up_to_date && report_broken(&urdd);
        }
    }
    match (failed, broken) {
        (true, _) => ExitCode::from(FAILED),
        (false, true) => ExitCode::from(BROKEN),
        (false, false) => ExitCode::SUCCESS,
    }
}

/// Reports documents that are unusable although their hashes are now correct.
fn report_broken(found: &Found) -> bool {
    let Ok(urdd) = Urdd::read(&found.path) else {
        return false;
    };
    let faults: Vec<String> = urdd.modules().filter_map(Module::first_fault).collect();
    for fault in &faults {
        output::error(&format!(
            "{}/{}; fix it, and run `urdd rehash` again",
            found.name,
            escape::line(fault)
        ));
    }
    !faults.is_empty()
}
