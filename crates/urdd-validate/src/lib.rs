//! The validator: checks a URDD from any producer against the specification.
//!
//! [`validate`] finds URDDs and runs every rule over each; what comes out is a [`Run`], plain
//! data. Rules are one file each, in `rules/`.
//!
//! ```
//! use urdd_validate::{settings::Settings, validate};
//!
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("toy");
//! # testkit::fixture::Fixture::toy().write_to(&path);
//! let run = validate(&[path], &Settings::default())?; // URDDs, and folders with URDDs at any depth
//! for finding in run.report.urdds.iter().flat_map(|urdd| &urdd.findings) {
//!     println!("{}: {}", finding.code, finding.message);
//! }
//! assert_eq!(run.report.urdds[0].findings, []);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[doc(hidden)]
pub mod bare_urdf;
#[doc(hidden)]
pub mod bound;
pub mod code;
#[doc(hidden)]
pub mod consequence;
#[doc(hidden)]
pub mod context;
#[doc(hidden)]
pub mod distances;
#[doc(hidden)]
pub mod effect;
pub mod engine;
mod examined;
mod find_errors;
#[doc(hidden)]
pub mod finding;
#[doc(hidden)]
pub mod fold;
#[doc(hidden)]
pub mod learned;
mod locate;
mod memo;
#[doc(hidden)]
pub mod memory;
mod model_verified;
mod names;
mod needs;
#[doc(hidden)]
pub mod part;
#[doc(hidden)]
pub mod places;
#[doc(hidden)]
pub mod reference;
pub mod report;
#[doc(hidden)]
pub mod rule;
#[doc(hidden)]
pub mod rules;
#[doc(hidden)]
pub mod scope;
pub mod selection;
pub mod settings;
pub mod settings_file;
#[doc(hidden)]
pub mod skip;
#[doc(hidden)]
pub mod solids;
#[doc(hidden)]
pub mod tolerance;
mod two_robots;
mod unverified;
#[doc(hidden)]
pub mod urdf_text;
#[doc(hidden)]
pub mod views;
#[doc(hidden)]
pub mod worst;

pub use examined::Examined;
pub use find_errors::find_errors;

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use thiserror::Error;

use self::context::Context;
use self::rule::{Description, Rule};
use self::settings::Settings;
use urdd_directory::cancellation::Cancelled;
use urdd_directory::discover::{DiscoverError, discover};
use urdd_directory::root::{ReadError, Root};
use urdd_directory::source::Source;
use urdd_document::urdd::Urdd;
use urdd_format::index::Count;
use urdd_format::report::{self as format, Kind, Module, Report, Size, Verdict};

/// The result of a run.
pub struct Run {
    /// The report.
    pub report: Report,
    /// The folder of each URDD of the report. The report itself has no absolute paths.
    pub folders: Vec<PathBuf>,
    /// Number of URDDs that the settings exclude.
    pub excluded: usize,
    rules: BTreeMap<&'static str, &'static Description>,
}

impl Run {
    /// The report on what was examined in these folders, with the settings applied.
    #[doc(hidden)]
    pub fn of(
        examined: Vec<Examined>,
        folders: Vec<PathBuf>,
        excluded: usize,
        settings: &Settings,
    ) -> Run {
        let checks = examined.iter().flat_map(|one| &one.checks);
        Run {
            rules: checks.map(|check| (check.rule.code.as_str(), check.rule)).collect(),
            report: report::fill(examined, settings),
            folders,
            excluded,
        }
    }

    /// What a rule that ran says of itself, by its code.
    pub fn rule(&self, code: &str) -> Option<&'static Description> {
        self.rules.get(code).copied()
    }
}

