//! In which order programs have the joints and the actuators of a robot that they load from an export.
//!
//! A program keeps the order of the file, or walks the tree of links. `tests/figures/exports/order.py` holds this to
//! MuJoCo, Pinocchio, PyBullet, Drake, libsdformat and Newton. That Isaac, by PhysX, goes breadth first is from the
//! documentation of Isaac Lab 3.0, which finds PhysX' order by Newton's reader with `joint_ordering="bfs"`.

use std::collections::VecDeque;

use serde::{Serialize, Serializer};
use serde_json::{Map, Value, json};

use crate::mjcf::actuators;
use crate::names::JointNames;
use crate::usd::prim::names_of_joints;
use crate::{ExportError, Format, Note, Structure, Subject, drake};
use urdd_format::urdf::{JointType, UrdfModule};
use urdd_kinematics::rotation::unit_axis;
use urdd_robot::Robot;

/// The joints and actuators of a robot in a program.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct JointOrder {
    /// The program; `urdf` for the order of the URDF, which is that of a URDD too.
    pub program: &'static str,
    /// The export that the program loads.
    #[serde(rename = "export", serialize_with = "word")]
    pub format: Format,
    /// How the program orders joints.
    pub rule: &'static str,
    /// The joints that move, in the order of their positions, as they are called there. Joints that follow others count.
    pub joints: Vec<String>,
    /// The actuators of the export, for formats that have some beside joints. Those of MJCF are called as their joints,
    /// unless an `export.toml` says otherwise.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub actuators: Vec<String>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde's form")]
fn word<S: Serializer>(format: &Format, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(format.word())
}

/// How a program goes from the root to the joints.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Walk {
    AsWritten,
    DepthFirst,
    DepthFirstByName,
    BreadthFirstByName,
}

use Walk::{AsWritten, BreadthFirstByName, DepthFirst, DepthFirstByName};

const PYBULLET: &str = "pybullet";

const PROGRAMS: [(&str, Format, Walk); 8] = [
    ("urdf", Format::Urdf, AsWritten),
    ("mujoco", Format::Mjcf, DepthFirst),
    ("pinocchio", Format::Urdf, DepthFirstByName),
    (PYBULLET, Format::Urdf, DepthFirst),
    ("drake", Format::Drake, DepthFirst),
    ("libsdformat", Format::Sdf, AsWritten),
    ("newton", Format::Usd, DepthFirstByName),
    ("isaac", Format::Usd, BreadthFirstByName),
];

impl Walk {
    fn rule(self) -> &'static str {
        match self {
            AsWritten => "as the URDF has them",
            DepthFirst => "depth first",
            DepthFirstByName => "depth first, the joints of a link by name",
            BreadthFirstByName => "breadth first, the joints of a link by name",
        }
    }

    /// All joints of a robot, as indices, by their names in the program.
    pub(super) fn joints(self, of: &Structure, names: &[String]) -> Vec<usize> {
        let tree = &of.tree;
        if self == AsWritten {
            return (0..names.len()).collect();
        }
        let is_broad = self == BreadthFirstByName;
        let mut found = Vec::new();
        let mut links = VecDeque::from([tree.root]);
        while let Some(link) = if is_broad { links.pop_front() } else { links.pop_back() } {
            found.extend(tree.parent_joint[link]);
            let mut next = tree.child_joints[link].clone();
            if self != DepthFirst {
                next.sort_by_key(|joint| names[*joint].as_str());
            }
            if !is_broad {
                next.reverse();
            }
            links.extend(next.into_iter().map(|joint| tree.joint_links[joint].1));
        }
        found
    }
}

/// The order of joints and actuators in each program. The free joint of a floating base comes before them.
///
/// # Errors
/// If the joints do not form a tree, or mimics cannot be resolved.
pub fn joint_orders(robot: &Robot) -> Result<Vec<JointOrder>, ExportError> {
    let urdf = robot.description()?;
    let structure = Structure::of(&urdf)?;
    let order = |&(program, format, walk): &(&'static str, Format, Walk)| {
        let joints = Joints::new(format, &structure);
        joints.order(program, walk, joints.actuators(&urdf))
    };
    Ok(PROGRAMS.iter().map(order).collect())
}

struct Joints<'a> {
    of: &'a Structure,
    format: Format,
    names: JointNames,
    /// Their names, in joint order.
    own: Vec<String>,
}

