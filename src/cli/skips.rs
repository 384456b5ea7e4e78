//! `urdd skips`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Subcommand};

use super::{output, shapes};
use crate::directory::regular;
use crate::directory::replacement::Replacement;
use crate::export::import_srdf;
use crate::format::escape;

/// Largest SRDF that is read, bytes.
const MAX_SRDF_BYTES: u64 = 16 << 20;

/// Arguments of `urdd skips`.
#[derive(Args)]
pub struct SkipsArguments {
    #[command(subcommand)]
    command: SkipsCommand,
}

#[derive(Subcommand)]
enum SkipsCommand {
    /// Read the pairs of links of an SRDF into the edits of a URDD.
    #[command(
        after_help = "Pairs that the URDD skips and the SRDF does not stay skipped. Edits that are there stay; where the SRDF says the \
        contrary of one, nothing is written unless --force lets the SRDF decide.\n\n\
        Exit status: 0 read; 2 nothing was written."
    )]
    Import {
        /// The SRDF.
        #[arg(value_name = "FILE.srdf")]
        srdf: PathBuf,

        /// The URDD: a folder.
        #[arg(value_name = "DIR")]
        urdd: PathBuf,

        /// Lets the SRDF decide where it says the contrary of an edit that is there.
        #[arg(long)]
        force: bool,
    },
}

/// Runs `urdd skips`.
pub fn run(arguments: &SkipsArguments) -> ExitCode {
    let SkipsCommand::Import { srdf, urdd, force } = &arguments.command;
    super::printed(import(srdf, urdd, *force).and_then(|text| output::print(&text)))
}

fn import(srdf: &Path, urdd: &Path, force: bool) -> Result<String, String> {
    let shown = |path: &Path| escape::line(&path.display().to_string()).into_owned();
    let of_srdf = |error: &dyn std::fmt::Display| format!("{}: {error}", shown(srdf));
    let of_urdd = |error: &dyn std::fmt::Display| format!("{}: {error}", shown(urdd));
    let bytes = regular::read(srdf, MAX_SRDF_BYTES).map_err(|error| of_srdf(&error))?;
    let text = String::from_utf8(bytes).map_err(|_| of_srdf(&"it is not UTF-8"))?;
    if !urdd.is_dir() {
        return Err(of_urdd(
            &"this is no folder; edits are written into the folder of a URDD",
        ));
    }
    let replacement = Replacement::begin(urdd).map_err(|error| error.to_string())?;
    let robot = shapes::open(urdd)?;
    let imported = import_srdf(&robot, &text, force).map_err(|error| of_srdf(&error))?;
    let mut model_is_stale = false;
    if imported.added > 0 {
        let edited = robot.with_skip_edits(imported.edits, None);
        let edited = edited.map_err(|error| of_urdd(&error))?;
        model_is_stale = edited.model_is_stale;
        replacement
            .stage(&edited.files)
            .map_err(|error| error.to_string())?;
        replacement.commit().map_err(|error| error.to_string())?;
    }
    let count = |number: usize, what: &str| match number {
        1 => format!("1 {what}"),
        _ => format!("{number} {what}s"),
    };
    let mut told = format!(
        "{}: {} added; {} of the SRDF as they were\n",
        shown(urdd),
        count(imported.added, "edit"),
        count(imported.already, "pair")
    );
    if imported.unlisted > 0 {
        told += &format!(
            "  {} skipped that the SRDF does not disable\n",
            count(imported.unlisted, "pair")
        );
    }
    if model_is_stale {
        told += "  the self-collision model was trained with the skips before: `urdd generate` with `--modules all,self_collision_model` makes another\n";
    }
    Ok(told)
}
