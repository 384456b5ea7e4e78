//! The Universal Robot Description Directory (URDD): a robot to ask about itself ([`robot`]), the format and its
//! published schemas ([`mod@format`]), the validator that checks a URDD from any producer ([`validate`]), and the reference
//! generator (`generate`). `SPEC.md` is the normative text.
//!
//! ```
//! # #[cfg(feature = "generate")] {
//! use urdd::robot::{InverseSettings, Robot, ShapeKind, Target};
//!
//! # let folder = tempfile::tempdir()?;
//! # let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/conformance/robots/welding_arm.urdf");
//! # let path = folder.path().join("welding_arm");
//! # urdd::generate::generate(urdf.as_ref(), &path, &Default::default(), &())?;
//! let robot = Robot::open(path)?;
//! let q = robot.configurations()?.random(7);
//! let poses = robot.link_poses(&q)?;
//! let torch = robot.link("torch")?;
//! println!("the torch is at {}", poses[torch].translation);
//!
//! let target = Target::pose(torch, poses[torch]);
//! let start = robot.configurations()?.zero();
//! let found = robot.inverse_kinematics(&target, &start, &InverseSettings::default())?;
//! println!("and from {start:?} it gets there at {:?}", found.nearest().configuration);
//!
//! let proximity = robot.proximity(ShapeKind::Pieces)?;
//! for pair in proximity.nearest(&q, 1)? {
//!     println!("{} and {} are {:.3} m apart", pair.links[0], pair.links[1], pair.distance);
//! }
//! println!("in collision: {}", proximity.in_collision(&q)?);
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod cancellation;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[cfg(feature = "generate")]
pub mod combine;
#[cfg(feature = "conformance")]
pub mod conformance;
pub mod directory;
pub mod document;
pub mod export;
pub mod format;
#[cfg(feature = "generate")]
pub mod generate;
pub mod geometry;
pub mod kinematics;
pub mod learn;
#[cfg(feature = "generate")]
pub mod process;
pub mod report;
pub mod robot;
pub mod skips;
pub mod validate;
#[cfg(feature = "view")]
pub mod view;
pub mod xml;

/// The Rust code in README.md is compiled and run with the tests.
#[cfg(all(doctest, feature = "cli"))]
#[doc = include_str!("../README.md")]
pub struct Readme;
