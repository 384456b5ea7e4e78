//! The tables of `NAME.export.toml`.

use std::collections::BTreeMap;

use serde::Deserialize;
use thiserror::Error;
use toml::Spanned;

use super::JointGains;
use crate::ExportError;
use urdd_directory::position::Position;
use urdd_robot::RobotError;

pub(super) type Name = Spanned<String>;

/// A value, or the byte offset of what is wrong, and what.
pub(super) type Placed<T> = Result<T, (usize, String)>;

/// What is wrong with a value, and where.
pub(super) fn wrong<T, V>(value: &Spanned<V>, reason: String) -> Placed<T> {
    Err((value.span().start, reason))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    pub robot: Name,
    #[serde(default)]
    pub base: BaseTable,
    #[serde(default)]
    pub group: Vec<Spanned<GroupTable>>,
    #[serde(default)]
    pub end_effector: Vec<EndEffectorTable>,
    #[serde(default)]
    pub frames: FramesTable,
    #[serde(default)]
    pub actuators: ActuatorsTable,
    #[serde(default)]
    pub limits: LimitsTable,
    #[serde(default)]
    pub contact: ContactTable,
    #[serde(default)]
    pub curobo: CuroboTable,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub(super) struct BaseTable {
    pub floating: bool,
    pub poses: BTreeMap<Name, Spanned<Vec<f64>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GroupTable {
    pub name: Name,
    pub base: Option<Name>,
    pub tip: Option<Name>,
    pub joints: Option<Vec<Name>>,
    pub groups: Option<Vec<Name>>,
    #[serde(default)]
    pub passive: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EndEffectorTable {
    pub name: Name,
    pub group: Name,
    pub parent_group: Option<Name>,
    pub parent_link: Name,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub(super) struct FramesTable {
    pub tools: Vec<Name>,
    pub imus: Vec<Name>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub(super) struct ActuatorsTable {
    pub bandwidth: Option<Spanned<f64>>,
    pub joint: BTreeMap<Name, Spanned<JointGains>>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub(super) struct LimitsTable {
    pub acceleration: Option<Spanned<f64>>,
    pub jerk: Option<Spanned<f64>>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub(super) struct ContactTable {
    pub friction: Option<Spanned<f64>>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub(super) struct CuroboTable {
    pub ee_link: Option<Name>,
    pub retract: Option<Name>,
    pub locked: BTreeMap<Name, Spanned<f64>>,
}

/// Errors of a file with what exports need.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SetupError {
    /// The content is wrong.
    #[error("{}{}: {reason}", .file.escape_debug(), .at.map_or(String::new(), |at| format!(":{at}")))]
    Content {
        /// The file.
        file: String,
        /// The place.
        at: Option<Position>,
        /// What is wrong.
        reason: String,
    },
    /// The file cannot be read.
    #[error("{}: {reason}", .file.escape_debug())]
    Unreadable {
        /// The file.
        file: String,
        /// Why.
        reason: String,
    },
    /// A query on the robot failed.
    #[error(transparent)]
    Robot(#[from] ExportError),
}

impl From<RobotError> for SetupError {
    fn from(error: RobotError) -> Self {
        SetupError::Robot(error.into())
    }
}
