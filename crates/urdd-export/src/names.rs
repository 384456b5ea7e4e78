//! Names: those that formats can represent, those that an export invents, and those of files. None that is invented is one of
//! the robot's, nor another invented one; above all those of the simple joints that a joint of several DOFs is a chain of.

use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};

use nalgebra::Vector3;

use crate::{ExportError, Format, Structure};
use urdd_directory::path::is_device;
use urdd_document::robot::{Joint as View, Robot};
use urdd_document::tree::Tree;
use urdd_format::urdf::JointType;
use urdd_kinematics::rotation::{planar_basis, unit_axis};
use urdd_xml::is_character;

/// Maximum length of a link name within a file name.
pub const LONGEST: usize = 80;

/// What xacro evaluates, refuses, or writes as a space.
const XACRO: [&str; 6] = ["${", "$(", "$$", "\t", "\n", "\r"];

/// The settings beside which MoveIt's file of planners names groups.
const OMPL: [&str; 7] = [
    "planning_plugin",
    "planning_plugins",
    "request_adapters",
    "response_adapters",
    "planner_configs",
    "start_state_max_bounds_error",
    "jiggle_fraction",
];

/// An error if the format cannot represent a name of the robot, a link or a joint.
pub(super) fn check(format: Format, robot: &Robot, tree: &Tree) -> Result<(), ExportError> {
    one(format, "robot", &robot.name)?;
    let links = robot.links.iter().map(|link| link.name.as_str());
    check_names(format, "link", links, "two links have it")?;
    let inner = robot.links.iter().enumerate().filter(|(index, _)| *index != tree.root);
    let reason = match format {
        Format::Mjcf => "MuJoCo has a body of that name, which only the root can use",
        Format::Sdf => "SDF has a frame of that name, which only the root can use",
        Format::Drake => "Drake has a body of that name, which only the root can use",
        _ => "",
    };
    if !reason.is_empty() && inner.map(|(_, link)| &link.name).any(|name| name == "world") {
        return Err(error(format, "link", "world", reason));
    }
    let joints = robot.joints.iter().map(|joint| joint.name.as_str());
    check_names(format, "joint", joints, "two joints have it")
}

/// An error if the format cannot represent names, or two are the same, for which `twice` is the reason.
pub(super) fn check_names<'n>(
    format: Format,
    what: &'static str,
    names: impl Iterator<Item = &'n str> + Clone,
    twice: &'static str,
) -> Result<(), ExportError> {
    names.clone().try_for_each(|name| one(format, what, name))?;
    check_unique(format, what, names, twice)
}

/// An error if two names are the same, for which `twice` is the reason.
pub fn check_unique<'n>(
    format: Format,
    what: &'static str,
    names: impl IntoIterator<Item = &'n str>,
    twice: &'static str,
) -> Result<(), ExportError> {
    let mut seen = HashSet::new();
    match names.into_iter().find(|name| !seen.insert(*name)) {
        Some(name) => Err(error(format, what, name, twice)),
        None => Ok(()),
    }
}

/// Why names that a person chose must differ.
pub(super) const ANOTHER: &str = "another one has it";

/// An error if ROS does not take the name of a package (REP 144): small letters, digits and `_`, a letter first.
pub(super) fn check_package(name: &str) -> Result<(), ExportError> {
    let is_first = |byte: &u8| byte.is_ascii_lowercase();
    let is_inside = |byte: &u8| is_first(byte) || byte.is_ascii_digit() || *byte == b'_';
    match name.as_bytes() {
        [first, rest @ ..] if is_first(first) && rest.iter().all(is_inside) => Ok(()),
        _ => Err(ExportError::Package(name.to_owned())),
    }
}

pub fn one(format: Format, what: &'static str, name: &str) -> Result<(), ExportError> {
    let is_robot = what == "robot" && !name.is_empty();
    let is_xml = !matches!(format, Format::Curobo | Format::Foam | Format::Usd);
    let reason = match format {
        _ if name.is_empty() && what != "robot" => "it is empty",
        Format::Moveit if XACRO.iter().any(|part| name.contains(part)) => {
            "MoveIt reads files by xacro, which would evaluate or change it"
        }
        Format::Moveit if name.starts_with('-') => {
            "the launch file gives names to programs, which take it for an option"
        }
        Format::Moveit if what == "group" && OMPL.contains(&name) => {
            "MoveIt's file of planners has a setting of that name"
        }
        Format::Sdf if name.contains("::") => {
            "SDF reads the part before `::` as the name of a model"
        }
        Format::Sdf if what == "robot" && name == "world" => "SDF keeps it for itself",
        Format::Sdf if name.starts_with("__") && name.ends_with("__") => {
            "SDF keeps such names for itself"
        }
        Format::Sdf if name.trim() != name => "SDF drops white space at the ends of a name",
        Format::Drake | Format::Sdf if what == "link" && name.starts_with(':') => {
            "Drake reads a colon at its beginning as the end of the name of a model"
        }
        Format::Drake | Format::Sdf if is_robot && name.bytes().all(|byte| byte == b':') => {
            "Drake finds no link of a model of that name"
        }
        Format::Drake if is_robot && (name.starts_with("::") || name.ends_with("::")) => {
            "Drake drops `::` at the ends of the name of a model"
        }
        Format::Drake if name.is_empty() => "Drake refuses a robot without a name",
        Format::Drake if what == "link" && name.contains("::") => {
            "Drake reads the part before `::` as the name of a model"
        }
        _ if is_xml && !name.chars().all(is_character) => {
            "it has characters that XML does not allow"
        }
        _ => return Ok(()),
    };
    Err(error(format, what, name, reason))
}

