//! `urdd rehash`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::output::{self, Failure, one_line};
use super::watch::Watch;
use urdd_directory::discover::{Found, discover};
use urdd_directory::metadata::rehash;
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

/// Runs `urdd rehash`. Returns the exit status.
pub fn run(arguments: &RehashArguments, watch: &Watch) -> Result<u8, Failure> {
    let first = arguments.paths.first().map_or(Path::new(""), PathBuf::as_path);
    watch.run_one(first, None, |_| Ok(rehashed(arguments)))
}

fn rehashed(arguments: &RehashArguments) -> u8 {
    let mut worst = 0;
    for path in &arguments.paths {
        match discover(path) {
            Ok(found) => found.iter().for_each(|urdd| worst = worst.max(update(urdd))),
            Err(error) => {
                output::error(&one_line(error));
                worst = FAILED;
            }
        }
    }
    worst
}

/// Updates the hashes of a URDD. Returns the exit status.
fn update(urdd: &Found) -> u8 {
    let root = urdd.closed.clone().map_or_else(|| Root::open(&urdd.path), Err);
    let changed = root.map_err(one_line).and_then(|root| rehash(&root).map_err(one_line));
    let name = escape::line(&urdd.name);
    let changed = match changed {
        Ok(changed) => changed,
        Err(error) => {
            output::error(&format!("{name}: {error}"));
            return FAILED;
        }
    };
    let done = if changed.is_empty() { "up to date" } else { "updated" };
    let paths = changed.iter().map(|path| format!("  {}\n", escape::line(path)));
    let text = format!("{name}: {done}\n{}", paths.collect::<String>());
    let printed = output::print(&text).inspect_err(|error| output::error(error));
    let is_broken = report_broken(urdd);
    match printed {
        Err(_) => FAILED,
        Ok(()) if is_broken => BROKEN,
        Ok(()) => 0,
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
