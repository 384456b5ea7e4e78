//! Why a model is of no use.

use thiserror::Error;

/// Why a model is of no use.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ModelError {
    /// A list is of another length than what it goes with.
    #[error("{pointer}: there are {found} entries, where {what} asks for {expected}")]
    Length {
        /// The place in the document, as a JSON pointer.
        pointer: String,
        /// How many there are.
        found: usize,
        /// How many there must be.
        expected: usize,
        /// What asks for them.
        what: &'static str,
    },
    /// An index is beyond the last.
    #[error("{pointer}: DOF {index} is not one of the robot's {count}")]
    Dof {
        /// The place in the document, as a JSON pointer.
        pointer: String,
        /// The index.
        index: usize,
        /// Number of DOFs.
        count: usize,
    },
    /// A number is not finite, or one that must be positive is not.
    #[error("{pointer}: a number is not finite, or not positive where it must be")]
    Number {
        /// The place in the document, as a JSON pointer.
        pointer: String,
    },
    /// There is nothing where the network needs at least one value.
    #[error("{pointer}: there is none; the network needs at least one")]
    NoValues {
        /// The place in the document, as a JSON pointer.
        pointer: String,
    },
    /// There is no layer.
    #[error("/layers: there is none; the network needs at least one")]
    NoLayer,
}
