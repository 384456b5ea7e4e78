//! The reference generator: a URDF becomes a URDD, each module a pure function of those before it.
//!
//! [`generate`] makes one URDD, [`batch`] many. It imports nothing from `validate`, nor the other
//! way about: both are written from SPEC.md.

pub mod batch;
mod bounded;
mod bounds;
mod carry_over;
mod chain;
mod connections;
mod dof;
mod error;
pub mod fault;
mod geometry_stages;
mod kinematics_samples;
mod meshes;
mod metadata;
pub mod note;
mod old;
mod pose;
mod robot;
mod selection;
mod shapes;
mod solids;
mod source;
mod stages;
mod urdf;

pub use connections::MOST_LINKS_WITH_PAIRS;
pub use error::GenerateError;
pub use kinematics_samples::NUM_SAMPLED;
pub use meshes::{PackagePathError, Packages};
pub use robot::{Generated, MadeModule, Progress, Settings, generate};
pub use selection::{Selection, UnknownModule};
pub use source::{SourceRobot, read_urdf};
