//! What exports need and a URDD does not say: planning groups, end effectors, tool frames, the kind of base, gains.
//!
//! It is guessed from the structure of the robot (`guess`), written for a person to change (`write`), and
//! read from `NAME.export.toml` beside the URDD `NAME` (`read`). Every name in it is checked when it is read.

mod file;
pub(crate) mod gains;
mod guess;
mod guesser;
mod read;
#[doc(hidden)]
pub mod words;
mod write;

use std::collections::BTreeMap;

pub use file::SetupError;
use urdd_directory::export_toml::JointGains;

/// What exports need and a URDD does not say.
///
/// It belongs to the robot that it was read or guessed for: it refers to links and joints by index.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// The robot to which places refer: its name, and its numbers of links and joints.
    pub(super) of: (String, [usize; 2]),
    /// Whether the root link moves freely in the world.
    pub(super) floating: Guess<bool>,
    /// Where the base is in named configurations, if it moves freely: x, y, z in m, and the quaternion w, x, y, z.
    pub(super) base_poses: BTreeMap<String, [f64; 7]>,
    pub(super) groups: Vec<Guess<Group>>,
    pub(super) end_effectors: Vec<Guess<EndEffector>>,
    /// Links whose frames are tools, the one that cuRobo plans for first.
    pub(super) tools: Guess<Vec<usize>>,
    /// Links whose frames are those of inertial measurement units.
    pub(super) imus: Guess<Vec<usize>>,
    pub(super) gains: Gains,
    pub(super) curobo: Curobo,
    /// Acceleration and jerk of joints for which the URDF has none, rad/s² or m/s², and rad/s³ or m/s³.
    pub(super) acceleration: Option<f64>,
    pub(super) jerk: Option<f64>,
    /// The coefficient of friction of all shapes.
    pub(super) friction: Option<f64>,
}

/// A value, and why it was guessed; no reason where it was read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Guess<T> {
    pub value: T,
    pub why: String,
}

impl<T> Guess<T> {
    /// A value that was read.
    fn read(value: T) -> Self {
        let why = String::new();
        Guess { value, why }
    }
}

/// A planning group.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Group {
    pub name: String,
    pub members: Members,
    /// Whether nothing drives its joints: casters.
    pub passive: bool,
}

/// The members of a group.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Members {
    /// The joints between two links; the base is an ancestor of the tip.
    Chain { base: usize, tip: usize },
    /// Joints, in joint order.
    Joints(Vec<usize>),
    /// Other groups, by their place.
    Groups(Vec<usize>),
}

/// What a group ends with.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct EndEffector {
    pub name: String,
    /// Its own group.
    pub group: usize,
    /// The group that carries it.
    pub parent_group: Option<usize>,
    /// The link that carries it.
    pub parent_link: usize,
}

/// Gains of actuators that a person set.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Gains {
    /// The frequency below which a joint follows its actuator, Hz.
    pub bandwidth: Option<f64>,
    pub joints: BTreeMap<usize, JointGains>,
}

/// What cuRobo's robot file needs.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Curobo {
    /// The link whose pose is planned; the first tool otherwise.
    pub ee_link: Option<usize>,
    /// Joints that do not move, with their positions, rad or m.
    pub locked: BTreeMap<usize, f64>,
    /// The named configuration to which plans retract; the default configuration otherwise.
    pub retract: Option<String>,
}

/// A group and all groups in it, each once; `None` if it contains itself. `inner` has the groups that are directly in one
/// of the `count` groups.
pub(super) fn within<'a>(
    group: usize,
    count: usize,
    inner: impl Fn(usize) -> &'a [usize],
) -> Option<Vec<usize>> {
    let mut found = vec![group];
    let mut is_seen = vec![false; count];
    let mut next = 0;
    while let Some(&at) = found.get(next) {
        next += 1;
        for other in inner(at) {
            if *other == group {
                return None;
            }
            if !std::mem::replace(&mut is_seen[*other], true) {
                found.push(*other);
            }
        }
    }
    Some(found)
}

/// What is wrong with a group that contains itself.
pub(super) fn contains_itself(group: &str) -> String {
    format!("the group `{}` contains itself", group.escape_debug())
}
