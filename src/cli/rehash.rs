//! `urdd rehash`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::output;
use crate::directory::discover::discover;
use crate::directory::rehash::rehash;
use crate::directory::root::Root;

/// Arguments of `urdd rehash`.
#[derive(Args)]
pub struct RehashArguments {
    /// URDDs of version 1, or folders with URDDs at any depth.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
}

/// Runs `urdd rehash`.
pub fn run(arguments: &RehashArguments) -> ExitCode {
    let mut failed = false;
    for path in &arguments.paths {
        let found = match discover(path) {
            Ok(found) => found,
            Err(error) => {
                output::error(&error.to_string());
                failed = true;
                continue;
            }
        };
        for urdd in found {
            let changed = urdd
                .closed
                .map_or_else(|| Root::open(&urdd.path), Err)
                .map_err(|error| error.to_string())
                .and_then(|root| rehash(&root).map_err(|error| error.to_string()));
            match changed {
                Ok(changed) if changed.is_empty() => {
                    output::print(&format!("{}: up to date\n", urdd.name))
                }
                Ok(changed) => {
                    let list: String = changed.iter().map(|path| format!("  {path}\n")).collect();
                    output::print(&format!("{}: brought up to date\n{list}", urdd.name));
                }
                Err(error) => {
                    output::error(&format!("{}: {error}", urdd.name));
                    failed = true;
                }
            }
        }
    }
    if failed {
        ExitCode::from(2)
    } else {
        ExitCode::SUCCESS
    }
}
