//! Reads MJCF, as MuJoCo's compiler does.

mod assets;
mod body;
mod compiler;
mod defaults;
mod document;
pub mod fault;
mod fit;
mod geom;
mod inertia;
mod joint;
mod material;
mod mesh;
mod mesh_mass;
mod msh;
mod names;
mod orientation;
mod principal;
mod reading;
mod robot;
mod scene;
mod solid;

use super::features::Tally;
use super::model::{Model, TextFile};
use super::options::ImportOptions;
use super::placed::{Placed, placed};
use super::reach::Reach;
use assets::Assets;
use compiler::Compiler;
use defaults::Defaults;
use document::Element;
use fault::Fallible;
use material::Materials;
use mesh::Meshes;
use robot::Maker;

/// Reads the robot of a description.
///
/// # Errors
/// If it is refused, with the place.
pub fn read(file: TextFile, reach: &Reach, options: &ImportOptions) -> Result<Model, Placed> {
    let document::Document { files, root } = document::read(file, reach)
        .map_err(|(files, fault)| placed(&files, fault.place, fault.fault))?;
    match model(&root, &files, reach, options) {
        Ok(model) => Ok(Model { files, ..model }),
        Err(fault) => Err(placed(&files, fault.place, fault.fault)),
    }
}

fn model(
    root: &Element,
    files: &[TextFile],
    reach: &Reach,
    options: &ImportOptions,
) -> Fallible<Model> {
    let mut tally = Tally::default();
    let defaults = Defaults::of(root)?;
    let compiler = Compiler::of(root)?;
    let bodies = body::bodies(root, &defaults, &compiler, &mut tally)?;
    let robot = scene::robot(root, &bodies, options.body.as_deref(), &mut tally)?;
    let mut maker = Maker {
        bodies: &bodies,
        robot: &robot,
        compiler: &compiler,
        meshes: Meshes::of(root, &defaults)?,
        materials: Materials::of_model(root, &defaults)?,
        assets: Assets::new(reach, &compiler, files),
        tally: &mut tally,
    };
    let made = maker.make()?;
    let assets = maker.assets.all;
    Ok(Model {
        name: root.text("model").unwrap_or_default().to_owned(),
        bodies: made.bodies,
        is_floating: robot.is_floating,
        assets,
        tally,
        ..Model::default()
    })
}
