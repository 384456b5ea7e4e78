//! Internal to urdd; no stability promise.
//!
//! Kinematics from the modules of a URDD alone, without the URDF, as consumers compute it.
//!
//! [`ForwardKinematics`] computes the pose of every link from a configuration. [`ConfigurationSpace`] provides the
//! configurations that the specification defines. [`inverse`] computes a configuration from a pose.

mod branch;
#[doc(hidden)]
pub mod configurations;
mod error;
mod fill;
mod forward;
mod gravity;
pub mod inverse;
mod jacobian;
mod joint;
pub mod pose;
pub mod pose_matrix;
pub mod rotation;
mod travel;

pub use branch::{Branch, Place};
pub use configurations::{ConfigurationSpace, unit};
pub use error::{ConfigurationError, KinematicsError};
pub use fill::fill;
pub use forward::ForwardKinematics;
pub use gravity::{Load, gather};
pub use joint::{has_axis, joint_motion, num_dofs};
pub use travel::Travel;
