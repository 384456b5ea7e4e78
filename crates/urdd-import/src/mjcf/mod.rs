//! Reads MJCF, as MuJoCo's compiler does.

mod assets;
mod body;
mod compiler;
mod contact;
mod document;
mod drive;
mod equality;
mod geom;
mod inertia;
mod joint;
mod mesh;
mod reading;
mod robot;
mod said;
mod scene;

use urdd_source::ImportOptions;
use urdd_source::gate::Gate;

use crate::features::Tally;
use crate::model::Model;
use crate::place::{Fallible, Placed, TextFile, placed};
use assets::Assets;
use body::Lookup;
use compiler::Compilers;
use contact::Contacts;
use document::Whole;
use geom::Materials;
use mesh::Meshes;
use reading::Defaults;
use robot::Maker;
use scene::Seen;

pub use compiler::Compiler;
pub use drive::{Driven, give_all};
pub use joint::Actuator;
pub use reading::Element;

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
    said::say_refused(root, &bodies.all, &made, &maker.assets, maker.tally);
    let (assets, all) = (maker.assets.all, &bodies.all);
    equality::equalities(root, &defaults, all, &lookup, &mut made, &mut tally, account)?;
    drive::drive(root, &defaults, &compilers, &lookup, &mut made, &mut tally)?;
    let configurations = robot::configurations(root, &bodies, &made, &mut tally, account)?;
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
