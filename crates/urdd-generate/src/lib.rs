//! The reference generator: builds a URDD from a URDF. Each module is a pure function of the modules before it.
//!
//! [`generate`] builds one URDD, [`batch`] many. The generator and the validator are each written from SPEC.md and
//! import nothing from each other.
//!
//! ```
//! use urdd_generate::{Settings, generate};
//!
//! # let folder = tempfile::tempdir()?;
//! # let target = folder.path().join("gripper");
//! let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/../../conformance/robots/gripper.urdf");
//! let made = generate(urdf.as_ref(), &target, &Settings::default(), &())?;
//! println!("{}: {} links, {} DOFs", made.robot_name, made.num_links, made.num_dofs);
//! for note in &made.notes {
//!     println!("{note}"); // what is odd about the URDF, and how it was read
//! }
//! assert!(target.join("urdd.json").is_file());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// Hidden modules are public for `tests/`.
pub mod batch;
mod checked_pieces;
pub mod combine;
mod context;
mod donor;
mod error;
mod given;
mod inputs;
#[doc(hidden)]
pub mod kinematics;
mod loops;
#[doc(hidden)]
pub mod made;
#[doc(hidden)]
pub mod meshes;
mod metadata;
mod modules;
mod robot;
mod selection;
mod settings;
#[doc(hidden)]
pub mod shapes;
mod stages;

pub use error::{EditsFault, GenerateError, OutsideMesh, ReferenceFault};
pub use meshes::MeshCount;
pub use modules::MadeModule;
pub(crate) use robot::MOST_LINKS;
pub use robot::{Generated, UrddFiles, generate, generate_in_memory, generate_text};
pub use selection::{Selection, UnknownModule};
pub use settings::{MeshFormats, PIECE_TOLERANCE, PIECES, Pieces, Progress, SAMPLES, Settings};
pub use urdd_learned::train::Effort;
pub use urdd_source::{
    Files as SourceFiles, MAX_SOURCE_BYTES, PackagePathError, Packages, Settings as SourceSettings,
    SourceError, XacroSettings, fault, note,
};
