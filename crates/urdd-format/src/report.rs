//! The validator's report, the output of `--format json`.

use super::index::Count;
use super::registry::PROGRAM_VERSION;
pub use super::report_of_urdf::{
    Deed, Does, ImportedFrom, ImportedPart, ProgramEffect, ProgramResult,
};
use super::types::{module, types};

/// Version of the report's own format.
pub const REPORT_VERSION: &str = "1.2.0";

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

impl Report {
    /// Number of URDDs with this verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.urdds.iter().filter(|urdd| urdd.verdict == verdict).count()
    }
}

types! {
    /// The program that wrote a report.
    pub struct Tool {
        /// Its name.
        pub name: String,
        /// Its version.
        pub version: String,
    }
}

impl Tool {
    /// This program.
    pub fn urdd() -> Tool {
        Tool { name: "urdd".to_owned(), version: PROGRAM_VERSION.to_owned() }
    }
}

impl Urdd {
    /// Its path, and the arguments that tell it from other robots of the same file: the words of a command line.
    pub fn label(&self) -> String {
        self.label_at(&self.path)
    }

    /// As [`Urdd::label`], with another path.
    pub fn label_at(&self, path: &str) -> String {
        let words = std::iter::once(path).chain(self.xacro_arguments.iter().map(String::as_str));
        words.collect::<Vec<_>>().join(" ")
    }
}

