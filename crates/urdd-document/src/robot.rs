//! The robot of `urdf_module` or of the source URDF, with URDF's defaults filled in, and its degrees of freedom (SPEC 5.8).

use std::collections::HashMap;
use std::f64::consts::PI;
use std::ops::Range;

use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion};

use crate::pose::{has_quaternions, rotation_of_quaternion, rotation_of_rpy, unit_quaternion};
use urdd_format::dof::Quantity;
use urdd_format::meshes::GeometryKind;
pub use urdd_format::urdf::Limit;
use urdd_format::urdf::{self as v1, JointType};

/// A robot.
#[derive(Debug, Clone, Default)]
pub struct Robot {
    /// Its name.
    pub name: String,
    /// Its links, in link order.
    pub links: Vec<Link>,
    /// Its joints, in joint order.
    pub joints: Vec<Joint>,
    link_by_name: HashMap<String, usize>,
    joint_by_name: HashMap<String, usize>,
}

/// A link.
#[derive(Debug, Clone)]
pub struct Link {
    /// Its name.
    pub name: String,
    /// Its mass properties, if any.
    pub inertial: Option<Inertial>,
    /// Its visual elements.
    pub visual: Vec<Element>,
    /// Its collision elements.
    pub collision: Vec<Element>,
}

impl Link {
    /// Its visual or its collision elements.
    pub fn elements(&self, kind: GeometryKind) -> &[Element] {
        match kind {
            GeometryKind::Visual => &self.visual,
            GeometryKind::Collision => &self.collision,
        }
    }
}

/// A visual or collision element.
#[derive(Debug, Clone)]
pub struct Element {
    /// Its shape, if any.
    pub geometry: Option<v1::Geometry>,
    /// Pose of the shape in the link's frame.
    pub origin: Origin,
}

/// A pose in URDF notation, with defaults filled in.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Origin {
    /// Position, m.
    pub xyz: [f64; 3],
    /// Rotation: fixed-axis roll, pitch, yaw, rad.
    pub rpy: [f64; 3],
    /// The quaternion x, y, z, w that replaces `rpy`, if any (SPEC 6.1.9).
    pub quat_xyzw: Option<[f64; 4]>,
}

impl Origin {
    fn of_v1(origin: Option<&v1::Origin>, quaternions: bool) -> Self {
        Origin {
            xyz: origin.and_then(|origin| origin.xyz).unwrap_or_default(),
            rpy: origin.and_then(|origin| origin.rpy).unwrap_or_default(),
            quat_xyzw: origin.and_then(|origin| origin.quat_xyzw).filter(|_| quaternions),
        }
    }

    /// Its rotation.
    pub fn rotation(&self) -> Matrix3<f64> {
        let Some([x, y, z, w]) = self.quat_xyzw else { return rotation_of_rpy(self.rpy) };
        // One of zeros says nothing, and the rotation is none (SPEC 6.1.9).
        unit_quaternion([w, x, y, z]).map_or_else(Matrix3::identity, rotation_of_quaternion)
    }

    /// It as a rigid motion, m.
    pub fn motion(&self) -> Isometry3<f64> {
        let rotation = Rotation3::from_matrix_unchecked(self.rotation());
        Isometry3::from_parts(self.xyz.into(), UnitQuaternion::from_rotation_matrix(&rotation))
    }
}

/// Mass properties.
#[derive(Debug, Clone, Copy)]
pub struct Inertial {
    /// Centre of mass and axes of `inertia`, in the link's frame.
    pub origin: Origin,
    /// Mass, kg.
    pub mass: Option<f64>,
    /// xx, xy, xz, yy, yz, zz, kg m²; missing elements are 0.
    pub inertia: Option<[f64; 6]>,
}

/// A joint.
#[derive(Debug, Clone)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Its type of motion.
    pub joint_type: JointType,
    /// Its frame in the parent link's frame.
    pub origin: Origin,
    /// Its axis as written, or (1, 0, 0).
    pub axis: [f64; 3],
    /// Name of the parent link.
    pub parent: String,
    /// Name of the child link.
    pub child: String,
    /// Its limits. Legacy modules write absent limits as zeros, which count as absent.
    pub limit: Option<Limit>,
    /// The joint that it mimics.
    pub mimic: Option<Mimic>,
}

