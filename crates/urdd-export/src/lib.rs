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
//! | [`Format::Spherized`] | any reader of URDF | the robot, with these spheres as collision geometry |
//! | [`Format::Moveit`] | MoveIt 2 | a package: groups, limits, solvers, planners, controllers, a launch file, our URDF |
//! | [`Format::Sdf`] | Gazebo, Drake | links, joints, our shapes as collisions, collision filters for Drake |
//! | [`Format::UrdfPlus`] | generalized_rbda | as `urdf`, with `<loop>` and `<coupling>` |
//! | [`Format::ExtendedUrdf`] | example-parallel-robots | as `urdf`, with a YAML of pairs of links that coincide |
//! | [`Format::Usd`] | Isaac, Newton, Omniverse | rigid bodies under an articulation, joints, our shapes, filtered pairs |
//!
//! ```
//! use urdd_export::{Choices, Format, export};
//! use urdd_robot::Robot;
//!
//! # let folder = tempfile::tempdir()?;
//! # let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/../../conformance/robots/gripper.urdf");
//! # let path = folder.path().join("gripper");
//! # urdd_generate::generate(urdf.as_ref(), &path, &Default::default(), &())?;
//! let robot = Robot::open(&path)?;
//! let srdf = export(&robot, &Choices::default().options(Format::Srdf)?)?;
//! assert!(srdf.text.contains("<disable_collisions "));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// Hidden modules are public for `tests/`.
mod arrange;
mod carried;
mod choices;
mod contacts;
mod drake;
mod error;
mod format;
mod gains;
mod groups;
#[doc(hidden)]
pub mod inertia;
mod joints;
mod layout;
#[doc(hidden)]
pub mod meshes;
mod mjcf;
mod moveit;
#[doc(hidden)]
pub mod names;
mod order;
mod output;
#[doc(hidden)]
pub mod pairs;
mod sdf;
#[doc(hidden)]
pub mod setup;
mod shapes;
#[doc(hidden)]
pub mod simplify;
mod source_shapes;
#[doc(hidden)]
pub mod spheres;
mod srdf;
mod stand;
mod structure;
mod subject;
mod textures;
mod urdf;
mod urdf_elements;
mod urdf_loops;
mod usd;
mod xacro;
#[doc(hidden)]
pub mod yaml;
// What most files use.

use gains::Gains;
use layout::Layout;
use meshes::{FlatShapes, MeshFiles, MeshFormat, Painted};
use names::{Moves, Taken};
use output::Files;
use pairs::LinkPair;
use setup::Members;
use shapes::{Shape, Solid};
use stand::Stand;
use structure::Structure;
use subject::Subject;
use urdd_directory::account::Account;
use urdd_robot::Robot;
use yaml::Yaml;

pub use carried::carried_table;
pub use choices::{CHOICES, Choice, ChoiceError, Choices, KINDS, Kind, REASONS};
pub use error::ExportError;
pub use format::{Format, Limited, Ros};
pub use groups::{JointGroup, joint_groups_of_srdf};
pub use order::{JointOrder, joint_orders};
pub use output::{Export, Note};
pub use pairs::Contacts;
pub use setup::{Setup, SetupError};
pub use shapes::{ShapeCounts, Shapes};
pub use simplify::Detail;
pub use source_shapes::{Fit, NoFit};
pub use spheres::SphereRates;
pub use spheres::import::{
    ImportedSpheres, ListError, SphereFault, SpheresError, Unnamed, import_spheres, read_spheres,
};
pub use srdf::{ImportedSkips, ImportedStates, SrdfError, import_srdf, import_states};
pub use stand::base_pose;
pub use subject::{Misfit, Options};
pub use urdd_directory::export_toml::ActuatorKind;
pub use urdd_format::word::{UnknownWord, Word};
pub use urdd_spheres::model::{Sphere, SphereList};

/// Exports a robot.
///
/// # Errors
/// If an option is out of its range, if a required module is missing or unusable, and in the other cases of
/// [`ExportError`].
pub fn export(robot: &Robot, options: &Options) -> Result<Export, ExportError> {
    export_within(robot, options, &Account::default())
}

/// As [`export`], with the account of the run.
///
/// # Errors
/// As [`export`], and if the run was cancelled.
pub fn export_within(
    robot: &Robot,
    options: &Options,
    account: &Account,
) -> Result<Export, ExportError> {
    options.check()?;
    account.charge(0)?;
    let mut subject = Subject::new(robot, options, true, account)?;
    subject.lost = carried::lost(&subject);
    let mut made = match options.format {
        Format::Srdf => srdf::export(&subject),
        Format::Urdf => urdf::export(&subject),
        Format::Drake => drake::export(&subject),
        Format::Mjcf => mjcf::export(&subject),
        Format::Curobo => spheres::curobo::export(&subject),
        Format::Foam => spheres::said::foam(&subject),
        Format::Spherized => spheres::said::spherized(&subject),
        Format::Moveit => moveit::export(&subject),
        Format::Sdf => sdf::export(&subject),
        Format::Usd => usd::export(&subject),
        Format::UrdfPlus => urdf_loops::plus(&subject),
        Format::ExtendedUrdf => urdf_loops::extended(&subject),
    }?;
    made.notes.extend(subject.shape_notes.clone());
    made.notes.extend(subject.arranged.iter().chain(&subject.lost).cloned());
    made.notes.extend(order::note(subject.format, &subject.structure));
    made.report = carried::report(&subject, &made)?;
    Ok(made)
}
