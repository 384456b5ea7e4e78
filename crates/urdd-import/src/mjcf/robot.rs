//! The robot of a model, as the writers of imports want it: its bodies, and keyframes as named configurations.

use std::collections::HashMap;

use nalgebra::{Isometry3, Quaternion};
use urdd_directory::account::{Account, Charged};
use urdd_kinematics::rotation::to_rotation_vector;

use super::assets::Assets;
use super::body::{Bodies, Made, RawBody, WORLD};
use super::compiler::{Compilers, unit};
use super::contact::Contacts;
use super::geom::{Geom, GeomKind, Materials};
use super::inertia::{Fitted, fitted, inertial};
use super::mesh::Meshes;
use super::reading::{Element, list};
use super::scene::{Part, Robot, Seen};
use crate::fault::MjcfFault;
use crate::features::{self, Tally};
use crate::model::{
    Body, Configuration, Geometry, Inertial, Joint, JointKind, JointValue, Shape, Use,
};
use crate::place::{Fallible, Place, Placing, at};
use crate::tree::Names;

pub struct Maker<'m, 'd> {
    pub bodies: &'m Bodies<'d>,
    pub robot: &'m Robot,
    pub compilers: &'m Compilers,
    pub meshes: Meshes<'d>,
    pub materials: Materials<'d>,
    pub assets: Assets<'m>,
    pub contacts: &'m Contacts,
    pub seen: Seen,
    pub tally: &'m mut Tally,
    pub account: &'m Account,
}

