//! The validator: checks a URDD from any producer against the specification.
//!
//! [`validate`] finds URDDs and runs every rule over each; what comes out is a [`Run`], plain
//! data. Rules are in `rules/`.
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

mod bare_urdf;
#[doc(hidden)]
pub mod context;
#[doc(hidden)]
pub mod described;
mod engine;
#[doc(hidden)]
pub mod finding;
mod locate;
mod memo;
mod needs;
#[doc(hidden)]
pub mod reference;
#[doc(hidden)]
pub mod rule;
#[doc(hidden)]
pub mod rules;
#[doc(hidden)]
pub mod skip;
#[doc(hidden)]
pub mod solids;
mod summary;
#[doc(hidden)]
pub mod tolerance;
mod two_robots;
#[doc(hidden)]
pub mod views;

#[doc(hidden)]
pub use bare_urdf::{examine_urdf, found};
#[doc(hidden)]
pub use reference::{distances, learned, urdf_text};
pub use summary::{ModelVerdict, find_errors, verify_model};
pub use urdd_findings::run::Run;
pub use urdd_findings::{code, report, selection, settings, settings_file};

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rayon::prelude::*;
use thiserror::Error;

use self::context::Context;
use self::rule::Rule;
use self::settings::Settings;
use urdd_directory::cancellation::Cancelled;
use urdd_directory::discover::{DiscoverError, discover};
use urdd_directory::root::{ReadError, Root};
use urdd_directory::source::Source;
use urdd_document::load::Loaded;
use urdd_document::urdd::Urdd;
use urdd_findings::examined::Examined;
use urdd_findings::places;
use urdd_format::report::Kind;
use urdd_xml::Xml;

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
        let path = path.as_ref();
        if bare_urdf::is_urdf(path) {
            found.push((Kind::Urdf, bare_urdf::found(path)));
        } else {
            found.extend(discover(path)?.into_iter().map(|found| (Kind::Urdd, found)));
        }
    }
    let all = found.len();
    found.retain(|(_, found)| {
        let mut excludes = settings.excludes.iter();
        !excludes.any(|exclude| exclude.matches(&found.name))
    });
    let kept = places::of_each(found.len());
    let examined = found.par_iter().map(|(kind, found)| {
        let mut examined = Examined::caught(*kind, &found.name, || match (kind, &found.closed) {
            (Kind::Urdf, _) => bare_urdf::examine(found, rules),
            (Kind::Urdd, Some(error)) => Err(error.clone()),
            (Kind::Urdd, None) => {
                Ok(examine(Urdd::read(&found.path)?, &found.name, settings, rules))
            }
        });
        places::trim(&mut examined.checks, kept);
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
    run_of(name, settings, None, || Urdd::of(Root::of(source)))
}

/// As [`validate_source`], of a URDD that is loaded. `xml` is the text of its source URDF, if somebody has parsed it.
///
/// # Errors
/// Like [`validate_source`].
#[doc(hidden)]
pub fn validate_loaded(
    loaded: Arc<Loaded>,
    name: &str,
    settings: &Settings,
    xml: Option<&Xml<'_>>,
) -> Result<Run, ValidateError> {
    run_of(name, settings, xml.map(urdf_text::of), || Ok(Urdd::new(loaded)))
}

fn run_of(
    name: &str,
    settings: &Settings,
    urdf: Option<urdf_text::Reading>,
    load: impl FnOnce() -> Result<Urdd, ReadError>,
) -> Result<Run, ValidateError> {
    let examined = Examined::caught::<ReadError>(Kind::Urdd, name, || {
        Ok(examine_with(load()?, urdf, name, settings, &rules::all()))
    });
    settings.cancellation.check()?;
    Ok(alone(examined, name.into(), settings))
}

/// A run of one URDD or URDF.
#[doc(hidden)]
pub fn alone(mut examined: Examined, path: PathBuf, settings: &Settings) -> Run {
    places::trim(&mut examined.checks, places::of_each(1));
    Run::of(vec![examined], vec![path], 0, settings)
}

/// Runs the rules over a URDD. `name` is its name in the report. Of the settings, only those that change what the rules
/// compute apply here.
pub fn examine(urdd: Urdd, name: &str, settings: &Settings, rules: &[&'static Rule]) -> Examined {
    examine_with(urdd, None, name, settings, rules)
}

fn examine_with(
    urdd: Urdd,
    urdf: Option<urdf_text::Reading>,
    name: &str,
    settings: &Settings,
    rules: &[&'static Rule],
) -> Examined {
    let context = Context::new(urdd, settings.class).knowing(urdf);
    let context = context.deep(settings.deep).until(&settings.cancellation);
    context.examined(name, two_robots::run(&context, rules))
}