/// A mimic: `multiplier * position of joint + offset`.
#[derive(Debug, Clone)]
pub struct Mimic {
    /// Name of the joint to follow.
    pub joint: String,
    /// Factor.
    pub multiplier: f64,
    /// Offset.
    pub offset: f64,
}

impl Robot {
    /// Index of a link.
    pub fn link(&self, name: &str) -> Option<usize> {
        self.link_by_name.get(name).copied()
    }

    /// Index of a joint.
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joint_by_name.get(name).copied()
    }
}

impl Joint {
    /// Number of DOFs of a joint of this type, mimic or not (SPEC 5.8).
    pub fn num_dofs(&self) -> usize {
        dofs(self.joint_type).len()
    }

    /// The mimic, unless the joint is fixed and cannot follow.
    pub fn active_mimic(&self) -> Option<&Mimic> {
        match self.joint_type {
            JointType::Fixed => None,
            _ => self.mimic.as_ref(),
        }
    }

    /// Whether the joint has an axis (SPEC 6.3.4).
    pub fn has_axis(&self) -> bool {
        matches!(
            self.joint_type,
            JointType::Revolute | JointType::Continuous | JointType::Prismatic | JointType::Planar
        )
    }

    /// Position limits of a limited joint (SPEC 6.5.2).
    pub fn position_limits(&self) -> Option<(f64, f64)> {
        let limit = self.limit?;
        match (self.joint_type, limit.lower, limit.upper) {
            (JointType::Revolute | JointType::Prismatic, lower, upper)
                if lower.is_some() || upper.is_some() =>
            {
                Some((lower.unwrap_or(0.0), upper.unwrap_or(0.0)))
            }
            _ => None,
        }
    }
}

/// The DOFs of a joint of this type (SPEC 5.8): of each the suffix that its name adds to its joint's name, and what it
/// measures.
fn dofs(joint_type: JointType) -> &'static [(&'static str, Quantity)] {
    use Quantity::{Angle, Length};
    match joint_type {
        JointType::Fixed => &[],
        JointType::Revolute | JointType::Continuous => &[("", Angle)],
        JointType::Prismatic => &[("", Length)],
        JointType::Planar => &[("/trans_x", Length), ("/trans_y", Length), ("/rot", Angle)],
        JointType::Floating => &[
            ("/trans_x", Length),
            ("/trans_y", Length),
            ("/trans_z", Length),
            ("/rot_x", Angle),
            ("/rot_y", Angle),
            ("/rot_z", Angle),
        ],
        JointType::Spherical => &[("/rot_x", Angle), ("/rot_y", Angle), ("/rot_z", Angle)],
    }
}

/// The robot of a URDF, or of `urdf_module`, which is a complete copy of it.
pub fn of_urdf(urdf: &v1::UrdfModule) -> Robot {
    let quaternions = has_quaternions(urdf.version.as_deref());
    let link = |link| from_v1_link(link, quaternions);
    let joint = |joint| from_v1_joint(joint, quaternions);
    let mut robot = Robot {
        name: urdf.name.clone(),
        links: urdf.links.iter().map(link).collect(),
        joints: urdf.joints.iter().map(joint).collect(),
        ..Robot::default()
    };
    // For duplicate names, the first one counts; URD002 and URD003 report them.
    for (index, link) in robot.links.iter().enumerate() {
        robot.link_by_name.entry(link.name.clone()).or_insert(index);
    }
    for (index, joint) in robot.joints.iter().enumerate() {
        robot.joint_by_name.entry(joint.name.clone()).or_insert(index);
    }
    robot
}

fn from_v1_link(link: &v1::Link, quaternions: bool) -> Link {
    let element = |geometry: &Option<v1::Geometry>, origin| Element {
        geometry: geometry.clone(),
        origin: Origin::of_v1(origin, quaternions),
    };
    let inertial = link.inertial.as_ref().map(|inertial| Inertial {
        origin: Origin::of_v1(inertial.origin.as_ref(), quaternions),
        mass: inertial.mass.as_ref().map(|mass| mass.value),
        inertia: inertial.inertia.as_ref().map(|i| {
            [i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz].map(|element| element.unwrap_or(0.0))
        }),
    });
    let visual = link.visual.iter().map(|of| element(&of.geometry, of.origin.as_ref())).collect();
    let collision = link.collision.iter().map(|of| element(&of.geometry, of.origin.as_ref()));
    Link { name: link.name.clone(), inertial, visual, collision: collision.collect() }
}

