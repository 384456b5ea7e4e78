//! Chooses the model of a file.

use super::super::features::{self, Tally};
use super::super::options::ImportOptions;
use super::super::place::Place;
use super::fault::SdfFault;
use super::included::{Included, Overrides, included};
use super::kept::keep_plugins;
use super::models::model;
use super::reader::Reader;
use super::refusal::Refusal;
use super::tag::{Tag, is_true};

/// A model of a file, or an `<include>` of one.
struct Candidate<'a> {
    tag: Tag<'a>,
    name: String,
    is_static: bool,
}

/// Reads the model of a file that a person chose, or the only one. Gives its name and whether it is static.
///
/// # Errors
/// If there is none, if there are several, or if it is refused.
pub fn read_chosen(
    reader: &mut Reader,
    root: Tag,
    options: &ImportOptions,
) -> Result<(String, bool), Refusal> {
    let mut there = Vec::new();
    for tag in root.children() {
        match tag.name() {
            "world" => there.extend(tag.children().filter_map(candidate)),
            _ => there.extend(candidate(tag)),
        }
    }
    let names = || there.iter().map(|one| one.name.clone()).collect::<Vec<String>>();
    let moving: Vec<&Candidate> = there.iter().filter(|one| !one.is_static).collect();
    let chosen = match (&options.model, &there[..], &moving[..]) {
        (Some(wanted), _, _) => {
            let found = there.iter().find(|one| one.name == *wanted);
            let other = SdfFault::OtherModels { wanted: wanted.clone(), there: names() };
            found.map_or_else(|| Refusal::at(root.place(), other), Ok)?
        }
        (None, [], _) => return Refusal::at(root.place(), SdfFault::NoModel),
        (None, [one], _) => one,
        (None, _, [one]) => *one,
        (None, ..) => return Refusal::at(root.place(), SdfFault::Models(names())),
    };
    if there.len() > 1 {
        let others = there.len() - 1;
        let text = format!("`{}` is the robot; {others} other models are left out", chosen.name);
        reader.tally.remark(chosen.tag.place(), text);
    }
    around(root, &mut reader.tally);
    if chosen.tag.name() == "model" {
        let is_static = model(reader, chosen.tag, None, &Overrides::default(), 0)?;
        return Ok((chosen.name.clone(), is_static));
    }
    let Included { file, overrides } = included(reader, chosen.tag)?;
    let place: Place = chosen.tag.place();
    let read = reader.include(&file, place, |reader, root| {
        let Some(inside) = root.child("model") else {
            return Refusal::at(place, SdfFault::IncludesNone(file.file.display().to_string()));
        };
        let name = overrides.name.as_deref().or(inside.attribute("name")).unwrap_or_default();
        Ok((name.to_owned(), model(reader, inside, None, &overrides, 0)?))
    })?;
    keep_plugins(reader, chosen.tag)?;
    Ok(read)
}

/// A model, or what includes one.
fn candidate(tag: Tag) -> Option<Candidate> {
    match tag.name() {
        "model" => {
            let name = tag.attribute("name").unwrap_or_default().to_owned();
            Some(Candidate { tag, name, is_static: tag.flag("static") })
        }
        "include" => {
            let uri = tag.words("uri").unwrap_or_default();
            let last = uri.trim_end_matches('/').rsplit('/').next().unwrap_or_default().to_owned();
            let name = tag.words("name").unwrap_or(last);
            // Gazebo's own surroundings, which are not robots.
            let is_ground = matches!(name.as_str(), "ground_plane" | "sun");
            let is_static = tag.words("static").is_some_and(|text| is_true(&text)) || is_ground;
            Some(Candidate { tag, name, is_static })
        }
        _ => None,
    }
}

/// Counts what is around the model.
fn around(root: Tag, tally: &mut Tally) {
    for tag in root.children() {
        match tag.name() {
            "world" => {
                for child in tag.children() {
                    match child.name() {
                        "model" | "include" => {}
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
