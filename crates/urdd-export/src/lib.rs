//! Exports robots to the formats of programs that do not read URDDs.
//!
//! [`export`] creates the text and the mesh files that it references in memory; the caller writes them. Every file
//! states its source. The same URDD gives the same bytes.
//!
//! | format | for | holds |
//! |---|---|---|
//! | [`Format::Srdf`] | MoveIt, and what reads SRDF | the pairs of links that need no check, and why |
//! | [`Format::Urdf`] | any reader of URDF | the robot, with our shapes as collision geometry |
//! | [`Format::Drake`] | Drake | the same, with pairs of links as collision filter groups |
//! | [`Format::Mjcf`] | MuJoCo | bodies, joints, our shapes as geoms, `<exclude>` and `<pair>` for pairs |
//! | [`Format::Curobo`] | cuRobo | spheres by link, and pairs of links that are ignored, as YAML |
//! | [`Format::Foam`] | readers of Foam's JSON | spheres by link |
//!
//! ```
//! use urdd_export::{Format, Options, export};
//! use urdd_robot::Robot;
//!
//! # let folder = tempfile::tempdir()?;
//! # let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/../../conformance/robots/gripper.urdf");
//! # let path = folder.path().join("gripper");
//! # urdd_generate::generate(urdf.as_ref(), &path, &Default::default(), &())?;
//! let robot = Robot::open(&path)?;
//! let srdf = export(&robot, Format::Srdf, &Options::default())?;
//! assert!(srdf.text.contains("<disable_collisions "));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contacts;
mod drake;
mod element;
mod error;
mod format;
mod joints;
mod meshes;
mod mjcf;
mod names;
mod numbers;
mod options;
mod output;
mod pairs;
mod spheres;
mod srdf;
mod srdf_import;
mod srdf_merge;
mod subject;
mod urdf;
mod urdf_elements;

use urdd_robot::Robot;

pub use contacts::link_pairs;
pub use error::{ExportError, Note};
pub use format::Format;
pub use options::{Options, SphereBudget};
pub use output::Export;
pub use pairs::{Contacts, LinkPair, MixedPair};
pub use spheres::SphereRates;
pub use srdf_import::{ImportError, ImportedSkips, import_srdf};
pub use srdf_merge::{MergedSrdf, SrdfError, merge_srdf};

use subject::Subject;

/// Exports a robot.
///
/// # Errors
/// If a required module is missing or unusable, and in the other cases of [`ExportError`].
pub fn export(robot: &Robot, format: Format, options: &Options) -> Result<Export, ExportError> {
    let subject = Subject::new(robot, format, options)?;
    match format {
        Format::Srdf => srdf::export(&subject),
        Format::Urdf => urdf::export(&subject),
        Format::Drake => drake::export(&subject),
        Format::Mjcf => mjcf::export(&subject),
        Format::Curobo => spheres::curobo::export(&subject),
        Format::Foam => spheres::foam::export(&subject),
    }
}
