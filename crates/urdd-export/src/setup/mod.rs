//! What exports need and a URDD does not say: planning groups, end effectors, tool frames, the kind of base, gains.
//!
//! It is guessed from the structure of the robot (`guess`), written for a person to change (`write`), and
//! read from `NAME.export.toml` beside the URDD `NAME` (`read`). Every name in it is checked when it is read.

mod guess;
#[doc(hidden)]
pub mod guesser;
mod read;
mod write;

use std::collections::BTreeMap;

use thiserror::Error;
use toml::Spanned;

use crate::ExportError;
use urdd_directory::export_toml::{JointGains, Name};
use urdd_directory::position::Position;
use urdd_directory::range::Range;
use urdd_robot::RobotError;

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

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Group {
    pub name: String,
    pub members: Members,
    /// Whether nothing drives its joints: casters.
    pub passive: bool,
}

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
    pub parent_group: Option<usize>,
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

pub(super) fn contains_itself(group: &str) -> String {
    format!("the group `{}` contains itself", group.escape_debug())
}

/// A value, or the byte offset of what is wrong, and what.
pub(super) type Placed<T> = Result<T, (usize, String)>;

/// What is wrong with a value, and where.
pub(super) fn wrong<T, V>(value: &Spanned<V>, reason: String) -> Placed<T> {
    Err((value.span().start, reason))
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

/// The frequency below which a joint follows its actuator.
pub(crate) const BANDWIDTH: Range = Range::real("bandwidth", 0.01, 1000.0, "Hz");

/// It where nobody chose it, Hz.
pub(crate) const USUAL_BANDWIDTH: f64 = 10.0;

/// Whether a name is a pattern, if no joint has it.
pub(super) fn is_pattern(name: &str) -> bool {
    name.contains('*')
}

/// Whether a pattern stands for a name: `*` stands for any letters, or none.
pub(super) fn stands_for(pattern: &str, name: &str) -> bool {
    let mut parts = pattern.split('*');
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = name.strip_prefix(first) else { return false };
    let Some(last) = parts.next_back() else { return rest.is_empty() };
    for part in parts {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

/// The tables of joints: what says more about a joint comes later, and counts. That is a name, or the longer pattern.
pub(super) fn by_breadth(
    all: &BTreeMap<Name, Spanned<JointGains>>,
) -> Vec<(&Name, &Spanned<JointGains>)> {
    let mut all: Vec<_> = all.iter().collect();
    all.sort_by_key(|(name, _)| breadth(name.get_ref()));
    all
}

/// The number of letters of a pattern; that of a name is above all.
fn breadth(name: &str) -> usize {
    if is_pattern(name) { name.replace('*', "").len() } else { usize::MAX }
}

/// The gains of joints, and for each of their words what set it.
#[derive(Default)]
pub(super) struct Chosen<'a> {
    pub gains: BTreeMap<usize, JointGains>,
    by: BTreeMap<(usize, &'static str), &'a str>,
}

impl<'a> Chosen<'a> {
    /// Adds what a table says of a joint, over what others said.
    pub fn add(&mut self, joint: usize, name: &'a Name, own: JointGains) -> Placed<()> {
        let JointGains { kp, kv, armature, name: called, kind, ctrlrange, forcerange } = own;
        let mut all = self.gains.remove(&joint).unwrap_or_default();
        self.set((joint, "kp"), name, kp, &mut all.kp)?;
        self.set((joint, "kv"), name, kv, &mut all.kv)?;
        self.set((joint, "armature"), name, armature, &mut all.armature)?;
        self.set((joint, "name"), name, called, &mut all.name)?;
        self.set((joint, "kind"), name, kind, &mut all.kind)?;
        self.set((joint, "ctrlrange"), name, ctrlrange, &mut all.ctrlrange)?;
        self.set((joint, "forcerange"), name, forcerange, &mut all.forcerange)?;
        self.gains.insert(joint, all);
        Ok(())
    }

    fn set<T>(
        &mut self,
        place: (usize, &'static str),
        name: &'a Name,
        from: Option<T>,
        to: &mut Option<T>,
    ) -> Placed<()> {
        let Some(value) = from else { return Ok(()) };
        let other = self.by.insert(place, name.get_ref());
        let is_even = |other: &&str| breadth(other) == breadth(name.get_ref());
        if let Some(other) = other.filter(is_even) {
            let [one, other] = [name.get_ref().as_str(), other].map(str::escape_debug);
            let word = place.1;
            let why = format!(
                "`{other}` and `{one}` say `{word}` of one joint, and neither is longer: say it in a table of the joint"
            );
            return wrong(name, why);
        }
        *to = Some(value);
        Ok(())
    }

    /// Whether two actuators have this name.
    pub fn is_given_twice(&self, name: &str) -> bool {
        self.gains.values().filter(|of| of.name.as_deref() == Some(name)).nth(1).is_some()
    }
}
