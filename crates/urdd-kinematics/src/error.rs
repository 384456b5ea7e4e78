//! Errors in modules and configurations.

use thiserror::Error;

use urdd_format::readable::counted;
use urdd_format::registry::ModuleKind;

/// A fault in a module that prevents kinematics.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}{pointer}: {fault}", .module.name())]
pub struct KinematicsError {
    /// The module with the fault.
    pub module: ModuleKind,
    /// JSON Pointer to the invalid value.
    pub pointer: String,
    /// What is wrong with it.
    pub fault: String,
}

impl KinematicsError {
    fn of(module: ModuleKind, pointer: impl Into<String>, fault: impl Into<String>) -> Self {
        Self { module, pointer: pointer.into(), fault: fault.into() }
    }

    pub(super) fn chain(pointer: impl Into<String>, fault: impl Into<String>) -> Self {
        Self::of(ModuleKind::Chain, pointer, fault)
    }

    pub(super) fn dof(pointer: impl Into<String>, fault: impl Into<String>) -> Self {
        Self::of(ModuleKind::Dof, pointer, fault)
    }

    pub(super) fn bounds(pointer: impl Into<String>, fault: impl Into<String>) -> Self {
        Self::of(ModuleKind::Bounds, pointer, fault)
    }
}

/// Why link poses cannot be computed for a configuration.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ConfigurationError {
    /// The number of values is not the number of DOFs.
    #[error(
        "the configuration has {}, but the robot has {}",
        counted(*.found, "value"),
        counted(*.expected, "DOF")
    )]
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
