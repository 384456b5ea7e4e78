//! The validator's report, as `--format json` writes it.

use super::index::Count;
use super::object::{module, object, string_enum};

/// Version of the report's own format.
pub const REPORT_VERSION: &str = "1.0.0";

module! {
    /// What a run of `urdd validate` found.
    pub struct Report {
        /// The program.
        pub tool: Tool,
        /// Version of the specification that was checked against.
        pub spec_version: String,
        /// Every URDD, in the order of the paths given, then by name.
        pub urdds: Vec<Urdd>,
        /// Ignores of the settings that matched nothing.
        pub stale_ignores: Vec<StaleIgnore>,
        /// Sums over all URDDs.
        pub totals: Totals,
    }
}

object! {
    /// The program that wrote a report.
    pub struct Tool {
        /// Its name.
        pub name: String,
        /// Its version.
        pub version: String,
    }
}

object! {
    /// One URDD.
    pub struct Urdd {
        /// Its folder's path from the path that was given, with forward slashes; its own name where
        /// that path was the URDD itself.
        pub path: String,
        /// Name of the robot; null where no module says it.
        pub name: Option<String>,
        /// What came of it.
        pub verdict: Verdict,
        /// Why it is unreadable; else null.
        pub reason: Option<String>,
        /// How large the robot is.
        pub size: Size,
        /// Its modules.
        pub modules: Vec<Module>,
        /// Every rule, in order of code.
        pub checks: Vec<CheckStatus>,
        /// What was found: by module, then by severity and code.
        pub findings: Vec<Finding>,
    }
}

object! {
    /// How large a robot is; null where no module says it.
    pub struct Size {
        /// Number of links.
        pub links: Option<Count>,
        /// Number of joints.
        pub joints: Option<Count>,
        /// Number of degrees of freedom.
        pub dofs: Option<Count>,
    }
}

string_enum! {
    /// What came of examining a URDD.
    pub enum Verdict {
        /// Nothing found at or above the severity at which a run fails.
        Pass = "pass",
        /// Something found.
        Fail = "fail",
        /// The folder could not be read.
        Unreadable = "unreadable",
        /// A rule crashed: a fault of this program. The URDD is not fully examined.
        Incomplete = "incomplete",
    }
}

object! {
    /// A module of a URDD.
    pub struct Module {
        /// Its name.
        pub name: String,
        /// Its folder, relative to the URDD's root.
        pub path: String,
        /// Its version; null where it has none.
        pub version: Option<String>,
        /// `1.0` or `legacy`; null for extensions and unknown modules.
        pub profile: Option<String>,
    }
}

object! {
    /// What became of a rule.
    pub struct CheckStatus {
        /// Its code.
        pub code: String,
        /// What became of it.
        pub status: Status,
        /// Why it was skipped, or how it crashed; else null.
        pub reason: Option<String>,
    }
}

string_enum! {
    /// What became of a rule.
    pub enum Status {
        /// It found nothing.
        Passed = "passed",
        /// It found something.
        Failed = "failed",
        /// It did not run.
        Skipped = "skipped",
        /// It ran into a fault of its own.
        Crashed = "crashed",
    }
}

string_enum! {
    /// How bad a finding is.
    pub enum Severity {
        /// A MUST that is not kept.
        Error = "error",
        /// A SHOULD that is not kept, or an odd robot.
        Warning = "warning",
        /// Worth knowing.
        Info = "info",
    }
}

object! {
    /// Something that was found, or several of the same.
    pub struct Finding {
        /// Code of the rule.
        pub code: String,
        /// Name of the rule.
        pub name: String,
        /// How bad it is, settings applied.
        pub severity: Severity,
        /// The severity that the rule has without settings.
        pub default_severity: Severity,
        /// Clause of the specification.
        pub clause: String,
        /// The module; null where it is about none.
        pub module: Option<String>,
        /// The file, relative to the URDD's root, with forward slashes.
        pub file: Option<String>,
        /// JSON Pointer into the document.
        pub pointer: Option<String>,
        /// Line in the file, from 1.
        pub line: Option<Count>,
        /// Column in the line, in characters, from 1.
        pub column: Option<Count>,
        /// What is wrong, and what to do.
        pub message: String,
        /// What should be there.
        pub expected: Option<String>,
        /// What is there.
        pub actual: Option<String>,
        /// Where numbers were compared: the tolerance, in their unit.
        pub tolerance: Option<f64>,
        /// How many findings this one stands for.
        pub count: Count,
        /// The next few of these.
        pub more: Vec<Place>,
    }
}

object! {
    /// Another place of a finding.
    pub struct Place {
        /// The file.
        pub file: Option<String>,
        /// JSON Pointer into the document.
        pub pointer: Option<String>,
        /// Line in the file, from 1.
        pub line: Option<Count>,
        /// Column in the line, in characters, from 1.
        pub column: Option<Count>,
        /// What should be there.
        pub expected: Option<String>,
        /// What is there.
        pub actual: Option<String>,
    }
}

object! {
    /// An ignore of the settings that matched nothing.
    pub struct StaleIgnore {
        /// Code of the rule.
        pub code: String,
        /// The pattern.
        pub path: String,
    }
}

object! {
    /// Sums over all URDDs.
    pub struct Totals {
        /// Number of URDDs.
        pub urdds: Count,
        /// Number of errors.
        pub error: Count,
        /// Number of warnings.
        pub warning: Count,
        /// Number of informations.
        pub info: Count,
    }
}
