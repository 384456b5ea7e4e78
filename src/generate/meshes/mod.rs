//! Mesh files that a URDF names: where they are, and how they are carried.

pub(crate) mod inspect;
pub(crate) mod layout;
pub(crate) mod original;
mod package;
pub(crate) mod resolve;

pub use package::{PackagePathError, Packages};
