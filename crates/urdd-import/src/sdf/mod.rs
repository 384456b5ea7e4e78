//! Reads SDF: files into a scene, whose names are then looked up, and the tree in its graph of links and joints.

mod assets;
mod bodies;
mod joint_reader;
mod libsdformat;
mod link_reader;
mod models;
mod moving;
mod reader;
mod scene;
mod tag;

use std::collections::BTreeMap;

use urdd_source::ImportOptions;
use urdd_source::gate::Gate;

use crate::fault::{ImportFault, SdfFault};
use crate::features::{self, Tally};
use crate::model::{LETTER, Model};
use crate::place::{Fallible, Placed, TextFile, at, placed};
use bodies::bodies;
use joint_reader::world_joints;
use libsdformat::say_refusals;
use models::{Overrides, find, include, model};
use reader::{SdfReader, keep_posed, keep_static};
use scene::Frames;
use tag::Tag;

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

/// A model of a file, or an `<include>` of one.
struct Candidate<'a> {
    tag: Tag<'a>,
    name: String,
    is_static: bool,
    /// The last part of what an `<include>` names, by which it can be chosen too.
    uri: String,
    world: Option<Tag<'a>>,
}

/// Reads the model of a file that a person chose, or the only one. Gives its name and whether it is static.
///
/// # Errors
/// If there is none, if there are several, or if it is refused.
pub fn read_chosen(
    reader: &mut SdfReader,
    root: Tag,
    options: &ImportOptions,
) -> Fallible<(String, bool)> {
    let mut there = Vec::new();
    for tag in root.children() {
        match tag.name() {
            "world" => {
                let inside = tag.children().filter_map(candidate);
                there.extend(inside.map(|one| Candidate { world: Some(tag), ..one }));
            }
            _ => there.extend(candidate(tag)),
        }
    }
    if there.len() > 1 || options.model.is_some() {
        look_inside(reader, &mut there)?;
    }
    let names = || there.iter().map(|one| one.name.clone()).collect::<Vec<String>>();
    let moving: Vec<&Candidate> = there.iter().filter(|one| !one.is_static).collect();
    let chosen = match (&options.model, &there[..], &moving[..]) {
        (Some(wanted), _, _) => {
            let by_uri = || there.iter().find(|one| one.uri == *wanted);
            let found = there.iter().find(|one| one.name == *wanted).or_else(by_uri);
            let other = SdfFault::OtherModels { wanted: wanted.clone(), there: names() };
            found.map_or_else(|| Err(at(root.place(), other)), Ok)?
        }
        (None, [], _) => return Err(at(root.place(), SdfFault::NoModel)),
        (None, [one], _) => one,
        (None, _, [one]) => *one,
        (None, ..) => return Err(at(root.place(), SdfFault::Models(names()))),
    };
    if there.len() > 1 {
        let others = match there.len() - 1 {
            1 => "1 other model is".to_owned(),
            others => format!("{others} other models are"),
        };
        let text = format!("`{}` is the robot; {others} left out", chosen.name);
        reader.tally.remark(chosen.tag.place(), text);
    }
    around(root, chosen.world, &mut reader.tally);
    let (name, is_static) = match chosen.tag.name() {
        "model" => {
            (chosen.name.clone(), model(reader, chosen.tag, None, &Overrides::default(), 0)?)
        }
        _ => include(reader, chosen.tag, None, 0)?,
    };
    if let Some(world) = chosen.world {
        world_joints(reader, world, &name)?;
    }
    Ok((name, is_static))
}

/// A model, or what includes one.
fn candidate(tag: Tag) -> Option<Candidate> {
    let is_static = tag.flag("static");
    match tag.name() {
        "model" => {
            let name = tag.attribute("name").unwrap_or_default().to_owned();
            Some(Candidate { tag, name, is_static, uri: String::new(), world: None })
        }
        "include" => {
            let uri = tag.words("uri").unwrap_or_default();
            let uri = uri.trim_end_matches('/').rsplit('/').next().unwrap_or_default().to_owned();
            let name = tag.words("name").unwrap_or_else(|| uri.clone());
            // Gazebo's own surroundings, which are not robots.
            let is_ground =
                [&name, &uri].iter().any(|of| matches!(of.as_str(), "ground_plane" | "sun"));
            Some(Candidate { tag, name, is_static: is_static || is_ground, uri, world: None })
        }
        _ => None,
    }
}

/// What an included file has: the name of its model and whether that is static, or no model.
type Inside = Option<(String, bool)>;

/// Takes from included files what their `<include>`s do not say. Lights and actors are no candidates.
fn look_inside(reader: &mut SdfReader, there: &mut Vec<Candidate>) -> Fallible<()> {
    let mut known: BTreeMap<String, Option<Inside>> = BTreeMap::new();
    let mut is_model = Vec::new();
    for one in &mut *there {
        let uri =
            Some(one.tag).filter(|tag| tag.name() == "include").and_then(|tag| tag.words("uri"));
        let inside = match uri {
            None => None,
            Some(uri) => match known.get(&uri) {
                Some(known) => known.clone(),
                None => known.entry(uri.clone()).or_insert(peek(reader, one.tag, &uri)?).clone(),
            },
        };
        is_model.push(inside != Some(None));
        let Some(Some((name, is_static))) = inside else { continue };
        // It is a copy for each.
        reader.charge(LETTER * name.len(), one.tag.place())?;
        if one.tag.words("name").is_none() {
            one.name = name;
        }
        one.is_static |= is_static && one.tag.words("static").is_none();
    }
    let mut is_model = is_model.into_iter();
    there.retain(|_| is_model.next() == Some(true));
    Ok(())
}

/// What is in an included file; none of one that cannot be read.
fn peek(reader: &mut SdfReader, tag: Tag, uri: &str) -> Fallible<Option<Inside>> {
    let files = reader.files.len();
    let name = |model: Tag| model.attribute("name").unwrap_or_default().to_owned();
    let read = find(reader, tag, uri).and_then(|file| {
        reader.include(&file, tag.place(), |_, root| {
            Ok(root.child("model").map(|model| (name(model), model.flag("static"))))
        })
    });
    reader.files.truncate(files);
    match read {
        Ok(inside) => Ok(Some(inside)),
        Err(why) if matches!(why.fault, ImportFault::Account(_)) => Err(why),
        Err(_) => Ok(None),
    }
}

/// Counts what is around the model.
fn around(root: Tag, chosen: Option<Tag>, tally: &mut Tally) {
    for tag in root.children() {
        match tag.name() {
            "world" => {
                for child in tag.children() {
                    match child.name() {
                        "model" | "include" => {}
                        "joint" if chosen.is_some_and(|world| world.node == tag.node) => {}
                        "joint" | "frame" | "actor" => {
                            tally.unread(format!("`<{}>` of `<world>`", child.name()));
                        }
                        _ => tally.count(features::SETTINGS),
                    }
                }
            }
            "model" | "include" => {}
            name => tally.unread(format!("`<{name}>` of `<sdf>`")),
        }
    }
}
