//! Why a rule did not run.

use std::fmt;

use super::code::Code;
use urdd_document::carried_urdf::NoUrdf;
use urdd_document::module::Unusable;
use urdd_format::registry::ModuleKind;

/// Why a rule did not run, or could not be checked after all.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SkipReason {
    /// The module that it is about is not there.
    Absent(ModuleKind),
    /// None of the modules that it is about can be used.
    NoneUsable(&'static [ModuleKind]),
    /// A module that it needs cannot be used.
    Unusable(Unusable),
    /// There is no root metadata that can be used.
    NoRootMetadata,
    /// There is no source URDF to look at.
    NoCarriedUrdf(NoUrdf),
    /// A rule that it counts on found a fault.
    Failed(Code),
    /// A rule that it counts on crashed.
    Crashed(Code),
    /// A rule that it counts on was not among those that ran.
    DidNotRun(Code),
    /// It is about version 1, and this is a legacy URDD.
    NotVersion1,
    /// It is about legacy URDDs, and this is none.
    NotLegacy,
    /// The module is of a version that does not say what the rule is about.
    NotInThisVersion(ModuleKind),
    /// The edits of legacy skips are not recorded.
    EditsNotRecorded,
    /// The modules do not say how every link moves.
    KinematicsOpen,
    /// Poses or configurations cannot be computed, for this reason.
    Kinematics(String),
    /// The independent kinematics cannot read the carried URDF, for this reason.
    Reference(String),
    /// Planar and floating joints of legacy URDDs have other coordinates.
    LegacyCoordinates,
    /// There is nothing to compare distances with.
    NoStatistics(NoStatistics),
    /// A complete check takes long, and was not asked for: these kinds of shapes were left out.
    NotDeep(Vec<&'static str>),
    /// Counting the configurations that SPEC 8.8 asks for takes more work than a validation does.
    TooMuchWork {
        /// Whether `--deep` was asked for, which allows more.
        deep: bool,
    },
    /// Settings say to ignore every finding, for this reason.
    Ignored(String),
}

/// Why there are no statistics to compare distances with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoStatistics {
    /// The module has none.
    Unusable,
    /// It does not say over how many samples they are.
    SamplesUnknown,
    /// They are over no samples.
    NoSamples,
    /// There is no list of shapes.
    NoShapes,
}

impl SkipReason {
    /// Whether the rule is about something that this URDD does not have, so that nothing is missed.
    pub fn is_absence(&self) -> bool {
        matches!(self, SkipReason::Absent(_) | SkipReason::NoneUsable(_))
    }

    /// Whether a fault stood in the way, so that something is missed.
    pub fn is_obstacle(&self) -> bool {
        matches!(
            self,
            SkipReason::Unusable(_)
                | SkipReason::Failed(_)
                | SkipReason::Crashed(_)
                | SkipReason::KinematicsOpen
                | SkipReason::Kinematics(_)
                | SkipReason::Reference(_)
        )
    }

    /// Whether the rule is for another family of URDDs.
    pub fn is_for_others(&self) -> bool {
        matches!(self, SkipReason::NotVersion1 | SkipReason::NotLegacy)
    }
}

impl fmt::Display for SkipReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SkipReason::Absent(kind) => write!(f, "there is no {}", kind.name()),
            SkipReason::NoneUsable(kinds) => {
                let names: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
                write!(f, "there is no usable {}", names.join(" or "))
            }
            SkipReason::Unusable(unusable) => unusable.fmt(f),
            SkipReason::NoRootMetadata => f.write_str("there is no usable urdd.json"),
            SkipReason::NoCarriedUrdf(why) => why.fmt(f),
            SkipReason::Failed(code) => write!(f, "{code} found a fault"),
            SkipReason::Crashed(code) => write!(f, "{code} crashed"),
            SkipReason::DidNotRun(code) => write!(f, "{code} did not run"),
            SkipReason::NotVersion1 => f.write_str("this is a legacy URDD"),
            SkipReason::NotLegacy => f.write_str("this is not a legacy URDD"),
            SkipReason::NotInThisVersion(kind) => {
                let name = kind.name();
                write!(f, "{name} is of a version that does not say this")
            }
            SkipReason::EditsNotRecorded => {
                f.write_str("the edits of legacy skips are not recorded")
            }
            SkipReason::KinematicsOpen => f.write_str("the modules leave the kinematics open"),
            SkipReason::Kinematics(why) | SkipReason::Reference(why) => f.write_str(why),
            SkipReason::LegacyCoordinates => f.write_str(
                "planar and floating joints of legacy URDDs have other coordinates (SPEC 5.11)",
            ),
            SkipReason::NoStatistics(why) => f.write_str(match why {
                NoStatistics::Unusable => "there are no usable statistics",
                NoStatistics::SamplesUnknown => {
                    "the statistics do not say over how many samples they are"
                }
                NoStatistics::NoSamples => "the statistics are over no samples",
                NoStatistics::NoShapes => "there is no list of shapes",
            }),
            SkipReason::NotDeep(kinds) => write!(
                f,
                "{} would take long to compute again; only the first configurations were checked. Use --deep to check all",
                kinds.join(", ")
            ),
            SkipReason::TooMuchWork { deep: false } => f.write_str(
                "counting its collisions again takes more work than a validation does; use --deep, which allows more",
            ),
            SkipReason::TooMuchWork { deep: true } => f.write_str(
                "counting its collisions again takes more work than even --deep allows",
            ),
            SkipReason::Ignored(reason) => write!(f, "ignored by the settings: {reason}"),
        }
    }
}
