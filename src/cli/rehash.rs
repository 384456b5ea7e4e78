//! `urdd rehash`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::output;
use crate::directory::discover::discover;
use crate::directory::rehash::rehash;
use crate::directory::root::Root;
use crate::format::escape;

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
                output::error(&escape::line(&error.to_string()));
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
            let name = escape::line(&urdd.name);
            let mut text = String::new();
            match changed {
                Ok(changed) if changed.is_empty() => text += &format!("{name}: up to date\n"),
                Ok(changed) => {
                    text += &format!("{name}: brought up to date\n");
                    for path in changed {
                        text += &format!("  {}\n", escape::line(&path));
                    }
                }
                Err(error) => {
                    output::error(&format!("{name}: {}", escape::line(&error)));
                    failed = true;
                }
            }
            if let Err(error) = output::print(&text) {
                output::error(&error);
                failed = true;
            }
        }
    }
    if failed {
        ExitCode::from(2)
    } else {
        ExitCode::SUCCESS
    }
}
