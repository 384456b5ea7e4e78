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
#[doc(hidden)]
pub mod chain;
mod checked_pieces;
pub mod combine;
#[doc(hidden)]
pub mod connections;
mod context;
#[doc(hidden)]
pub mod distinct;
mod dof;
mod donor;
mod error;
mod geometry_notes;
mod given;
mod inputs;
mod kinematics_samples;
mod learned;
mod loops;
mod made;
mod mesh_stages;
#[doc(hidden)]
pub mod meshes;
mod metadata;
mod modules;
mod named;
mod product;
mod robot;
mod selection;
mod settings;
#[doc(hidden)]
pub mod shape_documents;
#[doc(hidden)]
pub mod shapes;
mod size;
mod skipped_contacts;
mod spheres;
mod stages;

pub use error::{EditsFault, GenerateError, OutsideMesh, ReferenceFault};
pub use meshes::MeshCount;
pub use modules::MadeModule;
pub use robot::{Generated, UrddFiles, generate, generate_in_memory, generate_text};
pub use selection::{Selection, UnknownModule};
pub use settings::{MeshFormats, PIECE_TOLERANCE, PIECES, Pieces, Progress, SAMPLES, Settings};
pub(crate) use size::MOST_LINKS;
pub use urdd_learned::train::Effort;
pub use urdd_source::{
    Files as SourceFiles, MAX_SOURCE_BYTES, PackagePathError, Packages, Settings as SourceSettings,
    SourceError, XacroSettings, fault, note,
};
