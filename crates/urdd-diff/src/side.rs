//! One of the two robots, opened.

use thiserror::Error;

use crate::dof_state::DofState;
use crate::shapes::Shapes;
use urdd_directory::account::Account;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::DiscoverError;
use urdd_directory::loops_toml::File;
use urdd_document::pose::has_quaternions;
use urdd_document::robot::Robot;
use urdd_document::urdd::Urdd;
use urdd_format::diff_report::DiffSide;
use urdd_format::escape;
use urdd_format::index::Count;
use urdd_format::report::{self, Kind};
use urdd_format::urdf::UrdfModule;
use urdd_source::beside::Beside;
use urdd_source::{Settings as SourceSettings, SourceError};
use urdd_xml::other_parts::OtherParts;

/// How robots are compared.
#[derive(Debug, Default)]
pub struct Options {
    /// Where the meshes of URDFs are, and how xacro files are expanded.
    pub urdf: SourceSettings,
    /// Cancellation.
    pub cancellation: Cancellation,
    /// Whether to leave out findings.
    pub without_findings: bool,
}

/// Why a robot cannot be compared.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DiffError {
    /// The path has no robot.
    #[error(transparent)]
    Discover(DiscoverError),
    /// The path has several URDDs.
    #[error(
        "{}: contains {count} URDDs; give one of them, such as {}",
        escape::line(path),
        escape::line(first)
    )]
    Several {
        /// The path as given.
        path: String,
        /// Number of URDDs.
        count: usize,
        /// Path of the first.
        first: String,
    },
    /// The URDD does not say what its robot is.
    #[error(
        "{}: {}; `urdd validate` says what is wrong with this URDD",
        escape::line(path),
        escape::line(reason)
    )]
    NoRobot {
        /// The path as given.
        path: String,
        /// Why.
        reason: String,
    },
    /// The URDF cannot be read or is not a valid robot.
    #[error("{0}")]
    Urdf(SourceError),
    /// Validation was cancelled.
    #[error("stopped before it was finished")]
    Cancelled,
}

/// A robot, with all that is compared.
pub struct Side {
    pub(super) path: String,
    pub(super) kind: Kind,
    /// As the URDF describes it.
    pub(super) robot: UrdfModule,
    /// The same with defaults.
    pub(super) view: Robot,
    /// What its URDF says where URDF defines nothing; `None` without a URDF.
    pub(super) other_parts: Option<OtherParts>,
    pub(super) shapes: Shapes,
    pub(super) dofs: Vec<DofState>,
    /// Unless it is a URDF.
    pub(super) urdd: Option<Urdd>,
    /// Its validation, if findings are compared.
    pub(super) validation: Option<report::Urdd>,
    pub(super) beside: Beside,
    /// What its source says of loops; `None` of a URDD, which has a module.
    pub(super) loops: Option<File>,
    pub(super) notes: Vec<String>,
    /// What may be made of its elements.
    pub(super) account: Account,
}

impl Side {
    pub(super) fn has_quaternions(&self) -> bool {
        has_quaternions(self.robot.version.as_deref())
    }

    /// The other parts of this robot and another, if both have a URDF.
    pub(super) fn others_beside<'a>(&'a self, other: &'a Side) -> [Option<&'a OtherParts>; 2] {
        match (&self.other_parts, &other.other_parts) {
            (Some(own), Some(others)) => [Some(own), Some(others)],
            _ => [None, None],
        }
    }

    pub(super) fn link_names(&self) -> Vec<&str> {
        self.robot.links.iter().map(|link| link.name.as_str()).collect()
    }

    pub(super) fn joint_names(&self) -> Vec<&str> {
        self.robot.joints.iter().map(|joint| joint.name.as_str()).collect()
    }

    pub(super) fn summary(&self) -> DiffSide {
        DiffSide {
            path: self.path.clone(),
            kind: self.kind,
            name: self.robot.name.clone(),
            links: Count::saturating(self.robot.links.len()),
            joints: Count::saturating(self.robot.joints.len()),
            dofs: Count::saturating(self.dofs.len()),
            verdict: self.validation.as_ref().map(|urdd| urdd.verdict),
        }
    }
}
