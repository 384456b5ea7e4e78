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

#[doc(hidden)]
pub mod context;
mod engine;
mod locate;
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
#[doc(hidden)]
pub mod tolerance;
#[doc(hidden)]
pub mod views {
    //! Data that several rules use: schemas of extensions and what their annotations say, shapes and pairs of shapes.

    pub mod annotated;
    pub mod enclosure;
    pub mod extension_schema;
    pub mod judged;
    mod pattern;
    mod schema_work;
    pub mod shared_meshes;
    pub mod tangled;
}

#[doc(hidden)]
pub use engine::examine_urdf;
#[doc(hidden)]
pub use reference::{distances, learned, urdf_text};
pub use urdd_findings::run::Run;
pub use urdd_findings::{code, report, selection, settings, settings_file};

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use thiserror::Error;

use self::code::Code;
use self::context::Context;
use self::rule::Rule;
use self::settings::Settings;
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_directory::discover::{DiscoverError, Found, discover};
use urdd_directory::file_type::RobotFile;
use urdd_directory::root::{ReadError, Root};
use urdd_directory::source::Source;
use urdd_directory::watched::{map_robots, watched};
use urdd_document::load::Loaded;
use urdd_document::urdd::Urdd;
use urdd_findings::answer;
use urdd_findings::check::Examined;
use urdd_findings::description::Severity;
use urdd_findings::places;
use urdd_format::report::{Kind, Status};
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
    let mut all = Vec::new();
    for path in paths {
        let path = path.as_ref();
        if path.is_file() && RobotFile::at(path) == Some(RobotFile::Urdf) {
            all.push((Kind::Urdf, found(path)));
        } else {
            all.extend(discover(path)?.into_iter().map(|found| (Kind::Urdd, found)));
        }
    }
    let excluded = all.len();
    all.retain(|(_, found)| !settings.excludes.iter().any(|exclude| exclude.matches(&found.name)));
    let excluded = excluded - all.len();
    let kept = places::of_each(all.len());
    let run = &settings.cancellation;
    let all_rules: Arc<[&'static Rule]> = rules.into();
    let one = |(kind, found): &(Kind, Found)| {
        let (kind, own, settings) = (*kind, found.clone(), settings.clone());
        let rules = Arc::clone(&all_rules);
        let work = move |cancellation: &Cancellation| {
            let settings = Settings { cancellation: cancellation.clone(), ..settings };
            let examine = || match (kind, &own.closed) {
                (Kind::Urdf, _) => engine::examine_urdf_file(&own, &rules),
                (Kind::Urdd, Some(error)) => Err(error.clone()),
                (Kind::Urdd, None) => {
                    Ok(examine(Urdd::read(&own.path)?, &own.name, &settings, &rules))
                }
            };
            Examined::caught(kind, &own.name, || examine().map_err(engine::unread))
        };
        let examined = watched(run, &found.name, work);
        let mut examined = examined.unwrap_or_else(|limit| {
            Examined::without_checks(kind, &found.name, answer::beyond(limit))
        });
        places::trim(&mut examined.checks, kept);
        examined
    };
    let examined = map_robots(run, &all, one);
    settings.cancellation.check()?;
    let folders = all.into_iter().map(|(_, found)| found.path);
    Ok(Run::of(examined, folders.collect(), excluded, settings))
}

/// The URDF at a path: its folder, and its file name.
#[doc(hidden)]
pub fn found(path: &Path) -> Found {
    // The target of a symbolic link can be in another folder.
    let target = path.is_symlink().then(|| path.canonicalize().unwrap_or_default());
    let path = target.as_deref().unwrap_or(path);
    let name = path.file_name().unwrap_or_default();
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    Found { path: folder.to_owned(), name: name.to_string_lossy().into_owned(), closed: None }
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
    let examined = Examined::caught(Kind::Urdd, name, || {
        Ok(examine_with(load().map_err(engine::unread)?, urdf, name, settings, &rules::all()))
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
    let context = Context::new(urdd, urdf, settings);
    context.examined(name, engine::run(&context, rules))
}

/// The rules that find errors in a URDD, each with its number of findings, as text; empty if there are none. For a URDD
/// that cannot be examined, the reason.
///
/// # Errors
/// If cancelled.
pub fn find_errors(path: &Path, cancellation: &Cancellation) -> Result<Vec<String>, Cancelled> {
    let usual = Settings { cancellation: cancellation.clone(), ..Settings::default() };
    let run = match validate(&[path], &usual) {
        Ok(run) => run,
        Err(ValidateError::Cancelled(cancelled)) => return Err(cancelled),
        Err(error) => return Ok(vec![error.to_string()]),
    };
    let mut codes: BTreeMap<Option<Code>, usize> = BTreeMap::new();
    for urdd in run.report.urdds {
        if let Some(reason) = urdd.reason {
            return Ok(vec![reason]);
        }
        let errors = urdd.findings.iter();
        for finding in errors.filter(|finding| finding.severity == Severity::Error) {
            *codes.entry(Code::parse(&finding.code)).or_default() += 1;
        }
    }
    let codes = codes.into_iter().filter_map(|(code, count)| Some((code?, count)));
    let texts = codes.map(|(code, count)| match count {
        1 => format!("{code} (1 finding)"),
        _ => format!("{code} ({count} findings)"),
    });
    Ok(texts.collect())
}

/// The result of recounting the rates of a model (SPEC 8.8.9 to 8.8.12).
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ModelVerdict {
    /// The stated rates are right.
    Verified,
    /// The stated rates are wrong: the codes of the rules that found it.
    Refuted(Vec<String>),
    /// The rates were not verified, for these reasons.
    NotVerified(Vec<String>),
}

/// Runs the rules that verify the self-collision model of the URDD at `path`, and the rules that they need.
pub fn verify_model(path: &Path) -> ModelVerdict {
    let all = rules::all();
    let mut wanted = BTreeSet::from([Code::LRN010, Code::LRN011]);
    let mut open: Vec<Code> = wanted.iter().copied().collect();
    while let Some(code) = open.pop() {
        let needs = all.iter().filter(|rule| rule.code == code);
        let needs = needs.flat_map(|rule| rule.needs).flat_map(|need| need.codes());
        open.extend(needs.filter(|code| wanted.insert(*code)));
    }
    let wanted: Vec<&'static Rule> =
        all.into_iter().filter(|rule| wanted.contains(&rule.code)).collect();
    let urdd = match validate_with(&[path], &Settings::default(), &wanted) {
        Ok(run) => run.report.urdds.into_iter().next(),
        Err(error) => return ModelVerdict::NotVerified(vec![error.to_string()]),
    };
    let Some(urdd) = urdd else { return ModelVerdict::NotVerified(Vec::new()) };
    let failed = urdd.checks.iter().filter(|check| check.status == Status::Failed);
    let refuted: Vec<String> =
        failed.map(|check| check.code.clone()).filter(|code| code.starts_with("LRN")).collect();
    if !refuted.is_empty() {
        return ModelVerdict::Refuted(refuted);
    }
    let open = urdd.model_not_verified.into_iter().flat_map(|open| open.reasons);
    let reasons: Vec<String> = open.chain(urdd.reason).collect();
    if reasons.is_empty() { ModelVerdict::Verified } else { ModelVerdict::NotVerified(reasons) }
}
