//! Internal to urdd; no stability promise.
//!
//! What programs do with a URDF: what they refuse whole, what they leave out, and what they read otherwise than it says.
//! A *reader* is a model of one program's way to read, one file a program, and is held to that program by
//! `tests/figures/programs`. A reader takes any bytes.

mod drake;
mod effect;
mod fault;
mod file;
mod look;
mod mesh;
mod mujoco;
mod number;
mod part;
mod pinocchio;
mod prelude;
mod program;
mod pybullet;
mod rapidxml;
mod sdformat;
mod space;
mod strict;
mod three;
mod tinyxml;
mod tinyxml1;
mod tree;
mod unknown;
mod urdfdom;
mod usd;

pub use effect::{Deed, Effect, Effects};
pub use fault::{Fault, MASSLESS, MASSLESS_WITH_OTHERS};
pub use file::File;
pub use mesh::{ColladaFacts, Format, Measures, Mesh, MeshFacts, ObjFacts, StlFacts};
pub use part::Part;
pub use program::Program;
