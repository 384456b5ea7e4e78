//! The result of examining one URDD or URDF.

use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::check::{Check, panic_message};
use urdd_format::report::{Kind, Size, Urdd, Verdict};

/// One examined URDD or URDF.
pub struct Examined {
    /// Its report, still without the results of the checks.
    pub report: Urdd,
    /// The result of every rule, in order of code.
    pub checks: Vec<Check>,
}

impl Examined {
    /// One that could not be examined, for this reason.
    pub fn without_checks(kind: Kind, name: &str, verdict: Verdict, reason: String) -> Self {
        let report = Urdd { verdict, reason: Some(reason), ..blank(kind, name) };
        Examined { report, checks: Vec::new() }
    }

    /// Examines a URDD or URDF. If it cannot be read, or if the program crashes outside a rule, its report says so; others
    /// still have their reports.
    pub fn caught<E: Display>(
        kind: Kind,
        name: &str,
        examine: impl FnOnce() -> Result<Examined, E>,
    ) -> Examined {
        let without_checks =
            |verdict, reason| Examined::without_checks(kind, name, verdict, reason);
        match catch_unwind(AssertUnwindSafe(examine)) {
            Ok(Ok(examined)) => examined,
            Ok(Err(error)) => without_checks(Verdict::Unreadable, error.to_string()),
            Err(panic) => {
                let message = panic_message(&*panic);
                let reason = format!(
                    "the program crashed: {message}; this is a bug in the program, please report it"
                );
                without_checks(Verdict::Incomplete, reason)
            }
        }
    }
}

/// The report on a URDD before anything is known about it. `path` is its path in the report.
pub fn blank(kind: Kind, path: &str) -> Urdd {
    Urdd {
        kind,
        path: path.to_owned(),
        name: None,
        xacro_arguments: Vec::new(),
        verdict: Verdict::Pass,
        reason: None,
        size: Size::default(),
        modules: Vec::new(),
        checks: Vec::new(),
        findings: Vec::new(),
        not_checked: Vec::new(),
        geometry_not_verified: Vec::new(),
        model_not_verified: None,
        programs: Vec::new(),
        imported: None,
    }
}
