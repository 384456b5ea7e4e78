//! JSON output of `urdd conformance producer` and `urdd conformance validator`.

use super::index::Count;
use super::report::Tool;
use super::root_metadata::ConformanceClass;
use super::types::module;

/// Version of the format of a producer's result.
pub const PRODUCER_RESULT_VERSION: &str = "1.0.0";

/// Version of the format of a validator's result.
pub const VALIDATOR_RESULT_VERSION: &str = "1.2.0";

module! {
    /// How somebody's producer did on our robots.
    pub struct ProducerResult {
        /// The program that judged.
        pub tool: Tool,
        /// Version of the specification that was judged by.
        pub spec_version: String,
        /// The command that was run, as it was given.
        pub command: Vec<String>,
        /// The conformance class that was asked for.
        pub class: ConformanceClass,
        /// Whether everything passed except what is skipped, and no skip is stale.
        pub passed: bool,
        /// Every robot, by name.
        pub robots: Vec<RobotScore>,
        /// Every URDF that a producer must refuse or repair, by name.
        pub refused: Vec<RefusedScore>,
        /// The class that was asked for, and those below it.
        pub classes: Vec<ClassScore>,
        /// Every module that the class asks for or that a URDD has, in the specification's order.
        pub modules: Vec<ModuleScore>,
        /// Entries of the skip list that passed now, or name nothing that was run.
        pub stale_skips: Vec<String>,
    }

    /// One robot.
    pub struct RobotScore {
        /// Its name: the URDF's, without `.urdf`.
        pub robot: String,
        /// What came of it.
        pub status: ScoreStatus,
        /// Why it is skipped; else null.
        pub skipped_since: Option<String>,
        /// How the command ended.
        pub end: String,
        /// The last part of what it printed to standard output; null where the robot passed.
        pub stdout: Option<String>,
        /// The last part of what it printed to standard error; null where the robot passed.
        pub stderr: Option<String>,
        /// Why the URDD could not be examined; else null.
        pub unreadable: Option<String>,
        /// Codes of the errors that are of no module, sorted.
        pub codes: Vec<String>,
        /// Its modules.
        pub modules: Vec<RobotModule>,
    }

    /// A URDF that has no URDD as it is: a producer refuses it, or repairs it and carries the repaired text.
    pub struct RefusedScore {
        /// Its name: the rule that every URDD of it would break, a slash and a name.
        pub robot: String,
        /// What came of it.
        pub status: ScoreStatus,
        /// Why it is skipped; else null.
        pub skipped_since: Option<String>,
        /// What the command did.
        pub outcome: RefusedOutcome,
        /// How the command ended.
        pub end: String,
        /// The last part of what it printed to standard output; null where this passed.
        pub stdout: Option<String>,
        /// The last part of what it printed to standard error; null where this passed.
        pub stderr: Option<String>,
        /// Why the URDD could not be examined; else null.
        pub unreadable: Option<String>,
        /// Codes of the errors in the URDD that it wrote, sorted.
        pub codes: Vec<String>,
    }

    /// What a producer did with a URDF that has no URDD as it is.
    pub enum RefusedOutcome {
        /// It ended with another exit status than 0, said why, and left nothing at the output.
        Refused = "refused",
        /// It wrote a URDD without errors, which carries the repaired text.
        Repaired = "repaired",
        /// It ended with exit status 0, without a URDD that passes and carries its source.
        Written = "written",
        /// It ended with another exit status than 0, and something is at the output.
        LeftOver = "left_over",
        /// It ended with another exit status than 0, and did not say why.
        Silent = "silent",
        /// It did not start, ended by a signal or at the time limit, or printed what an interpreter prints of an uncaught
        /// exception.
        Crashed = "crashed",
    }

    /// A module of one robot.
    pub struct RobotModule {
        /// Its name.
        pub name: String,
        /// What came of it.
        pub status: ModuleStatus,
        /// Why it is skipped; else null.
        pub skipped_since: Option<String>,
        /// Codes of the errors, sorted.
        pub codes: Vec<String>,
        /// The first error, with its place; null where there is none.
        pub first: Option<String>,
    }

    /// What came of something.
    pub enum ScoreStatus {
        /// As it should be.
        Passed = "passed",
        /// Not as it should be.
        Failed = "failed",
        /// Not as it should be, and on the skip list.
        Skipped = "skipped",
    }

    /// What came of a module.
    pub enum ModuleStatus {
        /// It is there, without errors.
        Passed = "passed",
        /// It is there, with errors.
        Failed = "failed",
        /// It is not there, and the class asks for it.
        Missing = "missing",
    }

    /// A conformance class.
    pub struct ClassScore {
        /// Which.
        pub class: ConformanceClass,
        /// Robots whose modules of this class are all present and without errors.
        pub passed: Count,
        /// Robots that were run.
        pub of: Count,
    }

    /// A module, over all robots.
    pub struct ModuleScore {
        /// Its name.
        pub name: String,
        /// Robots that have it.
        pub present: Count,
        /// Robots that have it without errors.
        pub passed: Count,
        /// Robots that have it with errors.
        pub failed: Count,
        /// Robots that were run.
        pub of: Count,
        /// Codes of the errors, sorted.
        pub codes: Vec<String>,
    }
}