fn from_v1_joint(joint: &v1::Joint, quaternions: bool) -> Joint {
    Joint {
        name: joint.name.clone(),
        joint_type: joint.joint_type,
        origin: Origin::of_v1(joint.origin.as_ref(), quaternions),
        axis: joint.axis.as_ref().and_then(|axis| axis.xyz).unwrap_or([1.0, 0.0, 0.0]),
        parent: joint.parent.link.clone(),
        child: joint.child.link.clone(),
        limit: joint.limit,
        mimic: joint.mimic.as_ref().map(|mimic| Mimic {
            joint: mimic.joint.clone(),
            multiplier: mimic.multiplier.unwrap_or(1.0),
            offset: mimic.offset.unwrap_or(0.0),
        }),
    }
}

/// The degrees of freedom of a robot, in joint order.
#[derive(Debug, Clone)]
pub struct DofLayout {
    /// DOFs of each joint.
    pub dofs_of_joint: Vec<Range<usize>>,
    /// Joint of each DOF.
    pub joint_of_dof: Vec<usize>,
}

impl DofLayout {
    /// The degrees of freedom of a robot. With `mimics_too`, mimic joints have their own.
    pub fn new(robot: &Robot, mimics_too: bool) -> DofLayout {
        let mut layout = DofLayout {
            dofs_of_joint: Vec::with_capacity(robot.joints.len()),
            joint_of_dof: Vec::new(),
        };
        for (index, joint) in robot.joints.iter().enumerate() {
            let start = layout.joint_of_dof.len();
            let dofs = if mimics_too { joint.num_dofs() } else { own_dofs(joint) };
            layout.joint_of_dof.extend((0..dofs).map(|_| index));
            layout.dofs_of_joint.push(start..start + dofs);
        }
        layout
    }

    /// The joint of a DOF, and its place among that joint's DOFs.
    pub fn place(&self, dof: usize) -> Option<(usize, usize)> {
        let joint = *self.joint_of_dof.get(dof)?;
        let first = self.dofs_of_joint.get(joint)?.start;
        Some((joint, dof.checked_sub(first)?))
    }
}

/// Number of DOFs that a joint contributes to the robot. A mimic joint of a single-DOF type contributes none.
pub fn own_dofs(joint: &Joint) -> usize {
    match (joint.num_dofs(), &joint.mimic) {
        (1, Some(_)) => 0,
        (dofs, _) => dofs,
    }
}

/// The suffix that a DOF's name adds to its joint's name (empty for a joint with one DOF), and the quantity that it
/// measures. `place` is its place among the joint's DOFs.
pub fn describe(joint_type: JointType, place: usize) -> Option<(&'static str, Quantity)> {
    dofs(joint_type).get(place).copied()
}

/// Bounds of an unlimited DOF (SPEC 6.5.3). `place` is its place among the joint's DOFs.
pub fn bounds_without_limits(joint_type: JointType, place: usize) -> Option<[f64; 2]> {
    let (_, quantity) = describe(joint_type, place)?;
    let end = match quantity {
        Quantity::Angle => PI,
        Quantity::Length => 1.0,
    };
    Some([-end, end])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As SPEC 5.8 counts them.
    #[test]
    fn every_dof_of_every_joint_type_is_described() {
        let numbers = JointType::ALL.iter().map(|joint_type| {
            let described = (0..).take_while(|place| describe(*joint_type, *place).is_some());
            (*joint_type, described.count())
        });
        let stated = [
            (JointType::Revolute, 1),
            (JointType::Continuous, 1),
            (JointType::Prismatic, 1),
            (JointType::Fixed, 0),
            (JointType::Floating, 6),
            (JointType::Planar, 3),
            (JointType::Spherical, 3),
        ];
        assert_eq!(numbers.collect::<Vec<_>>(), stated);
    }
}
