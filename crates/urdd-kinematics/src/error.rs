//! What can be wrong with modules, and with a configuration.

use thiserror::Error;

use super::pose::PoseError;
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::JointType;

/// Modules that kinematics cannot be computed from: where, and why.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}{pointer}: {fault}", .module.name())]
pub struct KinematicsError {
    /// The module with the fault.
    pub module: ModuleKind,
    /// JSON Pointer to the value at fault.
    pub pointer: String,
    /// What is wrong with it.
    pub fault: Fault,
}

impl KinematicsError {
    pub(super) fn chain(pointer: impl Into<String>, fault: Fault) -> Self {
        let (module, pointer) = (ModuleKind::Chain, pointer.into());
        Self {
            module,
            pointer,
            fault,
        }
    }

    pub(super) fn dof(pointer: impl Into<String>, fault: Fault) -> Self {
        let (module, pointer) = (ModuleKind::Dof, pointer.into());
        Self {
            module,
            pointer,
            fault,
        }
    }

    pub(super) fn bounds(pointer: impl Into<String>, fault: Fault) -> Self {
        let (module, pointer) = (ModuleKind::Bounds, pointer.into());
        Self {
            module,
            pointer,
            fault,
        }
    }
}

/// What is wrong with a value of a module.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Fault {
    /// A list that goes with another one has another length.
    #[error("{found} entries, expected {expected}: one for each {what}")]
    Length {
        /// What each entry is for.
        what: &'static str,
        /// Number of those.
        expected: usize,
        /// Number of entries.
        found: usize,
    },
    /// An index that points at nothing.
    #[error("there is no {what} {index}: the number of them is {count}")]
    OutOfRange {
        /// What is indexed.
        what: &'static str,
        /// The index.
        index: u32,
        /// Number of things there are.
        count: usize,
    },
    /// A joint that moves the root.
    #[error("this joint moves link {link}, the root")]
    RootMoved {
        /// Index of the root.
        link: usize,
    },
    /// Two joints that move one link.
    #[error("link {link} is moved by joint {first} already")]
    MovedTwice {
        /// Index of the link.
        link: usize,
        /// Index of the joint that comes first in the list.
        first: usize,
    },
    /// A link that hangs on nothing, or on a ring of joints.
    #[error("no path leads from the root to this link")]
    Unreached,
    /// A joint with more or fewer DOFs than joints of its type have.
    #[error("{found} DOFs, expected {expected} of a {joint_type} joint")]
    DofCount {
        /// Type of the joint.
        joint_type: JointType,
        /// Number of DOFs that such a joint has.
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
    /// A mimic joint whose position is not one number.
    #[error("a {0} joint cannot be a mimic joint: its position is not one number")]
    MimicType(JointType),
    /// A joint that needs an axis and has none.
    #[error("a {0} joint needs an axis")]
    NoAxis(JointType),
    /// An axis that is not of length 1.
    #[error("not a unit vector: its length is {norm}")]
    AxisNotUnit {
        /// Its length.
        norm: f64,
    },
    /// Numbers that are no rigid transform.
    #[error(transparent)]
    Pose(#[from] PoseError),
    /// A number that is infinite, or none.
    #[error("{0} is not a finite number")]
    NotFinite(f64),
}

/// A configuration that has no link poses.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ConfigurationError {
    /// More or fewer values than DOFs.
    #[error("the configuration has {found} values, the robot {expected} DOFs")]
    Length {
        /// Number of DOFs.
        expected: usize,
        /// Number of values.
        found: usize,
    },
    /// A value that is infinite, or none.
    #[error("value {dof_idx} of the configuration is {value}, not a finite number")]
    NotFinite {
        /// Index of the DOF.
        dof_idx: usize,
        /// The value.
        value: f64,
    },
    /// Values so large that a link's pose is beyond what `f64` can hold.
    #[error("link {link_idx} is out of the range of 64-bit numbers")]
    Overflow {
        /// Index of the link.
        link_idx: usize,
    },
}

impl ConfigurationError {
    /// Whether a configuration has so many values, and all are finite.
    pub(crate) fn check(configuration: &[f64], expected: usize) -> Result<(), Self> {
        let found = configuration.len();
        if found != expected {
            return Err(Self::Length { expected, found });
        }
        match configuration.iter().position(|q| !q.is_finite()) {
            Some(dof_idx) => Err(Self::NotFinite {
                dof_idx,
                value: configuration[dof_idx],
            }),
            None => Ok(()),
        }
    }
}
