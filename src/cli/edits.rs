//! `urdd skips`, `urdd spheres` and `urdd configurations`: edits of a URDD.

use std::path::{Path, PathBuf};

use clap::Subcommand;

use super::arguments::around;
use super::inputs::{self, Edited, SrdfArguments, edited, left_out, some_read, text, with_srdf};
use super::output::{self, Failure, about, one_line, shown};
use super::watch::Watch;
use urdd_directory::account::Account;
use urdd_directory::limits::MAX_SPHERES_BYTES;
use urdd_export::{
    ImportedSkips, ImportedSpheres, Sphere, SphereList, Unnamed, import_spheres, import_srdf,
    import_states, read_spheres,
};
use urdd_format::escape;
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_format::nearest::nearest;
use urdd_format::readable::{counted, first_of};
use urdd_format::registry::ModuleKind;
use urdd_format::self_collision_model::LinkPair;
use urdd_format::short::Short;
use urdd_format::urdf::Geometry;
use urdd_robot::Robot;
use urdd_source::{RobotFile, Settings};

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

pub fn skips(command: &SkipsCommand, watch: &Watch) -> Result<u8, Failure> {
    let SkipsCommand::Import { files, force } = command;
    with_srdf(files, watch, |text| import_skips(files, text, *force))
}

fn import_skips(files: &SrdfArguments, text: &str, force: bool) -> Result<String, Failure> {
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

/// Maximum number of pairs that a message names.
const MOST_NAMED: usize = 6;

/// The commands of `urdd spheres`.
#[derive(Subcommand)]
pub enum SpheresCommand {
    /// Import a list of spheres into a URDD: cuRobo's YAML, Foam's JSON, or a URDF with spheres.
    #[command(
        after_help = "The list becomes the last level of link_shapes_spheres_module, in place of fitted spheres; levels that cover the links are \
        made around it. How well it fits, and how often it is right, is measured. `urdd generate` with `--modules all,link_shapes_spheres` \
        keeps it.\n\n\
        Links that the list does not name keep the spheres that they have, unless --alone is given; both are said.\n\n\
        Of a URDF, spheres are the spheres of its collision elements. Spheres of links that the robot does not have, or that have no shape, \
        are named and left out.\n\n\
        Exit status: 0 imported; 2 nothing was written."
    )]
    Import {
        /// The list.
        #[arg(value_name = "LIST")]
        list: PathBuf,

        /// The URDD: a folder.
        #[arg(value_name = "DIR")]
        urdd: PathBuf,

        /// Links that the list does not name get no spheres; by default they keep those that they have.
        #[arg(long)]
        alone: bool,
    },
}

pub fn spheres(command: &SpheresCommand, watch: &Watch) -> Result<u8, Failure> {
    let SpheresCommand::Import { list, urdd, alone } = command;
    let unnamed = if *alone { Unnamed::Clear } else { Unnamed::Keep };
    watch.run_one(urdd, None, |cancellation| {
        let account = Account::new(cancellation);
        let spheres = spheres_of(list, &account)?;
        let told = edited(urdd, ModuleKind::LinkShapesSpheres, |robot| {
            let imported =
                import_spheres(robot, &spheres, unnamed, &account).map_err(about(list))?;
            let last = imported.module.levels.last();
            let mut told =
                format!("{}: {} imported\n", shown(urdd), counted(imported.taken, "sphere"));
            let names = robot.link_names().map_err(about(urdd))?;
            told += &unnamed_links(&imported, names);
            if let Some(level) = last {
                let of = &level.evaluation;
                told += &format!(
                    "  in {} sampled configurations: missed collisions {}; false contacts {}\n",
                    imported.module.num_samples,
                    of.miss_rate(),
                    of.false_contact_rate()
                );
                told += &always(&level.always_pairs, names);
            }
            told += &left_out(&imported.left_out);
            Ok(Edited { files: imported.files, told })
        })?;
        output::print(&told)?;
        Ok(0)
    })
}