impl<'d> Maker<'_, 'd> {
    /// Makes the bodies, then the frames of sites and cameras.
    pub fn make(&mut self) -> Fallible<Made> {
        let scale = self.scale()?;
        let names = self.names()?;
        let mut joint_names = Names::new(self.account);
        let (bodies, robot) = (self.bodies, self.robot);
        for raw in &bodies.all {
            for joint in raw.joints.iter().filter(|joint| !joint.name.is_empty()) {
                if !joint_names.take(&joint.name).at(joint.place)? {
                    let fault = MjcfFault::SameName { what: "joints", name: joint.name.clone() };
                    return Err(at(joint.place, fault));
                }
            }
        }
        let mut made = Made { is_floating: robot.is_floating, ..Made::default() };
        for (raw_index, name) in robot.bodies.iter().zip(names.0) {
            let raw = &bodies.all[*raw_index];
            let index = made.bodies.len();
            let is_world = *raw_index == WORLD;
            let is_empty = is_world && !robot.has_world;
            let parent = raw.parent.and_then(|parent| made.index.get(&parent).copied());
            let pose = parent.map_or_else(Isometry3::identity, |_| raw.pose);
            let mut body = Body::new(name, parent, pose, raw.place);
            if !is_world {
                self.tally.count(features::BODIES);
            }
            if !is_empty {
                let fitted = self.fitted(raw)?;
                body.shapes = self.shapes(*raw_index, &fitted)?;
                if !is_world {
                    body.inertial = self.inertial(raw, &fitted)?;
                }
                if let Some(inertial) = &mut body.inertial {
                    self.tally.count(features::MASSES);
                    inertial.mass *= scale;
                    inertial.inertia *= scale;
                }
            }
            if body.parent.is_some() {
                for (number, joint) in raw.joints.iter().enumerate() {
                    let place = joint.place;
                    let Some(joint) = self.joint(joint, &body.name, &mut joint_names)? else {
                        continue;
                    };
                    made.joints.insert((*raw_index, number), (index, body.joints.len()));
                    body.joints.push(joint, self.account).at(place)?;
                }
                if body.joints.len() > 1 {
                    self.tally.count(features::MORE_JOINTS);
                }
            } else if robot.is_floating {
                self.tally.count(features::FREE);
            }
            made.index.insert(*raw_index, index);
            made.bodies.push(body, self.account).at(raw.place)?;
        }
        self.frames(&mut made, names.1)?;
        Ok(made)
    }

    fn fitted(&mut self, raw: &RawBody<'d>) -> Fallible<Vec<Fitted>> {
        let each = raw.geoms.iter();
        let compilers = self.compilers;
        let of = |geom| fitted(geom, compilers.at(raw.place), &mut self.meshes, &self.assets);
        each.map(of).collect()
    }

    fn inertial(&mut self, raw: &RawBody<'d>, fitted: &[Fitted]) -> Fallible<Option<Inertial>> {
        inertial(raw, fitted, self.compilers.at(raw.place), &mut self.meshes, &self.assets)
    }

    /// By how much all masses are multiplied, so that their sum is what the compiler asks.
    fn scale(&mut self) -> Fallible<f64> {
        let Some(total) = self.compilers.at(Place::default()).total_mass else { return Ok(1.0) };
        let mut mass = 0.0;
        let bodies = self.bodies;
        for raw in bodies.all.iter().skip(1) {
            let fitted = self.fitted(raw)?;
            mass += self.inertial(raw, &fitted)?.map_or(0.0, |inertial| inertial.mass);
        }
        Ok((total / mass.max(1e-15)).max(1e-15))
    }

    /// A name for each body of the robot, and the names that are left.
    fn names(&self) -> Fallible<(Vec<String>, Names)> {
        let mut names = Names::new(self.account);
        let all = &self.bodies.all;
        for body in self.robot.bodies.iter().map(|index| &all[*index]) {
            let Some(name) = body.name.as_deref() else { continue };
            if !names.take(name).at(body.place)? {
                let fault = MjcfFault::SameName { what: "bodies", name: name.to_owned() };
                return Err(at(body.place, fault));
            }
        }
        let mut known: HashMap<usize, String> = HashMap::new();
        let mut found = Vec::new();
        for index in &self.robot.bodies {
            let body = &all[*index];
            let name = match (&body.name, body.parent.and_then(|parent| known.get(&parent))) {
                (Some(name), _) => Ok(name.clone()),
                (None, _) if *index == WORLD => names.free("world"),
                (None, Some(parent)) => names.free(&format!("{parent}_body")),
                (None, None) => names.free("body"),
            };
            let name = name.at(body.place)?;
            known.insert(*index, name.clone());
            found.push(name);
        }
        Ok((found, names))
    }

    fn joint(&mut self, raw: &Joint, body: &str, names: &mut Names) -> Fallible<Option<Joint>> {
        if raw.kind == JointKind::Floating {
            return Ok(None);
        }
        self.tally.count(raw.feature());
        let name = match raw.name.as_str() {
            "" => names.free(&format!("{body}_joint")).at(raw.place)?,
            name => name.to_owned(),
        };
        Ok(Some(Joint { name, ..raw.clone() }))
    }

    fn shapes(&mut self, body: usize, fitted: &[Fitted]) -> Fallible<Charged<Shape>> {
        let (mut shapes, contacts) = (Charged::default(), self.contacts);
        let geoms = &self.bodies.all[body].geoms;
        let is_visual = |(place, geom): (usize, &Geom<'_>)| contacts.is_visual(geom, body, place);
        let discards = self.compilers.at(self.bodies.all[body].place).discards_visuals;
        let each = geoms.iter().enumerate().zip(fitted);
        let parts: Vec<Part<'_, '_>> = each
            .map(|((place, geom), fitted)| (geom, fitted, is_visual((place, geom))))
            .filter(|(.., is_visual)| !(*is_visual && discards))
            .collect();
        self.tally.add(features::DISCARDED, geoms.len() - parts.len());
        let seen = self.seen.of_body(&parts, &mut self.meshes, &self.assets)?;
        for ((geom, fitted, is_visual), is_seen) in parts.into_iter().zip(seen) {
            let is_seen = is_seen && !self.materials.is_clear(geom, &self.meshes)?;
            let used = match (is_visual, is_seen) {
                (true, true) => Use::Visual,
                (false, true) => Use::Both,
                (false, false) => {
                    self.tally.count(features::ONLY_COLLIDING);
                    Use::Collision
                }
                (true, false) => {
                    self.tally.count(features::UNSEEN);
                    continue;
                }
            };
            let Some((geometry, frame)) = self.geometry(geom, fitted)? else { continue };
            let material = self.materials.of(geom, &self.meshes, &mut self.assets, self.tally)?;
            let shape = Shape {
                name: geom.name.clone(),
                used,
                pose: fitted.pose * frame,
                geometry,
                material,
                place: geom.place,
            };
            shapes.push(shape, self.account).at(geom.place)?;
        }
        Ok(shapes)
    }

    fn geometry(
        &mut self,
        geom: &Geom<'d>,
        fitted: &Fitted,
    ) -> Fallible<Option<(Geometry, Isometry3<f64>)>> {
        let geometry = match (geom.kind, geom.kind.solid(fitted.size)) {
            (_, Some(solid)) => solid,
            (GeomKind::Mesh | GeomKind::DistanceField, None) => {
                let mesh = geom.mesh.unwrap_or_default();
                return self.meshes.shape(mesh, geom.place, &mut self.assets, self.tally);
            }
            (_, None) => {
                self.tally.count(features::SURFACES);
                return Ok(None);
            }
        };
        self.tally.count(geometry.feature());
        Ok(Some((geometry, Isometry3::identity())))
    }

    /// The sites and cameras, as bodies without mass.
    fn frames(&mut self, made: &mut Made, mut names: Names) -> Fallible<()> {
        let (bodies, robot) = (self.bodies, self.robot);
        for raw_index in robot.bodies.iter().filter(|index| **index != WORLD || robot.has_world) {
            let parent = made.index.get(raw_index).copied();
            for frame in &bodies.all[*raw_index].frames {
                self.tally.count(features::FRAMES);
                let wanted = frame.name.clone().unwrap_or_else(|| {
                    let body = parent.map_or("", |parent| &made.bodies[parent].name);
                    format!("{body}_{}", frame.kind)
                });
                let name = match names.take(&wanted).at(frame.place)? {
                    true => wanted,
                    false => names.free(&format!("{wanted}_{}", frame.kind)).at(frame.place)?,
                };
                let body = Body::new(name, parent, frame.pose, frame.place);
                let body = Body { is_frame: true, ..body };
                made.bodies.push(body, self.account).at(frame.place)?;
            }
        }
        Ok(())
    }
}

