//! Reads SDF: files into a scene, whose names are then looked up, and the tree in its graph of links and joints.

mod assets;
mod bodies;
mod chosen;
mod closing;
pub mod fault;
mod gearbox;
mod included;
mod inertial;
mod joint_reader;
mod kept;
mod libsdformat;
mod link_reader;
mod models;
mod moving;
mod part;
mod poses;
mod reader;
mod scene;
mod shape_reader;
mod spanning;
mod tag;

use super::model::Model;
use super::place::TextFile;
use super::refusal::{Fallible, Placed, at, placed};
use bodies::bodies;
use chosen::read_chosen;
use fault::SdfFault;
use kept::{keep_posed, keep_static};
use libsdformat::say_refusals;
use poses::Frames;
use reader::SdfReader;
use urdd_source::ImportOptions;
use urdd_source::gate::Gate;

/// Reads the robot of a description.
pub fn read(file: TextFile, gate: &Gate, options: &ImportOptions) -> Result<Model, Placed> {
    let mut reader = SdfReader::new(gate);
    let made = made(&mut reader, file, options);
    made.map_err(|why| placed(&reader.files, why))
}

fn made(reader: &mut SdfReader, file: TextFile, options: &ImportOptions) -> Fallible<Model> {
    let (name, is_static) = reader.open(file, |reader, root| {
        say_refusals(root, &mut reader.tally);
        read_chosen(reader, root, options)
    })?;
    let scene = std::mem::take(&mut reader.scene);
    if scene.links.is_empty() {
        return Err(at(scene.nodes[0].place, SdfFault::NoLink(name)));
    }
    let frames = Frames::of(&scene)?;
    keep_posed(reader, &scene, &frames)?;
    if is_static {
        keep_static(reader, scene.nodes[0].place)?;
    }
    let made = bodies(scene, &frames, &mut reader.tally, reader.gate.account())?;
    Ok(Model {
        name,
        files: std::mem::take(&mut reader.files),
        is_floating: !made.is_held && !is_static,
        closings: made.closings,
        couplings: made.couplings,
        bodies: made.bodies,
        assets: std::mem::take(&mut reader.assets.files),
        elements: std::mem::take(&mut reader.kept),
        friction: reader.friction.common(&mut reader.tally),
        tally: std::mem::take(&mut reader.tally),
        ..Model::default()
    })
}