/// What became of the links that the list does not name; empty without one.
fn unnamed_links(imported: &ImportedSpheres, links: &[String]) -> String {
    let listed = |all: &[usize]| {
        let name =
            |link: &usize| format!("`{}`", one_line(links.get(*link).map_or("", String::as_str)));
        first_of(all.iter().map(name), MOST_NAMED)
    };
    let mut told = String::new();
    if !imported.kept.is_empty() {
        told += &format!(
            "  not in the list, so they keep their spheres (--alone removes them): {}\n",
            listed(&imported.kept)
        );
    }
    if !imported.bare.is_empty() {
        told += &format!(
            "  without spheres, so that a check by this list calls all that touches them free: {}\n",
            listed(&imported.bare)
        );
    }
    told
}

/// What pairs of links that touch in every configuration mean, and what to do; empty without one.
fn always(pairs: &[LinkPair], links: &[String]) -> String {
    if pairs.is_empty() {
        return String::new();
    }
    let name = |link: usize| one_line(links.get(link).map_or("", String::as_str));
    let names = pairs.iter().map(|LinkPair { link_a_idx, link_b_idx }| {
        format!("`{}` with `{}`", name(link_a_idx.get()), name(link_b_idx.get()))
    });
    format!(
        "  in every configuration these links touch, so that a check by this list always says that the robot collides: {}\n  \
         if they need no check, disable them by `urdd skips import` of an SRDF, and import the list again\n",
        first_of(names, MOST_NAMED)
    )
}

fn spheres_of(file: &Path, account: &Account) -> Result<SphereList, Failure> {
    if matches!(RobotFile::at(file), Some(RobotFile::Urdf | RobotFile::Xacro)) {
        return of_urdf(file, account);
    }
    let text = text(file, MAX_SPHERES_BYTES)?;
    account.deposit(text.len());
    Ok(read_spheres(&text, account).map_err(about(file))?)
}

fn of_urdf(file: &Path, account: &Account) -> Result<SphereList, Failure> {
    let settings = Settings { cancellation: account.cancellation().clone(), ..around() };
    let source = urdd_source::load(file, &settings).map_err(one_line)?;
    account.deposit(source.carried.len());
    let mut list = SphereList::default();
    for link in &source.reading.robot.links {
        let mut spheres = Vec::new();
        for element in &link.collision {
            match &element.geometry {
                Some(Geometry::Sphere(sphere)) => spheres.push(Sphere {
                    centre: element.origin.as_ref().and_then(|of| of.xyz).unwrap_or_default(),
                    radius: sphere.radius,
                }),
                _ => list.left_out.push(format!(
                    "link `{}` has a collision element that is no sphere",
                    Short::of(&link.name).escape_debug()
                )),
            }
        }
        if !spheres.is_empty() {
            list.links.push((link.name.clone(), spheres));
        }
    }
    if list.links.is_empty() {
        Err(about(file)("none of its collision elements is a sphere"))?;
    }
    Ok(list)
}

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

pub fn configurations(command: &ConfigurationsCommand, watch: &Watch) -> Result<u8, Failure> {
    let edit = |urdd: &Path, text: &dyn Fn() -> Result<String, Failure>| {
        watch.run_one(urdd, None, |_| {
            output::print(&text()?)?;
            Ok(0)
        })
    };
    match command {
        ConfigurationsCommand::List { urdd } => edit(urdd, &|| list(urdd)),
        ConfigurationsCommand::Set { urdd, name, positions } => {
            edit(urdd, &|| set(urdd, name, positions))
        }
        ConfigurationsCommand::Import { files, force } => {
            with_srdf(files, watch, |text| import_configurations(files, text, *force))
        }
        ConfigurationsCommand::Remove { urdd, name } => edit(urdd, &|| remove(urdd, name)),
    }
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

fn import_configurations(
    files: &SrdfArguments,
    text: &str,
    force: bool,
) -> Result<String, Failure> {
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