fn error(format: Format, what: &'static str, name: &str, reason: &'static str) -> ExportError {
    ExportError::Name { format, what, name: name.to_owned(), reason }
}

/// The last name of a path.
pub(super) fn last(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

/// Derives file names from link names: letters, digits, `.`, `-` and `_`, unique regardless of case.
#[derive(Debug, Default)]
pub struct FileNames {
    taken: HashSet<String>,
}

impl FileNames {
    /// A name that was not returned before.
    pub fn of(&mut self, wanted: &str) -> String {
        let kept = |c: char| match c {
            'a'..='z' | 'A'..='Z' | '0'..='9' | '.' | '-' | '_' => c,
            _ => '_',
        };
        let mut base: String = wanted.chars().map(kept).take(LONGEST).collect();
        if base.is_empty() || base.starts_with(['.', '-']) || is_device(&base) {
            base.insert(0, '_');
        }
        let mut name = base.clone();
        let mut number = 2;
        while !self.taken.insert(name.to_ascii_lowercase()) {
            name = format!("{base}-{number}");
            number += 1;
        }
        name
    }
}

/// The number that is tried first for a name that is taken.
const FIRST: usize = 2;

/// The names of one space of names, each with the number that is tried next for it.
#[derive(Debug, Clone, Default)]
pub struct Taken(HashMap<String, usize>);

impl Taken {
    pub fn new<'n>(names: impl IntoIterator<Item = &'n String>) -> Self {
        Taken(names.into_iter().map(|name| (name.clone(), FIRST)).collect())
    }

    /// Whether nothing had this name, which is taken from now on.
    pub fn insert(&mut self, name: &str) -> bool {
        match self.0.entry(name.to_owned()) {
            Entry::Vacant(free) => _ = free.insert(FIRST),
            Entry::Occupied(_) => return false,
        }
        true
    }

    /// A name that nothing has yet, and that is taken from now on: the wanted one, or with a number after it.
    pub fn free(&mut self, wanted: String) -> String {
        let mut name = wanted;
        if let Some(next) = self.0.get(&name) {
            let (wanted, mut number) = (name, *next);
            name = format!("{wanted}_{number}");
            while self.0.contains_key(&name) {
                number += 1;
                name = format!("{wanted}_{number}");
            }
            self.0.insert(wanted, number + 1);
        }
        self.0.insert(name.clone(), FIRST);
        name
    }

    /// A name that nothing has yet, as [`Taken::free`]; it stays free.
    pub fn untaken(&self, wanted: String) -> String {
        if self.0.contains_key(&wanted) { self.clone().free(wanted) } else { wanted }
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) enum Moves {
    /// Along an axis in the joint's frame.
    Slides(Vector3<f64>),
    /// About an axis in the joint's frame.
    Turns(Vector3<f64>),
    /// About its centre.
    Ball,
}

/// The simple joints that a joint of several DOFs is a chain of, from its parent to its child: for formats that have no
/// planar and floating joints. Empty for joints of one DOF and fixed ones. A ball has the name `own` of the joint; other
/// names are new.
fn parts(joint: &View, own: &str, taken: &mut Taken) -> Vec<(String, Moves)> {
    let mut part = |name: &str, moves: Moves| (taken.free(format!("{}/{name}", joint.name)), moves);
    let ball = || (own.to_owned(), Moves::Ball);
    match joint.joint_type {
        JointType::Planar => {
            let axis = unit_axis(joint.axis).unwrap_or(Vector3::x_axis());
            let [x, y] = planar_basis(&axis);
            vec![
                part("trans_x", Moves::Slides(x)),
                part("trans_y", Moves::Slides(y)),
                part("rot", Moves::Turns(axis.into_inner())),
            ]
        }
        JointType::Floating => vec![
            part("trans_x", Moves::Slides(Vector3::x())),
            part("trans_y", Moves::Slides(Vector3::y())),
            part("trans_z", Moves::Slides(Vector3::z())),
            ball(),
        ],
        JointType::Spherical => vec![ball()],
        JointType::Fixed | JointType::Revolute | JointType::Continuous | JointType::Prismatic => {
            Vec::new()
        }
    }
}

/// What the joints of a robot are called in a file.
pub(super) struct JointNames {
    pub joints: Vec<String>,
    /// By joint, the simple joints that one of several DOFs is a chain of.
    pub parts: Vec<Vec<(String, Moves)>>,
    /// The names of the space that joints are in, with those above.
    pub taken: Taken,
}

impl JointNames {
    pub fn new(format: Format, of: &Structure) -> Self {
        let own = || of.view.joints.iter().map(|joint| &joint.name);
        let links = || of.view.links.iter().map(|link| &link.name);
        let mut joints: Vec<String> = own().cloned().collect();
        let mut taken = match format {
            // Links, joints and frames share one space of names. A joint that has the name of a link is renamed, as by
            // Gazebo's own converter.
            Format::Sdf => {
                let mut links = Taken::new(links());
                links.insert("world");
                let mut taken = Taken::new(links.0.keys().chain(own()));
                for name in joints.iter_mut().filter(|name| links.0.contains_key(*name)) {
                    *name = taken.free(format!("{name}_joint"));
                }
                taken
            }
            // Parts of a joint have links between them, of the same names.
            Format::Drake => Taken::new(links().chain(own())),
            _ => Taken::new(own()),
        };
        let each = of.view.joints.iter().zip(&joints);
        let parts = each.map(|(joint, own)| parts(joint, own, &mut taken)).collect();
        JointNames { joints, parts, taken }
    }
}
