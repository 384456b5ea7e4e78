//! A robot of another format, in the terms of that format: bodies in a tree, each with the joints by which it moves.
//!
//! Lengths in m, angles in rad, masses in kg, inertias in kg m². A reader of a format makes a [`Model`]; `urdf.rs` makes a
//! URDF and its companions from it. What is in a list was charged to the account of the run, with all that is made of it.

use std::sync::Arc;

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};
use urdd_directory::account::{Charged, Cost};
use urdd_format::loops::LoopKind;

use crate::features::{self, Feature, Tally};
use crate::place::{Place, TextFile};

#[derive(Debug, Clone, Default)]
pub struct Model {
    pub name: String,
    /// The files that were read: the description first, then what it includes.
    pub files: Vec<TextFile>,
    /// Its bodies. A parent stands before its children; names are unique and not empty.
    pub bodies: Charged<Body>,
    /// Whether the root moves freely in the world.
    pub is_floating: bool,
    /// The meshes and images that shapes name.
    pub assets: Charged<Asset>,
    /// Named configurations. Joints without a value are at 0.
    pub configurations: Charged<Configuration>,
    /// Pairs of bodies that are never checked for collisions, by index.
    pub apart: Charged<Apart>,
    /// Pairs of bodies that are checked, though a joint connects them.
    pub checked: Charged<Apart>,
    /// What closes its chains, beside the tree.
    pub closings: Charged<Closing>,
    /// Equations between its joints that no mimic can say.
    pub couplings: Charged<Coupled>,
    /// What stands in the URDF as it is.
    pub elements: Charged<GazeboElement>,
    /// The coefficient of friction of all shapes, where all have the same.
    pub friction: Option<f64>,
    pub tally: Tally,
}

#[derive(Debug, Clone, Default)]
pub struct Body {
    pub name: String,
    /// Its parent, by index; none of the first body alone.
    pub parent: Option<usize>,
    /// Its frame in its parent's, where each of its joints is at [`Joint::reference`].
    pub pose: Isometry3<f64>,
    /// The joints between it and its parent, the one that moves first. None: it is fixed.
    pub joints: Charged<Joint>,
    /// The name of the fixed joint, if it has no others; `NAME_fixed` otherwise.
    pub fixed_by: Option<String>,
    pub inertial: Option<Inertial>,
    pub shapes: Charged<Shape>,
    /// Whether it is a frame alone: a site, a camera, a frame of SDF.
    pub is_frame: bool,
    pub place: Place,
}

impl Body {
    /// A body without joints, mass and shapes.
    pub fn new(name: String, parent: Option<usize>, pose: Isometry3<f64>, place: Place) -> Self {
        Body { name, parent, pose, place, ..Body::default() }
    }
}

/// Mass, centre of mass and inertia about it, in the frame of a body or of a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertial {
    /// Mass, kg.
    pub mass: f64,
    pub centre: Point3<f64>,
    /// The inertia about the centre of mass, along the axes of the frame.
    pub inertia: Matrix3<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum JointKind {
    /// About its axis.
    #[default]
    Hinge,
    /// Along its axis.
    Slide,
    /// About a point.
    Ball,
    /// In the plane whose normal is its axis, and about it.
    Planar,
    /// In all ways.
    Floating,
}

impl JointKind {
    /// What is put behind the name of a joint for each of its DOFs: SPEC 5.8.
    pub fn dofs(self) -> &'static [&'static str] {
        const ALL: [&str; 6] = ["/trans_x", "/trans_y", "/trans_z", "/rot_x", "/rot_y", "/rot_z"];
        match self {
            JointKind::Hinge | JointKind::Slide => &[""],
            JointKind::Ball => &ALL[3..],
            JointKind::Planar => &["/trans_x", "/trans_y", "/rot"],
            JointKind::Floating => &ALL,
        }
    }
}

