//! `urdd skips`.

use clap::Subcommand;

use super::inputs::{Edited, SrdfArguments, edited, left_out, some_read, with_srdf};
use super::output::{Failure, about, shown};
use urdd_export::{ImportedSkips, import_srdf};
use urdd_format::readable::counted;
use urdd_format::registry::ModuleKind;

/// The commands of `urdd skips`.
#[derive(Subcommand)]
pub enum SkipsCommand {
    /// Import the pairs of links in an SRDF as edits of a URDD.
    #[command(
        after_help = "Pairs that the URDD skips but the SRDF does not disable stay skipped. Lines without a link, or with one that the URDD \
        does not have, are named and left out. Existing edits stay; if the SRDF contradicts one, nothing is written unless --force is \
        given.\n\n\
        Exit status: 0 imported; 2 nothing was written."
    )]
    Import {
        #[command(flatten)]
        files: SrdfArguments,

        /// Replaces existing edits that the SRDF contradicts.
        #[arg(long)]
        force: bool,
    },
}

/// Runs `urdd skips`.
pub fn run(command: &SkipsCommand) -> Result<u8, Failure> {
    let SkipsCommand::Import { files, force } = command;
    with_srdf(files, |text| import(files, text, *force))
}

fn import(files: &SrdfArguments, text: &str, force: bool) -> Result<String, Failure> {
    let SrdfArguments { srdf, urdd, .. } = files;
    edited(urdd, ModuleKind::LinkShapesSkips, |robot| {
        let imported = import_srdf(robot, text, force).map_err(about(srdf))?;
        some_read(imported.added + imported.already, &imported.wrong).map_err(about(srdf))?;
        if imported.added == 0 {
            return Ok(Edited::unchanged(told(&shown(urdd), &imported, &[])));
        }
        let edited = robot.with_skip_edits(imported.edits.clone(), None);
        let edited = edited.map_err(about(urdd))?;
        let told = told(&shown(urdd), &imported, &edited.stale);
        Ok(Edited { files: edited.files, told })
    })
}

fn told(urdd: &str, imported: &ImportedSkips, stale: &[ModuleKind]) -> String {
    let mut told = format!(
        "{urdd}: {} added; {} of the SRDF unchanged\n",
        counted(imported.added, "edit"),
        counted(imported.already, "pair")
    );
    told += &left_out(&imported.wrong);
    if imported.unlisted > 0 {
        told += &format!(
            "  {} skipped that the SRDF does not disable\n",
            counted(imported.unlisted, "pair")
        );
    }
    if stale.contains(&ModuleKind::SelfCollisionModel) {
        told += "  the self-collision model was trained with the previous skips: `urdd generate` with `--modules all,self_collision_model` trains it again\n";
    }
    if stale.contains(&ModuleKind::LinkShapesSpheres) {
        told += "  what spheres say of collisions is by the previous skips: `urdd generate` with `--modules all,spheres` counts again\n";
    }
    told
}
