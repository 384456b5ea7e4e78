//! Joint motion as a function of the configuration.

use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

use super::error::KinematicsError;
use super::pose::is_unit;
use super::rotation::{from_rotation_vector, planar_basis};
use urdd_format::chain::{ChainModule, JointInChain};
use urdd_format::dof::DofModule;
use urdd_format::index::DofIdx;
use urdd_format::readable::counted;
use urdd_format::urdf::JointType;

/// A unit vector.
pub type Axis = Unit<Vector3<f64>>;

const DOFS: &str = "joint_idx_to_dof_idxs_mapping";
const MIMICS: &str = "joint_idx_to_mimic_mapping";

/// The scalar position of a joint: `multiplier * q[dof] + offset`.
#[derive(Debug, Clone)]
pub struct Position {
    /// The DOF that it follows; `None` if it never changes.
    pub dof: Option<usize>,
    /// What the DOF is multiplied by.
    pub multiplier: f64,
    /// What is added, rad or m.
    pub offset: f64,
}

impl Position {
    /// The position of a joint that moves by its own DOF.
    fn own(dofs: &[usize]) -> Self {
        Position { dof: dofs.first().copied(), multiplier: 1.0, offset: 0.0 }
    }

    /// The position in a configuration, rad or m.
    pub fn at(&self, q: &[f64]) -> f64 {
        match self.dof {
            Some(dof) => self.multiplier * q[dof] + self.offset,
            None => self.offset,
        }
    }
}

/// The motion of a joint, with the indices of its DOFs. They are checked, so [`Motion::at`] cannot fail on a
/// configuration of the right length.
#[derive(Debug, Clone)]
pub enum Motion {
    /// None.
    Fixed,
    /// A rotation about an axis.
    Turn {
        /// The axis.
        axis: Axis,
        /// The angle, rad.
        position: Position,
    },
    /// A translation along an axis.
    Slide {
        /// The axis.
        axis: Axis,
        /// The length, m.
        position: Position,
    },
    /// A translation in a plane, then a rotation about its normal.
    Plane {
        /// The normal.
        axis: Axis,
        /// The directions of the first two DOFs.
        basis: [Vector3<f64>; 2],
        /// Two lengths, m, and the angle, rad.
        dofs: [usize; 3],
    },
    /// A translation, then a rotation.
    Float {
        /// The translation, m, and the rotation vector, rad.
        dofs: [usize; 6],
    },
    /// A rotation.
    Ball {
        /// The rotation vector, rad.
        dofs: [usize; 3],
    },
}

impl Motion {
    /// The DOFs that move the joint.
    pub fn dofs(&self) -> &[usize] {
        match self {
            Motion::Fixed => &[],
            Motion::Turn { position, .. } | Motion::Slide { position, .. } => {
                position.dof.as_slice()
            }
            Motion::Plane { dofs, .. } | Motion::Ball { dofs } => dofs,
            Motion::Float { dofs } => dofs,
        }
    }

    /// The motion of a joint type that is not fixed; `None` without the axis or the DOFs that it needs.
    fn of(
        joint_type: JointType,
        axis: Option<Axis>,
        position: Position,
        dofs: &[usize],
    ) -> Option<Self> {
        Some(match (joint_type, axis, dofs) {
            (JointType::Revolute | JointType::Continuous, Some(axis), _) => {
                Motion::Turn { axis, position }
            }
            (JointType::Prismatic, Some(axis), _) => Motion::Slide { axis, position },
            (JointType::Planar, Some(axis), &[x, y, angle]) => {
                Motion::Plane { basis: planar_basis(&axis), axis, dofs: [x, y, angle] }
            }
            (JointType::Spherical, _, &[a, b, c]) => Motion::Ball { dofs: [a, b, c] },
            (JointType::Floating, _, &[x, y, z, a, b, c]) => {
                Motion::Float { dofs: [x, y, z, a, b, c] }
            }
            _ => return None,
        })
    }

    /// Pose of the child link's frame in the joint frame.
    pub fn at(&self, q: &[f64]) -> Isometry3<f64> {
        match self {
            Motion::Fixed => Isometry3::identity(),
            Motion::Turn { axis, position } => Isometry3::from_parts(
                Translation3::identity(),
                UnitQuaternion::from_axis_angle(axis, position.at(q)),
            ),
            Motion::Slide { axis, position } => Isometry3::from_parts(
                Translation3::from(axis.into_inner() * position.at(q)),
                UnitQuaternion::identity(),
            ),
            Motion::Plane { axis, basis: [x, y], dofs: [a, b, c] } => Isometry3::from_parts(
                Translation3::from(x * q[*a] + y * q[*b]),
                UnitQuaternion::from_axis_angle(axis, q[*c]),
            ),
            Motion::Float { dofs: [x, y, z, a, b, c] } => Isometry3::from_parts(
                Translation3::new(q[*x], q[*y], q[*z]),
                from_rotation_vector([q[*a], q[*b], q[*c]]),
            ),
            Motion::Ball { dofs: [a, b, c] } => Isometry3::from_parts(
                Translation3::identity(),
                from_rotation_vector([q[*a], q[*b], q[*c]]),
            ),
        }
    }
}

/// Number of DOFs of a joint that is not a mimic joint.
pub fn num_dofs(joint_type: JointType) -> usize {
    match joint_type {
        JointType::Fixed => 0,
        JointType::Revolute | JointType::Continuous | JointType::Prismatic => 1,
        JointType::Planar | JointType::Spherical => 3,
        JointType::Floating => 6,
    }
}

