//! The validator: checks a URDD from any producer against the specification.
//!
//! [`validate`] finds URDDs and runs every rule over each; what comes out is a [`Run`], plain
//! data. Rules are one file each, in `rules/`.
//!
//! ```
//! use urdd_format::report::Severity;
//! use urdd_validate::{settings::Settings, validate};
//!
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("toy");
//! # testkit::fixture::Fixture::toy().write_to(&path);
//! let run = validate(&[path], &Settings::default())?; // URDDs, and folders with URDDs at any depth
//! let report = run.report(Severity::Error);
//! for finding in report.urdds.iter().flat_map(|urdd| &urdd.findings) {
//!     println!("{}: {}", finding.code, finding.message);
//! }
//! assert_eq!(report.urdds[0].findings, []);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bare_urdf;
mod bound;
pub mod code;
mod context;
mod distances;
#[doc(hidden)]
pub mod engine;
mod find_errors;
#[doc(hidden)]
pub mod finding;
mod fold;
#[doc(hidden)]
pub mod learned;
mod locate;
mod model_verified;
mod names;
mod needs;
#[doc(hidden)]
pub mod part;
mod place;
#[doc(hidden)]
pub mod reference;
pub mod report;
#[doc(hidden)]
pub mod rule;
#[doc(hidden)]
pub mod rules;
mod scope;
pub mod selection;
pub mod settings;
#[doc(hidden)]
pub mod skip;
#[doc(hidden)]
pub mod solids;
mod tolerance;
mod two_robots;
mod unverified;
#[doc(hidden)]
pub mod urdf_text;
mod views;
mod worst;

pub use find_errors::find_errors;
use model_verified::{ModelVerdict, verify_model};

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use thiserror::Error;

use self::context::Context;
use self::engine::{Check, Outcome};
use self::rule::Rule;
use self::settings::{Settings, StaleIgnore};
use urdd_directory::cancellation::Cancelled;
use urdd_directory::discover::{DiscoverError, Found, discover};
use urdd_directory::root::{ReadError, Root};
use urdd_directory::source::Source;
use urdd_document::urdd::Urdd;
use urdd_format::registry::Profile;

/// A module of an examined URDD.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExaminedModule {
    /// Its name.
    pub name: String,
    /// Its folder, relative to the URDD's root.
    pub path: String,
    /// Its version; `None` where it has none.
    pub version: Option<String>,
    /// The family of formats it is of; `None` for extensions and unknown modules.
    pub profile: Option<Profile>,
}

/// What was examined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A URDD.
    Urdd,
    /// A URDF by itself.
    Urdf,
}

/// A URDD, or a URDF by itself, that was examined.
pub struct Examined {
    /// How it is called: its path from the folder that was searched.
    pub name: String,
    /// How the program crashed outside of any rule, where it did.
    pub crashed: Option<String>,
    /// The robot's name, where a module says it.
    pub robot_name: Option<String>,
    /// Number of links, joints and DOFs, where modules say them.
    pub size: RobotSize,
    /// Its modules.
    pub modules: Vec<ExaminedModule>,
    /// Every rule and what became of it, in order of code; settings applied.
    pub checks: Vec<Check>,
}

/// How large a robot is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RobotSize {
    /// Number of links.
    pub links: Option<usize>,
    /// Number of joints.
    pub joints: Option<usize>,
    /// Number of degrees of freedom.
    pub dofs: Option<usize>,
}

/// A URDD that was found, and what came of examining it.
pub struct Subject {
    /// What it is.
    pub kind: Kind,
    /// Where it was found.
    pub found: Found,
    /// What was found, or why it could not be examined.
    pub result: Result<Examined, ReadError>,
}

/// What came of a run.
pub struct Run {
    /// Every URDD, in the order of the paths given, then by name.
    pub subjects: Vec<Subject>,
    /// How many URDDs the settings exclude.
    pub excluded: usize,
    /// Ignores of the settings that matched nothing.
    pub stale_ignores: Vec<StaleIgnore>,
}