#[derive(Debug, Clone, Default)]
pub struct Joint {
    /// Its name; unique and not empty.
    pub name: String,
    pub kind: JointKind,
    /// Its frame in the body's, which moves with the body.
    pub frame: Isometry3<f64>,
    /// Its axis in its frame; not zero. Of no meaning for a ball and for what floats.
    pub axis: Vector3<f64>,
    /// Its value in the pose of [`Body::pose`], rad or m.
    pub reference: f64,
    /// Its least and greatest value, rad or m.
    pub range: Option<[f64; 2]>,
    /// The greatest force, N or N m.
    pub effort: Option<f64>,
    /// The greatest speed, m/s or rad/s.
    pub velocity: Option<f64>,
    /// Damping, N s/m or N m s/rad.
    pub damping: f64,
    /// Friction, N or N m.
    pub friction: f64,
    pub mimic: Option<Mimic>,
    /// Gains of its actuator: N m/rad or N/m, and N m s/rad or N s/m; the inertia of its motor, kg m² or kg.
    pub kp: Option<f64>,
    pub kv: Option<f64>,
    pub armature: Option<f64>,
    /// What else its actuator says.
    pub actuator: Actuator,
    pub place: Place,
}

/// What an actuator says beside its gains, in the units of its joint.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Actuator {
    /// Its name, where the joint has one actuator, of another name.
    pub name: Option<String>,
    /// Whether it is told a speed.
    pub is_of_speed: bool,
    /// The least and greatest position or speed that it can be told: rad or m, rad/s or m/s.
    pub control: Option<[f64; 2]>,
    /// The least and greatest force, N or N m.
    pub force: Option<[f64; 2]>,
}

impl Joint {
    /// A joint about or along z, of which nothing else is said.
    pub fn new(name: String, kind: JointKind, frame: Isometry3<f64>, place: Place) -> Self {
        Joint { name, kind, frame, axis: Vector3::z(), place, ..Joint::default() }
    }

    /// What is counted of it.
    pub fn feature(&self) -> Feature {
        match (self.kind, self.range) {
            (JointKind::Hinge, _) => features::HINGES,
            (JointKind::Slide, None) => features::FREE_SLIDES,
            (JointKind::Slide, Some(_)) => features::SLIDES,
            (JointKind::Ball, _) => features::BALLS,
            (JointKind::Planar | JointKind::Floating, _) => features::PLANAR,
        }
    }
}

/// `value = multiplier × leader + offset`.
#[derive(Debug, Clone, PartialEq)]
pub struct Mimic {
    /// The name of the joint that is followed.
    pub joint: String,
    pub multiplier: f64,
    pub offset: f64,
}

/// What a shape is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Use {
    Visual,
    Collision,
    Both,
}

#[derive(Debug, Clone)]
pub struct Shape {
    pub name: Option<String>,
    pub used: Use,
    /// Its frame in the body's.
    pub pose: Isometry3<f64>,
    pub geometry: Geometry,
    pub material: Option<Material>,
    pub place: Place,
}

/// A geometric shape about the origin of its frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// Lengths of the edges.
    Box([f64; 3]),
    /// Along z.
    Cylinder {
        radius: f64,
        length: f64,
    },
    /// Along z; the length is without the two ends.
    Capsule {
        radius: f64,
        length: f64,
    },
    Sphere(f64),
    Ellipsoid([f64; 3]),
    /// A mesh: an index in [`Model::assets`], and the factors by which it is scaled.
    Mesh {
        asset: usize,
        scale: [f64; 3],
    },
}