/// Whether joints of a type move along or about an axis.
pub fn has_axis(joint_type: JointType) -> bool {
    use JointType::{Continuous, Planar, Prismatic, Revolute};
    matches!(joint_type, Revolute | Continuous | Prismatic | Planar)
}

/// Checks that the per-joint lists have one entry for each joint of the chain.
pub(super) fn check_lengths(chain: &ChainModule, dof: &DofModule) -> Result<(), KinematicsError> {
    let expected = chain.joints_in_chain.len();
    let dofs = dof.joint_idx_to_dof_idxs_mapping.len();
    let mimics = dof.joint_idx_to_mimic_mapping.len();
    for (list, found) in [(DOFS, dofs), (MIMICS, mimics)] {
        if found != expected {
            let fault =
                format!("{found} entries, expected {expected}: one for each joint of chain_module");
            return Err(KinematicsError::dof(format!("/{list}"), fault));
        }
    }
    Ok(())
}

/// The DOFs of joint `idx`: the number that its type requires (none for a mimic joint), each in range.
/// [`check_lengths`] must have passed.
pub(super) fn joint_dofs(
    joint_type: JointType,
    idx: usize,
    dof: &DofModule,
) -> Result<Vec<usize>, KinematicsError> {
    let expected = num_dofs(joint_type);
    let listed = &dof.joint_idx_to_dof_idxs_mapping[idx];
    let found = counted(listed.len(), "DOF");
    let fault = match &dof.joint_idx_to_mimic_mapping[idx] {
        Some(_) if !listed.is_empty() => Some(format!("{found}, expected 0 of a mimic joint")),
        None if listed.len() != expected => {
            Some(format!("{found}, expected {expected} of a {joint_type} joint"))
        }
        _ => None,
    };
    if let Some(fault) = fault {
        return Err(KinematicsError::dof(format!("/{DOFS}/{idx}"), fault));
    }
    let places = listed.iter().enumerate();
    places.map(|(k, of)| in_range(*of, dof, || format!("/{DOFS}/{idx}/{k}"))).collect()
}

fn in_range(
    dof_idx: DofIdx,
    dof: &DofModule,
    pointer: impl Fn() -> String,
) -> Result<usize, KinematicsError> {
    let count = dof.num_dofs.get();
    if dof_idx.get() < count {
        return Ok(dof_idx.get());
    }
    let fault = format!("DOF {} is out of range: there are {count}", dof_idx.0);
    Err(KinematicsError::dof(pointer(), fault))
}

pub(super) fn motion(
    joint: &JointInChain,
    idx: usize,
    dof: &DofModule,
) -> Result<Motion, KinematicsError> {
    let joint_type = joint.joint_type;
    let dofs = joint_dofs(joint_type, idx, dof)?;
    if joint_type == JointType::Fixed {
        return Ok(Motion::Fixed);
    }
    let axis = has_axis(joint_type).then(|| axis(joint, idx)).transpose()?;
    let position = position(idx, &dofs, dof)?;
    // The axis and the number of DOFs are right, so this is a mimic joint, which has no DOFs.
    Motion::of(joint_type, axis, position, &dofs).ok_or_else(|| {
        let fault =
            format!("a {joint_type} joint cannot be a mimic joint: its position is not one number");
        KinematicsError::dof(format!("/{MIMICS}/{idx}"), fault)
    })
}

/// The pose of a joint's child link in the joint frame, for a value of each of its DOFs, rad or m. `axis` is `None` where
/// the type has none; without an axis or a value that the type needs, the pose is the identity.
pub fn joint_motion(joint_type: JointType, axis: Option<Axis>, values: &[f64]) -> Isometry3<f64> {
    let dofs: Vec<usize> = (0..values.len()).collect();
    let own = Position::own(&dofs);
    let motion = Motion::of(joint_type, axis, own, &dofs);
    let motion = motion.filter(|_| values.len() == num_dofs(joint_type));
    motion.unwrap_or(Motion::Fixed).at(values)
}

fn position(idx: usize, dofs: &[usize], dof: &DofModule) -> Result<Position, KinematicsError> {
    let Some(mimic) = &dof.joint_idx_to_mimic_mapping[idx] else { return Ok(Position::own(dofs)) };
    let pointer = |key: &str| format!("/{MIMICS}/{idx}/{key}");
    for (key, value) in [("multiplier", mimic.multiplier), ("offset", mimic.offset)] {
        if !value.is_finite() {
            let fault = format!("{value} is not a finite number");
            return Err(KinematicsError::dof(pointer(key), fault));
        }
    }
    let driver = mimic.dof_idx.map(|driver| in_range(driver, dof, || pointer("dof_idx")));
    Ok(Position { dof: driver.transpose()?, multiplier: mimic.multiplier, offset: mimic.offset })
}

fn axis(joint: &JointInChain, idx: usize) -> Result<Axis, KinematicsError> {
    let fail = |fault| KinematicsError::chain(format!("/joints_in_chain/{idx}/axis"), fault);
    let Some(axis) = joint.axis else {
        return Err(fail(format!("a {} joint needs an axis", joint.joint_type)));
    };
    let vector = Vector3::from(axis);
    let norm = vector.norm();
    if !is_unit(norm) {
        return Err(fail(format!("not a unit vector: its length is {norm}")));
    }
    Ok(Unit::new_normalize(vector))
}
