//! Why a rule was skipped.

use std::fmt;

use super::code::Code;
use urdd_document::carried_urdf::NoUrdf;
use urdd_document::module::Unusable;
use urdd_format::registry::ModuleKind;

/// Why a rule did not run, or did not run to its end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SkipReason {
    /// The module that it is about is missing.
    Absent(ModuleKind),
    /// None of the modules that it is about can be used.
    NoneUsable(&'static [ModuleKind]),
    /// A module that it needs cannot be used.
    Unusable(Unusable),
    /// The root metadata is missing or unusable.
    NoRootMetadata,
    /// The source URDF is not available.
    NoCarriedUrdf(NoUrdf),
    /// A rule that it needs found a fault.
    Failed(Code),
    /// A rule that it needs crashed.
    Crashed(Code),
    /// A rule that it needs was not among the rules to run.
    DidNotRun(Code),
    /// The rule takes something that it does not declare as a need: a fault of the rule. In debug builds it crashes.
    UndeclaredNeed,
    /// It is about version 1, and this is a legacy URDD.
    NotVersion1,
    /// It is about legacy URDDs, and this is not one.
    NotLegacy,
    /// The module's version does not contain what the rule checks.
    NotInThisVersion(ModuleKind),
    /// The edits of legacy skips are not recorded.
    EditsNotRecorded,
    /// The modules do not define the kinematics of every link.
    KinematicsOpen,
    /// Poses or configurations cannot be computed, for this reason.
    Kinematics(String),
    /// The independent kinematics cannot read the carried URDF, for this reason.
    Reference(String),
    /// Planar and floating joints of legacy URDDs use other coordinates.
    LegacyCoordinates,
    /// There are no statistics to compare distances with.
    NoStatistics(NoStatistics),
    /// A complete check takes long and was not requested: these kinds of shapes were left out.
    NotDeep(Vec<&'static str>),
    /// Counting the configurations of SPEC 8.8 takes more work than allowed.
    TooMuchWork {
        /// Whether `--deep` was requested, which allows more.
        deep: bool,
    },
    /// The URDF makes no robot, for this reason.
    Refused(String),
    /// The file has xacro macros, which were not expanded.
    NotExpanded,
    /// No mesh file is read, as while somebody types.
    WithoutMeshes,
    /// The settings ignore every finding, for this reason.
    Ignored(String),
}

/// Why there are no statistics to compare distances with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoStatistics {
    /// The module has none.
    Unusable,
    /// The number of samples is not stated.
    SamplesUnknown,
    /// The number of samples is 0.
    NoSamples,
    /// There is no list of shapes.
    NoShapes,
}

impl SkipReason {
    /// That poses or configurations cannot be computed.
    pub fn kinematics(error: impl fmt::Display) -> SkipReason {
        SkipReason::Kinematics(error.to_string())
    }

    /// Whether the URDD does not have what the rule is about, so that nothing is missed.
    pub fn is_absence(&self) -> bool {
        matches!(self, SkipReason::Absent(_) | SkipReason::NoneUsable(_))
    }

    /// Whether a fault prevented the check, so that something may be missed.
    pub fn is_obstacle(&self) -> bool {
        matches!(
            self,
            SkipReason::Unusable(_)
                | SkipReason::Failed(_)
                | SkipReason::Crashed(_)
                | SkipReason::UndeclaredNeed
                | SkipReason::KinematicsOpen
                | SkipReason::Kinematics(_)
                | SkipReason::Reference(_)
                | SkipReason::Refused(_)
                | SkipReason::NotExpanded
        )
    }

    /// Whether the rule is for the other family of URDDs.
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
            SkipReason::UndeclaredNeed => {
                f.write_str("the rule has a fault: it takes something that it does not declare")
            }
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
            SkipReason::Refused(why) => write!(f, "the URDF makes no robot: {why}"),
            SkipReason::NotExpanded => {
                f.write_str("the file has xacro macros, which were not expanded (LNT051)")
            }
            SkipReason::Ignored(reason) => write!(f, "ignored: {reason}"),
            SkipReason::WithoutMeshes => f.write_str("no mesh file was read"),
        }
    }
}
