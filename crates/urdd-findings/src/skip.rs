//! Why a rule was skipped.

use std::borrow::Cow;
use std::fmt;

use super::code::Code;
use urdd_format::registry::ModuleKind;

/// Why a rule did not run, or did not run to its end. The texts are for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SkipReason {
    /// What it is about is not there, so that nothing is missed.
    Absent(Cow<'static, str>),
    /// It is for other kinds of descriptions.
    ForOthers(Cow<'static, str>),
    /// What it is about is there and not whole, so that something may be missed.
    Obstacle(Cow<'static, str>),
    /// It was left out, or what it compares with is not there.
    LeftOut(Cow<'static, str>),
    /// A rule that it needs found a fault.
    Failed(Code),
    /// A rule that it needs crashed.
    Crashed(Code),
    /// A rule that it needs was not among the rules to run.
    DidNotRun(Code),
    /// The rule takes something that it does not declare as a need: a fault of the rule. In debug builds it crashes.
    UndeclaredNeed,
    /// The settings ignore every finding, for this reason.
    Ignored(String),
}

impl SkipReason {
    /// A module that is not there.
    pub fn absent(kind: ModuleKind) -> Self {
        SkipReason::Absent(format!("there is no {}", kind.name()).into())
    }

    /// Something that is there and not whole.
    pub fn obstacle(why: impl fmt::Display) -> Self {
        SkipReason::Obstacle(why.to_string().into())
    }

    /// Whether a fault prevented the check, so that something may be missed.
    pub fn is_obstacle(&self) -> bool {
        matches!(
            self,
            SkipReason::Obstacle(_)
                | SkipReason::Failed(_)
                | SkipReason::Crashed(_)
                | SkipReason::UndeclaredNeed
        )
    }
}

impl fmt::Display for SkipReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SkipReason::Absent(why)
            | SkipReason::ForOthers(why)
            | SkipReason::Obstacle(why)
            | SkipReason::LeftOut(why) => f.write_str(why),
            SkipReason::Failed(code) => write!(f, "{code} found a fault"),
            SkipReason::Crashed(code) => write!(f, "{code} crashed"),
            SkipReason::DidNotRun(code) => write!(f, "{code} did not run"),
            SkipReason::UndeclaredNeed => {
                f.write_str("the rule has a fault: it takes something that it does not declare")
            }
            SkipReason::Ignored(reason) => write!(f, "ignored: {reason}"),
        }
    }
}
