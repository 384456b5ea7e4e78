//! A [`Model`] as links and joints of a URDF: a link a body, and a link without mass between two joints of a body; and
//! unique names for what has none.

use std::collections::{HashMap, HashSet};

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use urdd_directory::account::{Account, AccountError, Charged, Cost};
use urdd_source::ImportOptions;
use urdd_xml::number::numbers;

use crate::model::{Body, Joint, JointKind, LETTER, Material, Mimic, Model, PART};
use crate::place::{Fallible, Place, Placing};

/// The axes about which the three joints of a ball turn, and what is put behind its name.
const BALL: [([f64; 3], &str); 3] =
    [([1.0, 0.0, 0.0], "_x"), ([0.0, 1.0, 0.0], "_y"), ([0.0, 0.0, 1.0], "_z")];

/// The links and joints of a URDF.
#[derive(Debug, Default)]
pub struct Tree {
    /// The root first, each parent before its children.
    pub links: Charged<Link>,
    /// In the order of their children.
    pub joints: Charged<Edge>,
}

#[derive(Debug)]
pub struct Link {
    pub name: String,
    /// The body whose mass and shapes it has, by index.
    pub body: Option<usize>,
    pub place: Place,
}

#[derive(Debug)]
pub struct Edge {
    pub name: String,
    /// The type, in URDF's words.
    pub kind: &'static str,
    pub parent: String,
    pub child: String,
    pub origin: Isometry3<f64>,
    pub axis: Option<Vector3<f64>>,
    /// What it is made of: a body, and its joint. None: it is fixed.
    pub joint: Option<(usize, usize)>,
    pub range: Option<[f64; 2]>,
    pub mimic: Option<Mimic>,
    pub place: Place,
}

impl Cost for Link {
    fn cost(&self) -> usize {
        PART + self.name.len()
    }
}

impl Cost for Edge {
    fn cost(&self) -> usize {
        PART + LETTER * (self.name.len() + self.parent.len() + self.child.len())
    }
}

impl Tree {
    /// The links and joints of a model.
    ///
    /// # Errors
    /// If the account does not have what names cost that are made of others; with the place of the body.
    pub fn of(model: &Model, options: &ImportOptions, account: &Account) -> Fallible<Self> {
        let (links, joints) = (Names::new(account), Names::new(account));
        let mut names = Taken { links, joints, account };
        for body in model.bodies.walk(account).at(Place::default())? {
            names.links.take(&body.name).at(body.place)?;
            for joint in body.joints.walk(account).at(body.place)? {
                names.joints.take(&joint.name).at(body.place)?;
            }
        }
        let mut tree = Tree::default();
        for (at, body) in model.bodies.walk(account).at(Place::default())?.enumerate() {
            let parent = body.parent.and_then(|parent| model.bodies.get(parent));
            if let Some(parent) = parent {
                let connected = tree.connect(at, body, &parent.name, options, &mut names);
                connected.at(body.place)?;
            }
            let link = Link { name: body.name.clone(), body: Some(at), place: body.place };
            tree.links.push(link, account).at(body.place)?;
        }
        Ok(tree)
    }

    fn connect(
        &mut self,
        at: usize,
        body: &Body,
        parent: &str,
        options: &ImportOptions,
        names: &mut Taken<'_>,
    ) -> Result<(), AccountError> {
        let mut parent = parent.to_owned();
        let mut origin = body.pose;
        let mut left: usize = 0;
        let moves: Vec<Move> = body
            .joints
            .walk(names.account)?
            .enumerate()
            .flat_map(|(which, joint)| moves(which, joint, options))
            .collect();
        let is_last_at_body = moves.last().is_some_and(|last| is_identity(&last.frame));
        for (turn, one) in moves.iter().enumerate() {
            let joint = &body.joints[one.of];
            let is_last = turn + 1 == moves.len() && is_last_at_body;
            let name = match one.suffix {
                "" => joint.name.clone(),
                suffix => names.joints.free(&format!("{}{suffix}", joint.name))?,
            };
            let child = match is_last {
                true => body.name.clone(),
                false => names.links.free(&format!("{}/{name}", body.name))?,
            };
            let edge = Edge {
                kind: one.kind,
                parent,
                child: child.clone(),
                origin: origin * one.frame * one.back,
                axis: one.axis,
                joint: Some((at, one.of)),
                range: joint.range.filter(|_| one.suffix.is_empty()),
                mimic: joint.mimic.clone().filter(|_| one.suffix.is_empty()),
                place: joint.place,
                name,
            };
            self.joints.push(edge, names.account)?;
            origin = one.frame.inverse();
            left = turn + 1;
            parent = child;
            if !is_last {
                let place = joint.place;
                let link = Link { name: parent.clone(), body: None, place };
                self.links.push(link, names.account)?;
            }
        }
        if left == 0 || !is_last_at_body {
            let name = body.fixed_by.clone().filter(|_| moves.is_empty());
            let name = name.unwrap_or_else(|| format!("{}_fixed", body.name));
            let edge = Edge {
                name: names.joints.free(&name)?,
                kind: "fixed",
                parent,
                child: body.name.clone(),
                origin,
                axis: None,
                joint: None,
                range: None,
                mimic: None,
                place: body.place,
            };
            self.joints.push(edge, names.account)?;
        }
        Ok(())
    }
}

