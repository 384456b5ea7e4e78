//! What a person asks of a run of a validator.

use std::path::PathBuf;
use std::time::Duration;

use semver::Version;

use crate::process::Template;
use crate::skips::Skip;
use urdd_directory::cancellation::Cancellation;
use urdd_format::conformance::ValidatorProfile;

/// Settings of a validator run.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The command, with `{dir}` unless it is a batch.
    pub command: Template,
    /// Whether a process of the command judges many URDDs.
    pub is_batch: bool,
    /// The version of the specification that the validator implements.
    pub spec_version: Version,
    /// Time limit per URDD.
    pub limit: Duration,
    /// Known failures: a case, or all cases of a code or a family.
    pub skips: Vec<Skip>,
    /// Id prefixes of the cases to run; empty for all.
    pub only: Vec<String>,
    /// Whether to include legacy URDDs.
    pub legacy: bool,
    /// Whether to include cases about what cannot be read.
    pub unreadable: bool,
    /// The profile of the validator: only cases that it can decide are run; `None` for a whole one.
    pub profile: Option<ValidatorProfile>,
    /// The exit status for rejection.
    pub reject_status: i32,
    /// The exit status for what cannot be read; `None` for 2, where rejecting it is good enough too.
    pub unreadable_status: Option<i32>,
    /// Number of URDDs to judge in parallel; `None` for the number of processors.
    pub jobs: Option<usize>,
    /// A new folder that keeps the URDDs; `None` for a temporary one.
    pub keep: Option<PathBuf>,
    /// Cancels the run, with all running commands and their child processes.
    pub cancellation: Cancellation,
}
