//! Why rules are skipped.

use std::borrow::Cow;

use urdd_findings::check::{Check, Outcome};
use urdd_findings::code::Code;
use urdd_findings::skip::SkipReason;
use urdd_source::SourceError;
use urdd_source::fault::Fault;

/// The file has xacro macros, which were not expanded.
pub const NOT_EXPANDED: SkipReason = SkipReason::Obstacle(Cow::Borrowed(
    "the file has xacro macros, which were not expanded (LNT051)",
));
/// Xacro needs arguments that nobody gives.
pub const NEEDS_ARGUMENTS: SkipReason =
    SkipReason::Obstacle(Cow::Borrowed("the robot needs arguments (LNT065)"));
/// No mesh file is read, as while somebody types.
pub const WITHOUT_MESHES: SkipReason = SkipReason::LeftOut(Cow::Borrowed("no mesh file was read"));

/// The URDF makes no robot, for this reason.
pub fn refused(why: &str) -> SkipReason {
    SkipReason::obstacle(format!("the URDF makes no robot: {why}"))
}

/// The rule that says why the reader refused a URDF, among those that the validator ran; the reader's own words if none does.
pub fn refusal(error: &SourceError, checks: &[Check]) -> SkipReason {
    let fault = match error {
        SourceError::Refused { faults, .. } => faults.first().map(|placed| &placed.fault),
        _ => None,
    };
    let failed = |code: &Code| {
        let mut checks = checks.iter();
        checks.any(|check| check.rule.code == *code && check.outcome == Outcome::Failed)
    };
    let code = fault.map_or(Code::URD011, code);
    match Some(code).filter(failed) {
        Some(code) => SkipReason::Failed(code),
        None => refused(&fault.map_or_else(|| error.to_string(), |fault| fault.to_string())),
    }
}

/// The rule of the validator about a fault.
fn code(fault: &Fault) -> Code {
    match fault {
        Fault::TwoLinks { .. } => Code::URD002,
        Fault::TwoJoints { .. } => Code::URD003,
        Fault::NoLinks | Fault::ManyRoots { .. } => Code::URD004,
        Fault::TwoParents { .. } => Code::URD005,
        Fault::Cycle(_) => Code::URD006,
        Fault::UnknownLink { .. } => Code::URD007,
        Fault::MimicCircle(_) => Code::URD009,
        Fault::ZeroAxis { .. } => Code::URD010,
        // Also an SRDF in place of a URDF: URD004 would speak of a missing link, and the reader names the SRDF.
        _ => Code::URD011,
    }
}
