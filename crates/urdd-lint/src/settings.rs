//! How URDFs are linted, and why rules are skipped.

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use urdd_findings::baseline::Baseline;
use urdd_findings::check::Examined;
use urdd_findings::check::{Check, Outcome};
use urdd_findings::code::Code;
use urdd_findings::part::SkipReason;
use urdd_findings::settings::Settings;
use urdd_findings::settings_file::SettingsFile;
use urdd_source::fault::Fault;
use urdd_source::{Declared, SourceError};

/// How URDFs are linted.
#[derive(Debug, Clone, Default)]
pub struct LintSettings {
    /// What is reported, and how severe it is.
    pub report: Settings,
    /// Where packages and meshes are, and how xacro files are expanded.
    pub source: urdd_source::Settings,
    /// What was found before, and is not reported.
    pub baseline: Option<Arc<Baseline>>,
    /// Whether no mesh file is read, as while somebody types: rules about the shapes of links are skipped.
    pub without_meshes: bool,
    /// Whether a xacro file is compared with the `.urdf` of its name beside it, since nobody examines that one (LNT067).
    pub compares_checked_in: bool,
}

/// The robots that a settings file declares.
pub fn declared(file: &SettingsFile) -> Vec<Declared> {
    let one = |robot: &urdd_findings::settings_file::DeclaredRobot| Declared {
        source: robot.file.clone(),
        name: robot.name.clone(),
        arguments: robot.arguments.clone(),
    };
    file.robots.iter().map(one).collect()
}

impl LintSettings {
    /// Leaves out of the result for one file what the baseline and the settings leave out, and changes severities, as
    /// [`lint`](super::lint) does. `seen` is the path that patterns of the settings match.
    pub fn apply(&self, path: Option<&Path>, seen: String, mut examined: Examined) -> Examined {
        examined.report.path = seen;
        if let (Some(baseline), Some(path)) = (&self.baseline, path) {
            baseline.apply(path, &mut examined);
        }
        let mut examined = [examined];
        self.report.apply(&mut examined);
        let [examined] = examined;
        examined
    }
}

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
