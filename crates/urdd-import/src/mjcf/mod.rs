//! Reads MJCF, as MuJoCo's compiler does.

mod actuator;
mod assets;
mod attach;
mod body;
mod closing;
mod compiler;
mod contact;
mod defaults;
mod document;
mod drive;
mod element;
mod equality;
pub mod fault;
mod fit;
mod geom;
mod inertia;
mod joint;
mod keyframe;
mod lookup;
mod material;
mod mesh;
mod moved;
mod msh;
mod orientation;
mod principal;
mod reading;
mod refused;
mod robot;
mod said;
mod scene;
mod seen;

pub use actuator::Actuator;
pub use compiler::Compiler;
pub use drive::{Driven, give_all};
pub use element::Element;

use super::features::Tally;
use super::model::Model;
use super::place::TextFile;
use super::refusal::{Fallible, Placed, placed};
use assets::Assets;
use compiler::Compilers;
use contact::Contacts;
use defaults::Defaults;
use document::Whole;
use lookup::Lookup;
use material::Materials;
use mesh::Meshes;
use robot::Maker;
use seen::Seen;
use urdd_source::ImportOptions;
use urdd_source::gate::Gate;

/// Reads the robot of a description.
pub fn read(file: TextFile, gate: &Gate, options: &ImportOptions) -> Result<Model, Placed> {
    let Whole { files, models, root } = document::read(file, gate);
    match root.and_then(|root| model(&root, &files, models, gate, options)) {
        Ok(model) => Ok(Model { files, ..model }),
        Err(why) => Err(placed(&files, why)),
    }
}

fn model(
    root: &Element,
    files: &[TextFile],
    models: Vec<usize>,
    gate: &Gate,
    options: &ImportOptions,
) -> Fallible<Model> {
    let (mut tally, account) = (Tally::default(), gate.account());
    said::say(root, &mut tally);
    let defaults = Defaults::of(root, account)?;
    let compilers = Compilers::of(root, models)?;
    let bodies = body::bodies(root, &defaults, &compilers, &mut tally, account)?;
    let robot = scene::robot(root, &bodies, options.body.as_deref(), &mut tally)?;
    let lookup = Lookup::of(&bodies, account);
    let contacts = Contacts::of(root, &lookup, &mut tally)?;
    let mut maker = Maker {
        bodies: &bodies,
        robot: &robot,
        compilers: &compilers,
        meshes: Meshes::of(root, &defaults)?,
        materials: Materials::of_model(root, &defaults)?,
        assets: Assets::new(gate, &compilers, files)?,
        contacts: &contacts,
        seen: Seen::of(&bodies, &robot, &contacts),
        tally: &mut tally,
        account,
    };
    let mut made = maker.make()?;
    refused::say(root, &bodies.all, &made, &maker.assets, maker.tally);
    let (assets, all) = (maker.assets.all, &bodies.all);
    equality::equalities(root, &defaults, all, &lookup, &mut made, &mut tally, account)?;
    drive::drive(root, &defaults, &compilers, &lookup, &mut made, &mut tally)?;
    let configurations = keyframe::configurations(root, &bodies, &made, &mut tally, account)?;
    let pairs = contacts.pairs(all, &made, &mut tally, account)?;
    let friction = contact::friction(all, &made, &mut tally);
    Ok(Model {
        name: root.text("model").unwrap_or_default().to_owned(),
        bodies: made.bodies,
        is_floating: robot.is_floating,
        assets,
        configurations,
        apart: pairs.apart,
        checked: pairs.checked,
        closings: made.closings,
        couplings: made.couplings,
        friction,
        tally,
        ..Model::default()
    })
}
