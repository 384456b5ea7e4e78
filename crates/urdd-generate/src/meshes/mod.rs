//! The mesh files that a URDF references: how they are found and stored.

pub(crate) mod inspect;
pub(crate) mod layout;
#[doc(hidden)]
pub mod names;
pub(crate) mod original;
pub(crate) mod package;
pub(crate) mod plain;
pub(crate) mod resolve;
pub(crate) mod roots;
#[doc(hidden)]
pub mod sniff;
pub(crate) mod written;

pub use original::MeshCount;
pub use package::{PackagePathError, Packages};
