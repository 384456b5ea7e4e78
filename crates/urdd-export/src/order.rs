//! In which order programs have the joints and the actuators of a robot that they load from an export.
//!
//! A program keeps the order of the file, or walks the tree of links. `tests/figures/exports/order.py` holds this to
//! MuJoCo, Pinocchio, PyBullet, Drake, libsdformat and Newton. That Isaac, by PhysX, goes breadth first is from the
//! documentation of Isaac Lab 3.0, which finds PhysX' order by Newton's reader with `joint_ordering="bfs"`.

use serde_json::{Value, json};

use super::drake;
use super::error::{ExportError, Note};
use super::format::Format;
use super::parts::JointNames;
use super::structure::Structure;
use super::usd::names::names_of_joints;
use urdd_format::urdf::{JointType, UrdfModule};
use urdd_kinematics::rotation::unit_axis;
use urdd_robot::Robot;

/// The joints and actuators of a robot in a program.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct JointOrder {
    /// The program; `urdf` for the order of the URDF, which is that of a URDD too.
    pub program: &'static str,
    /// The export that the program loads.
    pub format: Format,
    /// How the program orders joints.
    pub rule: &'static str,
    /// The joints that move, in the order of their positions, as they are called there. Joints that follow others count.
    pub joints: Vec<String>,
    /// The actuators of the export, for formats that have some beside joints.
    pub actuators: Vec<String>,
}

/// How a program goes from the root to the joints.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Walk {
    AsWritten,
    DepthFirst,
    DepthFirstByName,
    BreadthFirst,
}

use Walk::{AsWritten, BreadthFirst, DepthFirst, DepthFirstByName};

const PROGRAMS: [(&str, Format, Walk); 8] = [
    ("urdf", Format::Urdf, AsWritten),
    ("mujoco", Format::Mjcf, DepthFirst),
    ("pinocchio", Format::Urdf, DepthFirstByName),
    ("pybullet", Format::Urdf, DepthFirst),
    ("drake", Format::Drake, DepthFirst),
    ("libsdformat", Format::Sdf, AsWritten),
    ("newton", Format::Usd, DepthFirst),
    ("isaac", Format::Usd, BreadthFirst),
];

impl Walk {
    fn rule(self) -> &'static str {
        match self {
            AsWritten => "as the URDF has them",
            DepthFirst => "depth first",
            DepthFirstByName => "depth first, the joints of a link by name",
            BreadthFirst => "breadth first",
        }
    }

    /// All joints of a robot, as indices.
    fn joints(self, of: &Structure) -> Vec<usize> {
        let (tree, joints) = (&of.tree, &of.view.joints);
        match self {
            AsWritten => return (0..joints.len()).collect(),
            BreadthFirst => {
                let links = of.links_after(tree.root);
                return links.into_iter().filter_map(|link| tree.parent_joint[link]).collect();
            }
            DepthFirst | DepthFirstByName => {}
        }
        let mut found = Vec::new();
        let mut links = vec![tree.root];
        while let Some(link) = links.pop() {
            found.extend(tree.parent_joint[link]);
            let mut next = tree.child_joints[link].clone();
            if self == DepthFirstByName {
                next.sort_by_key(|joint| joints[*joint].name.as_str());
            }
            links.extend(next.into_iter().rev().map(|joint| tree.joint_links[joint].1));
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
    Ok(PROGRAMS.iter().map(|program| order(program, &urdf, &structure)).collect())
}

fn order(
    &(program, format, walk): &(&'static str, Format, Walk),
    urdf: &UrdfModule,
    structure: &Structure,
) -> JointOrder {
    let names = JointNames::new(format, structure);
    let own = match format {
        Format::Usd => names_of_joints(&names.joints),
        _ => names.joints.clone(),
    };
    let moving =
        walk.joints(structure).into_iter().filter(|joint| moves(structure, format, *joint));
    let joints = moving.flat_map(|joint| match &names.parts[joint][..] {
        parts if !parts.is_empty() && is_chain(structure, format, joint) => {
            parts.iter().map(|(name, _)| name.clone()).collect()
        }
        _ => vec![own[joint].clone()],
    });
    let joints = joints.collect();
    let actuated = (0..own.len()).filter(|joint| structure.is_actuated(*joint));
    let actuators = match format {
        Format::Mjcf => actuated.map(|joint| own[joint].clone()).collect(),
        Format::Drake => drake::actuators(urdf, structure),
        _ => Vec::new(),
    };
    JointOrder { program, format, rule: walk.rule(), joints, actuators }
}

/// Whether a joint moves in an export.
fn moves(of: &Structure, format: Format, joint: usize) -> bool {
    let view = &of.view.joints[joint];
    match format {
        Format::Usd => of.stands_at(joint).is_none(),
        Format::Mjcf => view.num_dofs() > 0,
        Format::Sdf if view.num_dofs() == 1 && unit_axis(view.axis).is_none() => false,
        _ => view.num_dofs() > 0 && !of.follows_fixed(joint),
    }
}

/// Whether an export has a joint of several DOFs as a chain of joints.
fn is_chain(of: &Structure, format: Format, joint: usize) -> bool {
    let is_floating = of.view.joints[joint].joint_type == JointType::Floating;
    match format {
        Format::Mjcf | Format::Sdf => true,
        Format::Drake => is_floating && !drake::is_free(of, &of.view.joints[joint]),
        _ => false,
    }
}

/// The orders in the programs that load an export of a format, as JSON.
pub(super) fn report(format: Format, urdf: &UrdfModule, structure: &Structure) -> Value {
    let format = match format {
        Format::Spherized | Format::Moveit => Format::Urdf,
        format => format,
    };
    let programs = PROGRAMS.iter().filter(|(_, of, _)| *of == format);
    let each = programs.map(|program| {
        let order = order(program, urdf, structure);
        let mut said = json!({"rule": order.rule, "joints": order.joints});
        if !order.actuators.is_empty() {
            said["actuators"] = order.actuators.into();
        }
        (order.program.to_owned(), said)
    });
    Value::Object(each.collect())
}

/// Which programs have the moving joints of an export in another order than the URDD. Readers of URDF are known to.
pub(super) fn note(format: Format, structure: &Structure) -> Option<Note> {
    let is_other = |(_, of, walk): &&(&str, Format, Walk)| {
        let joints = walk.joints(structure).into_iter();
        *of == format && !joints.filter(|joint| moves(structure, format, *joint)).is_sorted()
    };
    let programs = PROGRAMS.iter().filter(|_| format != Format::Urdf).filter(is_other);
    let programs: Vec<&str> = programs.map(|(program, _, _)| *program).collect();
    (!programs.is_empty()).then(|| Note::Order(programs.join(", ")))
}
