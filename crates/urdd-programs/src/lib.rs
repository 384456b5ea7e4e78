//! Internal to urdd; no stability promise.
//!
//! What programs do with a URDF: what they refuse whole, what they leave out, and what they read otherwise than it says.
//! A *reader* is a model of one program's way to read, one file a program, and is held to that program by
//! `tests/figures/programs`. A reader takes any bytes.

mod control;
mod drake;
mod effect;
mod fault;
mod file;
mod mesh;
mod mujoco;
mod number;
mod pinocchio;
mod program;
mod pybullet;
mod sdformat;
mod three;
mod tinyxml;
mod tinyxml1;
mod tree;
mod unknown;
mod urdfdom;
mod usd;

pub use effect::{Deed, Effect, Effects, KEPT, Part};
pub use fault::{Fault, MASSLESS, MASSLESS_WITH_OTHERS};
pub use file::File;
pub use mesh::formats::{ColladaFacts, Measures, ObjFacts, StlFacts};
pub use mesh::{Format, Mesh, MeshFacts};
pub use program::Program;

/// Names that readers use.
mod prelude {
    pub use std::collections::{HashMap, HashSet};

    pub use crate::effect::{At, Effects, Look, Part, Reading};
    pub use crate::fault::*;
    pub use crate::file::{About, File};
    pub use crate::mesh::{Mesh, MeshFacts, format_fault};
    pub use crate::number::{is_space, istream, pieces, strtod, whole};
    pub(crate) use crate::tinyxml;
    pub use crate::tree::{Attribute, Node};
    pub use crate::unknown::Names;
}
