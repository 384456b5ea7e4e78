//! The validator: checks a URDD from any producer against the specification.
//!
//! [`validate`] finds URDDs and runs every rule over each; what comes out is a [`Report`], plain
//! data. Rules are one file each, in [`rules`].

pub mod code;
pub mod context;
pub mod distances;
pub mod engine;
pub mod finding;
pub mod fold;
pub mod reference;
pub mod rule;
pub mod rules;
pub mod settings;
pub mod skip;
pub mod solids;
pub mod tolerance;
mod two_robots;
pub mod urdf_text;
pub mod views;

use std::path::Path;

use rayon::prelude::*;

use self::context::Context;
use self::engine::{Check, Outcome};
use self::rule::Rule;
use self::settings::{Settings, StaleIgnore};
use crate::directory::discover::{DiscoverError, Found, discover};
use crate::directory::root::ReadError;
use crate::document::urdd::Urdd;
use crate::format::registry::Profile;

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

/// A URDD that was examined.
pub struct Examined {
    /// How it is called: its path from the folder that was searched.
    pub name: String,
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
    /// Where it was found.
    pub found: Found,
    /// What was found, or why it could not be examined.
    pub result: Result<Examined, ReadError>,
}

/// What came of a run.
pub struct Report {
    /// Every URDD, in the order of the paths given, then by name.
    pub subjects: Vec<Subject>,
    /// Ignores of the settings that matched nothing.
    pub stale_ignores: Vec<StaleIgnore>,
}

/// Examines every URDD at or below each of the paths, in parallel, with every rule.
///
/// # Errors
/// Where under one of the paths there is nothing to examine.
pub fn validate<P: AsRef<Path>>(paths: &[P], settings: &Settings) -> Result<Report, DiscoverError> {
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
) -> Result<Report, DiscoverError> {
    let mut found = Vec::new();
    for path in paths {
        found.extend(discover(path.as_ref())?);
    }
    let mut subjects: Vec<Subject> = found
        .into_par_iter()
        .map(|found| {
            let result = examine(&found, settings, rules);
            Subject { found, result }
        })
        .collect();
    let stale_ignores = settings.apply(
        subjects
            .iter_mut()
            .filter_map(|subject| subject.result.as_mut().ok()),
    );
    Ok(Report {
        subjects,
        stale_ignores,
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
    let urdd = Urdd::read(&found.path)?;
    let context = Context::new(urdd, settings.class).deep(settings.deep);
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
        robot_name,
        size,
        modules,
        checks,
    })
}

impl Examined {
    /// Whether a rule crashed, so that the URDD was not fully examined.
    pub fn incomplete(&self) -> bool {
        self.checks
            .iter()
            .any(|check| matches!(check.outcome, Outcome::Crashed(_)))
    }
}
