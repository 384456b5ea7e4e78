//! Faults of a recipe.

use std::fmt;

use thiserror::Error;

use urdd_directory::position::Position;
use urdd_format::escape;
use urdd_format::urdf::JointType;

/// Formats a position as `:line:column`.
pub(super) struct Place(pub Option<Position>);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(at) => write!(f, ":{at}"),
            None => Ok(()),
        }
    }
}

/// A joint type as written in URDFs and recipes.
pub(super) fn joint_type_word(joint_type: JointType) -> String {
    joint_type.as_str().to_ascii_lowercase()
}

/// Shortens a word that may be very long.
fn shortened(word: &str) -> String {
    const SHOWN: usize = 60;
    match word.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &word[..end]),
        None => word.to_owned(),
    }
}

/// Formats a suggestion: `; did you mean …?`
struct Meant<'a>(&'a Option<String>);

impl fmt::Display for Meant<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(name) => write!(f, "; did you mean `{}`?", escape::line(name)),
            None => Ok(()),
        }
    }
}

/// A fault of a recipe.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RecipeFault {
    /// Not valid TOML, or a value of the wrong type.
    #[error("{}", escape::line(.0))]
    Toml(String),
    /// An unknown key.
    #[error("unknown key `{}`{}; expected one of: {known}", escape::line(key), Meant(nearest))]
    UnknownKey {
        /// The key.
        key: String,
        /// The nearest known key.
        nearest: Option<String>,
        /// The known keys.
        known: String,
    },
    /// A missing key.
    #[error("`{0}` is missing")]
    MissingKey(&'static str),
    /// The recipe has no parts.
    #[error("there is no part; write one or more tables `[[part]]`, each with `id` and `source`")]
    NoParts,
    /// More links than a robot may have, or more parts.
    #[error(
        "a robot has at most {limit} links, and the parts have {found} or more: use fewer parts, or drop links"
    )]
    TooManyLinks {
        /// Number of links up to the part at which reading stopped.
        found: usize,
        /// Maximum number of links.
        limit: usize,
    },
    /// More text in the parts than a robot may have.
    #[error("{what} of the parts have more than {} MiB in total: use fewer parts, or shorter ones", limit >> 20)]
    TooLong {
        /// The kind of text: `the URDFs`, `the composition modules`, `the edits of skips`.
        what: &'static str,
        /// Maximum number of bytes.
        limit: u64,
    },
    /// A name or prefix that cannot be written in a URDF.
    #[error("{what} `{}` {why}", escape::line(&shortened(found)))]
    BadWord {
        /// The kind of word: `the name`, `the prefix`, `the link`, `the joint`.
        what: &'static str,
        /// The word.
        found: String,
        /// What is wrong with it and what to do.
        why: String,
    },
    /// An id that cannot be used in `part/link`.
    #[error("`{}` is not a valid id; use letters, digits, `_` and `-`", escape::line(.0))]
    BadId(String),
    /// Two parts with the same id.
    #[error(
        "another part has the id `{}`{}; ids must differ in more than upper and lower case", escape::line(id), Place(*first)
    )]
    IdTwice {
        /// The id.
        id: String,
        /// Position of the first part.
        first: Option<Position>,
    },
    /// An attachment that does not name a part.
    #[error("`{}` does not name a part; write `part/link`", escape::line(.0))]
    NoPartNamed(String),
    /// A part that does not exist.
    #[error("there is no part `{}`{}", escape::line(name), Meant(nearest))]
    UnknownPart {
        /// Its name.
        name: String,
        /// The nearest existing id.
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
        /// The nearest existing name.
        nearest: Option<String>,
    },
    /// Two parts without an attachment.
    #[error(
        "parts `{}` and `{}` are both unattached, but a robot has one root; give one of them `attach`",
        escape::line(first),
        escape::line(second)
    )]
    TwoRoots {
        /// The first.
        first: String,
        /// The second.
        second: String,
    },
    /// A part that is attached to itself.
    #[error("part `{}` is attached to itself; `attach.to` must name a link of another part", escape::line(.0))]
    OnItself(String),
    /// Parts that are attached to each other in a cycle.
    #[error(
        "parts are attached in a cycle: `{}`; one part must be unattached, or attached to `[base]`", escape::line(&.0.join("` to `"))
    )]
    Ring(Vec<String>),
    /// A joint type that URDF does not define.
    #[error(
        "unknown joint type `{}`{}; expected one of: revolute, continuous, prismatic, fixed, floating, planar, spherical",
        escape::line(found),
        Meant(nearest)
    )]
    UnknownJointType {
        /// The word.
        found: String,
        /// The nearest joint type.
        nearest: Option<String>,
    },
    /// A joint without the limits that it needs.
    #[error(
        "a {} joint needs limits: `limit = {{ lower = …, upper = …, effort = …, velocity = … }}`", joint_type_word(*.0)
    )]
    NoLimit(JointType),
    /// A lower limit above the upper one.
    #[error("the lower limit, {lower}, is above the upper one, {upper}")]
    CrossedLimit {
        /// The lower limit.
        lower: f64,
        /// The upper limit.
        upper: f64,
    },
    /// A zero axis.
    #[error("the axis is 0 0 0, which has no direction")]
    ZeroAxis,
    /// A number that is infinite or NaN.
    #[error("a number of `{0}` is not finite")]
    NotFinite(&'static str),
    /// The root link of a part cannot be dropped.
    #[error(
        "`{}` is the root of part `{}`, and without it nothing is left; leave out the part, or drop links farther from the root",
        escape::line(link),
        escape::line(part)
    )]
    DropsRoot {
        /// The part.
        part: String,
        /// The link.
        link: String,
    },
    /// A link or joint is needed but dropped.
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
        /// The entry in `drop` that removes it.
        with: String,
    },
    /// A mimic joint whose driver is dropped.
    #[error(
        "joint `{}` of part `{}` follows `{}`, which is dropped with `{}`; freeze the joint, or drop its child link too",
        escape::line(joint),
        escape::line(part),
        escape::line(driver),
        escape::line(with)
    )]
    DriverDropped {
        /// The part.
        part: String,
        /// The mimic joint.
        joint: String,
        /// The joint that it mimics.
        driver: String,
        /// The entry in `drop` that removes it.
        with: String,
    },
    /// A fixed joint cannot be frozen.
    #[error("joint `{}` of part `{}` is already fixed", escape::line(joint), escape::line(part))]
    FreezesFixed {
        /// The part.
        part: String,
        /// The joint.
        joint: String,
    },
    /// A frozen joint with the wrong number of values.
    #[error(
        "joint `{}` of part `{}` has {expected} DOF{}, but there {} {found}", escape::line(joint), escape::line(part), if *expected == 1 { "" } else { "s" }, if *found == 1 { "is" } else { "are" }
    )]
    FreezeCount {
        /// The part.
        part: String,
        /// The joint.
        joint: String,
        /// Number of values that it needs.
        expected: usize,
        /// Number of values found.
        found: usize,
    },
    /// A joint frozen outside its limits.
    #[error(
        "joint `{}` of part `{}` moves from {lower} to {upper}, so it cannot be frozen at {value}",
        escape::line(joint),
        escape::line(part)
    )]
    FreezeBeyond {
        /// The part.
        part: String,
        /// The joint.
        joint: String,
        /// The given position.
        value: f64,
        /// Its lower limit.
        lower: f64,
        /// Its upper limit.
        upper: f64,
    },
    /// A name that occurs twice.
    #[error(
        "the {what} `{}` comes from {first} and from {second}; give one of them a `prefix`, or another name",
        escape::line(name)
    )]
    Clash {
        /// The kind of thing with the name.
        what: &'static str,
        /// The name in the combined robot.
        name: String,
        /// The first origin of the name.
        first: String,
        /// The second origin of the name.
        second: String,
    },
    /// An XML prefix with two different namespaces.
    #[error(
        "the XML prefix `{}` means `{}` in one part and `{}` in part `{}`; rename one of them in its URDF",
        escape::line(prefix),
        escape::line(first),
        escape::line(second),
        escape::line(part)
    )]
    Namespace {
        /// The prefix.
        prefix: String,
        /// Its first namespace.
        first: String,
        /// Its namespace in the part.
        second: String,
        /// The part.
        part: String,
    },
    /// An entry of `names` in the wrong form.
    #[error(
        "`{}` does not say where links and joints are named; write `element` for its text, or `element@attribute`", escape::line(.0)
    )]
    BadName(String),
}