impl<'a> Joints<'a> {
    fn new(format: Format, of: &'a Structure) -> Self {
        let names = JointNames::new(format, of);
        let own = match format {
            Format::Usd => names_of_joints(&names.joints),
            _ => names.joints.clone(),
        };
        Joints { of, format, names, own }
    }

    /// The actuators, where no `export.toml` names others.
    fn actuators(&self, urdf: &UrdfModule) -> Vec<String> {
        let actuated = (0..self.own.len()).filter(|joint| self.of.is_actuated(*joint));
        match self.format {
            Format::Mjcf => actuated.map(|joint| self.own[joint].clone()).collect(),
            Format::Drake => drake::actuators(urdf, self.of),
            _ => Vec::new(),
        }
    }

    fn order(&self, program: &'static str, walk: Walk, actuators: Vec<String>) -> JointOrder {
        // PyBullet holds a floating joint fixed.
        let is_fixed = |joint: usize| {
            program == PYBULLET && self.of.view.joints[joint].joint_type == JointType::Floating
        };
        let moving = self.moving(walk).into_iter().filter(|joint| !is_fixed(*joint));
        let joints = moving.flat_map(|joint| {
            let parts = self.names.parts[joint].iter().map(|(name, _)| name.clone());
            let parts: Vec<String> = parts.filter(|_| self.is_chain(joint)).collect();
            if parts.is_empty() { vec![self.own[joint].clone()] } else { parts }
        });
        let joints = joints.collect();
        JointOrder { program, format: self.format, rule: walk.rule(), joints, actuators }
    }

    /// The joints that move, as indices.
    fn moving(&self, walk: Walk) -> Vec<usize> {
        let joints = walk.joints(self.of, &self.own).into_iter();
        joints.filter(|joint| self.moves(*joint)).collect()
    }

    fn moves(&self, joint: usize) -> bool {
        let view = &self.of.view.joints[joint];
        match self.format {
            Format::Usd => self.of.stands_at(joint).is_none(),
            Format::Mjcf => view.num_dofs() > 0,
            Format::Sdf if view.num_dofs() == 1 && unit_axis(view.axis).is_none() => false,
            _ => view.num_dofs() > 0 && !self.of.follows_fixed(joint),
        }
    }

    /// Whether a joint of several DOFs is a chain of joints.
    fn is_chain(&self, joint: usize) -> bool {
        let view = &self.of.view.joints[joint];
        match self.format {
            Format::Mjcf | Format::Sdf => true,
            Format::Drake => {
                view.joint_type == JointType::Floating && !drake::is_free(self.of, view)
            }
            _ => false,
        }
    }
}

/// The orders in the programs that load an export, as JSON.
pub(super) fn report(subject: &Subject) -> Result<Value, ExportError> {
    let format = match subject.format {
        Format::Spherized | Format::Moveit | Format::UrdfPlus | Format::ExtendedUrdf => {
            Format::Urdf
        }
        format => format,
    };
    let joints = Joints::new(format, &subject.structure);
    let actuators: Vec<String> = match format {
        Format::Mjcf => actuators::names(subject)?.into_values().collect(),
        _ => joints.actuators(&subject.urdf),
    };
    let mut all = Map::new();
    for &(program, _, walk) in PROGRAMS.iter().filter(|(_, of, _)| *of == format) {
        let order = joints.order(program, walk, actuators.clone());
        let mut said = json!({"rule": order.rule, "joints": order.joints});
        if !order.actuators.is_empty() {
            said["actuators"] = order.actuators.into();
        }
        all.insert(program.to_owned(), said);
    }
    Ok(Value::Object(all))
}

/// Which programs have the moving joints of an export in another order than the URDD. Readers of URDF are known to.
pub(super) fn note(format: Format, structure: &Structure) -> Option<Note> {
    let joints = Joints::new(format, structure);
    let is_other = |&&(_, of, walk): &&(&str, Format, Walk)| {
        of == format && format != Format::Urdf && !joints.moving(walk).is_sorted()
    };
    let programs = PROGRAMS.iter().filter(is_other).map(|(program, _, _)| *program);
    let programs: Vec<&str> = programs.collect();
    (!programs.is_empty()).then(|| Note::Order(programs.join(", ")))
}