/// The names that are taken.
struct Taken<'a> {
    links: Names,
    joints: Names,
    account: &'a Account,
}

/// A joint of the URDF in the frame of its body.
struct Move {
    of: usize,
    kind: &'static str,
    frame: Isometry3<f64>,
    /// From its frame at its reference to its frame at 0.
    back: Isometry3<f64>,
    axis: Option<Vector3<f64>>,
    suffix: &'static str,
}

fn moves(of: usize, joint: &Joint, options: &ImportOptions) -> Vec<Move> {
    let (frame, axis) = (joint.frame, Some(joint.axis));
    let turned = |angle: f64| match nalgebra::Unit::try_new(joint.axis, 0.0) {
        Some(axis) => Isometry3::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_axis_angle(&axis, -angle),
        ),

        None => Isometry3::identity(),
    };
    let still = Isometry3::identity();
    let one = |kind, back, axis| vec![Move { of, kind, frame, back, axis, suffix: "" }];
    match joint.kind {
        JointKind::Hinge if joint.range.is_some() => one("revolute", turned(joint.reference), axis),
        JointKind::Hinge => one("continuous", turned(joint.reference), axis),
        JointKind::Slide => {
            let back = joint.axis.try_normalize(0.0).unwrap_or_default() * -joint.reference;
            one("prismatic", Translation3::from(back).into(), axis)
        }
        JointKind::Ball if options.has_revolute_balls => {
            let each = BALL.iter().map(|(axis, suffix)| {
                let axis = Some(Vector3::from(*axis));
                Move { of, kind: "continuous", frame, back: still, axis, suffix }
            });
            each.collect()
        }
        JointKind::Ball => one("spherical", still, None),
        JointKind::Planar => one("planar", still, axis),
        JointKind::Floating => one("floating", still, None),
    }
}

fn is_identity(pose: &Isometry3<f64>) -> bool {
    pose.translation.vector.amax() == 0.0 && pose.rotation.angle() == 0.0
}

/// What a name costs beside its bytes.
const NAME: usize = 100;
/// Copies of a name until it is in a model: here, in a list and in a table.
const COPIES: usize = 4;

/// The names that are taken. Each is charged: names that are made of others may grow.
#[derive(Debug)]
pub struct Names {
    account: Account,
    taken: HashSet<String>,
    /// The last number that was tried, by name.
    last: HashMap<String, usize>,
}

impl Names {
    pub fn new(account: &Account) -> Self {
        Names { account: account.clone(), taken: HashSet::new(), last: HashMap::new() }
    }

    /// Takes a name; `false` if it was taken.
    pub fn take(&mut self, name: &str) -> Result<bool, AccountError> {
        self.account.charge(NAME + COPIES * name.len())?;
        Ok(self.taken.insert(name.to_owned()))
    }

    /// The first free of `wanted`, `wanted_2`, `wanted_3` and so on.
    pub fn free(&mut self, wanted: &str) -> Result<String, AccountError> {
        let mut name = wanted.to_owned();
        while !self.take(&name)? {
            let number = self.last.entry(wanted.to_owned()).or_insert(1);
            *number += 1;
            name = format!("{wanted}_{number}");
        }
        Ok(name)
    }
}

/// What was named so far.
#[derive(Debug)]
pub struct Titles {
    visuals: Names,
    collisions: Names,
    materials: Names,
    /// The names of materials, by what they are.
    known: HashMap<String, String>,
}

impl Titles {
    pub fn new(account: &Account) -> Self {
        let [visuals, collisions, materials] = std::array::from_fn(|_| Names::new(account));
        Titles { visuals, collisions, materials, known: HashMap::new() }
    }

    /// The name of a shape of a link: its own, or with the link's if another shape of the robot has it.
    pub fn shape(
        &mut self,
        is_visual: bool,
        link: &str,
        name: &str,
    ) -> Result<String, AccountError> {
        let names = if is_visual { &mut self.visuals } else { &mut self.collisions };
        if names.take(name)? { Ok(name.to_owned()) } else { names.free(&format!("{link}/{name}")) }
    }

    /// The name of a material: the same for what is the same.
    pub fn material(&mut self, model: &Model, of: &Material) -> Result<String, AccountError> {
        let texture = of.texture.and_then(|texture| model.assets.get(texture));
        let texture = texture.map_or("", |file| &file.path);
        let name = match (&of.name, of.rgba) {
            (Some(name), _) => name.clone(),
            (None, Some(rgba)) => format!("rgba {}", numbers(&rgba)),
            (None, None) => texture.to_owned(),
        };
        let key = format!("{name}\n{:?}\n{texture}", of.rgba);
        if let Some(known) = self.known.get(&key) {
            return Ok(known.clone());
        }
        let name = self.materials.free(&name)?;
        self.known.insert(key, name.clone());
        Ok(name)
    }
}
