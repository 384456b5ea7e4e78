//! The validator: checks a URDD from any producer against the specification.
//!
//! [`validate`] finds URDDs and runs every rule on each. The result is a [`Run`], plain data. Rules are one file each,
//! in [`rules`].

pub mod bare_urdf;
mod bound;
pub mod code;
pub mod context;
pub mod distances;
pub mod engine;
mod find_errors;
pub mod finding;
pub mod fold;
pub mod learned;
mod locate;
mod model_verified;
mod names;
pub mod needs;
pub mod part;
pub mod place;
pub mod reference;
pub mod report;
pub mod rule;
pub mod rules;
pub mod scope;
pub mod selection;
pub mod settings;
pub mod skip;
pub mod solids;
pub mod tolerance;
mod two_robots;
mod unverified;
pub mod urdf_text;
pub mod views;
mod worst;

pub use find_errors::find_errors;
pub use model_verified::{ModelVerdict, verify_model};

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
    /// Its version; `None` if it has none.
    pub version: Option<String>,
    /// Its format family; `None` for extensions and unknown modules.
    pub profile: Option<Profile>,
}

/// The kinds of subject.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A URDD.
    Urdd,
    /// A URDF on its own.
    Urdf,
}

/// An examined URDD, or an examined URDF on its own.
pub struct Examined {
    /// Its name: the path from the folder that was searched.
    pub name: String,
    /// How the program crashed outside of any rule, if it did.
    pub crashed: Option<String>,
    /// The robot's name, if a module states it.
    pub robot_name: Option<String>,
    /// Number of links, joints and DOFs, if modules state them.
    pub size: RobotSize,
    /// Its modules.
    pub modules: Vec<ExaminedModule>,
    /// Every rule with its outcome, by code; settings applied.
    pub checks: Vec<Check>,
}

/// The size of a robot.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RobotSize {
    /// Number of links.
    pub links: Option<usize>,
    /// Number of joints.
    pub joints: Option<usize>,
    /// Number of degrees of freedom.
    pub dofs: Option<usize>,
}

/// A URDD that was found, and the result of examining it.
pub struct Subject {
    /// Its kind.
    pub kind: Kind,
    /// Where it was found.
    pub found: Found,
    /// The result, or why it could not be examined.
    pub result: Result<Examined, ReadError>,
}

/// The result of a run.
pub struct Run {
    /// Every URDD, in the order of the paths given, then by name.
    pub subjects: Vec<Subject>,
    /// Number of URDDs that the settings exclude.
    pub excluded: usize,
    /// Ignores of the settings that matched nothing.
    pub stale_ignores: Vec<StaleIgnore>,
}

/// Why a run has no result.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ValidateError {
    /// A path contains nothing to examine.
    #[error(transparent)]
    Discover(#[from] DiscoverError),
    /// The run was cancelled: [`Settings::cancellation`].
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Examines every URDD at or below each path, in parallel, with every rule.
///
/// # Errors
/// If a path contains nothing to examine, or the run is cancelled.
pub fn validate<P: AsRef<Path>>(paths: &[P], settings: &Settings) -> Result<Run, ValidateError> {
    validate_with(paths, settings, &rules::all())
}

/// Like [`validate`], with the given rules.
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

/// Examines the URDD in a source, with every rule. `name` is its name in the report. Excludes do not apply.
///
/// # Errors
/// [`ValidateError::Cancelled`] if it is cancelled.
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

/// Runs an examination. A crash outside of any rule is recorded for this URDD, and the others are still reported.
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
    /// Whether a crash prevented a complete examination.
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
