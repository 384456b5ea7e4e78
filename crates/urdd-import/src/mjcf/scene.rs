//! Which bodies of a model are the robot.
//!
//! The robot is the trees of the world that have a joint with an actuator. Without actuators it is the tree with most
//! joints, and those that have as many; without joints, the one with most bodies. `--body NAME` chooses another.

use std::collections::HashSet;

use nalgebra::Isometry3;

use super::super::features::Tally;
use super::super::model::JointKind;
use super::super::place::Place;
use super::super::refusal::{Fallible, at};
use super::body::{Bodies, RawBody, WORLD};
use super::element::Element;
use super::fault::MjcfFault;
use urdd_format::readable::first_of;
use urdd_format::short::Short;

/// The robot of a model.
pub struct Robot {
    /// Its bodies, by index, each parent before its children.
    pub bodies: Vec<usize>,
    /// Whether the world's shapes and sites are part of it.
    pub has_world: bool,
    /// Whether its root moves freely.
    pub is_floating: bool,
}

/// What is known of a tree: a body of the world, with all that hangs on it.
#[derive(Clone, Copy, Default)]
struct Tree {
    joints: usize,
    bodies: usize,
    is_driven: bool,
}

/// Chooses the robot, and says what is left out.
pub fn robot(
    root: &Element,
    bodies: &Bodies<'_>,
    wanted: Option<&str>,
    tally: &mut Tally,
) -> Fallible<Robot> {
    let all = &bodies.all;
    if all.len() == 1 {
        let is_soft = bodies.is_partial;
        let fault = if is_soft { MjcfFault::SoftBodies } else { MjcfFault::NoBody };
        return Err(at(root.place, fault));
    }
    let trees = trees(all);
    let chosen: HashSet<usize> = match wanted {
        Some("world") => (1..all.len()).filter(|body| trees[*body] == *body).collect(),
        Some(name) => {
            let found = all.iter().position(|body| body.name.as_deref() == Some(name));
            let found = found.filter(|body| *body != WORLD);
            let found =
                found.ok_or_else(|| at(root.place, MjcfFault::UnknownBody(name.to_owned())))?;
            if trees[found] != found {
                return Ok(below(all, found, tally));
            }
            HashSet::from([found])
        }
        None => by_structure(all, &trees, &driven(root)),
    };
    let has_world = wanted == Some("world");
    if !has_world {
        say_left_out(all, &trees, &chosen, tally);
    }
    let mut robot: Vec<usize> =
        (1..all.len()).filter(|body| chosen.contains(&trees[*body])).collect();
    let only = robot.first().filter(|_| chosen.len() == 1 && !has_world).copied();
    let is_floating = only.is_some_and(|root| is_free(&all[root]));
    let is_at_origin =
        |body: &RawBody<'_>| body.joints.is_empty() && body.pose == Isometry3::identity();
    if !is_floating && !only.is_some_and(|root| is_at_origin(&all[root])) {
        robot.insert(0, WORLD);
        for free in chosen.iter().filter(|body| is_free(&all[**body])) {
            let text =
                "the free joint is left out, because the robot has other roots: the body is fixed";
            tally.remark(all[*free].place, text);
        }
        tally.remarks.sort_by_key(|remark| remark.place);
    }
    Ok(Robot { bodies: robot, has_world, is_floating })
}

/// The tree that each body is in: the index of its body in the world.
fn trees(all: &[RawBody<'_>]) -> Vec<usize> {
    let mut trees = vec![WORLD];
    for (index, body) in all.iter().enumerate().skip(1) {
        trees.push(match body.parent {
            Some(WORLD) | None => index,
            Some(parent) => trees[parent],
        });
    }
    trees
}

/// A body that is not in the world, and what hangs on it.
fn below(all: &[RawBody<'_>], root: usize, tally: &mut Tally) -> Robot {
    let mut inside = vec![false; all.len()];
    inside[root] = true;
    for index in root + 1..all.len() {
        inside[index] = all[index].parent.is_some_and(|parent| inside[parent]);
    }
    let text = "the robot begins at this body; its joints, and what it hangs on, are left out";
    tally.remark(all[root].place, text);
    let bodies = (root..all.len()).filter(|index| inside[*index]).collect();
    Robot { bodies, has_world: false, is_floating: false }
}

fn by_structure(all: &[RawBody<'_>], trees: &[usize], driven: &HashSet<&str>) -> HashSet<usize> {
    let mut known = vec![Tree::default(); all.len()];
    for (body, tree) in all.iter().zip(trees).skip(1) {
        let tree = &mut known[*tree];
        tree.bodies += 1;
        let moving = body.joints.iter().filter(|joint| joint.kind != JointKind::Floating);
        tree.joints += moving.count();
        let sites = body.frames.iter().filter_map(|site| site.name.as_deref());
        let mut names = body.joints.iter().map(|joint| joint.name.as_str()).chain(sites);
        tree.is_driven |= names.any(|name| driven.contains(name));
    }
    let roots = || (1..all.len()).filter(|body| trees[*body] == *body);
    let still = || roots().filter(|root| !all[*root].is_mocap);
    let driven: HashSet<usize> = still().filter(|root| known[*root].is_driven).collect();
    if !driven.is_empty() {
        return driven;
    }
    match still().map(|root| known[root].joints).max() {
        Some(0) | None => {}
        Some(most) => return still().filter(|root| known[*root].joints == most).collect(),
    }
    let largest = roots()
        .max_by_key(|root| (!all[*root].is_mocap, known[*root].bodies, std::cmp::Reverse(*root)));
    largest.into_iter().collect()
}

/// The names of joints and sites that actuators drive, also by tendons.
fn driven(root: &Element) -> HashSet<&str> {
    let (mut names, mut tendons) = (HashSet::new(), HashSet::new());
    for actuator in root.sections("actuator") {
        let of = |attribute| actuator.text(attribute);
        names.extend(["joint", "jointinparent", "site", "cranksite"].into_iter().filter_map(of));
        tendons.extend(actuator.text("tendon"));
    }
    let is_driven =
        |tendon: &&Element| tendon.text("name").is_some_and(|name| tendons.contains(name));
    for tendon in root.sections("tendon").filter(is_driven) {
        let of = tendon.children.iter().filter_map(|part| part.text("joint").or(part.text("site")));
        names.extend(of);
    }
    names
}

fn is_free(body: &RawBody<'_>) -> bool {
    body.joints.iter().any(|joint| joint.kind == JointKind::Floating)
}

fn say_left_out(all: &[RawBody<'_>], trees: &[usize], chosen: &HashSet<usize>, tally: &mut Tally) {
    let left: Vec<usize> =
        (1..all.len()).filter(|body| trees[*body] == *body && !chosen.contains(body)).collect();
    let place = |index: usize| -> Place { all[index].place };
    if let Some(first) = left.first() {
        let names = left.iter().map(|body| title(&all[*body]));
        let text = format!(
            "bodies of the world that are not the robot are left out: {}; `--body NAME` takes one of them, `--body world` all",
            first_of(names, 5)
        );
        tally.remark(place(*first), text);
    }
    let world = &all[WORLD];
    let things = world.geoms.len() + world.frames.len();
    if things > 0 {
        let text = format!(
            "shapes, sites and cameras of the world itself ({things}) are left out; `--body world` takes them"
        );
        tally.remark(world.place, text);
    }
}

fn title(body: &RawBody<'_>) -> String {
    let name = body.name.as_deref().unwrap_or("one without a name");
    format!("`{}`", Short::of(name).replace(char::is_control, " "))
}