/// What passing a joint of the model costs.
const JOINT: usize = 10;

pub fn configurations(
    root: &Element,
    bodies: &Bodies<'_>,
    made: &Made,
    tally: &mut Tally,
    account: &Account,
) -> Fallible<Charged<Configuration>> {
    let joints = || {
        let each = bodies.all.iter().enumerate();
        each.flat_map(|(body, raw)| {
            raw.joints.iter().enumerate().map(move |(at, joint)| ((body, at), joint))
        })
    };
    let expected: usize = joints().map(|(_, joint)| positions(joint)).sum();
    let (mut configurations, mut names) = (Charged::default(), Names::new(account));
    for (number, key) in root.sections("keyframe").filter(|of| of.tag == "key").enumerate() {
        for name in ["qvel", "act", "ctrl"] {
            if key.text(name).is_some() {
                tally.count(features::CONTROLS);
            }
        }
        if bodies.is_partial {
            let text = "the key is left out: it also has positions of what is not read";
            tally.say(features::SOFT, key.place, text);
            continue;
        }
        let numbers = list(key, "qpos", usize::MAX)?;
        if numbers.len() > expected {
            let fault = MjcfFault::Qpos { found: numbers.len(), expected };
            return Err(at(key.place, fault));
        }
        account.charge(JOINT * joints().count()).at(key.place)?;
        let (mut values, mut base) = (Charged::default(), None);
        let mut rest = &numbers[..];
        for (place, joint) in joints() {
            let (own, after) = rest.split_at(positions(joint).min(rest.len()));
            rest = after;
            if joint.kind == JointKind::Floating && bodies.all[place.0].parent.is_some() {
                let is_root = made.index.get(&place.0) == Some(&0);
                if let (true, [x, y, z, turn @ ..]) = (is_root, own)
                    && let [w, i, j, k] = turn
                {
                    tally.count(features::BASE_POSES);
                    let q = unit(Quaternion::new(*w, *i, *j, *k));
                    base = Some([*x, *y, *z, q.w, q.i, q.j, q.k]);
                }
                continue;
            }
            let Some(&(body, at)) = made.joints.get(&place) else { continue };
            // What a short key does not say is as in the model.
            let whole = [own, start(joint).get(own.len()..).unwrap_or_default()].concat();
            let own = match whole[..] {
                [w, x, y, z] => to_rotation_vector(&unit(Quaternion::new(w, x, y, z))).to_vec(),
                _ => whole,
            };
            let name = made.bodies[body].joints[at].name.clone();
            let value = JointValue { joint: (body, at), name, values: own };
            values.push(value, account).at(key.place)?;
        }
        tally.count(features::POSES);
        let name = key.text("name").map_or_else(|| format!("key_{number}"), str::to_owned);
        let name = names.free(&name).at(key.place)?;
        configurations.push(Configuration { name, values, base }, account).at(key.place)?;
    }
    Ok(configurations)
}

/// How many numbers of a configuration a joint has.
fn positions(joint: &Joint) -> usize {
    match joint.kind {
        JointKind::Floating => 7,
        JointKind::Ball => 4,
        _ => 1,
    }
}

/// The numbers that it has in the model's own configuration. A free joint's are its body's.
fn start(joint: &Joint) -> Vec<f64> {
    match joint.kind {
        JointKind::Floating => Vec::new(),
        JointKind::Ball => vec![1.0, 0.0, 0.0, 0.0],
        _ => vec![joint.reference],
    }
}
