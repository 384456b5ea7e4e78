//! Which bodies of a model are the robot, and which of its shapes are seen.
//!
//! The robot is the trees of the world that have a joint with an actuator. Without actuators it is the tree with most
//! joints, and those that have as many; without joints, the one with most bodies. `--body NAME` chooses another. Seen are the
//! shapes that MuJoCo's viewer shows from the start.

use std::collections::HashSet;
use std::ops::RangeInclusive;

use nalgebra::{Isometry3, Point3};
use urdd_format::readable::first_of;
use urdd_format::short::Short;
use urdd_geometry::mesh::Bounds;

use super::assets::Assets;
use super::body::{Bodies, RawBody, WORLD};
use super::contact::Contacts;
use super::geom::Geom;
use super::inertia::Fitted;
use super::mesh::Meshes;
use super::reading::Element;
use crate::fault::{ImportFault, MjcfFault};
use crate::features::Tally;
use crate::model::{Geometry, JointKind};
use crate::place::{Fallible, Place, at};

pub struct Robot {
    /// Its bodies, by index, each parent before its children.
    pub bodies: Vec<usize>,
    /// Whether the world's shapes and sites are part of it.
    pub has_world: bool,
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

/// The groups that the viewer shows.
const SHOWN: RangeInclusive<i64> = 0..=2;
/// How far a shape may stand out of those that cover it, as a part of the longest edge of the box around them. Of 634 shapes
/// of robosuite and its models that collide in a group of their own, 619 stand out by less.
const MARGIN: f64 = 0.25;

pub struct Seen {
    /// Whether hidden groups are seen too: without them, nothing of the robot would be.
    shows_all: bool,
    /// The groups that are shown and have shapes that do not collide.
    looks: HashSet<i64>,
}

/// A shape of a body, with its size, and whether it does not collide.
pub type Part<'p, 'd> = (&'p Geom<'d>, &'p Fitted, bool);

impl Seen {
    pub fn of(bodies: &Bodies<'_>, robot: &Robot, contacts: &Contacts) -> Self {
        let own = robot.bodies.iter().filter(|body| **body != WORLD || robot.has_world);
        let geoms = own.flat_map(|body| {
            let each = bodies.all[*body].geoms.iter().enumerate();
            each.map(move |(place, geom)| (geom.group, contacts.is_visual(geom, *body, place)))
        });
        let shown: Vec<(i64, bool)> = geoms.filter(|(group, _)| SHOWN.contains(group)).collect();
        let looks = shown.iter().filter(|(_, is_visual)| *is_visual).map(|(group, _)| *group);
        Seen { shows_all: shown.is_empty(), looks: looks.collect() }
    }

    /// Whether each shape of a body is seen. One that collides is not, where others are its look: the robot keeps those that
    /// collide in a group of their own, and the box around those that do not holds it.
    pub fn of_body(
        &self,
        parts: &[Part<'_, '_>],
        meshes: &mut Meshes<'_>,
        assets: &Assets<'_>,
    ) -> Fallible<Vec<bool>> {
        let is_shown = |geom: &Geom<'_>| self.shows_all || SHOWN.contains(&geom.group);
        let may_be_covered = |(geom, _, is_visual): &Part<'_, '_>| {
            is_shown(geom) && !is_visual && !self.looks.contains(&geom.group)
        };
        let mut corners: Vec<[f64; 3]> = Vec::new();
        if parts.iter().any(may_be_covered) {
            let others = parts.iter().filter(|(geom, _, is_visual)| *is_visual && is_shown(geom));
            for (geom, fitted, _) in others {
                let own = bounds(geom, fitted, meshes, assets)?;
                corners.extend(own.into_iter().flat_map(|own| [own.min, own.max]));
            }
        }
        let look = (!corners.is_empty()).then(|| Bounds::of(corners));
        let mut seen = Vec::with_capacity(parts.len());
        for part @ (geom, fitted, _) in parts {
            seen.push(match look.as_ref().filter(|_| may_be_covered(part)) {
                Some(look) => {
                    let own = bounds(geom, fitted, meshes, assets)?;
                    !own.is_some_and(|own| is_inside(&own, look))
                }
                None => is_shown(geom),
            });
        }
        Ok(seen)
    }
}

fn is_inside(own: &Bounds, look: &Bounds) -> bool {
    let margin = MARGIN * look.size().into_iter().fold(0.0, f64::max);
    (0..3).all(|axis| {
        own.min[axis] >= look.min[axis] - margin && own.max[axis] <= look.max[axis] + margin
    })
}

/// The box around a shape, in the frame of its body; none of a surface without an end, and of what cannot be read.
fn bounds(
    geom: &Geom<'_>,
    fitted: &Fitted,
    meshes: &mut Meshes<'_>,
    assets: &Assets<'_>,
) -> Fallible<Option<Bounds>> {
    let moved = |point: [f64; 3]| (fitted.pose * Point3::from(point)).coords.into();
    let half = match geom.kind.solid(fitted.size) {
        Some(Geometry::Sphere(radius)) => [radius; 3],
        Some(Geometry::Cylinder { radius, length }) => [radius, radius, length / 2.0],
        Some(Geometry::Capsule { radius, length }) => [radius, radius, length / 2.0 + radius],
        Some(Geometry::Ellipsoid(radii)) => radii,
        Some(Geometry::Box(edges)) => edges.map(|edge| edge / 2.0),
        Some(Geometry::Mesh { .. }) | None => {
            let Some(mesh) = geom.mesh else { return Ok(None) };
            return match meshes.placed(mesh, geom.place, assets) {
                Ok(mesh) => Ok(Some(Bounds::of(mesh.vertices.into_iter().map(moved)))),
                Err(why) if matches!(why.fault, ImportFault::Account(_)) => Err(why),
                Err(_) => Ok(None),
            };
        }
    };
    let corner = |bits: usize| [0, 1, 2].map(|axis| half[axis] * [-1.0, 1.0][(bits >> axis) & 1]);
    Ok(Some(Bounds::of((0..8).map(|bits| moved(corner(bits))))))
}
