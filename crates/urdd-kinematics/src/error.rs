//! Errors in modules and configurations.

use thiserror::Error;

use super::pose::PoseError;
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::JointType;

/// A fault in a module that prevents kinematics: its location and kind.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}{pointer}: {fault}", .module.name())]
pub struct KinematicsError {
    /// The module with the fault.
    pub module: ModuleKind,
    /// JSON Pointer to the invalid value.
    pub pointer: String,
    /// What is wrong with it.
    pub fault: Fault,
}

impl KinematicsError {
    fn of(module: ModuleKind, pointer: impl Into<String>, fault: Fault) -> Self {
        Self { module, pointer: pointer.into(), fault }
    }

    pub(super) fn chain(pointer: impl Into<String>, fault: Fault) -> Self {
        Self::of(ModuleKind::Chain, pointer, fault)
    }

    pub(super) fn dof(pointer: impl Into<String>, fault: Fault) -> Self {
        Self::of(ModuleKind::Dof, pointer, fault)
    }

    pub(super) fn bounds(pointer: impl Into<String>, fault: Fault) -> Self {
        Self::of(ModuleKind::Bounds, pointer, fault)
    }
}

/// What is wrong with a value of a module.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Fault {
    /// A list does not have one entry per item of another list.
    #[error("{found} entries, expected {expected}: one for each {what}")]
    Length {
        /// The items of the other list.
        what: &'static str,
        /// Number of those items.
        expected: usize,
        /// Number of entries.
        found: usize,
    },
    /// An index out of range.
    #[error("{what} {index} is out of range: there are {count}")]
    OutOfRange {
        /// The indexed items.
        what: &'static str,
        /// The index.
        index: u32,
        /// Number of items.
        count: usize,
    },
    /// A joint's child is the root link.
    #[error("this joint's child is the root link, {link}")]
    RootMoved {
        /// Index of the root.
        link: usize,
    },
    /// Two joints have the same child link.
    #[error("link {link} is already the child of joint {first}")]
    MovedTwice {
        /// Index of the link.
        link: usize,
        /// Index of the first such joint in the list.
        first: usize,
    },
    /// A link that is not connected to the root, or is on a cycle of joints.
    #[error("no path leads from the root to this link")]
    Unreached,
    /// A joint whose number of DOFs does not match its type.
    #[error("{found} DOFs, expected {expected} of a {joint_type} joint")]
    DofCount {
        /// Type of the joint.
        joint_type: JointType,
        /// Number of DOFs of this type.
        expected: usize,
        /// Number of DOFs listed.
        found: usize,
    },
    /// A mimic joint that has DOFs of its own.
    #[error("{found} DOFs, expected 0 of a mimic joint")]
    MimicWithDofs {
        /// Number of DOFs listed.
        found: usize,
    },
    /// A mimic joint whose position is not a scalar.
    #[error("a {0} joint cannot be a mimic joint: its position is not one number")]
    MimicType(JointType),
    /// A joint without the axis that its type requires.
    #[error("a {0} joint needs an axis")]
    NoAxis(JointType),
    /// An axis that is not a unit vector.
    #[error("not a unit vector: its length is {norm}")]
    AxisNotUnit {
        /// Its length.
        norm: f64,
    },
    /// A pose that is not a rigid transform.
    #[error(transparent)]
    Pose(#[from] PoseError),
    /// A number that is infinite or NaN.
    #[error("{0} is not a finite number")]
    NotFinite(f64),
}

/// Why link poses cannot be computed for a configuration.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ConfigurationError {
    /// The number of values is not the number of DOFs.
    #[error("the configuration has {found} values, but the robot has {expected} DOFs")]
    Length {
        /// Number of DOFs.
        expected: usize,
        /// Number of values.
        found: usize,
    },
    /// A value is infinite or NaN.
    #[error("value {dof_idx} of the configuration is {value}, not a finite number")]
    NotFinite {
        /// Index of the DOF.
        dof_idx: usize,
        /// The value.
        value: f64,
    },
    /// Values so large that a link's pose overflows `f64`.
    #[error("the pose of link {link_idx} is beyond the range of 64-bit numbers")]
    Overflow {
        /// Index of the link.
        link_idx: usize,
    },
}

impl ConfigurationError {
    /// Checks that a configuration has `expected` values, all finite.
    ///
    /// # Errors
    /// [`ConfigurationError::Length`], [`ConfigurationError::NotFinite`].
    pub fn check(configuration: &[f64], expected: usize) -> Result<(), Self> {
        let found = configuration.len();
        if found != expected {
            return Err(Self::Length { expected, found });
        }
        match configuration.iter().position(|q| !q.is_finite()) {
            Some(dof_idx) => Err(Self::NotFinite { dof_idx, value: configuration[dof_idx] }),
            None => Ok(()),
        }
    }
}
