//! Kinematics as a consumer does it: from the modules of a URDD alone, no URDF in sight.
//!
//! [`ForwardKinematics`] turns a configuration into the pose of every link;
//! [`ConfigurationSpace`] makes the configurations that the specification defines; [`inverse`] goes back from a pose to
//! a configuration.

mod branch;
mod configurations;
mod error;
mod forward;
pub mod inverse;
mod jacobian;
mod joint;
pub mod learn;
pub mod pose;
pub mod rotation;

pub use branch::{Branch, Place};
pub use configurations::{ConfigurationSpace, unit};
pub use error::{ConfigurationError, Fault, KinematicsError};
pub use forward::ForwardKinematics;