types! {
    /// One URDD, or a URDF by itself.
    pub struct Urdd {
        /// Which of them it is.
        pub kind: Kind,
        /// Its folder's path from the path that was given, with forward slashes; its own name where
        /// that path was the URDD itself.
        pub path: String,
        /// Name of the robot; null where no module says it.
        pub name: Option<String>,
        /// The arguments, each as `name:=value`, with which xacro expanded it, where settings declare robots of the file.
        pub xacro_arguments: Vec<String>,
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
        /// What was not verified, by reason.
        pub not_checked: Vec<NotChecked>,
        /// Links whose geometry was not verified by every rule, in order of index.
        pub geometry_not_verified: Vec<LinkNotVerified>,
        /// Why the rates of `self_collision_model_module` were not verified; null where they were, and where there is no
        /// such module.
        pub model_not_verified: Option<ModelNotVerified>,
        /// What programs do with a URDF, by their readers; empty where none was asked.
        pub programs: Vec<ProgramResult>,
        /// The description that the URDF was imported from; null where it was written as a URDF.
        pub imported: Option<ImportedFrom>,
    }

    /// What was examined.
    pub enum Kind {
        /// A URDD.
        Urdd = "urdd",
        /// A URDF by itself, judged by the rules that need nothing else.
        Urdf = "urdf",
    }

    /// How large a robot is; null where no module says it.
    #[derive(Default)]
    pub struct Size {
        /// Number of links.
        pub links: Option<Count>,
        /// Number of joints.
        pub joints: Option<Count>,
        /// Number of degrees of freedom.
        pub dofs: Option<Count>,
    }

    /// What came of examining a URDD.
    pub enum Verdict {
        /// Nothing found at or above the severity at which a run fails.
        Pass = "pass",
        /// Something found.
        Fail = "fail",
        /// The folder could not be read.
        Unreadable = "unreadable",
        /// A rule crashed: a bug in this program. The URDD is not fully examined.
        Incomplete = "incomplete",
    }

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

    /// What became of a rule.
    pub struct CheckStatus {
        /// Its code.
        pub code: String,
        /// What became of it.
        pub status: Status,
        /// Why it was skipped, or how it crashed; else null.
        pub reason: Option<String>,
        /// What kind of reason a skip has; null where it was not skipped.
        pub skipped: Option<Skipped>,
    }

    /// Why a rule did not run.
    pub enum Skipped {
        /// What it is about is not there.
        Absent = "absent",
        /// It is for another family of URDDs.
        OtherFormat = "other-format",
        /// The settings say to leave it out.
        Ignored = "ignored",
        /// Something that it needs is wrong or missing: what it checks is not verified.
        NotVerified = "not-verified",
    }

    /// What was not verified.
    pub struct NotChecked {
        /// Codes of the rules that were to verify it.
        pub codes: Vec<String>,
        /// Why they could not.
        pub reason: String,
    }

    /// Why the rates of the self-collision model were not verified.
    pub struct ModelNotVerified {
        /// The rules that did not verify them.
        pub codes: Vec<String>,
        /// Why not.
        pub reasons: Vec<String>,
    }

    /// A link of which some mesh or shape was not verified.
    pub struct LinkNotVerified {
        /// Index of the link.
        pub link: Count,
        /// Codes of the rules that were to verify it.
        pub codes: Vec<String>,
        /// Why they could not.
        pub reasons: Vec<String>,
    }

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

    /// How bad a finding is; the worst is the greatest.
    pub enum Severity {
        /// A convention of old, or something worth knowing.
        Info = "info",
        /// A violated SHOULD of the specification, or an unusual robot.
        Warning = "warning",
        /// A violated MUST of the specification.
        Error = "error",
    }

    /// What a fault does to users of the URDD, in ascending order of harm.
    pub enum Consequence {
        /// Nothing is wrong, but it could be tighter, or the robot itself is unusual.
        Looseness = "looseness",
        /// The robot is shown in other colours or textures.
        Appearance = "appearance",
        /// A reader may refuse it, or read it in another way.
        Format = "format",
        /// Collision checking misses contacts, or sees some that are not there.
        Collisions = "collisions",
        /// Geometry is not there, or cannot be read.
        MissingGeometry = "missing-geometry",
        /// Something is in another place than the robot has it.
        WrongPlace = "wrong-place",
        /// The robot moves otherwise than it says.
        WrongMotion = "wrong-motion",
    }

    /// By how much something is off.
    pub struct Magnitude {
        /// How much; null where it is no finite number.
        pub value: Option<f64>,
        /// Its unit; empty for a ratio.
        pub unit: String,
    }

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
        /// Clause of the specification; null where the rule is about robots and not about URDDs.
        pub clause: Option<String>,
        /// What it does to users of the URDD.
        pub consequence: Consequence,
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
        /// What the pointer refers to, by the names of links, joints or DOFs.
        pub subject: Option<String>,
        /// What is wrong, and what to do.
        pub message: String,
        /// What should be there.
        pub expected: Option<String>,
        /// What is there.
        pub actual: Option<String>,
        /// Where numbers were compared: the tolerance, in their unit.
        pub tolerance: Option<f64>,
        /// Where numbers were compared: by how much they differ.
        pub magnitude: Option<Magnitude>,
        /// How many findings this one stands for.
        pub count: Count,
        /// All places, the worst first; the first is the finding's own.
        pub places: Vec<Place>,
        /// How many of the counted places are not listed here, because there are too many.
        pub places_cut: Count,
        /// The programs that refuse the file, or read it otherwise than it says, because of it.
        pub programs: Vec<Does>,
    }

    /// A place of a finding.
    #[derive(Default)]
    pub struct Place {
        /// The file.
        pub file: Option<String>,
        /// JSON Pointer into the document.
        pub pointer: Option<String>,
        /// Line in the file, from 1.
        pub line: Option<Count>,
        /// Column in the line, in characters, from 1.
        pub column: Option<Count>,
        /// The place in a .xacro file that it was made from; null where that is not known.
        pub written_at: Option<WrittenAt>,
        /// What should be there.
        pub expected: Option<String>,
        /// What is there.
        pub actual: Option<String>,
        /// What the pointer refers to, by the names of links, joints or DOFs.
        pub subject: Option<String>,
        /// What is wrong at this place, where that differs from the finding's message.
        pub message: Option<String>,
        /// By how much it is off.
        pub magnitude: Option<Magnitude>,
        /// Other places to look at, such as the first of two elements of which one is too many; `message` says what is
        /// there.
        pub related: Vec<Place>,
        /// Changes that mend it, each by itself, the best first.
        pub fixes: Vec<Fix>,
        /// The programs that refuse the file, or read it otherwise than it says, because of what is at this place.
        pub programs: Vec<Does>,
    }

    /// The place in a .xacro file that a part of a URDF was made from.
    pub struct WrittenAt {
        /// The file, as seen from the URDF's folder, with forward slashes.
        pub file: String,
        /// Line in the file, from 1; null where only the file is known.
        pub line: Option<Count>,
        /// Column in the line, in characters, from 1.
        pub column: Option<Count>,
        /// The macro that holds it; null outside of macros.
        pub macro_name: Option<String>,
    }

    /// A change of files that mends a place of a finding.
    pub struct Fix {
        /// What it does, as a command: "remove the second `<axis>`".
        pub message: String,
        /// Whether it is the one right answer, so that a program may make it without asking.
        pub is_safe: bool,
        /// What to change. No two of them overlap.
        pub edits: Vec<TextEdit>,
    }

    /// A text in place of another.
    pub struct TextEdit {
        /// The file, relative to the URDD's root or the URDF's folder, with forward slashes.
        pub file: String,
        /// Line of the first character that goes, from 1.
        pub line: Count,
        /// Its column in the line, in characters, from 1.
        pub column: Count,
        /// Line of the first character that stays.
        pub end_line: Count,
        /// Its column.
        pub end_column: Count,
        /// What is put there; empty to remove only.
        pub text: String,
    }

    /// An ignore of the settings that matched nothing.
    pub struct StaleIgnore {
        /// Code of the rule; null where it is for all.
        pub code: Option<String>,
        /// The pattern.
        pub path: String,
    }

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
