//! Why no robot could be read from a URDF.

use urdd_generate::GenerateError;
use urdd_generate::fault::Fault;
use urdd_validate::code::Code;
use urdd_validate::engine::{Check, Outcome};
use urdd_validate::skip::SkipReason;

/// The rule that says why the reader refused a URDF, among those that the validator ran; the reader's own words if none does.
pub fn refusal(error: &GenerateError, checks: &[Check]) -> SkipReason {
    let fault = match error {
        GenerateError::Refused { faults, .. } => faults.first().map(|placed| &placed.fault),
        _ => None,
    };
    let failed = |code: &Code| {
        let mut checks = checks.iter();
        checks.any(|check| check.rule.code == *code && check.outcome == Outcome::Failed)
    };
    let code = fault.map_or(Code::URD011, code);
    match Some(code).filter(failed) {
        Some(code) => SkipReason::Failed(code),
        None => {
            SkipReason::Refused(fault.map_or_else(|| error.to_string(), |fault| fault.to_string()))
        }
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
        _ => Code::URD011,
    }
}
