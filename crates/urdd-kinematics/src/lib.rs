//! Internal to urdd; no stability promise.
//!
//! Kinematics from the modules of a URDD alone, without the URDF, as consumers compute it.
//!
//! [`ForwardKinematics`] computes the pose of every link from a configuration. [`ConfigurationSpace`] provides the
//! configurations that the specification defines. [`inverse`] computes a configuration from a pose.

#[doc(hidden)]
pub mod configurations;
mod error;
mod forward;
pub mod inverse;
mod jacobian;
mod joint;
pub mod loops;
pub mod pose;
pub mod rotation;
mod travel;

pub use configurations::{ConfigurationSpace, fill, unit};
pub use error::{ConfigurationError, KinematicsError};
pub use forward::{ForwardKinematics, Step};
pub use jacobian::{Branch, Load, Place, gather};
pub use joint::{Axis, Motion, Position, has_axis, joint_motion, num_dofs};
pub use travel::{Travel, reach};