impl Geometry {
    /// What is counted of it.
    pub fn feature(&self) -> Feature {
        match self {
            Geometry::Capsule { .. } => features::CAPSULES,
            Geometry::Ellipsoid(_) => features::ELLIPSOIDS,
            Geometry::Mesh { .. } => features::MESHES,
            Geometry::Box(_) | Geometry::Cylinder { .. } | Geometry::Sphere(_) => features::BOXES,
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Its name; one is given to it otherwise.
    pub name: Option<String>,
    /// Red, green, blue, alpha, each from 0 to 1.
    pub rgba: Option<[f64; 4]>,
    /// An image: an index in [`Model::assets`].
    pub texture: Option<usize>,
}

/// A file that the URDF names.
#[derive(Debug, Clone)]
pub struct Asset {
    /// Its path below the folder of the URDF, such as `meshes/base.stl`; unique regardless of case.
    pub path: String,
    pub bytes: Arc<[u8]>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Configuration {
    pub name: String,
    /// Values of joints, in the order of bodies and of their joints.
    pub values: Charged<JointValue>,
    /// Where the free root is in the world, if it is said: x, y, z in m, and the quaternion w, x, y, z.
    pub base: Option<[f64; 7]>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct JointValue {
    /// The joint: the index of its body, and its own there.
    pub joint: (usize, usize),
    pub name: String,
    /// Of each DOF, rad or m; of rotations about a point, the components of the rotation vector.
    pub values: Vec<f64>,
}

/// What holds two bodies together, beside the tree.
#[derive(Debug, Clone, PartialEq)]
pub struct Closing {
    pub name: Option<String>,
    pub kind: LoopKind,
    pub ends: [End; 2],
    pub place: Place,
}

/// A frame on a body, by index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End {
    pub body: usize,
    pub frame: Isometry3<f64>,
}

/// An equation between joints: the constant, and a polynomial without one of each, add up to 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Coupled {
    pub name: Option<String>,
    pub constant: f64,
    /// Names of joints, and up to four coefficients.
    pub terms: Vec<(String, Vec<f64>)>,
}

/// A complete XML element that stands in the URDF as it is, such as `<gazebo>` with a plugin.
#[derive(Debug, Clone, PartialEq)]
pub struct GazeboElement(pub String);

/// Two bodies that are never checked for collisions with each other, or always, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Apart {
    pub bodies: [usize; 2],
    /// The reason; of those that are never checked in one word, as SRDF has it: `Adjacent`, `Never`, `User`.
    pub reason: &'static str,
}

/// What comes of an entry, bytes: in memory, in the URDF and in its companions, and in what reads these.
pub const ENTRY: usize = 3000;
/// The same, of a value of a joint or a pair.
pub const PART: usize = 500;
/// The same, of each byte of a name.
pub const LETTER: usize = 12;

macro_rules! costs {
    ($($entry:ty: |$of:ident| $cost:expr;)*) => {
        $(impl Cost for $entry {
            fn cost(&self) -> usize {
                let $of = self;
                $cost
            }
        })*
    };
}

impl Cost for Apart {
    fn cost(&self) -> usize {
        PART
    }
}

/// The bytes of names.
fn letters<'n>(names: impl IntoIterator<Item = &'n String>) -> usize {
    LETTER * names.into_iter().map(String::len).sum::<usize>()
}

costs! {
    Body: |body| ENTRY + letters([&body.name]);
    Joint: |joint| {
        let leader = joint.mimic.as_ref().map(|of| &of.joint);
        ENTRY + letters([&joint.name].into_iter().chain(leader).chain(&joint.actuator.name))
    };
    Shape: |shape| {
        let material = shape.material.as_ref().and_then(|material| material.name.as_ref());
        ENTRY + letters(shape.name.iter().chain(material))
    };
    Asset: |asset| asset.path.len() + asset.bytes.len();
    Configuration: |configuration| ENTRY + letters([&configuration.name]);
    JointValue: |value| PART + letters([&value.name]);
    Closing: |closing| ENTRY + letters(&closing.name);
    Coupled: |coupled| {
        let terms = coupled.terms.iter().map(|(name, _)| name);
        ENTRY + PART * coupled.terms.len() + letters(coupled.name.iter().chain(terms))
    };
    GazeboElement: |element| ENTRY + letters([&element.0]);
}
