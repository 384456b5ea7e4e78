//! The mesh files that a URDF references: how they are stored.

pub(crate) mod layout;
#[doc(hidden)]
pub mod names;
pub(crate) mod original;
pub(crate) mod plain;
pub(crate) mod written;

pub use original::MeshCount;
