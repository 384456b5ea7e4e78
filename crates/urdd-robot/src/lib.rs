//! Queries on a robot: the contents of its URDD, with names and units, and results computed from them.
//!
//! [`Robot::open`] accepts a folder or a zip archive, version 1 or legacy. [`Robot::of`] accepts any
//! [`Source`](urdd_directory::source::Source), such as one in memory. Modules are read on demand: kinematics reads
//! `chain_module`, `dof_module` and `bounds_module`, and no mesh. A URDD that fails validation still works for every
//! module that can be read. A module that cannot be read is an error that names the module and says how to generate it.
//!
//! ```
//! use urdd_robot::{Queries, Robot, ShapeKind};
//!
//! # let folder = tempfile::tempdir()?;
//! # let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/../../conformance/robots/gripper.urdf");
//! # let path = folder.path().join("gripper");
//! # urdd_generate::generate(urdf.as_ref(), &path, &Default::default(), &())?;
//! let robot = Robot::open(&path)?;
//! let q = robot.configurations()?.middle();
//! let poses = robot.link_poses(&q)?;
//! let last = robot.link_names()?.len() - 1;
//! println!("{} is at {}", robot.link_names()?[last], poses[last].translation);
//!
//! let proximity = robot.proximity(ShapeKind::Pieces)?;
//! if let Some(pair) = proximity.nearest(&q, 1)?.first() {
//!     println!("{} and {}: {:.3} m", pair.links[0], pair.links[1], pair.distance);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Lengths are in metres, angles in radians. Poses are in the root link's frame. A configuration has one value for each
//! DOF, in the order of [`Robot::dof_names`]; values beyond the bounds are allowed. Links are in the order of
//! `urdf_module`.

mod batch;
mod checked;
mod copies;
mod edge;
mod edits;
mod error;
mod follow;
mod inverse;
mod kept;
mod kinematics;
mod lanes;
mod link_spheres;
mod loop_equations;
mod loops;
mod obstacle;
mod placed_part;
pub mod proximity;
mod queries;
mod robot;
mod shapes;
mod skips;
mod source_elements;
pub mod spheres;
mod workspace;
pub mod world;

#[doc(hidden)]
pub use batch::has_room;
pub use checked::check_margin;
pub use edge::{EdgeSettings, FirstContact, Obstruction};
pub use edits::{EditedConfigurations, EditedSkips, Files};
pub use error::RobotError;
pub use inverse::Target;
pub use kept::{Configurations, LinkMass, LinkShape, Solid};
pub use kinematics::{GravitySettings, Jacobian, Payload};
pub use loop_equations::LoopJacobian;
pub use loops::{CloseSettings, Closed, ClosedBatch, LoopErrors};
pub use obstacle::{Obstacle, World};
pub use proximity::{Gradient, Overlap, PairDistance, PairGradient, Proximity};
pub use queries::Queries;
pub use robot::{Robot, SourceFile};
pub use shapes::{LinkVisual, ShapeKind};
pub use skips::{PairStatistics, Skips};
pub use source_elements::{SourceElement, SourceElements, SourceShape};
#[doc(hidden)]
pub use urdd_kinematics::fill;
pub use urdd_kinematics::inverse::{Inverse, InverseSettings, InverseSolution, Verdict};
pub use urdd_kinematics::loops::{Gap, Mobility};
pub use urdd_learned::{Clearance, CollisionModel};
pub use world::{ObstacleDistance, ObstacleGradient, WorldProximity};