module! {
    /// How somebody's validator did on our cases.
    pub struct ValidatorResult {
        /// The program that judged.
        pub tool: Tool,
        /// The version of the specification whose cases were run.
        pub spec_version: String,
        /// The command that was run, as it was given.
        pub command: Vec<String>,
        /// Whether every case except those skipped was judged correctly, and no skip is stale.
        pub passed: bool,
        /// Sums over all cases of version 1.
        pub totals: CaseScore,
        /// Sums over valid URDDs and near misses of version 1: those of these that are rejected are false alarms.
        pub sound: CaseScore,
        /// Sums over all legacy cases: URDDs from before there was a specification.
        pub legacy: CaseScore,
        /// Sums by family of rules; valid URDDs are of none.
        pub families: Vec<GroupScore>,
        /// Sums by code.
        pub codes: Vec<GroupScore>,
        /// The codes that the command printed; null where it printed none for any case. They decide nothing above.
        pub printed_codes: Option<PrintedCodes>,
        /// Every case that was judged incorrectly, by id.
        pub wrong: Vec<WrongCase>,
        /// Cases that were rejected by a command that seems to have crashed: it printed what an interpreter prints of an
        /// uncaught exception. They count as rejected.
        pub crashed: Vec<String>,
        /// Cases that this operating system cannot have on disk.
        pub not_run: Vec<String>,
        /// Entries of the skip list whose cases are now judged correctly, or that name no case that was run.
        pub stale_skips: Vec<String>,
        /// The profile whose cases alone were run; null for a whole validator.
        pub profile: Option<ValidatorProfile>,
        /// Sums over URDDs that cannot be read, and near misses of these. They count nowhere above.
        pub unreadable: UnreadableScore,
        /// Cases of which the command said that they are not verified, as the specification allows: neither right nor wrong.
        pub unverified: Vec<String>,
        /// Cases that were called unreadable by a command that seems to have crashed. They count as that verdict.
        pub crashed_unreadable: Vec<String>,
        /// The class whose cases alone were run (SPEC 12.2); null for a whole validator, or one of a profile.
        pub class: Option<ConformanceClass>,
    }

    /// A part of the specification that a validator can be limited to.
    pub enum ValidatorProfile {
        /// Core modules, by their JSON and the source alone: SPEC 12.3.
        CoreJson = "core-json",
    }

    /// How URDDs were judged that cannot be read, and near misses of these, which can.
    pub struct UnreadableScore {
        /// All that were run.
        pub of: Count,
        /// As the suite does.
        pub right: Count,
        /// Accepted, and cannot be read.
        pub missed: Count,
        /// Rejected like a URDD that breaks a rule, and cannot be read. Wrong only where a status for this was asked for.
        pub rejected: Count,
        /// Not accepted, and to be accepted.
        pub false_alarms: Count,
        /// Neither accepted, nor rejected, nor unreadable.
        pub undecided: Count,
        /// Every case that was judged incorrectly, by id.
        pub wrong: Vec<UnreadableCase>,
    }

    /// A case of the third verdict that was judged incorrectly.
    pub struct UnreadableCase {
        /// Its id.
        pub id: String,
        /// In words.
        pub title: String,
        /// How it was judged.
        pub fault: UnreadableFault,
        /// How the command ended.
        pub end: String,
        /// The last part of what it printed to standard error.
        pub stderr: String,
        /// Why it is skipped; else null.
        pub skipped_since: Option<String>,
    }

    /// How a case of the third verdict was judged incorrectly.
    pub enum UnreadableFault {
        /// Accepted, and cannot be read.
        Missed = "missed",
        /// Rejected like a URDD that breaks a rule, and cannot be read.
        Rejected = "rejected",
        /// Not accepted, and to be accepted.
        FalseAlarm = "false_alarm",
        /// Neither accepted, nor rejected, nor unreadable: another exit status, a signal, the time limit.
        Undecided = "undecided",
    }

    /// How many cases were judged how.
    pub struct CaseScore {
        /// All that were run.
        pub of: Count,
        /// As the suite does.
        pub right: Count,
        /// Accepted, and to be rejected.
        pub missed: Count,
        /// Rejected, and to be accepted.
        pub false_alarms: Count,
        /// Neither accepted nor rejected.
        pub undecided: Count,
        /// Not verified, as the specification allows: neither right nor wrong.
        pub unverified: Count,
    }

    /// The score of a family or a code.
    pub struct GroupScore {
        /// The family's three letters, or the code.
        pub name: String,
        /// The score.
        pub score: CaseScore,
    }

    /// How many cases have the right code among those that the command printed: the case's own where it is to be
    /// rejected, and not that one where it is a near miss. Other codes count nothing. Legacy cases are left out.
    pub struct PrintedCodes {
        /// All that were run, except valid URDDs and cases of warnings and informations.
        pub of: Count,
        /// Those with the right code.
        pub right: Count,
        /// Ids of cases to be rejected, whose code was not printed.
        pub missing: Vec<String>,
        /// Ids of near misses, whose code was printed.
        pub extra: Vec<String>,
    }

    /// A case that was judged incorrectly.
    pub struct WrongCase {
        /// Its id.
        pub id: String,
        /// In words.
        pub title: String,
        /// How it was judged.
        pub fault: CaseFault,
        /// How the command ended.
        pub end: String,
        /// The last part of what it printed to standard error.
        pub stderr: String,
        /// Why it is skipped; else null.
        pub skipped_since: Option<String>,
    }

    /// How a case was judged incorrectly.
    pub enum CaseFault {
        /// Accepted, and to be rejected.
        Missed = "missed",
        /// Rejected, and to be accepted.
        FalseAlarm = "false_alarm",
        /// Neither accepted nor rejected: another exit status, a signal, the time limit.
        Undecided = "undecided",
    }
}