/// Why nothing came of a run.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ValidateError {
    /// Under one of the paths there is nothing to examine.
    #[error(transparent)]
    Discover(#[from] DiscoverError),
    /// It was asked to stop: [`Settings::cancellation`].
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Examines every URDD at or below each of the paths, in parallel, with every rule.
///
/// # Errors
/// Where under one of the paths there is nothing to examine, and where it is asked to stop.
pub fn validate<P: AsRef<Path>>(paths: &[P], settings: &Settings) -> Result<Run, ValidateError> {
    validate_with(paths, settings, &rules::all())
}

/// As [`validate`], with rules of your choice.
///
/// # Errors
/// As [`validate`].
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
    let excluded = all - found.len();
    let kept = bound::of_each(found.len());
    let mut subjects: Vec<Subject> = found
        .into_par_iter()
        .map(|(kind, found)| {
            let mut result = caught(&found, || match kind {
                Kind::Urdd => examine(&found, settings, rules),
                Kind::Urdf => bare_urdf::examine(&found, rules),
            });
            if let Ok(examined) = &mut result {
                bound::trim(examined, kept);
            }
            Subject {
                kind,
                found,
                result,
            }
        })
        .collect();
    settings.cancellation.check()?;
    let stale_ignores = settings.apply(
        subjects
            .iter_mut()
            .filter_map(|subject| subject.result.as_mut().ok()),
    );
    for subject in &mut subjects {
        if let Ok(examined) = &mut subject.result {
            settings.selection.apply(&mut examined.checks);
        }
    }
    Ok(Run {
        subjects,
        excluded,
        stale_ignores,
    })
}

/// Examines the URDD whose files a source holds, with every rule. `name` is what it is called in the report. Excludes do
/// not count.
///
/// # Errors
/// [`ValidateError::Cancelled`] where it is asked to stop.
pub fn validate_source(
    source: impl Source + 'static,
    name: &str,
    settings: &Settings,
) -> Result<Run, ValidateError> {
    let found = Found {
        path: PathBuf::from(name),
        name: name.to_owned(),
        closed: None,
    };
    let root = Root::of(source);
    let examine = || examine_urdd(Urdd::of(root)?, &found, settings, &rules::all());
    let mut result = caught(&found, examine);
    settings.cancellation.check()?;
    let mut stale_ignores = Vec::new();
    if let Ok(examined) = &mut result {
        bound::trim(examined, bound::of_each(1));
        stale_ignores = settings.apply(std::iter::once(&mut *examined));
        settings.selection.apply(&mut examined.checks);
    }
    Ok(Run {
        subjects: vec![Subject {
            kind: Kind::Urdd,
            found,
            result,
        }],
        excluded: 0,
        stale_ignores,
    })
}

/// Examines, and where that crashes outside of any rule says so of this URDD: the others have their
/// reports all the same.
fn caught(
    found: &Found,
    examine: impl FnOnce() -> Result<Examined, ReadError>,
) -> Result<Examined, ReadError> {
    catch_unwind(AssertUnwindSafe(examine)).unwrap_or_else(|panic| {
        Ok(Examined {
            name: found.name.clone(),
            crashed: Some(engine::panic_message(&*panic)),
            robot_name: None,
            size: RobotSize::default(),
            modules: Vec::new(),
            checks: Vec::new(),
        })
    })
}

fn examine(
    found: &Found,
    settings: &Settings,
    rules: &[&'static Rule],
) -> Result<Examined, ReadError> {
    if let Some(error) = &found.closed {
        return Err(error.clone());
    }
    examine_urdd(Urdd::read(&found.path)?, found, settings, rules)
}

fn examine_urdd(
    urdd: Urdd,
    found: &Found,
    settings: &Settings,
    rules: &[&'static Rule],
) -> Result<Examined, ReadError> {
    let context = Context::new(urdd, settings.class)
        .deep(settings.deep)
        .until(&settings.cancellation);
    let checks = two_robots::run(&context, rules);
    let modules = context
        .modules()
        .iter()
        .map(|module| ExaminedModule {
            name: module.name().to_owned(),
            path: module.folder.clone(),
            version: module.version.clone(),
            profile: module.spec.map(|spec| spec.profile),
        })
        .collect();
    let robot = context.robot();
    let size = RobotSize {
        links: robot.map(|robot| robot.links.len()),
        joints: robot.map(|robot| robot.joints.len()),
        dofs: context.dofs().map(|dofs| dofs.num_dofs.get()),
    };
    let robot_name = robot
        .map(|robot| robot.name.clone())
        .or_else(|| context.metadata().map(|m| m.robot_name.clone()));
    Ok(Examined {
        name: found.name.clone(),
        crashed: None,
        robot_name,
        size,
        modules,
        checks,
    })
}

impl Examined {
    /// Whether the program crashed, so that the URDD was not fully examined.
    pub fn incomplete(&self) -> bool {
        let mut checks = self.checks.iter();
        self.crashed.is_some() || checks.any(|check| matches!(check.outcome, Outcome::Crashed(_)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crash_outside_of_any_rule_is_said_of_its_urdd() {
        let found = Found {
            path: "a".into(),
            name: "a".to_owned(),
            closed: None,
        };
        let examined = caught(&found, || panic!("at index {}", 7)).expect("examined");
        assert!(examined.incomplete());
        assert_eq!(examined.crashed.as_deref(), Some("at index 7"));
    }
}
