//! Why a model cannot be used.

use thiserror::Error;

/// Why a model cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{pointer}: {fault}")]
pub struct ModelError {
    /// JSON Pointer to the value.
    pub pointer: String,
    /// What is wrong with it.
    pub fault: String,
}

impl ModelError {
    pub(super) fn new(pointer: impl Into<String>, fault: impl Into<String>) -> Self {
        Self { pointer: pointer.into(), fault: fault.into() }
    }

    /// A number is not one that the model can have.
    pub(super) fn number(pointer: impl Into<String>) -> Self {
        Self::new(pointer, "a number is not finite, or not positive where it must be")
    }

    /// A list is empty, but the network needs at least one `item`.
    pub(super) fn empty(pointer: impl Into<String>, item: &str) -> Self {
        Self::new(pointer, format!("empty; the network needs at least one {item}"))
    }
}
