//! The reference generator: builds a URDD from a URDF. Each module is a pure function of the modules before it.
//!
//! [`generate`] builds one URDD, [`batch`] many. The generator and the validator are each written from SPEC.md and
//! import nothing from each other.

pub mod batch;
mod bounded;
mod bounds;
mod chain;
pub mod combine;
mod composed;
mod connections;
mod context;
mod distinct;
mod dof;
mod donor;
mod error;
pub mod fault;
mod inputs;
mod kinematics_samples;
mod learned;
mod made;
mod mesh_stages;
mod meshes;
mod metadata;
mod modules;
pub mod note;
mod pose;
pub mod process;
mod product;
mod progress;
mod robot;
mod selection;
mod settings;
mod shape_documents;
mod shape_stages;
mod shapes;
mod size;
mod source;
mod stages;
pub mod train;
mod urdf;

pub use bounded::MAX_SOURCE_BYTES;
pub use composed::Composed;
pub use connections::{MOST_LINKS_IN_PAIRS, MOST_LINKS_WITH_PAIRS};
pub use error::{EditsFault, GenerateError, OutsideMesh};
pub use kinematics_samples::NUM_SAMPLED;
pub use meshes::{MeshCount, PackagePathError, Packages};
pub use modules::MadeModule;
pub use pose::{has_quaternions, of as origin_pose};
pub use progress::Progress;
pub use robot::{Generated, generate, generate_composed, generate_text};
pub use selection::{Selection, UnknownModule};
pub use settings::{MeshFormats, Pieces, Settings};
pub use size::{MOST_ELEMENTS, MOST_LINKS};
pub use source::{SourceRobot, XacroSettings, read_urdf};
