//! `urdd spheres`.

use std::path::{Path, PathBuf};

use clap::Subcommand;

use super::inputs::{Edited, edited, left_out, text};
use super::output::{self, Failure, about, one_line, shown};
use super::signals;
use super::sources::around;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::limits::MAX_SPHERES_BYTES;
use urdd_export::{Sphere, SphereList, import_spheres, read_spheres};
use urdd_format::readable::{counted, first_of};
use urdd_format::registry::ModuleKind;
use urdd_format::self_collision_model::LinkPair;
use urdd_format::urdf::Geometry;
use urdd_source::RobotFile;

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
    },
}

/// Runs `urdd spheres`.
pub fn run(command: &SpheresCommand) -> Result<u8, Failure> {
    let SpheresCommand::Import { list, urdd } = command;
    signals::run(None, |signals| {
        let cancellation = signals.cancellation();
        let spheres = read(list, &cancellation)?;
        let told = edited(urdd, ModuleKind::LinkShapesSpheres, |robot| {
            let imported = import_spheres(robot, &spheres, &cancellation).map_err(about(list))?;
            let last = imported.module.levels.last();
            let mut told =
                format!("{}: {} imported\n", shown(urdd), counted(imported.taken, "sphere"));
            if let Some(level) = last {
                let of = &level.evaluation;
                told += &format!(
                    "  in {} sampled configurations: missed collisions {}; false contacts {}\n",
                    imported.module.num_samples,
                    of.miss_rate(),
                    of.false_contact_rate()
                );
                told += &always(&level.always_pairs, robot.link_names().map_err(about(urdd))?);
            }
            told += &left_out(&imported.left_out);
            Ok(Edited { files: imported.files, told })
        })?;
        output::print(&told)?;
        Ok(0)
    })
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

fn read(file: &Path, cancellation: &Cancellation) -> Result<SphereList, Failure> {
    if matches!(RobotFile::at(file), Some(RobotFile::Urdf | RobotFile::Xacro)) {
        return of_urdf(file, cancellation);
    }
    Ok(read_spheres(&text(file, MAX_SPHERES_BYTES)?).map_err(about(file))?)
}

/// The spheres of a URDF's collision elements.
fn of_urdf(file: &Path, cancellation: &Cancellation) -> Result<SphereList, Failure> {
    let source = urdd_source::load(file, &around(), cancellation).map_err(one_line)?;
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
                    link.name.escape_debug()
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
