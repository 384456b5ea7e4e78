//! What is wrong with a recipe.

use std::fmt;

use thiserror::Error;

use urdd_directory::position::Position;
use urdd_format::escape;
use urdd_format::urdf::JointType;

/// `:line:column`.
pub(super) struct Place(pub Option<Position>);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(at) => write!(f, ":{at}"),
            None => Ok(()),
        }
    }
}

/// The word of a joint type, as URDFs and recipes write it.
pub(super) fn joint_type_word(joint_type: JointType) -> String {
    joint_type.as_str().to_ascii_lowercase()
}

/// The beginning of a word that may be very long.
fn shortened(word: &str) -> String {
    const SHOWN: usize = 60;
    match word.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &word[..end]),
        None => word.to_owned(),
    }
}

/// `, did you mean …?`
struct Meant<'a>(&'a Option<String>);

impl fmt::Display for Meant<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(name) => write!(f, "; did you mean `{}`?", escape::line(name)),
            None => Ok(()),
        }
    }
}

/// What is wrong with a recipe.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RecipeFault {
    /// No TOML, or a value of the wrong type.
    #[error("{}", escape::line(.0))]
    Toml(String),
    /// A key that means nothing.
    #[error(
        "there is no key `{}`{}; there are: {known}",
        escape::line(key),
        Meant(nearest)
    )]
    UnknownKey {
        /// The key.
        key: String,
        /// The nearest one that there is.
        nearest: Option<String>,
        /// Those that there are.
        known: String,
    },
    /// A key that must be there.
    #[error("`{0}` is missing")]
    MissingKey(&'static str),
    /// Nothing to put together.
    #[error("there is no part; write one or more tables `[[part]]`, each with `id` and `source`")]
    NoParts,
    /// More parts, or links, than a robot may have links.
    #[error(
        "a robot has at most {limit} links, and the parts have {found} or more: use fewer parts, or drop links"
    )]
    TooManyLinks {
        /// Links up to the part at which reading stopped.
        found: usize,
        /// How many there may be.
        limit: usize,
    },
    /// Parts with more text than a robot may have.
    #[error("{what} of the parts have more than {} MiB together: use fewer parts, or shorter ones", limit >> 20)]
    TooLong {
        /// What: `the URDFs`, `the composition modules`, `the edits of skips`.
        what: &'static str,
        /// Bytes that there may be.
        limit: u64,
    },
    /// A name or prefix that a URDF cannot hold.
    #[error("{what} `{}` {why}", escape::line(&shortened(found)))]
    BadWord {
        /// What it is: `the name`, `the prefix`.
        what: &'static str,
        /// The word.
        found: String,
        /// What is wrong with it, and what to do.
        why: String,
    },
    /// An id that cannot stand in `part/link`.
    #[error("`{}` is no id; write letters, digits, `_` and `-`", escape::line(.0))]
    BadId(String),
    /// Two parts of one id.
    #[error(
        "there is another part `{}`{}; ids differ in more than upper and lower case", escape::line(id), Place(*first)
    )]
    IdTwice {
        /// The id.
        id: String,
        /// Where the first part stands.
        first: Option<Position>,
    },
    /// An attachment that names no part.
    #[error("`{}` names no part; write `part/link`", escape::line(.0))]
    NoPartNamed(String),
    /// A part that is not there.
    #[error("there is no part `{}`{}", escape::line(name), Meant(nearest))]
    UnknownPart {
        /// Its name.
        name: String,
        /// The nearest one that there is.
        nearest: Option<String>,
    },
    /// A link or joint that a part does not have.
    #[error(
        "part `{}` has no {what} `{}`{}",
        escape::line(part),
        escape::line(name),
        Meant(nearest)
    )]
    Unknown {
        /// `link` or `joint`.
        what: &'static str,
        /// The part.
        part: String,
        /// The name.
        name: String,
        /// The nearest one that there is.
        nearest: Option<String>,
    },
    /// Two parts that hang on nothing.
    #[error(
        "parts `{}` and `{}` both hang on nothing, and a robot has one root; give one of them `attach`",
        escape::line(first),
        escape::line(second)
    )]
    TwoRoots {
        /// The first.
        first: String,
        /// The second.
        second: String,
    },
    /// A part on itself.
    #[error("part `{}` hangs on itself; `attach.to` names a link of another part", escape::line(.0))]
    OnItself(String),
    /// Parts that hang on each other.
    #[error(
        "parts hang on each other in a ring: `{}`; one part must hang on nothing, or on `[base]`", escape::line(&.0.join("` on `"))
    )]
    Ring(Vec<String>),
    /// A joint of a type that URDF does not have.
    #[error(
        "there is no joint type `{}`{}; there are: revolute, continuous, prismatic, fixed, floating, planar, spherical",
        escape::line(found),
        Meant(nearest)
    )]
    UnknownJointType {
        /// The word.
        found: String,
        /// The nearest one that there is.
        nearest: Option<String>,
    },
    /// A joint that needs limits.
    #[error(
        "a {} joint has limits: `limit = {{ lower = …, upper = …, effort = …, velocity = … }}`", joint_type_word(*.0)
    )]
    NoLimit(JointType),
    /// Limits that nothing lies between.
    #[error("the lower limit, {lower}, is above the upper one, {upper}")]
    CrossedLimit {
        /// The lower limit.
        lower: f64,
        /// The upper limit.
        upper: f64,
    },
    /// An axis without direction.
    #[error("the axis is 0 0 0, which has no direction")]
    ZeroAxis,
    /// A number that is infinite, or none.
    #[error("a number of `{0}` is not finite")]
    NotFinite(&'static str),
    /// Dropping the link that all others hang on.
    #[error(
        "`{}` is the root of part `{}`: without it nothing is left; leave out the part, or drop links further out",
        escape::line(link),
        escape::line(part)
    )]
    DropsRoot {
        /// The part.
        part: String,
        /// The link.
        link: String,
    },
    /// Something needs a link or joint that is dropped.
    #[error(
        "the {what} `{}` of part `{}` is dropped, with `{}`",
        escape::line(name),
        escape::line(part),
        escape::line(with)
    )]
    Dropped {
        /// `link` or `joint`.
        what: &'static str,
        /// The part.
        part: String,
        /// Its name.
        name: String,
        /// What is dropped.
        with: String,
    },
    /// A mimic whose driver is dropped.
    #[error(
        "joint `{}` of part `{}` follows `{}`, which is dropped with `{}`; freeze the joint, or drop what hangs on it too",
        escape::line(joint),
        escape::line(part),
        escape::line(driver),
        escape::line(with)
    )]
    DriverDropped {
        /// The part.
        part: String,
        /// The joint that follows.
        joint: String,
        /// The joint that is followed.
        driver: String,
        /// What is dropped.
        with: String,
    },
    /// Freezing what does not move.
    #[error(
        "joint `{}` of part `{}` is fixed already",
        escape::line(joint),
        escape::line(part)
    )]
    FreezesFixed {
        /// The part.
        part: String,
        /// The joint.
        joint: String,
    },
    /// Freezing with too few or too many numbers.
    #[error(
        "joint `{}` of part `{}` has {expected} DOF{}, and there {} {found}", escape::line(joint), escape::line(part), if *expected == 1 { "" } else { "s" }, if *found == 1 { "is" } else { "are" }
    )]
    FreezeCount {
        /// The part.
        part: String,
        /// The joint.
        joint: String,
        /// Numbers that it takes.
        expected: usize,
        /// Numbers that are there.
        found: usize,
    },
    /// Freezing a joint where it cannot be.
    #[error(
        "joint `{}` of part `{}` moves from {lower} to {upper}, and cannot be frozen at {value}",
        escape::line(joint),
        escape::line(part)
    )]
    FreezeBeyond {
        /// The part.
        part: String,
        /// The joint.
        joint: String,
        /// Where it is to be.
        value: f64,
        /// Its lower limit.
        lower: f64,
        /// Its upper limit.
        upper: f64,
    },
    /// A name that two parts have.
    #[error(
        "the {what} `{}` comes of {first} and of {second}; give one of them a `prefix`, or another name",
        escape::line(name)
    )]
    Clash {
        /// What bears the name.
        what: &'static str,
        /// The name in the robot that is made.
        name: String,
        /// Where it comes from first.
        first: String,
        /// Where it comes from again.
        second: String,
    },
    /// A prefix of XML names that stands for two things.
    #[error(
        "the XML prefix `{}` stands for `{}` in one part and for `{}` in part `{}`; write one of them otherwise in its URDF",
        escape::line(prefix),
        escape::line(first),
        escape::line(second),
        escape::line(part)
    )]
    Namespace {
        /// The prefix.
        prefix: String,
        /// What it stands for first.
        first: String,
        /// What it stands for in the part.
        second: String,
        /// The part.
        part: String,
    },
    /// A word of `names` that is not of its form.
    #[error(
        "`{}` says not what names links and joints; write `element` for its text, or `element@attribute`", escape::line(.0)
    )]
    BadName(String),
}
