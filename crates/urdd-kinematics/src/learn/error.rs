//! Why a model cannot be used.

use thiserror::Error;

/// Why a model cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ModelError {
    /// A list has the wrong length.
    #[error("{pointer}: found {found} entries, but {what} requires {expected}")]
    Length {
        /// JSON Pointer to the value.
        pointer: String,
        /// Number of entries.
        found: usize,
        /// Required number of entries.
        expected: usize,
        /// What determines the required number.
        what: &'static str,
    },
    /// A DOF index is out of range.
    #[error("{pointer}: DOF {index} is out of range: the robot has {count} DOFs")]
    Dof {
        /// JSON Pointer to the value.
        pointer: String,
        /// The index.
        index: usize,
        /// Number of DOFs.
        count: usize,
    },
    /// A number is not finite, or is not positive as required.
    #[error("{pointer}: a number is not finite, or not positive where it must be")]
    Number {
        /// JSON Pointer to the value.
        pointer: String,
    },
    /// A list is empty, but the network needs at least one value.
    #[error("{pointer}: empty; the network needs at least one entry")]
    NoValues {
        /// JSON Pointer to the value.
        pointer: String,
    },
    /// The network has no layers.
    #[error("/layers: empty; the network needs at least one layer")]
    NoLayer,
}
