//! The reference generator: builds a URDD from a URDF. Each module is a pure function of the modules before it.
//!
//! [`generate`] builds one URDD, [`batch`] many. The generator and the validator are each written from SPEC.md and
//! import nothing from each other.

mod artifacts;
pub mod batch;
mod bounded;
mod bounds;
mod carry_over;
mod chain;
pub mod combine;
mod composed;
mod connections;
mod distinct;
mod dof;
mod edits;
mod error;
pub mod fault;
mod geometry_stages;
mod kinematics_samples;
mod learned;
mod made;
mod meshes;
mod metadata;
pub mod note;
mod old;
mod pose;
pub mod process;
mod progress;
mod reuse;
mod robot;
mod selection;
mod settings;
mod shape_documents;
mod shapes;
mod size;
mod source;
mod stages;
mod taken;
pub mod train;
mod urdf;
mod work;

pub use bounded::MAX_SOURCE_BYTES;
pub use composed::Composed;
pub use connections::{MOST_LINKS_IN_PAIRS, MOST_LINKS_WITH_PAIRS};
pub use error::{EditsFault, GenerateError, OutsideMesh};
pub use kinematics_samples::NUM_SAMPLED;
pub use meshes::{MeshCount, PackagePathError, Packages};
pub use pose::{has_quaternions, of as origin_pose};
pub use progress::Progress;
pub use robot::{Generated, MadeModule, generate, generate_composed, generate_text};
pub use selection::{Selection, UnknownModule};
pub use settings::{MeshFormats, Pieces, Settings};
pub use size::{MOST_ELEMENTS, MOST_LINKS};
pub use source::{SourceRobot, XacroSettings, read_urdf};
