//! `urdd configurations`.

use std::path::{Path, PathBuf};

use clap::Subcommand;

use super::inputs::{self, Edited, SrdfArguments, edited, left_out, some_read};
use super::output::{self, Failure, about, shown};
use urdd_export::import_states;
use urdd_format::escape;
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_format::nearest::nearest;
use urdd_format::readable::counted;
use urdd_format::registry::ModuleKind;
use urdd_robot::Robot;

/// The commands of `urdd configurations`.
#[derive(Subcommand)]
pub enum ConfigurationsCommand {
    /// List the named configurations of a URDD, with the positions that were set.
    List {
        /// The URDD: a folder or a zip archive.
        #[arg(value_name = "URDD")]
        urdd: PathBuf,
    },
    /// Add a named configuration to a URDD, or replace one.
    #[command(
        after_help = "A DOF that is not given has its value in the default configuration: 0, or the bound nearest to 0.\n\n\
        Exit status: 0 set; 2 nothing was written."
    )]
    Set {
        /// The URDD: a folder.
        #[arg(value_name = "DIR")]
        urdd: PathBuf,

        /// The name of the configuration.
        #[arg(value_name = "NAME")]
        name: String,

        /// Positions, rad or m: `elbow=1.57`. A DOF is named as its joint; those of planar, floating and spherical joints
        /// as `urdd info` lists them.
        #[arg(value_name = "DOF=POSITION", allow_hyphen_values = true)]
        positions: Vec<String>,
    },
    /// Import the group states of an SRDF as named configurations of a URDD.
    #[command(
        after_help = "States of several groups with one name become one configuration. Positions of joints that the URDD \
        does not have, and what is wrong otherwise, are named and left out.\n\n\
        Exit status: 0 imported; 2 nothing was written."
    )]
    Import {
        #[command(flatten)]
        files: SrdfArguments,

        /// Replaces configurations of the same name that differ.
        #[arg(long)]
        force: bool,
    },
    /// Remove a named configuration from a URDD.
    #[command(after_help = "Exit status: 0 removed; 2 nothing was written.")]
    Remove {
        /// The URDD: a folder.
        #[arg(value_name = "DIR")]
        urdd: PathBuf,

        /// The name of the configuration.
        #[arg(value_name = "NAME")]
        name: String,
    },
}

/// Runs `urdd configurations`.
pub fn run(command: &ConfigurationsCommand) -> Result<u8, Failure> {
    let text = match command {
        ConfigurationsCommand::List { urdd } => list(urdd),
        ConfigurationsCommand::Set { urdd, name, positions } => set(urdd, name, positions),
        ConfigurationsCommand::Import { files, force } => {
            return inputs::with_srdf(files, |text| import(files, text, *force));
        }
        ConfigurationsCommand::Remove { urdd, name } => remove(urdd, name),
    };
    output::print(&text?)?;
    Ok(0)
}

fn list(urdd: &Path) -> Result<String, Failure> {
    let robot = inputs::open(urdd)?;
    // A folder that is no URDD has none either: say that.
    robot.dof_names().map_err(about(urdd))?;
    let named = robot.named_configurations().map_err(about(urdd))?;
    if named.is_empty() {
        return Ok(format!("{}: no named configurations\n", shown(urdd)));
    }
    let lines = named.iter().map(|named| {
        let positions = named.positions.iter();
        let positions = positions.map(|set| format!(" {}={}", set.dof_name, set.position));
        let line = format!("{}:{}", named.name, positions.collect::<String>());
        format!("{}\n", escape::line(&line))
    });
    Ok(lines.collect())
}

fn set(urdd: &Path, name: &str, positions: &[String]) -> Result<String, Failure> {
    let name = ConfigurationName::new(name).ok_or("the name of a configuration is empty")?;
    let edit = ConfigurationEdit { positions: parsed(positions)?, name };
    change(urdd, |edits| match edits.iter_mut().find(|other| other.name == edit.name) {
        Some(there) => {
            *there = edit.clone();
            Ok("replaced")
        }
        None => {
            edits.push(edit.clone());
            Ok("added")
        }
    })
}

fn remove(urdd: &Path, name: &str) -> Result<String, Failure> {
    change(urdd, |edits| {
        let place = edits.iter().position(|edit| edit.name.as_str() == name);
        let Some(place) = place else {
            let near = nearest(edits.iter().map(|edit| edit.name.as_str()), name);
            let near = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
            return Err(format!("there is no configuration `{name}`{near}"));
        };
        edits.remove(place);
        Ok("removed")
    })
}

fn import(files: &SrdfArguments, text: &str, force: bool) -> Result<String, Failure> {
    let SrdfArguments { srdf, urdd, .. } = files;
    edited(urdd, ModuleKind::NamedConfigurations, |robot: &Robot| {
        let imported = import_states(robot, text, force).map_err(about(srdf))?;
        let read = imported.changed + imported.already + imported.out_of_bounds.len();
        some_read(read + imported.left_out, &imported.wrong).map_err(about(srdf))?;
        let mut told = format!(
            "{}: {} imported; {} of the SRDF unchanged\n",
            shown(urdd),
            counted(imported.changed, "configuration"),
            imported.already
        );
        told += &left_out(&imported.wrong);
        if imported.left_out > 0 {
            let positions = counted(imported.left_out, "position");
            told += &format!(
                "  {positions} left out: of joints with no DOF of their own, or with several\n"
            );
        }
        for [state, joint] in &imported.out_of_bounds {
            told += &format!("  `{state}` left out: `{joint}` is out of its bounds there\n");
        }
        let told = escape::lines(&told).into_owned();
        if imported.changed == 0 {
            return Ok(Edited::unchanged(told));
        }
        let edited = robot.with_named_configurations(&imported.configurations);
        Ok(Edited { files: edited.map_err(about(urdd))?.files, told })
    })
}

/// Changes the named configurations. `change` returns what it did.
fn change(
    urdd: &Path,
    change: impl Fn(&mut Vec<ConfigurationEdit>) -> Result<&'static str, String>,
) -> Result<String, Failure> {
    edited(urdd, ModuleKind::NamedConfigurations, |robot: &Robot| {
        let named = robot.named_configurations().map_err(about(urdd))?;
        let mut edits: Vec<ConfigurationEdit> = named.iter().map(Into::into).collect();
        let done = change(&mut edits).map_err(about(urdd))?;
        let edited = robot.with_named_configurations(&edits).map_err(about(urdd))?;
        let count = counted(edits.len(), "named configuration");
        Ok(Edited { files: edited.files, told: format!("{}: {done}; {count}\n", shown(urdd)) })
    })
}

/// Positions as given on the command line.
fn parsed(words: &[String]) -> Result<Vec<DofPosition>, String> {
    let mut positions: Vec<DofPosition> = Vec::new();
    for word in words {
        let (name, value) = word
            .rsplit_once('=')
            .ok_or_else(|| format!("`{}` is not DOF=POSITION: elbow=1.57", escape::line(word)))?;
        let number = value.parse::<f64>().ok().filter(|value| value.is_finite());
        let position = number.ok_or_else(|| {
            format!("`{}`: `{}` is not a number, rad or m", escape::line(word), escape::line(value))
        })?;
        if positions.iter().any(|before| before.dof_name == name) {
            return Err(format!("the DOF `{}` is given twice", escape::line(name)));
        }
        positions.push(DofPosition { dof_name: name.to_owned(), position });
    }
    Ok(positions)
}