/// Why a run has no result.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ValidateError {
    /// One of the paths has nothing to examine.
    #[error(transparent)]
    Discover(#[from] DiscoverError),
    /// Cancelled through [`Settings::cancellation`].
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Examines every URDD at or below each path, in parallel, with every rule.
///
/// # Errors
/// If one of the paths has nothing to examine, or the run is cancelled.
pub fn validate<P: AsRef<Path>>(paths: &[P], settings: &Settings) -> Result<Run, ValidateError> {
    validate_with(paths, settings, &rules::all())
}

/// As [`validate`], with the given rules.
///
/// # Errors
/// Like [`validate`].
pub fn validate_with<P: AsRef<Path>>(
    paths: &[P],
    settings: &Settings,
    rules: &[&'static Rule],
) -> Result<Run, ValidateError> {
    let mut found = Vec::new();
    for path in paths {
        match bare_urdf::is_urdf(path.as_ref()) {
            true => found.push((Kind::Urdf, bare_urdf::found(path.as_ref()))),
            false => {
                let below = discover(path.as_ref())?;
                found.extend(below.into_iter().map(|found| (Kind::Urdd, found)));
            }
        }
    }
    let all = found.len();
    found.retain(|(_, found)| {
        let mut excludes = settings.excludes.iter();
        !excludes.any(|exclude| exclude.matches(&found.name))
    });
    let kept = bound::of_each(found.len());
    let examined = found.par_iter().map(|(kind, found)| {
        let mut examined = caught(*kind, &found.name, || match (kind, &found.closed) {
            (Kind::Urdf, _) => bare_urdf::examine(found, rules),
            (Kind::Urdd, Some(error)) => Err(error.clone()),
            (Kind::Urdd, None) => {
                Ok(examine(Urdd::read(&found.path)?, &found.name, settings, rules))
            }
        });
        bound::trim(&mut examined.checks, kept);
        examined
    });
    let examined = examined.collect();
    settings.cancellation.check()?;
    let excluded = all - found.len();
    let folders = found.into_iter().map(|(_, found)| found.path);
    Ok(Run::of(examined, folders.collect(), excluded, settings))
}

/// Examines the URDD of a source with every rule. `name` is its name in the report. Ignores [`Settings::excludes`].
///
/// # Errors
/// [`ValidateError::Cancelled`] if the run is cancelled.
pub fn validate_source(
    source: impl Source + 'static,
    name: &str,
    settings: &Settings,
) -> Result<Run, ValidateError> {
    let root = Root::of(source);
    let mut examined =
        caught(Kind::Urdd, name, || Ok(examine(Urdd::of(root)?, name, settings, &rules::all())));
    settings.cancellation.check()?;
    bound::trim(&mut examined.checks, bound::of_each(1));
    let folders = vec![PathBuf::from(name)];
    Ok(Run::of(vec![examined], folders, 0, settings))
}

/// Examines a URDD. If it cannot be read, or if the program crashes outside a rule, its report says so; the other URDDs
/// still have their reports.
#[doc(hidden)]
pub fn caught(
    kind: Kind,
    name: &str,
    examine: impl FnOnce() -> Result<Examined, ReadError>,
) -> Examined {
    let without_checks = |verdict, reason| {
        let mut report = report::blank(kind, name);
        (report.verdict, report.reason) = (verdict, Some(reason));
        Examined { report, checks: Vec::new() }
    };
    match catch_unwind(AssertUnwindSafe(examine)) {
        Ok(Ok(examined)) => examined,
        Ok(Err(error)) => without_checks(Verdict::Unreadable, error.to_string()),
        Err(panic) => {
            let message = engine::panic_message(&*panic);
            let reason = format!(
                "the program crashed: {message}; this is a bug in the program, please report it"
            );
            without_checks(Verdict::Incomplete, reason)
        }
    }
}

/// Runs the rules over a URDD. `name` is its name in the report. Of the settings, only those that change what the rules
/// compute apply here.
pub fn examine(urdd: Urdd, name: &str, settings: &Settings, rules: &[&'static Rule]) -> Examined {
    let context =
        Context::new(urdd, settings.class).deep(settings.deep).until(&settings.cancellation);
    let checks = two_robots::run(&context, rules);
    let modules = context.modules().map(|module| Module {
        name: module.name().to_owned(),
        path: module.folder.clone(),
        version: module.version.clone(),
        profile: module.spec.map(|spec| spec.profile.as_str().to_owned()),
    });
    let robot = context.robot();
    let metadata = context.metadata();
    let report = format::Urdd {
        name: robot
            .map(|robot| &robot.name)
            .or(metadata.map(|metadata| &metadata.robot_name))
            .cloned(),
        size: Size {
            links: robot.map(|robot| Count::saturating(robot.links.len())),
            joints: robot.map(|robot| Count::saturating(robot.joints.len())),
            dofs: context.dofs().map(|dofs| dofs.num_dofs),
        },
        modules: modules.collect(),
        ..report::blank(Kind::Urdd, name)
    };
    Examined { report, checks }
}
